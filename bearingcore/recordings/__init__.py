"""Signals over time and their spectra, simulated or measured."""

from bearingcore.recordings._recording import FEWEST_SAMPLES, Recording
from bearingcore.recordings._spectrum import Spectrum, check_samples, envelope_spectrum, spectrum

__all__ = [
    "FEWEST_SAMPLES",
    "Recording",
    "Spectrum",
    "check_samples",
    "envelope_spectrum",
    "spectrum",
]
