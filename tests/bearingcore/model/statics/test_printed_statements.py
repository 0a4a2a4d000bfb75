"""A slot and the fan rig: printed statements."""

import math

import pytest

from bearingcore import Defect, contact_damping, presets


@pytest.mark.parametrize(
    ("edge", "drop_um", "digit"), [("exact", 106.71, 0.005), ("chord", 128.1, 0.05),
                                   ("published", 31.6, 0.05)]
)  # fmt: skip
def test_drop_in_the_middle_of_a_2_mm_slot(edge: str, drop_um: float, digit: float) -> None:
    bearing = presets["6205"].bearing
    assert bearing.outer_raceway_radius == pytest.approx(23.49e-3, rel=1e-12)
    slot = Defect(2.0 * math.asin(1e-3 / 23.49e-3), 1e-3, 1.0, edge=edge)
    assert float(slot.path(1.0, bearing)) * 1e6 == pytest.approx(drop_um, abs=digit)


def test_contact_damping_of_the_fan_rig() -> None:
    """β · mean(k_xx + k_yy)/mean(loaded balls) of the healthy bearing, with β = 1e-5 s."""
    scene = presets["fan-rig"]
    assert contact_damping(scene) == pytest.approx(122.0, abs=0.1)
    assert contact_damping(scene.replace(contact_damping=80.0)) == 80.0
