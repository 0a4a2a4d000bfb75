"""Spectra over time, and over the turns of a shaft."""

import math

import numpy as np
import pytest

from bearingcore.signals.spectrograms import order_map, spectrogram

RATE = 6000.0
TIME = np.arange(int(8 * RATE)) / RATE


def run_up(first: float, last: float, orders: dict[float, float], noise: float = 0.3) -> np.ndarray:
    """A shaft that runs from one speed [Hz] to another, with tones at orders."""
    turns = first * TIME + (last - first) * TIME**2 / (2.0 * TIME[-1])
    tones = sum(a * np.sin(2.0 * math.pi * order * turns) for order, a in orders.items())
    return np.asarray(tones + noise * np.random.default_rng(2).standard_normal(TIME.size))


def test_the_power_of_a_tone_is_at_its_frequency_all_the_time():
    found = spectrogram(3.0 * np.sin(2.0 * math.pi * 500.0 * TIME), RATE, 10.0)
    power = found.density.sum(axis=1) * found.frequency[1]
    assert power == pytest.approx(np.full(len(found.time), 4.5), rel=1e-6)
    assert (found.frequency[found.density.argmax(axis=1)] == 500.0).all()
    assert found.time[0] == pytest.approx(0.05)
    assert found.time[-1] <= TIME[-1] - 0.04


def test_orders_stay_where_they_are_while_the_speed_changes():
    signal = run_up(15.0, 35.0, {1.0: 1.0, 3.58: 1.0}, noise=0.01)
    speed = 15.0 + 20.0 * TIME / TIME[-1]
    found = order_map(signal, RATE, TIME, speed)
    mean = found.density.mean(axis=0)
    near = (found.frequency > 2.0) & (found.frequency < 5.0)
    assert found.frequency[near][mean[near].argmax()] == pytest.approx(3.58, abs=0.06)
    line = found.density[:, np.abs(found.frequency - 3.58) < 0.25].sum(axis=1)
    assert line * found.frequency[1] == pytest.approx(np.full(len(line), 0.5), rel=0.02)
    steady = order_map(signal, RATE, [0.0], [25.0])  # it smears without the speed
    near = (steady.frequency > 2.0) & (steady.frequency < 5.0)
    assert steady.density.mean(axis=0)[near].max() < 0.3 * mean.max()


def test_what_cannot_be_is_refused():
    with pytest.raises(ValueError, match="row of 2400 samples"):
        spectrogram(np.zeros(1000), RATE, 10.0)
    with pytest.raises(ValueError, match="finite"):
        spectrogram(np.full(9000, math.nan), RATE, 10.0)
    with pytest.raises(ValueError, match="speeds above 0"):
        order_map(TIME, RATE, [0.0], [0.0])
