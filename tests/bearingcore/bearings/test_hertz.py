"""Hertzian contact against the integrals it comes from, and against a commercial code."""

import math

import pytest

from bearingcore import equilibrium, presets

PER_MM = 10.0**-4.5
"""N/mm^1.5 in one N/m^1.5."""

COMMERCIAL = 5e-5
"""Relative tolerance to which the published values of the commercial code are to be met."""


def test_commercial_load_deflection_factors() -> None:
    bearing = presets["seven-ball"].bearing
    for race, expected in (("inner", 971_990.0), ("outer", 916_453.0)):
        factor = bearing.race_contact(race).load_deflection_factor
        assert factor * PER_MM == pytest.approx(expected, rel=COMMERCIAL)
    together = bearing.load_deflection_factor * PER_MM
    assert together == pytest.approx(333_592.0, rel=COMMERCIAL)


@pytest.mark.parametrize(
    ("load", "clearance", "direction", "printed"),
    [
        ({"fy": -1000.0}, 0.0, 1, -15.1101e-6),
        ({"fy": -1000.0}, 10e-6, 1, -21.2230e-6),
        ({"fz": 1000.0}, 0.0, 2, 133.5381e-6),
        # the ball on the line of the moment does not feel the tilt; along x it is 3.6952 mrad
        ({"my": 1.0}, 0.0, 4, 3.6957e-3),
    ],
    ids=["radial", "radial, clearance", "axial", "tilt"],
)
def test_commercial_displacements(
    load: dict[str, float], clearance: float, direction: int, printed: float
) -> None:
    """With a ball at 270°."""
    nothing = dict.fromkeys(("fx", "fy", "fz", "mx", "my"), 0.0)
    scene = presets["seven-ball"].healthy().replace(radial_clearance=0.5 * clearance)
    scene = scene.replace(**{**nothing, **load})
    answer = equilibrium(scene, [math.radians(270.0)], ("x", "y", "z", "rx", "ry"))
    assert answer.residual[0] < 1e-9
    assert answer.displacement[0, direction] == pytest.approx(printed, rel=COMMERCIAL)
