"""Units as headings give them, and velocities made accelerations."""

import numpy as np
import pytest

from bearingcore.measured.files import UNITS, unit_in
from bearingcore.measured.files._units import differentiated


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


def test_factors_of_units() -> None:
    factors = [UNITS[unit] for unit in ("mg", "m/s²", "in/s²")]
    assert factors == pytest.approx([9.80665e-3, 1.0, 0.0254], rel=1e-12)


@pytest.mark.parametrize("frequency", [3.7, 123.3, 390.0])
def test_a_velocity_is_differentiated_far_from_its_ends(frequency: float) -> None:
    """A tenth of the error that differences of neighbours make, even near half the rate."""
    rate, time = 1000.0, np.arange(3000) / 1000.0
    omega = 2.0 * np.pi * frequency
    actual = differentiated(np.sin(omega * time + 1.0)[:, None], rate)[:, 0]
    exact = omega * np.cos(omega * time + 1.0)
    np.testing.assert_allclose(actual[100:-100], exact[100:-100], atol=1e-3 * omega)
