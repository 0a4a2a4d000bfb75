"""Units as headings give them, and velocities made accelerations."""

import numpy as np
import pytest

from bearingcore.files.units import UNITS, differentiated, kind_of, unit_in, unit_named


@pytest.mark.parametrize(
    ("heading", "unit"),
    [
        ("acc x [mm/s^2]", "mm/s²"),
        ("a (g's)", "g"),
        ("ay, g", "g"),
        ("a / g", "g"),
        ("velocity mm/s", "mm/s"),
        ("vel_mm_s", "mm/s"),
        ("Vibration [mG]", "mg"),
        ("acceleration_y_m_per_s2", "m/s²"),
        ("bearing.gs", "g"),
        ("ch1 (V)", "V"),
        ("vel [ips]", "in/s"),
        ("Zeit [µs]", "µs"),
        ("X097_DE_time", None),
        ("Horizontal_vibration_signals", None),
        ("column 1", None),
        ("Acceleration", None),
        ("g", None),
    ],
)
def test_units_in_headings(heading: str, unit: str | None) -> None:
    assert unit_in(heading) == unit


def test_all_units_are_named_by_themselves() -> None:
    for unit in UNITS:
        assert unit_named(unit) == unit
        assert unit_in(f"signal [{unit}]") == unit
        assert kind_of(unit) in ("acceleration", "velocity", "voltage")


@pytest.mark.parametrize("frequency", [3.7, 123.3, 390.0])
def test_a_velocity_is_differentiated_far_from_its_ends(frequency: float) -> None:
    """A tenth of the error that differences of neighbours make, even near half the rate."""
    rate, time = 1000.0, np.arange(3000) / 1000.0
    omega = 2.0 * np.pi * frequency
    found = differentiated(np.sin(omega * time + 1.0)[:, None], rate)[:, 0]
    exact = omega * np.cos(omega * time + 1.0)
    np.testing.assert_allclose(found[100:-100], exact[100:-100], atol=1e-3 * omega)


def test_a_steady_rise_has_a_constant_slope() -> None:
    ramp = np.linspace(0.0, 3.0, 1001)[:, None]
    np.testing.assert_allclose(differentiated(ramp, 1000.0), 3.0, rtol=1e-9)
