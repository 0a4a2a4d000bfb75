"""Spectra over time, and over the turns of a shaft."""

import math

import numpy as np
import pytest

from bearingcore.errors import FieldError
from bearingcore.signals.spectrograms import order_map, spectrogram

RATE = 6000.0
TIME = np.arange(int(8 * RATE)) / RATE


def test_what_cannot_be_is_refused():
    with pytest.raises(ValueError, match="row of 2400 samples"):
        spectrogram(np.zeros(1000), RATE, 10.0)
    with pytest.raises(ValueError, match="finite"):
        spectrogram(np.full(9000, math.nan), RATE, 10.0)


@pytest.mark.parametrize(
    ("signal", "time", "speed", "said"),
    [
        (TIME, [0.0], [0.0], "speeds above 0"),
        (TIME, [8.0, 0.0], [30.0, 20.0], "a later time for each speed"),
        (TIME, [0.0, 4.0, 8.0], [20.0, 30.0], "a later time for each speed"),
        (TIME, [0.0, math.nan], [20.0, 30.0], "time"),
        (TIME, [0.0, 8.0], [1e-4, 30.0], "leave out where it turns slower"),
        (TIME[:, None], [0.0], [20.0], "a row"),
        (TIME[:0], [0.0], [20.0], "a row"),
        (TIME * math.nan, [0.0], [20.0], "finite"),
    ],
)
def test_run_ups_that_cannot_be_are_refused(signal, time, speed, said):
    with pytest.raises(FieldError, match=said):
        order_map(signal, RATE, time, speed)
