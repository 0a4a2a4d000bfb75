"""View of a measured signal over frequency, with lines, a cursor and choices."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from bokeh.events import Tap
from bokeh.models import ColumnDataSource, CustomJS, Div, RadioButtonGroup, Row
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views import frequency_lines
from bearing_explorer.diagnosis.views.frequency_lines import (
    FAMILIES,
    fundamentals,
    row_frequencies,
    thin_to_peaks,
)
from bearing_explorer.diagnosis.views.measured_view import MEASURED, MeasuredView, shown_unit
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import add_all, curve, sources_of
from bearing_explorer.kit.plots.levels import FREQUENCY, HIGHEST, LEVEL_FLOOR, SHOWN
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.views.look_view import LookView
from bearing_explorer.kit.widgets.form import FieldSpec, stack
from bearingcore import Spectrum

FRAME = 236.0  # [px] height of the frame of a figure
HEIGHT = 300
AMPLITUDE = style.AxisQuantity("Amplitude", "A", "")
ORDER = style.AxisQuantity("Order, turns of the shaft", "", "")
DEPTH_OF_VIEW = 80.0  # [dB] below the highest line
RESOLUTIONS = ("32", "8", "2")
HANN_WIDTH = 1.5
"""Noise bandwidth of Hann's window, in lines."""


SIDEBANDS = ("Harmonics", "and ± shaft", "and ± cage")
"""Choices of the lines that go with the cursor."""
HINT = "Click on a line for its harmonics, sidebands, order and amplitude."
COLOR = "#0072B2"
_TURNING = ("shaft", "cage", "hertz")

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


class FrequencyCursor:
    """A cursor on a line, with its harmonics and sidebands, in the browser alone.

    A click puts it on the highest line nearby; a click on it takes it away. Its reading is the
    frequency, the order and the amplitude. The figure draws the "amplitude" of a `curve` over its
    "frequency".

    Parameters
    ----------
    prefix
        of the source, one per session.
    """

    def __init__(
        self,
        packed: PackedSource,
        prefix: str,
        plot: figure,
        curve: ColumnDataSource,
    ) -> None:
        self._name = f"{prefix}_turning"
        turning = packed.source(self._name, *_TURNING)
        lines = ColumnDataSource({"at": [], "main": [], "dash": [], "alpha": []}, syncable=False)
        words = f"{style.HTML_FONT};color:{style.css_color(style.FAINT_INK)};padding:6px 4px"
        reading = Div(text=HINT, styles={"font": "12.5px/1.45 system-ui"}, syncable=False)
        reading.styles = dict(part.split(":", 1) for part in words.split(";"))
        buttons = RadioButtonGroup(
            labels=list(SIDEBANDS), active=0, syncable=False, stylesheets=[style.BUTTONS]
        )
        args = {
            "turning": turning,
            "curve": curve,
            "lines": lines,
            "reading": reading,
            "buttons": buttons,
            "hint": HINT,
            "plot": plot,
        }
        code = style.JS_PREFIX + asset_text("frequency_cursor.js")
        move = CustomJS(args=args, code=code)
        plot.vspan(
            "at", source=lines, line_color=COLOR, line_dash="dash", line_alpha="alpha",
            line_width=1.3,
        )  # fmt: skip
        plot.js_on_event(Tap, move)
        buttons.js_on_change("active", move)
        turning.js_on_change("data", move)
        self.controls = Row(
            children=[buttons, reading],
            stylesheets=[style.WRAPPED],
            sizing_mode="stretch_width",
            margin=(2, 5, 6, 5),
        )

    def columns(self, shaft: float, cage: float, per: float) -> dict[str, dict[str, np.ndarray]]:
        """Return the source: frequencies of shaft and cage on the axis, and its hertz per unit."""
        values = (shaft / per, cage / per, per)
        return {self._name: {n: np.array([v]) for n, v in zip(_TURNING, values, strict=True)}}


class FrequencyView(LookView, MeasuredView):
    """Common parts of spectra: a figure in decibels or linear, lines, a cursor, and choices."""

    prefix: ClassVar[str]

    def build(self, packed: PackedSource) -> Any:
        self._levels = StickyRange(-80.0, -20.0, least_span=40.0)
        self._heights = StickyRange(0.0, 1.0, anchor="zero", shrink_below=0.7)
        p = self.prefix
        measured = curve(f"{p}_measured", "frequency", "amplitude", MEASURED, 1.2, alpha=0.9)
        layers = [*frequency_lines.layers(p), measured]
        self._plot = style.make_figure(
            FREQUENCY,
            AMPLITUDE,
            packed.range(f"{p}_frequency", 0.0, HIGHEST),
            packed.range(f"{p}_amplitude", 0.0, 1.0),
            height=HEIGHT,
            name=f"{p}_drawing",
        )
        sources = sources_of(packed, layers)
        add_all(self._plot, sources, layers)
        self._cursor = FrequencyCursor(packed, p, self._plot, sources[f"{p}_measured"])
        self.hidden = stack(self.panel_of_look, self._plot, self._cursor.controls, visible=False)
        return self.hidden

    def shown(self, model: Model, measured: Measured) -> Shown:
        """Return the spectrum that the choices above the figure ask for."""
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
        if look["scale"] == "dB":
            unit = f"dB re 1 {unit}".replace("units", "unit")
        self._plot.yaxis[0].axis_label = replace(AMPLITUDE, unit=unit).label()
        self._plot.xaxis[0].axis_label = (FREQUENCY if self._axis == "Hz" else ORDER).label()

    # The picture

    def data_of(self, model: Model, measured: Measured) -> tuple[Sources, Ranges]:
        p, look = self.prefix, self.look
        shown = self.shown(model, measured)
        turning, speed = self.turning, self.shaft_speed
        lines = [] if turning is None else row_frequencies(turning)
        top, resolution = shown.top, shown.resolution
        rows = len(lines) * len(look["lines"])
        room = frequency_lines.ROW_PIXELS / FRAME * (rows + 0.6)  # share of the height for names
        drawn = shown_curve(shown.measured, top, 1.0 / shown_unit(measured)[1], look["scale"])
        sources: Sources = {f"{p}_measured": drawn}
        # a slow drift at the lowest lines must not set the scale
        height = drawn["amplitude"][drawn["frequency"] > 1.5 * resolution]
        if look["scale"] == "dB":
            loudest = float(np.nanmax(height, initial=LEVEL_FLOOR))
            lowest = max(float(np.nanmin(height, initial=loudest)), loudest - DEPTH_OF_VIEW)
            head = (loudest - lowest) * room / (1.0 - room) + 3.0
            ends = self._levels.fit(np.array([lowest, loudest + head]))
        else:
            greatest = float(np.nanmax(height, initial=0.0)) / (1.0 - room)
            ends = self._heights.fit(np.array([0.0, greatest]))
        shaft = math.nan if speed is None else speed / (2.0 * math.pi)
        per = shaft if self._axis == "orders" else 1.0  # hertz per unit of the axis
        ranges = {f"{p}_frequency": (0.0, top / per), f"{p}_amplitude": ends}
        sources |= frequency_lines.columns(p, lines, look["lines"], top, FRAME)
        # on an axis of orders, divide frequencies by that of the shaft
        for columns in sources.values():
            for name in {"frequency", "low", "high", "label_at"} & set(columns):
                columns[name] = columns[name] / per
        cage = math.nan if turning is None else fundamentals(turning)["ftf"]
        return sources | self._cursor.columns(shaft, cage, per), ranges

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


def shown_curve(
    spectrum: Spectrum, top: float, factor: float, scale: str
) -> dict[str, NDArray[np.float64]]:
    """Amplitudes up to `top` [Hz] in a scale; a very fine spectrum is thinned to its peaks."""
    kept = spectrum.frequency <= top
    frequency, amplitude = thin_to_peaks(
        spectrum.frequency[kept], factor * amplitudes(spectrum)[kept]
    )
    if scale == "dB":
        amplitude = 20.0 * np.log10(np.maximum(amplitude, 10.0 ** (LEVEL_FLOOR / 20.0)))
    return {"frequency": frequency, "amplitude": amplitude}
