"""Units as headings give them, and velocities made accelerations."""

import numpy as np
import pytest

from bearingcore.files.units import cut_off, differentiated, unit_in


@pytest.mark.parametrize(
    ("heading", "unit"),
    [
        ("a / g", "g"),
        ("Vibration [mG]", "mg"),
        ("acceleration_y_m_per_s2", "m/s²"),
        ("ch1 (V)", "V"),
        ("vel [ips]", "in/s"),
        ("Zeit [µs]", "µs"),
        ("Horizontal_vibration_signals", None),
        ("Acceleration", None),
    ],
)
def test_units_in_headings(heading: str, unit: str | None) -> None:
    assert unit_in(heading) == unit


@pytest.mark.parametrize("frequency", [3.7, 123.3, 390.0])
def test_a_velocity_is_differentiated_far_from_its_ends(frequency: float) -> None:
    """A tenth of the error that differences of neighbours make, even near half the rate."""
    rate, time = 1000.0, np.arange(3000) / 1000.0
    omega = 2.0 * np.pi * frequency
    found = differentiated(np.sin(omega * time + 1.0)[:, None], rate)[:, 0]
    exact = omega * np.cos(omega * time + 1.0)
    np.testing.assert_allclose(found[100:-100], exact[100:-100], atol=1e-3 * omega)


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
