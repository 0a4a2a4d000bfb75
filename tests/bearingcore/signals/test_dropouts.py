"""What is wrong with a signal itself."""

import numpy as np
import pytest

from bearingcore.signals.dropouts import LEAST_RUN, cut_off, signal_faults
from tests.outside.witness import witness


@pytest.fixture
def noise() -> np.ndarray:
    return np.random.default_rng(1).standard_normal(4000)


@pytest.mark.parametrize("held", [0.0, 0.5])
def test_runs_of_one_number_are_dropouts_wherever_they_lie(noise, held):
    expected = np.zeros(len(noise), dtype=bool)
    for begin, end in ((0, 100), (1000, 1000 + LEAST_RUN), (3900, 4000)):
        noise[begin:end] = held
        expected[begin:end] = True
    noise[2000 : 2000 + LEAST_RUN - 1] = held  # a sample too few
    found = signal_faults(noise)
    np.testing.assert_array_equal(found.dropped, expected)
    assert found.dropped_share == expected.mean()


def test_a_sensor_that_stays_at_its_rail_has_dropped_out(noise):
    noise[1000:1400] = 9.0
    found = signal_faults(noise)
    assert found.dropped_share == 0.1
    assert found.clipped_share == 0.0


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
