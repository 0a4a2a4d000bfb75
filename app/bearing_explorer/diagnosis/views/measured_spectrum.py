"""The spectrum of a measured signal."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.frequency_view import (
    ALONG,
    AXIS,
    FIRST_LOOK,
    LINES,
    RESOLUTIONS,
    SCALE,
    FrequencyView,
    Shown,
    amplitudes,
)
from bearing_explorer.diagnosis.views.measured_view import MEASURED, shown_unit
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import curve, draw
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import FieldSpec
from bearingcore import Spectrum
from bearingcore.common import span

SPEED = style.AxisQuantity("Speed", "n", "rpm")
SPEED_HEIGHT = 190
SPEED_POINTS = 600


class MeasuredSpectrum(FrequencyView):
    """Amplitude spectrum of the measured acceleration, up to half the sample rate."""

    name = "measured-spectrum"
    prefix = "measured_spectrum"
    title = "Spectrum of the signal"
    about = (
        "Amplitudes of vibration to half the sample rate. A click puts a cursor on a line. Below "
        "is the speed of the shaft over time, where it was measured beside the signal; lines of a "
        "shaft whose speed changes are broad here, and the diagnosis follows it."
    )
    first_look: ClassVar[dict[str, Any]] = {**FIRST_LOOK, "resolution": "8"}
    look_fields: ClassVar[list[FieldSpec]] = [
        ALONG,
        SCALE,
        {
            "name": "resolution",
            "label": "Resolution",
            "options": [[resolution, f"{resolution} Hz"] for resolution in RESOLUTIONS],
        },
        AXIS,
        LINES,
    ]

    def build(self, packed: PackedSource) -> Any:
        built = super().build(packed)
        self._speed_range = StickyRange(0.0, 1.0)
        ranges = packed.range("shaft_time", 0.0, 1.0), packed.range("shaft_rpm", 0.0, 1.0)
        self.speed_plot = style.make_figure(
            style.TIME, SPEED, *ranges, height=SPEED_HEIGHT, title="Shaft speed, as measured"
        )
        draw(self.speed_plot, packed, [curve("shaft_speed", "time", "rpm", MEASURED, 1.4)])
        built.append(self.speed_plot)
        return built

    def data_of(self, model: Model, measured: Measured) -> tuple[Sources, Ranges]:
        sources, ranges = super().data_of(model, measured)
        if measured.speeds is None:
            return sources, ranges
        shown = np.linspace(0, len(measured.speeds) - 1, SPEED_POINTS).astype(int)
        rpm = 30.0 / math.pi * measured.speeds[shown]
        time = shown / measured.recording.sample_rate
        return sources | {"shaft_speed": {"time": time, "rpm": rpm}}, ranges | {
            "shaft_time": (0.0, measured.recording.duration),
            "shaft_rpm": self._speed_range.fit(np.append(rpm, 0.0)),
        }

    def show_look(self) -> None:
        super().show_look()
        self.speed_plot.visible = self.measured is not None and self.measured.speeds is not None

    def shown(self, model: Model, measured: Measured) -> Shown:
        direction = self.direction(measured)
        resolution = measured.finest(float(self.look["resolution"]))
        top = 0.5 * measured.recording.sample_rate
        return Shown(direction, top, measured.spectrum(direction, resolution), resolution)

    def words_of(self, model: Model, measured: Measured) -> str:
        shown = self.shown(model, measured)
        unit, size = shown_unit(measured)
        words = f"Above 100 Hz the highest line{measured.along(shown.direction)} is "
        words += _highest(shown.measured, unit, size)
        words += f"; resolution {style.number(shown.resolution, 2)} Hz."
        if measured.speed_limits is None:
            return words
        least, most = (30.0 / math.pi * speed for speed in measured.speed_limits)
        return f"{words} The shaft turned at {span(least, most, 'rpm', 4)}."


def _highest(spectrum: Spectrum, unit: str, size: float) -> str:
    amplitude = np.where(spectrum.frequency >= 100.0, amplitudes(spectrum), 0.0)
    highest = int(amplitude.argmax())
    height = f"{style.number(float(amplitude[highest]) / size, 3)} {unit}"
    return f"at {spectrum.frequency[highest]:.0f} Hz ({height})"
