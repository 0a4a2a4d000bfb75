"""Spectra of the housing without and with the mass of the balls, as far as they are known."""

from __future__ import annotations

from typing import Any

import numpy as np

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.mass_time import MASSLESS
from bearing_explorer.explorer.views.wide_spectrum import WideSpectra
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearingcore.common.numbers import prefixed_span


class MassInSpectrum(View):
    """Power spectral densities along x and y, with the band of the contact resonances."""

    name = "mass-spectrum"
    title = "Spectrum without and with the mass of the balls"
    about = (
        "In colour with mass of the balls, in grey without. Power spectral density of the "
        "housing's acceleration up to 0.4 of the sample rate; above it the "
        "recorder's filter would show. Shaded: where loaded balls resonate "
        "between their two contacts. In free flight balls react to the smallest "
        "disturbance: look at bands, not at single lines."
    )
    needs = frozenset({"ball_mass"})

    def build(self, packed: PackedSource) -> Any:
        self._spectra = WideSpectra(packed, "mass_spectrum", MASSLESS)
        return self._spectra.plots[::-1]

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        found = results.ball_mass
        return self._spectra.data(
            results, found.spectra, found.massless_spectra, found.resonances, found.bandwidth
        )

    def sentence(self, results: Results) -> str:
        found = results.ball_mass
        if not found.spectra:
            return f"There is no spectrum, as {found.broke_off}."
        low, high = found.resonances
        resonance = "No ball carries load, so none resonates between its contacts. "
        if high > 0.0:
            above = "" if low < found.bandwidth else ", above this range"
            resonance = (
                f"Loaded balls resonate between their contacts at "
                f"{prefixed_span(low, high, 'Hz')}{above}. "
            )
        comparison = found.comparison
        if comparison is None:
            return f"{resonance}The motion is too short to show where massless balls will do."
        return f"{resonance}{comparison.sentence[0].upper()}{comparison.sentence[1:]}."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.ball_mass.spectrum_table().named()
