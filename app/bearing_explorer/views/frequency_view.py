"""A measured and a simulated signal over frequency: figures, lines, and their choices."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
import panel as pn
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.measurement.form import number_of
from bearing_explorer.measurement.signal import Measured
from bearing_explorer.plots import style
from bearing_explorer.plots.layers import Layer, add_all, curve, nothing, sources_of
from bearing_explorer.plots.levels import (
    DEPTH_OF_VIEW,
    FREQUENCY,
    HIGHEST,
    LEVEL_FLOOR,
    SHOWN,
    decibels,
)
from bearing_explorer.plots.ranges import StickyRange
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources
from bearing_explorer.views.frequency_lines import FAMILIES, FrequencyLines, of_rows
from bearing_explorer.views.measured_view import MEASURED, MeasuredView
from bearing_explorer.widgets.look import LookField, LookPanel
from bearingcore import Spectrum

FRAME = 236.0  # [px] height of the frame of a figure
HEIGHT = 300
SCALES = ("dB", "linear")
AXES = {
    "dB": (
        style.AxisQuantity("Density", "S", "dB re 1 (m/s²)²/Hz"), "level", (-80.0, -20.0),
    ),
    "linear": (
        style.AxisQuantity("Amplitude density", "√S", "m/s²/√Hz", prefixed=True),
        "height", (0.0, 1.0),
    ),
}  # fmt: skip
"""Quantity, name and first range of the axis of each scale."""
RESOLUTIONS = ("32", "8", "2")
MOST_LINES = 3000
"""Of a spectrum that are drawn."""


ALONG: LookField = {
    "kind": "one",
    "name": "direction",
    "label": "Along",
    "options": [["x", "x"], ["y", "y"]],
}
SCALE: LookField = {
    "kind": "one",
    "name": "scale",
    "label": "Scale",
    "options": [["dB", "dB"], ["linear", "linear"]],
}
LINES: LookField = {
    "kind": "some",
    "name": "lines",
    "label": "Lines",
    "options": [[family.name, family.title, family.color] for family in FAMILIES],
}
"""Choices above the figures."""


@dataclass(frozen=True)
class Look:
    """Choices above a spectrum."""

    direction: str = "y"
    scale: str = "dB"
    resolution: str = "32"
    lines: tuple[str, ...] = ("bpfo",)
    band: tuple[float | None, float | None] = (None, None)


def look_values(look: Look) -> dict[str, Any]:
    """A look as the fields above the figures have it."""
    low, high = ("" if edge is None else f"{edge:g}" for edge in look.band)
    return {
        "direction": look.direction,
        "scale": look.scale,
        "resolution": look.resolution,
        "lines": list(look.lines),
        "low": low,
        "high": high,
    }


@dataclass(frozen=True)
class Shown:
    """Content of a figure: spectra up to `top` [Hz], and remarks on them."""

    direction: str
    top: float
    measured: Spectrum
    simulated: Spectrum | None
    resolution: float
    why_not: str = ""
    band: tuple[float, float] | None = None


class FrequencyView(MeasuredView):
    """Common parts of spectra: figures in decibels and linear, lines, and choices."""

    prefix: ClassVar[str]
    fields: ClassVar[list[LookField]]
    first_look: ClassVar[Look]
    needs = frozenset({"spectra"})

    def build(self, packed: PackedSource) -> Any:
        self.look = self.first_look
        self._levels = StickyRange(-80.0, -20.0, least_span=40.0)
        self._heights = StickyRange(0.0, 1.0, anchor="zero", shrink_below=0.7)
        p = self.prefix
        frequency = packed.range(f"{p}_frequency", 0.0, HIGHEST)
        layers = {scale: self._layers(scale) for scale in SCALES}
        sources = sources_of(packed, [layer for own in layers.values() for layer in own])
        self._plots = {
            scale: style.make_figure(
                FREQUENCY,
                quantity,
                frequency,
                packed.range(f"{p}_{name}", *first),
                height=HEIGHT,
                name=f"{p}_drawing_{scale}",
            )
            for scale, (quantity, name, first) in AXES.items()
        }
        self._lines = FrequencyLines(packed, p, list(self._plots.values()), FRAME)
        self.decorate(packed, list(self._plots.values()))
        for scale, plot in self._plots.items():
            add_all(plot, sources, layers[scale])
        self.panel_of_look = LookPanel(self.look_changed, self.fields)
        whole = {"sizing_mode": "stretch_width", "margin": 0}
        self.hidden = pn.Column(self.panel_of_look, *self._plots.values(), visible=False, **whole)
        self._show_look()
        return self.hidden

    def _layers(self, scale: str) -> list[Layer]:
        """The simulated spectra, and the measured one over them."""
        p = self.prefix
        return [
            *(
                curve(f"{p}_simulated_{dof}", "frequency", scale, style.color_along(dof), 2.4)
                for dof in SHOWN
            ),
            curve(f"{p}_measured", "frequency", scale, MEASURED, 1.2, alpha=0.9),
        ]

    def decorate(self, packed: PackedSource, plots: list[figure]) -> None:
        """Draw layers beneath the spectra."""

    def decoration(self, results: Results | None, shown: Shown | None) -> Sources:
        """The numbers of that."""
        return {}

    def shown(self, results: Results, measured: Measured) -> Shown:
        """The spectra as the look has them."""
        raise NotImplementedError

    # The look

    def look_changed(self, name: str, value: Any) -> None:
        """Draw as it was chosen; a number that is refused changes nothing."""
        try:
            self.look = self._looked(name, value)
        except ValueError as error:
            self.panel_of_look.refuse(str(error))
            return
        self.panel_of_look.refuse("")
        if self.measurement is not None:
            self.measurement.redraw()

    def _looked(self, name: str, value: Any) -> Look:
        if name in ("direction", "scale", "resolution"):
            return replace(self.look, **{name: value})
        if name == "lines":
            known = [family.name for family in FAMILIES]
            return replace(self.look, lines=tuple(line for line in known if line in value))
        words = f"The {'lower' if name == 'low' else 'upper'} end of the band"
        bare = value.strip()
        end = number_of(bare[:20], words, "Hz", 1e-3, 1e7) if bare else None
        low, high = self.look.band
        return replace(self.look, band=(end, high) if name == "low" else (low, end))

    def choices(self) -> dict[str, Any]:
        first = look_values(self.first_look)
        return {k: v for k, v in look_values(self.look).items() if v != first[k]}

    def choose(self, choices: Mapping[str, Any], results: Results) -> None:
        for name, value in choices.items():
            self.look = self._looked(name, value)

    def _show_look(self) -> None:
        look, measured = self.look, self.measured
        directions = measured.directions if measured is not None else SHOWN
        seen = look.direction if look.direction in directions else directions[0]
        self.panel_of_look.show(
            look_values(look) | {"direction": seen},
            disabled={"direction": [dof for dof in SHOWN if dof not in directions]},
        )
        for scale, plot in self._plots.items():
            plot.visible = scale == look.scale

    def direction(self, measured: Measured) -> str:
        """The direction that is shown: the one chosen, where it was measured."""
        chosen = self.look.direction
        return chosen if chosen in measured.directions else measured.directions[0]

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        self._show_look()

    # The picture

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        p, measured, look = self.prefix, self.measured, self.look
        if measured is None:
            empty = nothing([layer for scale in SCALES for layer in self._layers(scale)])
            return empty | self._lines.nothing() | self.decoration(None, None), {}
        shown = self.shown(results, measured)
        lines = of_rows(measured.scene(results.scene))
        top, resolution = shown.top, shown.resolution
        sources: Sources = {f"{p}_measured": curves(shown.measured, top)}
        for dof in SHOWN:
            own = shown.simulated if dof == shown.direction else None
            sources[f"{p}_simulated_{dof}"] = curves(own, top)
        both = [sources[f"{p}_measured"], sources[f"{p}_simulated_{shown.direction}"]]
        # the scale leaves a slow drift out
        seen = [part["frequency"] > 1.5 * resolution for part in both]
        level, height = (
            np.concatenate([part[scale][own] for part, own in zip(both, seen, strict=True)])
            for scale in SCALES
        )
        room = self._lines.head_room(look.lines, len(lines))
        loudest = float(np.nanmax(level, initial=LEVEL_FLOOR))
        lowest = max(float(np.nanmin(level, initial=loudest)), loudest - DEPTH_OF_VIEW)
        head = (loudest - lowest) * room / (1.0 - room) + 3.0
        greatest = float(np.nanmax(height, initial=0.0)) / (1.0 - room)
        ranges = {
            f"{p}_frequency": (0.0, top),
            f"{p}_level": self._levels.fit(np.array([lowest, loudest + head])),
            f"{p}_height": self._heights.fit(np.array([0.0, greatest])),
        }
        sources |= self._lines.columns(lines, look.lines, top)
        return sources | self.decoration(results, shown), ranges

    def table(self, results: Results) -> dict[str, np.ndarray]:
        measured = self.measured
        if measured is None:
            return {}
        shown = self.shown(results, measured)
        table: dict[str, np.ndarray] = {}
        unit = f"{shown.direction}_m2_per_s4_per_hz"
        for name, spectrum in (("measured", shown.measured), ("simulated", shown.simulated)):
            if spectrum is not None:
                kept = spectrum.frequency <= shown.top
                table[f"{name}_frequency_hz"] = spectrum.frequency[kept]
                table[f"{name}_density_{unit}"] = spectrum.density[kept]
        return table

    def simulated_at(self, results: Results, measured: Measured) -> str:
        """That the scene is simulated at another speed than the sliders have, if it is."""
        ours, theirs = results.scene.shaft_speed, measured.shaft_speed
        if math.isclose(ours, theirs, rel_tol=1e-4):
            return ""
        return (
            f" The scene is simulated at the measured {_hertz(theirs)} Hz, not at the "
            f"{_hertz(ours)} Hz of the sliders."
        )


def curves(spectrum: Spectrum | None, top: float) -> dict[str, NDArray[np.float64]]:
    """A spectrum up to `top` [Hz] in both scales; of very fine ones each peak stays."""
    if spectrum is None:
        return dict.fromkeys(("frequency", *SCALES), np.zeros(0))
    kept = spectrum.frequency <= top
    frequency, density = spectrum.frequency[kept], spectrum.density[kept]
    size = math.ceil(frequency.size / MOST_LINES)
    if size > 1:
        n = frequency.size // size * size
        frequency = frequency[:n].reshape(-1, size)[:, size // 2]
        density = density[:n].reshape(-1, size).max(axis=1)
    return {"frequency": frequency, "dB": decibels(density), "linear": np.sqrt(density)}


def _hertz(speed: float) -> str:
    return style.number(speed / (2.0 * math.pi), 4)
