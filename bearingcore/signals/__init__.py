"""Signals as such, measured or simulated: reading, spectra, envelopes, averages."""

from bearingcore.signals.averaging import BallPasses
from bearingcore.signals.filter_bank import BAND_COUNTS, Band, squared_envelopes
from bearingcore.signals.indicators import SHAFT_SPEEDS, ZONES, severity_zone
from bearingcore.signals.recording import FEWEST_SAMPLES
from bearingcore.signals.spectrograms import FEWEST_SEGMENTS, Spectrogram, order_map, spectrogram

__all__ = [
    "BAND_COUNTS",
    "FEWEST_SAMPLES",
    "FEWEST_SEGMENTS",
    "SHAFT_SPEEDS",
    "ZONES",
    "BallPasses",
    "Band",
    "Spectrogram",
    "order_map",
    "severity_zone",
    "spectrogram",
    "squared_envelopes",
]
