"""Signals over time and their spectra: what the model gives and a sensor measures."""

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
