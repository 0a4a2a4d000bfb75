"""Condition indicators against closed forms."""

import math

import numpy as np
import pytest

from bearingcore import Recording, indicators
from bearingcore.signals.indicators import ZONES, severity_zone

RATE = 12_000.0
TIME = np.arange(36_000) / RATE


def recorded(*columns: np.ndarray, rate: float = RATE) -> Recording:
    return Recording(np.stack(columns, axis=1), rate, ("x", "y")[: len(columns)])


@pytest.mark.parametrize("frequency", [12.0, 50.0, 160.0, 900.0])
@pytest.mark.parametrize("amplitude", [1e-3, 3.0])
def test_a_sine_about_any_mean(frequency, amplitude):
    sine = amplitude * np.sin(2.0 * math.pi * frequency * TIME)
    found = indicators(recorded(sine + 7.0))
    assert found.rms == pytest.approx([amplitude / math.sqrt(2.0)], rel=1e-6)
    assert found.peak == pytest.approx([amplitude], rel=1e-2)
    assert found.crest_factor == pytest.approx([math.sqrt(2.0)], rel=1e-2)
    assert found.kurtosis == pytest.approx([1.5], rel=1e-6)
    velocity = amplitude / (2.0 * math.pi * frequency)
    assert found.velocity_rms == pytest.approx([velocity / math.sqrt(2.0)], rel=2e-2)


def test_what_lies_outside_of_the_band_has_no_velocity():
    inside, below, above = (np.sin(2.0 * math.pi * f * TIME) for f in (100.0, 4.0, 3000.0))
    found = indicators(recorded(inside + below + above, inside))
    assert found.velocity_rms[0] == pytest.approx(found.velocity_rms[1], rel=1e-3)
    slow = indicators(recorded(inside + below, below), shaft_speed=2.0 * math.pi * 4.0)
    assert slow.band == (2.0, 1000.0)
    assert slow.velocity_rms[1] == pytest.approx(
        1.0 / (2.0 * math.pi * 4.0) / math.sqrt(2.0), rel=0.05
    )


def test_noise_square_waves_and_knocks():
    rng = np.random.default_rng(1)
    noise = indicators(recorded(rng.standard_normal(200_000)))
    assert noise.kurtosis == pytest.approx([3.0], abs=0.1)
    square = indicators(recorded(np.where(np.arange(4000) % 2, 1.0, -1.0)))
    assert square.crest_factor == pytest.approx([1.0])
    assert square.kurtosis == pytest.approx([1.0])
    knocks = np.zeros(10_000)
    knocks[::1000] = 1.0  # a share p of ones: kurtosis near 1/p, crest factor near 1/√p
    found = indicators(recorded(knocks))
    assert found.kurtosis == pytest.approx([1000.0], rel=0.01)
    assert found.crest_factor == pytest.approx([math.sqrt(1000.0)], rel=0.01)
    assert found.table()["kurtosis"] == pytest.approx(found.kurtosis)


@pytest.mark.parametrize(
    ("recording", "why"),
    [
        (recorded(np.sin(TIME), rate=2000.0), "sample rate is 2000 Hz"),
        (recorded(np.sin(100.0 * TIME[:1200])), "0.1 s long, and 10 Hz need 0.5 s"),
    ],
)
def test_where_there_is_no_velocity_it_says_why(recording, why):
    found = indicators(recording)
    assert np.isnan(found.velocity_rms).all()
    assert why in found.velocity_reason
    assert np.isfinite(found.rms).all()


@pytest.mark.parametrize("machine", ZONES)
def test_zones_begin_at_their_boundaries(machine):
    first, second, third = ZONES[machine]
    for boundary, below, above in ((first, "A", "B"), (second, "B", "C"), (third, "C", "D")):
        assert severity_zone(boundary, machine) == below
        assert severity_zone(1.001 * boundary, machine) == above


def test_zones_of_no_machine_and_no_number_are_refused():
    with pytest.raises(ValueError, match="machine"):
        severity_zone(1e-3, "small")
    with pytest.raises(ValueError, match="velocity"):
        severity_zone(math.nan, "large, rigid")
