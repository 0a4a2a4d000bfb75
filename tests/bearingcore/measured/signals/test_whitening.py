"""Whitening levels the spectrum and takes the weight from tones."""

import numpy as np
import pytest

from bearingcore.measured.signals import local_median
from bearingcore.measured.signals._whitening import LOUDEST, whiten

RATE = 8000.0


def test_coloured_noise_becomes_white_and_tones_no_louder_than_told():
    rng = np.random.default_rng(2)
    count = 80_000
    frequency = np.fft.rfftfreq(count, 1.0 / RATE)
    shape = 1.0 / np.maximum(frequency, 1.0) + 0.01 * np.exp(-(((frequency - 2000) / 50.0) ** 2))
    noise = np.fft.irfft(np.fft.rfft(rng.standard_normal(count)) * shape, count)
    time = np.arange(count) / RATE
    signal = noise + 100.0 * noise.std() * np.sin(2.0 * np.pi * 1234.0 * time)
    white = whiten(np.fft.rfft(signal), RATE / count, 20.0)
    loudness = np.abs(white)
    assert loudness.max() <= LOUDEST * (1.0 + 1e-12)
    powers = [np.mean(part**2) for part in np.array_split(loudness[100:-100], 20)]
    np.testing.assert_allclose(powers, 1.0, atol=0.15)


def test_the_local_median_follows_a_slope_and_passes_over_a_line():
    slope = np.exp(np.linspace(0.0, 3.0, 3000))
    with_line = slope.copy()
    with_line[1500:1503] *= 1e6
    np.testing.assert_allclose(local_median(with_line, 101), slope, rtol=0.06)
    assert local_median(np.ones(5), 101) == pytest.approx(np.ones(5))
