"""Spectrogram and order map of a measured signal, for speeds that change."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn
from bokeh.models import LinearColorMapper
from bokeh.palettes import Viridis256
from numpy.typing import NDArray

from bearing_explorer.plots import style
from bearing_explorer.plots.heat_map import CLEAR, GridImage, Side, color_bar, ends, scale_by
from bearing_explorer.plots.layers import curve, draw, nothing
from bearing_explorer.plots.levels import decibels
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources
from bearing_explorer.views.measured_view import MeasuredView
from bearing_explorer.widgets.look import LookField, LookPanel
from bearingcore.signals.spectrogram import (
    ShaftTrack,
    Spectrogram,
    follow_shaft,
    order_map,
    spectrogram,
)

if TYPE_CHECKING:
    from bearing_explorer.measurement.signal import Measured
    from bearing_explorer.results.results import Results

FOLLOWED = (0.55, 1.6)
"""Times the given shaft speed between which a speed is looked for."""
MOST_COLUMNS, MOST_ROWS = 220, 320
"""Of the picture."""
DEPTH_OF_VIEW = 50.0  # [dB]
SEGMENTS = 60.0
"""Of a spectrogram, one after the other."""
TOP_ORDER, ORDER_STEP = 20.0, 0.1
_SIDES = {
    "time": Side("", "Time", "t", "s"),
    "turns": Side("", "Turns of the shaft", "", ""),
    "frequency": Side("", "Frequency", "f", "Hz"),
    "order": Side("", "Order", "", ""),
}
_SAY = "return `${rounded(cell[0], 3)} dB`"
FIELDS: list[LookField] = [
    {"kind": "one", "name": "map", "label": "Show",
     "options": [["spectrogram", "spectrogram"], ["orders", "order map"]]},
    {"kind": "one", "name": "of", "label": "of",
     "options": [["signal", "the signal"], ["envelope", "its envelope"]]},
    {"kind": "one", "name": "speed", "label": "Shaft speed",
     "options": [["given", "as given"], ["followed", "followed by its lines"]]},
]  # fmt: skip
_TRACK = curve("spectrogram_track", "x", "y", "#FFFFFF", 1.6, (5, 4))


@dataclass(frozen=True)
class Look:
    """Choices above the map."""

    map: str = "spectrogram"
    of: str = "signal"
    speed: str = "given"


class MeasuredSpectrogram(MeasuredView):
    """Spectra over time, or over the turns of the shaft."""

    name = "measured-spectrogram"
    title = "Spectrogram and order map"
    about = (
        "Spectra over time, for speeds that change. Dashed: the shaft speed. An order map counts "
        "in turns of the shaft: lines of shaft and bearing stay level there whatever the speed, "
        "once it is known. It can be followed by the shaft's own lines; check in the spectrogram "
        "that the dashed curve lies on a line."
    )
    needs = frozenset()
    without_size = True

    def build(self, packed: PackedSource) -> Any:
        self.look = Look()
        self._known: tuple[Any, tuple[ShaftTrack, Spectrogram, float]] | None = None
        plot = style.make_figure(
            _SIDES["time"].quantity,
            _SIDES["frequency"].quantity,
            packed.range("spectrogram_x", 0.0, 1.0),
            packed.range("spectrogram_y", 0.0, 1.0),
            height=320,
            name="spectrogram_drawing",
        )
        plot.grid.visible = False
        mapper = LinearColorMapper(palette=list(Viridis256), nan_color=CLEAR)
        scale_by(packed.range("spectrogram_level", -50.0, 0.0), mapper)
        sides = list(_SIDES.values())
        self._image = GridImage(plot, packed, "spectrogram_cells", [mapper], sides, _SAY)
        title = "dB below the highest"
        plot.add_layout(color_bar(mapper, title, bar_line_color=None), "right")
        draw(plot, packed, [_TRACK])
        self.panel_of_look = LookPanel(self.look_changed, FIELDS)
        whole: dict[str, Any] = {"sizing_mode": "stretch_width", "margin": 0}
        self.hidden = pn.Column(self.panel_of_look, plot, visible=False, **whole)
        return self.hidden

    def look_changed(self, name: str, value: str) -> None:
        """Show another map, or by another speed."""
        self.look = replace(self.look, **{name: value})
        if self.measurement is not None:
            self.measurement.redraw()

    def choices(self) -> dict[str, Any]:
        first = Look()
        return {k: v for k, v in vars(self.look).items() if v != getattr(first, k)}

    def choose(self, choices: Mapping[str, Any], results: Results) -> None:
        self.look = replace(self.look, **choices)

    def shown(self, results: Results, measured: Measured) -> tuple[ShaftTrack, Spectrogram, float]:
        """The speed, the map as the look has it, and the highest frequency [Hz] or order of it."""
        band = self.demodulation(results, measured, self.direction_of(results, measured)).band
        key = id(measured), self.look, band
        if self._known is None or self._known[0] != key:
            track = self.track(results, measured)
            self._known = key, (track, *self._map(results, measured, track))
        return self._known[1]

    def track(self, results: Results, measured: Measured) -> ShaftTrack:
        """The shaft speed over time: followed where that is chosen and clear, or constant."""
        given = measured.shaft_speed / (2.0 * math.pi)
        ends_of_time = np.array([0.0, measured.recording.duration])
        constant = ShaftTrack(ends_of_time, np.full(2, given), 0.0, clear=False)
        if self.look.speed == "given":
            return constant
        signal, rate = self.signal(results, measured, "signal")
        lowest, highest = (share * given for share in FOLLOWED)
        try:
            found = follow_shaft(signal, rate, lowest, highest)
        except ValueError:  # too short, or sampled too slowly
            return constant
        return found if found.clear else constant

    def signal(
        self, results: Results, measured: Measured, of: str
    ) -> tuple[NDArray[np.float64], float]:
        """The signal or its envelope, and its sample rate [Hz]."""
        direction = self.direction_of(results, measured)
        if of == "signal":
            column = measured.directions.index(direction)
            return measured.recording.acceleration[:, column], measured.recording.sample_rate
        return measured.envelope_signal(
            direction, self.demodulation(results, measured, direction).band
        )

    def _map(
        self, results: Results, measured: Measured, track: ShaftTrack
    ) -> tuple[Spectrogram, float]:
        signal, rate = self.signal(results, measured, self.look.of)
        turning = measured.shaft_speed / (2.0 * math.pi)
        if self.look.map == "orders":
            return order_map(signal, rate, track.time, track.speed, ORDER_STEP), TOP_ORDER
        step = max(SEGMENTS / measured.recording.duration, rate / 8192.0)
        top = 0.5 * rate
        if self.look.of == "envelope":
            step, top = max(4.0 / measured.recording.duration, 0.25 * turning), TOP_ORDER * turning
        return spectrogram(signal, rate, step), min(top, 0.5 * rate)

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        measured = self.measured
        if measured is None:
            return {"spectrogram_cells": self._image.nothing(), **nothing([_TRACK])}, {}
        track, found, top = self.shown(results, measured)
        kept = found.frequency <= top
        level = thinned(decibels(found.density[:, kept]))
        level -= level.max()
        x, y = (
            np.linspace(values[0], values[-1], count)
            for values, count in zip((found.time, found.frequency[kept]), level.shape, strict=True)
        )
        across, up = ("turns", "order") if self.look.map == "orders" else ("time", "frequency")
        cells = self._image.columns((_SIDES[across], x), (_SIDES[up], y), [level.T])
        drawn = self.look.map != "orders" and self.look.speed == "followed"
        line = {"x": track.time, "y": track.speed} if drawn else nothing([_TRACK])[_TRACK.source]
        ranges = {"spectrogram_x": ends(x), "spectrogram_y": (0.0, top)}
        if drawn and self.look.of == "signal":
            ranges["spectrogram_y"] = (0.0, min(top, 8.0 * float(track.speed.max())))
        ranges["spectrogram_level"] = (-DEPTH_OF_VIEW, 0.0)
        return {"spectrogram_cells": cells, "spectrogram_track": line}, ranges

    def sentence(self, results: Results) -> str:
        measured = self.measured
        if measured is None:
            return self.why_nothing
        track, _, _ = self.shown(results, measured)
        words = f"Shaft speed {style.number(float(track.speed[0]), 4)} Hz throughout, as given"
        if track.clear:
            low, high = (
                style.number(float(end), 3) for end in (track.speed.min(), track.speed.max())
            )
            clear = style.number(track.prominence, 2)
            words = (
                f"Followed by its lines, {clear} dB clear, the shaft turns at {low} to {high} Hz"
            )
        elif self.look.speed == "followed":
            words += ": its own lines do not stand out enough to follow them"
        return f"{words}."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        measured = self.measured
        if measured is None:
            return {}
        track, _, _ = self.shown(results, measured)
        return {"time_s": track.time, "shaft_speed_hz": track.speed}


def thinned(level: NDArray[np.float64]) -> NDArray[np.float64]:
    """Levels (columns, rows) with no more than can be seen; each peak stays."""
    for axis, most in enumerate((MOST_COLUMNS, MOST_ROWS)):
        size = math.ceil(level.shape[axis] / most)
        level = np.maximum.reduceat(level, np.arange(0, level.shape[axis], size), axis=axis)
    return level
