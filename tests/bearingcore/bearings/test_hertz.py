"""Hertzian contact against the integrals it comes from, and against a commercial code."""

import math

import mpmath
import pytest

from bearingcore import equilibrium, presets
from bearingcore.bearings.hertz import race_contact

D_B, D_P = 11.5e-3, 43.5e-3
STEEL = (210e9, 0.3)
PER_MM = 10.0**-4.5
"""N/mm^1.5 in one N/m^1.5."""

COMMERCIAL = 5e-5
"""Relative tolerance to which the published values of the commercial code are to be met."""

GROOVES = [
    pytest.param(race, conformity, D_p, angle, id=f"{race} {conformity} {D_p} {angle}")
    for race in ("inner", "outer")
    for conformity, D_p, angle in (
        (0.505, D_P, 0.0),
        (0.52, D_P, 0.0),
        (0.53, 3.0 * D_B, 0.7),
        (0.6, 40.0 * D_B, 0.3),
        (0.5 + 1e-9, D_P, 0.0),
    )
]
every_groove = pytest.mark.parametrize(("race", "conformity", "D_p", "angle"), GROOVES)


def principal_curvatures(
    race: str, conformity: float, D_p: float, angle: float
) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Relative curvatures (along the rolling, across it) of ball and race, from their radii."""
    D_b, r = mpmath.mpf(D_B), mpmath.mpf(conformity * D_B)
    to_axis = mpmath.mpf(D_p) / 2 / mpmath.cos(mpmath.mpf(angle))  # along the line of contact
    around = 1 / (to_axis - D_b / 2) if race == "inner" else -1 / (to_axis + D_b / 2)
    return 2 / D_b + around, 2 / D_b - 1 / r


@every_groove
def test_contact_fulfils_hertz_integrals(
    race: str, conformity: float, D_p: float, angle: float
) -> None:
    """Half ellipsoid of pressure on half-spaces: both curvatures and the approach come out.

    Displacement of the surfaces under p = p0 √(1 − x²/a² − y²/b²) (Hertz 1882, Love 1944):
    δ − A x² − B y² = (1 − ν²)/E · 3Q/(2π) · ∫ (1 − x²/(a²+w) − y²/(b²+w)) dw / √((a²+w)(b²+w)w),
    with A and B half the relative curvatures; no elliptic integral is used here.
    """
    load = 1234.0
    contact = race_contact(race, D_B, D_p, conformity * D_B, angle, *STEEL)
    a, b = (mpmath.mpf(float(x)) for x in contact.semi_axes(load))
    with mpmath.workdps(40):
        along, across = principal_curvatures(race, conformity, D_p, angle)
        E, nu = map(mpmath.mpf, STEEL)
        factor = (1 - nu**2) / E * 3 * mpmath.mpf(load) / (2 * mpmath.pi)

        def integral(p: int, q: int) -> mpmath.mpf:
            """∫ dw / ((a²+w)^p (b²+w)^q √((a²+w)(b²+w)w)), with w = a² u², u = e^t."""
            k2 = (b / a) ** 2

            def part(t: mpmath.mpf) -> mpmath.mpf:
                u = mpmath.exp(t)
                w = u * u
                below = (1 + w) ** (p + mpmath.mpf(1) / 2) * (k2 + w) ** (q + mpmath.mpf(1) / 2)
                return 2 * u / below

            points = [mpmath.mpf(x) for x in (-100, -40, -20, -10, -5, 0, 5, 10, 40, 100)]
            return mpmath.quad(part, points) * a ** (-1 - 2 * p - 2 * q)

        assert float(factor * integral(1, 0) / (across / 2)) == pytest.approx(1.0, abs=2e-10)
        assert float(factor * integral(0, 1) / (along / 2)) == pytest.approx(1.0, abs=1e-13)
        approach = factor * integral(0, 0)
        K = load / approach ** mpmath.mpf("1.5")
    assert contact.load_deflection_factor == pytest.approx(float(K), rel=1e-13)
    assert contact.curvature_sum == pytest.approx(float(along + across), rel=1e-14)


@pytest.mark.parametrize(
    ("race", "radius", "words"),
    [
        ("inner", 5.7e-3, r"inner_groove_radius is 0.0057; .*0.00575 m"),
        ("outer", 30e-3, r"outer_groove_radius is 0.03; .*below 0.0275 m"),
    ],
)
def test_a_groove_tighter_than_its_ball_or_wider_than_its_race_is_refused(
    race: str, radius: float, words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        race_contact(race, D_B, D_P, radius, 0.0, *STEEL)


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
