"""View of a measured signal over frequency, with lines, a cursor and choices."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views import frequency_lines
from bearing_explorer.diagnosis.views.frequency_cursor import FrequencyCursor
from bearing_explorer.diagnosis.views.frequency_lines import (
    FAMILIES,
    fundamentals,
    row_frequencies,
    thinned_to_peaks,
)
from bearing_explorer.diagnosis.views.measured_view import MEASURED, MeasuredView, shown_unit
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import Layer, add_all, curve, sources_of
from bearing_explorer.kit.plots.levels import FREQUENCY, HIGHEST, LEVEL_FLOOR, SHOWN
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.views.look_view import LookView
from bearing_explorer.kit.widgets.form import FieldSpec, stack
from bearingcore import Spectrum

FRAME = 236.0  # [px] height of the frame of a figure
HEIGHT = 300
SCALES = ("dB", "linear")
AXES = {"dB": ("level", (-80.0, -20.0)), "linear": ("height", (0.0, 1.0))}
"""Name and first range of the axis of each scale."""
AMPLITUDE = style.AxisQuantity("Amplitude", "A", "")
ORDER = style.AxisQuantity("Order, turns of the shaft", "", "")
DEPTH_OF_VIEW = 80.0  # [dB] below the highest line
RESOLUTIONS = ("32", "8", "2")
HANN_WIDTH = 1.5
"""Noise bandwidth of Hann's window, in lines."""


ALONG: FieldSpec = {
    "name": "direction",
    "label": "Along",
    "options": [["x", "x"], ["y", "y"]],
}
SCALE: FieldSpec = {
    "name": "scale",
    "label": "Scale",
    "options": [["dB", "dB"], ["linear", "linear"]],
}
AXIS: FieldSpec = {
    "name": "axis",
    "label": "Axis",
    "options": [["Hz", "Hz"], ["orders", "orders"]],
}
LINES: FieldSpec = {
    "some": True,
    "name": "lines",
    "label": "Lines",
    "options": [[family.name, family.title, family.color] for family in FAMILIES],
}
"""Choices above the figures."""


FIRST_LOOK: Mapping[str, Any] = {"direction": "", "scale": "dB", "axis": "Hz", "lines": []}
"""First choices above a spectrum; no direction stands for the one that shows most."""


@dataclass(frozen=True)
class Shown:
    """Content of a figure: a spectrum up to `top` [Hz]; that of an envelope has its band [Hz]."""

    direction: str
    top: float
    measured: Spectrum
    resolution: float
    band: tuple[float, float] | None = None


class FrequencyView(LookView, MeasuredView):
    """Common parts of spectra: figures in decibels and linear, lines, a cursor, and choices."""

    prefix: ClassVar[str]

    def build(self, packed: PackedSource) -> Any:
        self._levels = StickyRange(-80.0, -20.0, least_span=40.0)
        self._heights = StickyRange(0.0, 1.0, anchor="zero", shrink_below=0.7)
        p = self.prefix
        frequency = packed.range(f"{p}_frequency", 0.0, HIGHEST)
        lines = frequency_lines.layers(p)
        measured = f"{p}_measured"
        layers: dict[str, list[Layer]] = {
            scale: [*lines, curve(measured, "frequency", scale, MEASURED, 1.2, alpha=0.9)]
            for scale in SCALES
        }
        sources = sources_of(packed, [layer for group in layers.values() for layer in group])
        self._plots = {
            scale: style.make_figure(
                FREQUENCY,
                AMPLITUDE,
                frequency,
                packed.range(f"{p}_{name}", *first),
                height=HEIGHT,
                name=f"{p}_drawing_{scale}",
            )
            for scale, (name, first) in AXES.items()
        }
        plots = list(self._plots.values())
        for scale, plot in self._plots.items():
            add_all(plot, sources, layers[scale])
        self._cursor = FrequencyCursor(packed, p, self._plots, sources[measured])
        self.hidden = stack(self.panel_of_look, *plots, self._cursor.controls, visible=False)
        return self.hidden

    def shown(self, model: Model, measured: Measured) -> Shown:
        """Return the spectrum that the choices of the look ask for."""
        raise NotImplementedError

    # The look

    def direction(self, measured: Measured) -> str:
        """The direction that is shown."""
        return self.direction_of(measured, self.look["direction"])

    @property
    def _axis(self) -> str:
        """The chosen axis; always Hz while the shaft speed is not known."""
        return "Hz" if self.shaft_speed is None else str(self.look["axis"])

    def choices(self) -> dict[str, Any]:
        chosen = super().choices()
        if self.measured is not None:  # exported Python does not know the diagnosis's choice
            chosen["direction"] = self.direction(self.measured)
        return chosen

    def show_look(self) -> None:
        look, measured = self.look, self.measured
        directions = measured.directions if measured is not None else SHOWN
        seen = directions[-1] if measured is None else self.direction(measured)
        self.panel_of_look.show(
            look | {"direction": seen, "axis": self._axis},
            disabled={
                "direction": [dof for dof in SHOWN if dof not in directions],
                "axis": ["orders"] if measured is not None and self.shaft_speed is None else [],
            },
        )
        unit = "" if measured is None else shown_unit(measured)[0]
        for scale, plot in self._plots.items():
            plot.visible = scale == look["scale"]
            label = f"dB re 1 {unit}".replace("units", "unit") if scale == "dB" else unit
            plot.yaxis[0].axis_label = replace(AMPLITUDE, unit=label).label()
            plot.xaxis[0].axis_label = (FREQUENCY if self._axis == "Hz" else ORDER).label()

    # The picture

    def data_of(self, model: Model, measured: Measured) -> tuple[Sources, Ranges]:
        p, look = self.prefix, self.look
        shown = self.shown(model, measured)
        turning, speed = self.turning, self.shaft_speed
        lines = [] if turning is None else row_frequencies(turning)
        top, resolution = shown.top, shown.resolution
        factor = 1.0 / shown_unit(measured)[1]
        drawn = curves(shown.measured, top, factor)
        sources: Sources = {f"{p}_measured": drawn}
        # a slow drift at the lowest lines must not set the scale
        level, height = (drawn[scale][drawn["frequency"] > 1.5 * resolution] for scale in SCALES)
        room = frequency_lines.head_room(look["lines"], len(lines), FRAME)
        loudest = float(np.nanmax(level, initial=LEVEL_FLOOR))
        lowest = max(float(np.nanmin(level, initial=loudest)), loudest - DEPTH_OF_VIEW)
        head = (loudest - lowest) * room / (1.0 - room) + 3.0
        greatest = float(np.nanmax(height, initial=0.0)) / (1.0 - room)
        turn = math.nan if speed is None else speed / (2.0 * math.pi)
        per = turn if self._axis == "orders" else 1.0  # [Hz] of a 1 on the axis
        ranges = {
            f"{p}_frequency": (0.0, top / per),
            f"{p}_level": self._levels.fit(np.array([lowest, loudest + head])),
            f"{p}_height": self._heights.fit(np.array([0.0, greatest])),
        }
        sources |= frequency_lines.columns(p, lines, look["lines"], top, FRAME)
        for columns in sources.values():
            for name in {"frequency", "low", "high", "label_at"} & set(columns):
                columns[name] = columns[name] / per
        cage = math.nan if turning is None else fundamentals(turning)["ftf"]
        return sources | self._cursor.columns(turn, cage, per), ranges

    def columns_of(self, model: Model, measured: Measured) -> dict[str, np.ndarray]:
        shown = self.shown(model, measured)
        unit, size = shown_unit(measured)
        words = unit.replace("/", "_per_").replace("²", "2") if measured.in_si else "as_in_file"
        kept = shown.measured.frequency <= shown.top
        return {
            "measured_frequency_hz": shown.measured.frequency[kept],
            f"measured_amplitude_{shown.direction}_{words}": amplitudes(shown.measured)[kept]
            / size,
        }


def amplitudes(spectrum: Spectrum) -> NDArray[np.float64]:
    """Peak amplitude of a tone at each line of a spectrum with Hann's window."""
    step = float(spectrum.frequency[1] - spectrum.frequency[0])
    return np.asarray(np.sqrt(2.0 * HANN_WIDTH * step * spectrum.density))


def curves(spectrum: Spectrum, top: float, factor: float) -> dict[str, NDArray[np.float64]]:
    """Amplitudes up to `top` [Hz] in both scales; a very fine spectrum is thinned to its peaks."""
    kept = spectrum.frequency <= top
    frequency, amplitude = spectrum.frequency[kept], factor * amplitudes(spectrum)[kept]
    frequency, amplitude = thinned_to_peaks(frequency, amplitude)
    level = 20.0 * np.log10(np.maximum(amplitude, 10.0 ** (LEVEL_FLOOR / 20.0)))
    return {"frequency": frequency, "dB": level, "linear": amplitude}
