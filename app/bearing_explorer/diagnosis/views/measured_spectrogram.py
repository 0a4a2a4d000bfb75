"""Spectrogram and order map of a measured signal, for speeds that change."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.diagnosis.signal import ENVELOPE_TOP
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.heat_map import Side, bright_image, ends
from bearing_explorer.kit.plots.layers import curve, draw
from bearing_explorer.kit.plots.levels import decibels
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.views.look_view import LookView
from bearing_explorer.kit.widgets.form import FieldSpec
from bearingcore.signals import FEWEST_SEGMENTS, Spectrogram, order_map, spectrogram

if TYPE_CHECKING:
    from bearing_explorer.diagnosis.model import Model
    from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.kit.widgets.form import stack

MOST_COLUMNS, MOST_ROWS = 220, 320
"""Of the picture."""
DEPTH_OF_VIEW = 50.0  # [dB]
SEGMENTS = 60.0
"""Of a spectrogram, one after the other."""
SEGMENT_LENGTHS = (64, 8192)
TOP_ORDER, ORDER_STEP = 20.0, 0.1
SPEED_TOP = 8.0
"""Turns of the shaft up to which a spectrogram shows a speed that changes."""
_SIDES = {
    "time": Side("", "Time", "t", "s"),
    "turns": Side("", "Turns of the shaft", "", ""),
    "frequency": Side("", "Frequency", "f", "Hz"),
    "order": Side("", "Order", "", ""),
}
_SAY = "return `${rounded(cell[0], 3)} dB`"
FIELDS: list[FieldSpec] = [
    {"name": "map", "label": "Show",
     "options": [["spectrogram", "spectrogram"], ["orders", "order map"]]},
    {"name": "of", "label": "of",
     "options": [["signal", "the signal"], ["envelope", "its envelope"]]},
    {"name": "last", "label": "Shaft speed at the end (Hz)",
     "hint": "the same", "within": ("The shaft speed at the end", "Hz", 0.1, 2000.0)},
]  # fmt: skip
_SPEED = curve("spectrogram_speed", "x", "y", "#FFFFFF", 1.6, (5, 4))


@dataclass(frozen=True)
class Shown:
    """A map: levels (columns, rows) [dB below the highest] at x and y, up to `top`."""

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    level: NDArray[np.float64]
    top: float


class MeasuredSpectrogram(LookView, MeasuredView):
    """Spectra over time, or over the turns of the shaft."""

    name = "measured-spectrogram"
    title = "Spectrogram and order map"
    about = (
        "Spectra over time, for speeds that change. Dashed: the shaft speed. An order map counts "
        "in turns of the shaft: lines of shaft and bearing stay level there at any speed. For a "
        "steady run-up or run-down give the shaft speed at the end, and check in the spectrogram "
        "that the dashed line lies on a line of the shaft."
    )
    look_fields = FIELDS
    first_look: ClassVar[dict[str, Any]] = {"map": "spectrogram", "of": "signal", "last": ""}

    def build(self, packed: PackedSource) -> Any:
        self._known: tuple[Any, Shown] | None = None
        plot = style.make_figure(
            _SIDES["time"].quantity,
            _SIDES["frequency"].quantity,
            packed.range("spectrogram_x", 0.0, 1.0),
            packed.range("spectrogram_y", 0.0, 1.0),
            height=320,
            name="spectrogram_drawing",
        )
        level = packed.range("spectrogram_level", -DEPTH_OF_VIEW, 0.0)
        sides, title = list(_SIDES.values()), "dB below the highest"
        self._image = bright_image(plot, packed, "spectrogram_cells", level, sides, _SAY, title)
        draw(plot, packed, [_SPEED])
        self.hidden = stack(self.panel_of_look, plot, visible=False)
        return self.hidden

    def speed(self, measured: Measured) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Times [s] and the shaft speed then [Hz]; NaN where it is not known."""
        own = self.shaft_speed
        first = math.nan if own is None else own / (2.0 * math.pi)
        last = float(self.look["last"] or first)
        return np.array([0.0, measured.recording.duration]), np.array([first, last])

    def too_short(self, measured: Measured) -> str:
        """Why there is no map, or an empty text."""
        time, speed = self.speed(measured)
        turns, needed = float(speed.mean() * time[-1]), FEWEST_SEGMENTS / ORDER_STEP
        if self.look["map"] == "spectrogram" or turns >= needed:
            return ""
        if math.isnan(turns):
            return "An order map needs the shaft speed, which is not known."
        return (
            f"An order map needs {needed:.0f} turns of the shaft, and the signal has "
            f"{style.number(turns, 2)}."
        )

    def shown(self, model: Model, measured: Measured) -> Shown:
        """The map as the look has it."""
        direction = self.direction_of(measured)
        band = None
        if self.look["of"] == "envelope":
            band = self.demodulation(measured, direction).band
        # a new look for each choice
        key = measured, self.look, direction, band, self.shaft_speed
        if self._known is None or self._known[0] != key:
            signal, rate = measured.column(direction), measured.recording.sample_rate
            if band is not None:
                signal, rate = measured.envelope_signal(direction, band)
            found, top = self._map(measured, signal, rate)
            kept = found.frequency <= top
            level = thinned(decibels(found.density[:, kept]))
            x, y = (
                np.linspace(values[0], values[-1], count)
                for values, count in zip(
                    (found.time, found.frequency[kept]), level.shape, strict=True
                )
            )
            self._known = key, Shown(x, y, level - level.max(), top)
        return self._known[1]

    def _map(
        self, measured: Measured, signal: NDArray[np.float64], rate: float
    ) -> tuple[Spectrogram, float]:
        """The map, and the highest frequency [Hz] or order that is drawn of it."""
        time, speed = self.speed(measured)
        if self.look["map"] == "orders":
            return order_map(signal, rate, time, speed, ORDER_STEP), TOP_ORDER
        if self.look["of"] == "envelope":
            step, top = max(5.0 / time[-1], 2.0), ENVELOPE_TOP
            if not math.isnan(speed[0]):
                step, top = max(5.0 / time[-1], 0.25 * speed[0]), TOP_ORDER * speed.max()
            return spectrogram(signal, rate, step), min(top, 0.5 * rate)
        least, most = SEGMENT_LENGTHS
        length = 2 ** round(math.log2(min(max(len(signal) / SEGMENTS, least), most)))
        return spectrogram(signal, rate, rate / length), 0.5 * rate

    def data_of(self, model: Model, measured: Measured) -> tuple[Sources, Ranges]:
        if self.too_short(measured):
            return {}, {}
        shown = self.shown(model, measured)
        orders = self.look["map"] == "orders"
        across, up = ("turns", "order") if orders else ("time", "frequency")
        cells = self._image.columns(
            (_SIDES[across], shown.x), (_SIDES[up], shown.y), [shown.level.T]
        )
        sources, top = {"spectrogram_cells": cells}, shown.top
        if not orders and self.look["last"] and self.shaft_speed is not None:
            time, speed = self.speed(measured)
            sources["spectrogram_speed"] = {"x": time, "y": speed}
            top = min(top, SPEED_TOP * float(speed.max()))
        ranges = {
            "spectrogram_x": ends(shown.x),
            "spectrogram_y": (0.0, top),
            "spectrogram_level": (-DEPTH_OF_VIEW, 0.0),
        }
        return sources, ranges

    def words_of(self, model: Model, measured: Measured) -> str:
        if why := self.too_short(measured):
            return why
        if self.shaft_speed is None:
            return "The shaft speed is not known."
        _, (first, last) = self.speed(measured)
        words = f"{style.number(first, 4)} Hz throughout"
        if self.look["last"]:
            words = f"from {style.number(first, 4)} Hz to {style.number(last, 4)} Hz"
        known = measured.machine.exact_speed is not None
        return f"Shaft speed {words}, {'as given' if known else 'found in the signal'}."

    def columns_of(self, model: Model, measured: Measured) -> dict[str, np.ndarray]:
        if self.too_short(measured):
            return {}
        shown = self.shown(model, measured)
        orders = self.look["map"] == "orders"
        across, up = ("turns", "order") if orders else ("time_s", "frequency_hz")
        x, y = np.meshgrid(shown.x, shown.y, indexing="ij")
        return {across: x.ravel(), up: y.ravel(), "level_db": shown.level.ravel()}


def thinned(level: NDArray[np.float64]) -> NDArray[np.float64]:
    """Levels (columns, rows) with no more than can be seen; each peak stays."""
    for axis, most in enumerate((MOST_COLUMNS, MOST_ROWS)):
        size = math.ceil(level.shape[axis] / most)
        level = np.maximum.reduceat(level, np.arange(0, level.shape[axis], size), axis=axis)
    return level
