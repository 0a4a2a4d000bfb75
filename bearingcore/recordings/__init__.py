"""Signals over time and their spectra, simulated or measured."""

from bearingcore.recordings._recording import (
    FEWEST_SAMPLES as FEWEST_SAMPLES,
    Recording as Recording,
)
from bearingcore.recordings._spectrum import (
    Spectrum as Spectrum,
    envelope_spectrum as envelope_spectrum,
    spectrum as spectrum,
)
