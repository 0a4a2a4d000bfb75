"""What is wrong with a signal itself."""

import numpy as np
import pytest

from bearingcore.measured.signals._dropouts import cut_off, signal_faults
from tests.outside.witness import witness


@pytest.fixture
def noise() -> np.ndarray:
    return np.random.default_rng(1).standard_normal(4000)


def _held(noise: np.ndarray, begin: int, end: int) -> np.ndarray:
    return np.full(end - begin, noise[begin])


def _drawn(noise: np.ndarray, begin: int, end: int) -> np.ndarray:
    return np.linspace(noise[begin - 1], noise[end], end - begin + 2)[1:-1]


def _again(noise: np.ndarray, begin: int, end: int) -> np.ndarray:
    return noise[2 * begin - end : begin]


@pytest.mark.parametrize("fill", [_held, _drawn, _again])
@pytest.mark.parametrize(("step", "least"), [(0.0, 3), (1e-3, 6), (0.05, 16)])
def test_gaps_are_found_however_a_recorder_fills_them(noise, fill, step, least):
    """What is found is as short as numbers so coarse allow, and nothing else is found."""
    whole = np.round(noise / step) * step if step else noise
    assert signal_faults(whole).dropped_share == 0.0
    filled = whole.copy()
    expected = np.zeros(len(noise), dtype=bool)
    for begin in (500, 1000, 3500):
        filled[begin : begin + least] = fill(whole, begin, begin + least)
        expected[begin : begin + least] = True
    faults = signal_faults(filled)
    assert np.count_nonzero(faults.dropped != expected) <= 3  # neighbours, by chance
    assert faults.dropped_share == faults.dropped.mean()


def test_signals_that_were_resampled_or_are_periodic_have_no_gaps(noise):
    place = np.arange(0.0, 3900.0, 0.3)
    drawn = np.interp(place, np.arange(4000), noise)
    for whole in (np.tile(noise[:500], 8), drawn, np.repeat(noise, 4)):
        assert signal_faults(whole).dropped_share < 0.01


def test_a_sensor_that_stays_at_its_rail_has_dropped_out(noise):
    noise[1000:1400] = 9.0
    faults = signal_faults(noise)
    assert faults.dropped_share == 0.1
    assert faults.clipped_share == 0.0


@witness(
    "signal: cut_off",
    by="counting: noise clipped at a known limit",
    compared="samples at the limit; none of whole signals in coarse numbers",
    within="each sample",
)
@pytest.mark.parametrize("step", [1e-9, 1e-3, 0.02])
def test_peaks_that_a_recorder_cut_off_are_said_and_coarse_numbers_are_not(step: float) -> None:
    """Noise, a sine and pulses between rests, in numbers as coarse as cheap recorders give."""
    noise = np.random.default_rng(3).standard_normal(20_000)
    sine = np.sin(2.0 * np.pi * 29.5 / 12_800.0 * np.arange(20_000))
    pulses = np.where(np.arange(20_000) % 400 < 40, np.abs(noise) + 1.0, 0.0)
    for whole in (noise, sine, pulses):
        assert not cut_off(np.round(whole / step) * step)
    both = np.round(np.clip(noise, -2.0, 2.0) / step) * step
    count = np.count_nonzero(np.abs(both) == both.max())
    assert f"{count} samples of the file reach exactly 2 or −2:" in cut_off(both)
    assert " exactly 2:" in cut_off(np.minimum(np.round(noise / step) * step, 2.0))
