"""Simulated measurements of small pits, with balls that have mass."""

import math

import pytest

from bearingcore import Load, presets
from tests.helpers.simulated import pit

CWRU = presets["6205"].replace(
    load=Load(fy=-400.0), shaft_speed=1796 * math.pi / 30.0, contact_damping=300.0
)


@pytest.mark.parametrize(
    ("length_mm", "extent_deg", "sinks_um"),
    [(0.178, 0.434, 0.83), (0.356, 0.867, 3.31), (0.533, 1.301, 7.45)],
)
def test_pits_as_machines_have_them(length_mm: float, extent_deg: float, sinks_um: float) -> None:
    """Seeded pits of the 6205: how long in degrees, how deep a ball sinks, which bridges them."""
    made = pit(CWRU, 1e-3 * length_mm)
    assert math.degrees(made.extent) == pytest.approx(extent_deg, abs=2e-3)
    deepest = float(made.path([made.center], CWRU.bearing)[0])
    assert deepest * 1e6 == pytest.approx(sinks_um, rel=0.02)
    assert deepest < made.depth
