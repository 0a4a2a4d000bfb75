"""The spectrum of a measured signal."""

from __future__ import annotations

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
from bearing_explorer.diagnosis.views.measured_view import shown_unit
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.widgets.form import FieldSpec
from bearingcore import Spectrum


class MeasuredSpectrum(FrequencyView):
    """Amplitude spectrum of the measured acceleration, up to half the sample rate."""

    name = "measured-spectrum"
    prefix = "measured_spectrum"
    title = "Spectrum of the signal"
    about = "Amplitudes of vibration to half the sample rate. A click puts a cursor on a line."
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
        return words + f"; resolution {style.number(shown.resolution, 2)} Hz."


def _highest(spectrum: Spectrum, unit: str, size: float) -> str:
    amplitude = np.where(spectrum.frequency >= 100.0, amplitudes(spectrum), 0.0)
    most = int(amplitude.argmax())
    height = f"{style.number(float(amplitude[most]) / size, 3)} {unit}"
    return f"at {spectrum.frequency[most]:.0f} Hz ({height})"
