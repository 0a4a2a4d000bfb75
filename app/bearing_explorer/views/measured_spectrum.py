"""The spectrum of a measured signal over that of the scene, with the scene's bands."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from bokeh.plotting import figure

from bearing_explorer.measurement.signal import Measured, Simulated
from bearing_explorer.plots import style
from bearing_explorer.plots.levels import HIGHEST, SHOWN, decibels
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.sentences import sentence_of
from bearing_explorer.views.base import Sources
from bearing_explorer.views.frequency_view import (
    ALONG,
    LINES,
    RESOLUTIONS,
    SCALE,
    FrequencyView,
    Look,
    Shown,
)
from bearing_explorer.views.measured_view import write_over
from bearing_explorer.views.modes import BAND_WORDS, bands_along, highest
from bearing_explorer.widgets.look import LookField

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results
    from bearingcore import Spectrum


class MeasuredSpectrum(FrequencyView):
    """Power spectral density of the measured and of the simulated acceleration."""

    name = "measured-spectrum"
    prefix = "measured_spectrum"
    title = "Spectrum, measured and simulated"
    about = (
        "Measured (thin), and what the scene gives (coloured). Shaded: the bands of the scene's "
        "natural frequencies. Where measured resonances lie in the bands, the scene is like the "
        "machine."
    )
    first_look = Look()
    fields: ClassVar[list[LookField]] = [
        ALONG,
        SCALE,
        {
            "kind": "one",
            "name": "resolution",
            "label": "Resolution",
            "options": [[resolution, f"{resolution} Hz"] for resolution in RESOLUTIONS],
        },
        LINES,
    ]

    def decorate(self, packed: PackedSource, plots: list[figure]) -> None:
        for dof in SHOWN:
            bands = packed.source(
                f"{self.prefix}_bands_{dof}", "low", "high", "direction", "number", "label_at"
            )
            color = style.color_along(dof)
            for plot in plots:
                plot.vstrip(
                    "low", "high", source=bands, fill_color=color, fill_alpha=0.14, line_color=None,
                    level="underlay",
                )  # fmt: skip
                write_over(plot, bands, BAND_WORDS, "label_at", 0.05, color, text_align="center")

    def decoration(self, results: Results | None, shown: Shown | None) -> Sources:
        columns = ("low", "high", "direction", "number", "label_at")
        sources: Sources = {
            f"{self.prefix}_bands_{dof}": dict.fromkeys(columns, np.zeros(0)) for dof in SHOWN
        }
        measured = self.measured
        if results is None or shown is None or measured is None:
            return sources
        bands = Simulated(results, measured).results.bands
        own = bands_along(bands, shown.direction, shown.top)
        return sources | {f"{self.prefix}_bands_{shown.direction}": own}

    def shown(self, results: Results, measured: Measured) -> Shown:
        model = Simulated(results, measured)
        direction = self.direction(measured)
        resolution = measured.finest(float(self.look.resolution))
        top = max(HIGHEST, 1.05 * highest(model.results.bands))
        top = min(top, 0.5 * measured.recording.sample_rate)
        spectrum = measured.spectrum(direction, resolution)
        try:
            simulated, why_not = model.spectrum(direction, resolution), ""
        except ValueError as error:
            simulated, why_not = None, sentence_of(error)
        return Shown(direction, top, spectrum, simulated, resolution, why_not)

    def sentence(self, results: Results) -> str:
        measured = self.measured
        if measured is None:
            return self.why_nothing
        shown = self.shown(results, measured)
        words = f"Along {shown.direction} above 100 Hz the measured housing vibrates most "
        words += _loudest(shown.measured, shown.top)
        if shown.simulated is not None:
            words += f", the simulated one {_loudest(shown.simulated, shown.top)}"
        words += f"; resolution {style.number(shown.resolution, 2)} Hz."
        return f"{words} {shown.why_not}".strip() + self.simulated_at(results, measured)


def _loudest(spectrum: Spectrum, top: float) -> str:
    frequency, density = spectrum
    audible = np.flatnonzero((frequency >= 100.0) & (frequency <= top))
    if not audible.size:
        return "below that"
    most = audible[np.argmax(density[audible])]
    level = style.number(float(decibels(density[most])), 2)
    return f"at {frequency[most]:.0f} Hz ({level} dB)"
