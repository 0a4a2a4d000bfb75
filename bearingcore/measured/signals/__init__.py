"""Analysis of signals: indicators, kurtograms, order maps, averages over ball passes."""

from bearingcore.measured.signals._averaging import (
    BallPasses as BallPasses,
    average_passes as average_passes,
    coefficients as coefficients,
    least_passes as least_passes,
)
from bearingcore.measured.signals._filter_bank import BAND_COUNTS as BAND_COUNTS
from bearingcore.measured.signals._indicators import (
    DISPLACEMENT_ZONES as DISPLACEMENT_ZONES,
    SHAFT_SPEEDS as SHAFT_SPEEDS,
    ZONES as ZONES,
    Indicators as Indicators,
    indicators as indicators,
    severity_zone as severity_zone,
    shaft_share as shaft_share,
)
from bearingcore.measured.signals._kurtogram import Kurtogram as Kurtogram, kurtogram as kurtogram
from bearingcore.measured.signals._spectrograms import (
    Spectrogram as Spectrogram,
    order_map as order_map,
    spectrogram as spectrogram,
)
from bearingcore.measured.signals._whitening import local_median as local_median
