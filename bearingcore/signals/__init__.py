"""Signals as such, measured or simulated: reading, spectra, envelopes, averages."""

from bearingcore.signals.filter_bank import BAND_COUNTS as BAND_COUNTS
from bearingcore.signals.indicators import DISPLACEMENT_ZONES as DISPLACEMENT_ZONES
from bearingcore.signals.indicators import SHAFT_SPEEDS as SHAFT_SPEEDS
from bearingcore.signals.indicators import ZONES as ZONES
from bearingcore.signals.indicators import severity_zone as severity_zone
from bearingcore.signals.indicators import shaft_share as shaft_share
from bearingcore.signals.recording import FEWEST_SAMPLES as FEWEST_SAMPLES
from bearingcore.signals.spectrograms import Spectrogram as Spectrogram
from bearingcore.signals.spectrograms import order_map as order_map
from bearingcore.signals.spectrograms import spectrogram as spectrogram
