"""Analysis of signals: indicators, kurtograms, order maps, averages over ball passes."""

from bearingcore.measured.signals._averaging import (
    BallPasses,
    average_passes,
    coefficients,
    least_passes,
)
from bearingcore.measured.signals._filter_bank import BAND_COUNTS
from bearingcore.measured.signals._indicators import (
    DISPLACEMENT_ZONES,
    SHAFT_SPEEDS,
    ZONES,
    Indicators,
    indicators,
    severity_zone,
    shaft_share,
)
from bearingcore.measured.signals._kurtogram import Kurtogram, kurtogram
from bearingcore.measured.signals._spectrograms import Spectrogram, order_map, spectrogram
from bearingcore.measured.signals._whitening import local_median

__all__ = [
    "BAND_COUNTS",
    "DISPLACEMENT_ZONES",
    "SHAFT_SPEEDS",
    "ZONES",
    "BallPasses",
    "Indicators",
    "Kurtogram",
    "Spectrogram",
    "average_passes",
    "coefficients",
    "indicators",
    "kurtogram",
    "least_passes",
    "local_median",
    "order_map",
    "severity_zone",
    "shaft_share",
    "spectrogram",
]
