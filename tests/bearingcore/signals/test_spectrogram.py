"""Spectra over time, and over the turns of a shaft."""

import math

import numpy as np
import pytest

from bearingcore.signals.spectrograms import order_map, spectrogram

RATE = 6000.0
TIME = np.arange(int(8 * RATE)) / RATE


def test_what_cannot_be_is_refused():
    with pytest.raises(ValueError, match="row of 2400 samples"):
        spectrogram(np.zeros(1000), RATE, 10.0)
    with pytest.raises(ValueError, match="finite"):
        spectrogram(np.full(9000, math.nan), RATE, 10.0)
    with pytest.raises(ValueError, match="speeds above 0"):
        order_map(TIME, RATE, [0.0], [0.0])
