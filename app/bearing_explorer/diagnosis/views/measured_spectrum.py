"""The spectrum of a measured signal over that of the scene, with the scene's bands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from bokeh.models import VStrip

from bearing_explorer.diagnosis import model as compared
from bearing_explorer.diagnosis.signal import Measured, Simulated
from bearing_explorer.diagnosis.views.frequency_view import (
    ALONG,
    AXIS,
    FIRST_LOOK,
    LINES,
    MODEL,
    RESOLUTIONS,
    SCALE,
    FrequencyView,
    Shown,
    amplitudes,
)
from bearing_explorer.diagnosis.views.measured_view import shown_unit
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.frequency_bands import BAND_WORDS, bands_along
from bearing_explorer.kit.plots.layers import Glyph, Layer, names_over
from bearing_explorer.kit.plots.levels import SHOWN
from bearing_explorer.kit.views.base import Sources
from bearing_explorer.kit.widgets.form import FieldSpec

if TYPE_CHECKING:
    from bearing_explorer.diagnosis.model import Model
    from bearingcore import Spectrum


class MeasuredSpectrum(FrequencyView):
    """Amplitude spectrum of the measured acceleration, up to half the sample rate."""

    name = "measured-spectrum"
    prefix = "measured_spectrum"
    title = "Spectrum of the signal"
    about = (
        "Amplitudes of vibration to half the sample rate. Dark: measured. Coloured: the "
        "scene. It is simulated once you switch it on, scaled to the measured root mean square, "
        "with the bands of its natural frequencies shaded: where measured resonances lie in "
        "them, the scene is like the machine. A click puts a cursor on a line."
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
        MODEL,
    ]

    def beneath(self) -> list[Layer]:
        drawn: list[Layer] = []
        for dof in SHOWN:
            bands, color = f"{self.prefix}_bands_{dof}", style.color_along(dof)
            look = {"fill_color": color, "fill_alpha": 0.14, "line_color": None}
            drawn += [
                Glyph(VStrip, bands, ("low", "high"), {**look, "level": "underlay"}),
                names_over(bands, BAND_WORDS, "label_at", 0.05, color, ("direction", "number"),
                           text_align="center"),
            ]  # fmt: skip
        return drawn

    def decoration(self, model: Model, shown: Shown) -> Sources:
        measured = self.measured
        if measured is None or shown.simulated is None:
            return {}
        own_bands = compared.bands(measured.scene(model.scene))
        own = bands_along(own_bands, shown.direction, shown.top)
        return {f"{self.prefix}_bands_{shown.direction}": own}

    def shown(self, model: Model, measured: Measured) -> Shown:
        direction = self.direction(measured)
        resolution = measured.finest(float(self.look["resolution"]))
        top = 0.5 * measured.recording.sample_rate
        shown = Shown(direction, top, measured.spectrum(direction, resolution), None, resolution)
        return self.with_model(
            shown, lambda: Simulated(model, measured).spectrum(direction, resolution)
        )

    def words_of(self, model: Model, measured: Measured) -> str:
        shown = self.shown(model, measured)
        unit, size = shown_unit(measured)
        words = f"Along {shown.direction} above 100 Hz the highest line is "
        words += _highest(shown.measured, unit, size)
        words += f"; resolution {style.number(shown.resolution, 2)} Hz."
        return words + self.words_on_model(model, measured, shown)


def _highest(spectrum: Spectrum, unit: str, size: float) -> str:
    amplitude = np.where(spectrum.frequency >= 100.0, amplitudes(spectrum), 0.0)
    most = int(amplitude.argmax())
    height = f"{style.number(float(amplitude[most]) / size, 3)} {unit}"
    return f"at {spectrum.frequency[most]:.0f} Hz ({height})"
