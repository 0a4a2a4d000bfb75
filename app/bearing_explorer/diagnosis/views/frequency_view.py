"""A measured signal over frequency: its lines, a cursor, the model over it, and their choices."""

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
from bearing_explorer.diagnosis.views.frequency_lines import FAMILIES, fundamentals, of_rows
from bearing_explorer.diagnosis.views.measured_view import MEASURED, MeasuredView, shown_unit
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.frequency_cursor import FrequencyCursor
from bearing_explorer.kit.plots.layers import Layer, add_all, curve, sources_of
from bearing_explorer.kit.plots.levels import FREQUENCY, HIGHEST, LEVEL_FLOOR, SHOWN
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.sentences import sentence_of
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
MOST_LINES = 3000
"""Of a spectrum that are drawn."""
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
MODEL: FieldSpec = {
    "some": True,
    "name": "overlay",
    "label": "Simulated",
    "options": [["model", "the scene, scaled", style.color_along("y")]],
}
"""Choices above the figures."""


FIRST_LOOK: Mapping[str, Any] = {
    "direction": "", "scale": "dB", "axis": "Hz", "lines": [], "overlay": [],
}  # fmt: skip
"""Choices above a spectrum at first; without a direction it is the one that shows most."""


@dataclass(frozen=True)
class Shown:
    """Content of a figure: spectra up to `top` [Hz], and remarks on them.

    `share`: by how much the simulated amplitudes are multiplied to be drawn over the measured ones.
    """

    direction: str
    top: float
    measured: Spectrum
    simulated: Spectrum | None
    resolution: float
    why_not: str = ""
    band: tuple[float, float] | None = None
    share: float = 1.0


class FrequencyView(LookView, MeasuredView):
    """Common parts of spectra: figures in decibels and linear, lines, a cursor, and choices."""

    prefix: ClassVar[str]
    needs = frozenset({"spectra"})

    def build(self, packed: PackedSource) -> Any:
        self._levels = StickyRange(-80.0, -20.0, least_span=40.0)
        self._heights = StickyRange(0.0, 1.0, anchor="zero", shrink_below=0.7)
        p = self.prefix
        frequency = packed.range(f"{p}_frequency", 0.0, HIGHEST)
        beneath = [*frequency_lines.layers(p), *self.beneath()]
        layers = {scale: [*beneath, *self._layers(scale)] for scale in SCALES}
        sources = sources_of(packed, [layer for own in layers.values() for layer in own])
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
        self._cursor = FrequencyCursor(packed, p, self._plots, sources[f"{p}_measured"])
        self.hidden = stack(self.panel_of_look, *plots, self._cursor.controls, visible=False)
        return self.hidden

    def _layers(self, scale: str) -> list[Layer]:
        """The simulated spectra, and the measured one over them."""
        p = self.prefix
        return [
            *(
                curve(f"{p}_simulated_{dof}", "frequency", scale, style.color_along(dof), 1.6)
                for dof in SHOWN
            ),
            curve(f"{p}_measured", "frequency", scale, MEASURED, 1.2, alpha=0.9),
        ]

    def beneath(self) -> list[Layer]:
        """Layers beneath the spectra."""
        return []

    def decoration(self, model: Model, shown: Shown) -> Sources:
        """The numbers of that."""
        return {}

    def shown(self, model: Model, measured: Measured) -> Shown:
        """The spectra as the look has them."""
        raise NotImplementedError

    def with_model(self, shown: Shown, simulate: Any) -> Shown:
        """The model over the measured spectrum where it is switched on, with its scale."""
        if not self.look["overlay"]:
            return shown
        try:
            simulated = simulate()
        except ValueError as error:
            return replace(shown, why_not=sentence_of(error))
        if simulated is None:
            return replace(shown, why_not="The scene does not move along this direction.")
        share = scale_of(shown.measured, simulated, 1.5 * shown.resolution, shown.top)
        return replace(shown, simulated=simulated, share=share)

    # The look

    def direction(self, measured: Measured) -> str:
        """The direction that is shown."""
        return self.direction_of(measured, self.look["direction"])

    @property
    def _axis(self) -> str:
        """The axis as chosen; of orders only where the shaft speed is known."""
        return "Hz" if self.shaft_speed is None else str(self.look["axis"])

    def choices(self) -> dict[str, Any]:
        chosen = super().choices()
        if self.measured is not None:  # what the diagnosis chose is not known elsewhere
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
        lines = [] if turning is None else of_rows(turning)
        top, resolution = shown.top, shown.resolution
        factor = 1.0 / shown_unit(measured)[1]
        sources: Sources = {f"{p}_measured": curves(shown.measured, top, factor)}
        for dof in SHOWN:
            own = shown.simulated if dof == shown.direction else None
            sources[f"{p}_simulated_{dof}"] = curves(own, top, shown.share * factor)
        both = [sources[f"{p}_measured"], sources[f"{p}_simulated_{shown.direction}"]]
        # the scale leaves a slow drift out
        seen = [part["frequency"] > 1.5 * resolution for part in both]
        level, height = (
            np.concatenate([part[scale][own] for part, own in zip(both, seen, strict=True)])
            for scale in SCALES
        )
        room = frequency_lines.head_room(look["lines"], len(lines), FRAME)
        loudest = float(np.nanmax(level, initial=LEVEL_FLOOR))
        lowest = max(float(np.nanmin(level, initial=loudest)), loudest - DEPTH_OF_VIEW)
        head = (loudest - lowest) * room / (1.0 - room) + 3.0
        greatest = float(np.nanmax(height, initial=0.0)) / (1.0 - room)
        turn = math.nan if speed is None else speed / (2.0 * math.pi)
        per = turn if self._axis == "orders" else 1.0  # [Hz] that a 1 on the axis is
        ranges = {
            f"{p}_frequency": (0.0, top / per),
            f"{p}_level": self._levels.fit(np.array([lowest, loudest + head])),
            f"{p}_height": self._heights.fit(np.array([0.0, greatest])),
        }
        sources |= frequency_lines.columns(p, lines, look["lines"], top, FRAME)
        sources |= self.decoration(model, shown)
        for columns in sources.values():
            for name in {"frequency", "low", "high", "label_at"} & set(columns):
                columns[name] = columns[name] / per
        cage = math.nan if turning is None else fundamentals(turning)["ftf"]
        return sources | self._cursor.columns(turn, cage, per), ranges

    def columns_of(self, model: Model, measured: Measured) -> dict[str, np.ndarray]:
        shown = self.shown(model, measured)
        unit, size = shown_unit(measured)
        words = unit.replace("/", "_per_").replace("²", "2") if measured.in_si else "as_in_file"
        table: dict[str, np.ndarray] = {}
        for name, spectrum, scale in (
            ("measured", shown.measured, 1.0),
            ("simulated_scaled", shown.simulated, shown.share),
        ):
            if spectrum is not None:
                kept = spectrum.frequency <= shown.top
                amplitude = amplitudes(spectrum)[kept] * scale / size
                table[f"{name}_frequency_hz"] = spectrum.frequency[kept]
                table[f"{name}_amplitude_{shown.direction}_{words}"] = amplitude
        return table

    def words_on_model(self, model: Model, measured: Measured, shown: Shown) -> str:
        """The scale of the simulated spectrum, and its speed where the sliders have another."""
        if not self.look["overlay"]:
            return ""
        words = f" {shown.why_not}".rstrip()
        if shown.simulated is not None:
            words += (
                f" The simulated amplitudes are multiplied by {style.number(shown.share, 3)}, to "
                "have the measured root mean square."
            )
        ours, theirs = model.scene.shaft_speed, measured.shaft_speed
        if theirs is None or measured.bearing is None:
            words += " It is simulated as it is: speed or bearing of the signal are not known."
        elif not math.isclose(ours, theirs, rel_tol=1e-4):
            words += (
                f" The scene is simulated at the measured {_hertz(theirs)} Hz, not at the "
                f"{_hertz(ours)} Hz of the sliders."
            )
        return words


def amplitudes(spectrum: Spectrum) -> NDArray[np.float64]:
    """Amplitude (peak) of a tone at each line of a spectrum with Hann's window."""
    step = float(spectrum.frequency[1] - spectrum.frequency[0])
    return np.asarray(np.sqrt(2.0 * HANN_WIDTH * step * spectrum.density))


def scale_of(measured: Spectrum, simulated: Spectrum, low: float, top: float) -> float:
    """The factor by which simulated amplitudes have the measured mean square in a range [Hz]."""
    high = min(top, float(measured.frequency[-1]), float(simulated.frequency[-1]))
    power = []
    for frequency, density in (measured, simulated):
        kept = (frequency >= low) & (frequency <= high)
        power.append(float(density[kept].sum()) * float(frequency[1] - frequency[0]))
    return math.sqrt(power[0] / power[1]) if power[1] > 0.0 else 1.0


def curves(spectrum: Spectrum | None, top: float, factor: float) -> dict[str, NDArray[np.float64]]:
    """Amplitudes up to `top` [Hz] in both scales; of very fine spectra each peak stays."""
    if spectrum is None:
        return dict.fromkeys(("frequency", *SCALES), np.zeros(0))
    kept = spectrum.frequency <= top
    frequency, amplitude = spectrum.frequency[kept], factor * amplitudes(spectrum)[kept]
    size = math.ceil(frequency.size / MOST_LINES)
    if size > 1:
        n = frequency.size // size * size
        highest = amplitude[:n].reshape(-1, size).argmax(axis=1) + np.arange(0, n, size)
        frequency, amplitude = frequency[highest], amplitude[highest]
    level = 20.0 * np.log10(np.maximum(amplitude, 10.0 ** (LEVEL_FLOOR / 20.0)))
    return {"frequency": frequency, "dB": level, "linear": amplitude}


def _hertz(speed: float) -> str:
    return style.number(speed / (2.0 * math.pi), 4)
