"""Order maps against tones and chirps by closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore.measured.signals import Spectrogram, order_map
from tests.outside.witness import witness

RATE = 25_600.0
TIME = np.arange(round(8.0 * RATE)) / RATE


def power(orders: Spectrogram) -> np.ndarray:
    """Mean square of each segment."""
    return np.asarray(orders.density.sum(axis=1) * (orders.frequency[1] - orders.frequency[0]))


@witness(
    "signal: order_map",
    by="closed form: mean of cos²",
    compared="power of tones up to 0.4 of the sample rate",
    within=0.01,
)
@pytest.mark.parametrize("frequency", [50.0, 1000.0, 5000.0, 10_000.0, 0.4 * RATE])
@pytest.mark.parametrize("speeds", [(25.0, 25.0), (20.0, 30.0)])
def test_a_tone_keeps_its_power(frequency: float, speeds: tuple[float, float]) -> None:
    """cos² has the mean 1/2, up to 0.4 of the sample rate; the cubic had left 0.369 at 10 kHz."""
    orders = order_map(np.cos(2.0 * math.pi * frequency * TIME), RATE, [0.0, 8.0], speeds)
    assert power(orders) == pytest.approx(0.5, rel=0.01)


@witness(
    "signal: order_map",
    by="closed form: a chirp",
    compared="place of its order",
    within=1e-3,
)
@pytest.mark.parametrize("order", [1.0, 3.57, 40.0, 250.0])
def test_an_order_stays_where_it_is_in_a_run_up(order: float) -> None:
    """A chirp that turns 20 to 30 times a second has its line at its order, to 1e-3 of it."""
    turns = 20.0 * TIME + 0.5 * 10.0 / 8.0 * TIME**2
    orders = order_map(np.cos(2.0 * math.pi * order * turns), RATE, [0.0, 8.0], [20.0, 30.0])
    assert power(orders) == pytest.approx(0.5, rel=0.01)
    mean = (orders.density * orders.frequency).sum() / orders.density.sum()
    assert mean == pytest.approx(order, rel=1e-3)
