"""What contacts of every kind bear: pressure, oil film, life, limits, and how often they pass."""

import math

import numpy as np
import pytest

from bearingcore import contact_pressures, equilibrium, film, life, limits
from tests.outside.elements import point_contact
from tests.outside.test_kinds import CAGE, CASES, INCH, Case, balls, kinds
from tests.outside.witness import witness

PLANE = 210e9 / 0.91
"""[Pa] E/(1 − ν²) of steel."""
LENGTH = {"roller": 11e-3, "tapered": 10.3e-3}
"""[m] of the rollers."""
RACES = (("inner", -1.0), ("outer", 1.0))


def gamma(case: Case) -> float:
    """D cos α/D_p, from the speed of the cage."""
    return 1.0 - 2.0 * case.cage


def heaviest(case: Case) -> float:
    """Load [N] of the most loaded element at the three cage angles."""
    states = [case.rows.rest(case.force, cage, case.free) for cage in CAGE]
    return max(case.rows.load(q, cage).max() for q, cage in zip(states, CAGE, strict=True))


def pressures(kind: str, load: float) -> list[float]:
    """Greatest pressure [Pa] on the inner and the outer race, by Hertz."""
    case = CASES[kind]
    if kind in LENGTH:  # cylinder on cylinder: p² = Q/l E'/(2 π R)
        radii = [0.5 * case.rows.element * (1.0 + side * gamma(case)) for _, side in RACES]
        return [math.sqrt(load / LENGTH[kind] * PLANE / (2.0 * math.pi * R)) for R in radii]
    results = []
    for across, along in case.curvatures:
        if across == along:  # a sphere in a sphere: p³ = 6 Q (E'/2)²/(π³ R²)
            R = 1.0 / (2.0 / case.rows.element + across)
            results.append((6.0 * load * (0.5 * PLANE) ** 2 / (math.pi**3 * R**2)) ** (1.0 / 3.0))
        else:
            one = point_contact(case.rows.element, across, along)[1]
            results.append(one * load ** (1.0 / 3.0))
    return results


@witness(
    "* bearing: pressure", "function: contact_pressures",
    by="Hertz by his integrals, for cylinders and spheres by closed form, on loads of `elements`",
    compared="greatest pressure on both races", within=1e-5,
)  # fmt: skip
@kinds
def test_pressures(kind: str) -> None:
    scene = CASES[kind].scene
    both = contact_pressures(scene, equilibrium(scene, CAGE))
    own = pressures(kind, heaviest(CASES[kind]))
    ours = [one.greatest_pressure for one in (both.inner, both.outer)]
    assert ours == pytest.approx(own, rel=1e-5)


LOADS = ("fx", "fy", "fz", "mx", "my")


@witness(
    "* bearing: limits", "function: limits",
    by="pressures of this file; 4600, 4200 and 4000 MPa as NSK prints them (Static Load Ratings)",
    compared="pressure and its limit on both races, on which side of it a load is", within=1e-5,
)  # fmt: skip
@kinds
def test_limits_of_pressure(kind: str) -> None:
    printed = {"self-aligning": 4.6e9, "roller": 4.0e9, "tapered": 4.0e9}.get(kind, 4.2e9)
    crossed = set()
    for times in (1.0, 25.0):
        case = CASES[kind]._replace(force=times * CASES[kind].force)
        scene = case.scene.replace(**dict(zip(LOADS, map(float, case.force), strict=True)))
        every_limit = limits(scene, equilibrium(scene, CAGE))
        own = pressures(kind, heaviest(case))
        for (race, _), pressure in zip(RACES, own, strict=True):
            (limit,) = [one for one in every_limit if one.name == f"contact pressure, {race} race"]
            assert limit.limit == printed
            assert limit.value == pytest.approx(pressure, rel=1e-5)
            assert limit.crossed == (pressure > printed)
            crossed.add(limit.crossed)
    assert crossed == {False, True}


@witness(
    "ball bearing: limits", "function: limits",
    by="moment of the contacts of `elements` about the shaft's middle",
    compared="moment that held tilts take, of a 7208 at 25°", within=3e-3,
)  # fmt: skip
def test_moment_of_held_tilts() -> None:
    case = balls(
        "7208-25deg", 14, 15 / 32 * INCH, 60e-3, math.radians(25), (0, -1500, 1500, 0, 0),
        0.0, (8.0, 1e-4), [0, 1, 2],
    )  # fmt: skip
    q = case.rows.rest(case.force, CAGE[1], case.free)
    moment = case.rows.directions(q, CAGE[1])[3:] @ case.rows.load(q, CAGE[1])
    (said,) = [
        one
        for one in limits(case.scene, equilibrium(case.scene, [CAGE[1]]))
        if one.name == "held tilts"
    ]
    shown = float(said.sentence.partition("up to ")[2].partition(" ")[0])
    assert shown == pytest.approx(np.hypot(*moment), rel=3e-3)


def test_free_tilts_are_those_of_least_energy() -> None:
    """The pair of 7208 with a radial and an axial load, by `elements`."""
    case = CASES["rows"]
    q = case.rows.rest(case.force, CAGE[1], case.free)
    every_limit = limits(case.scene, equilibrium(case.scene, [CAGE[1]]))
    (said,) = [one.sentence for one in every_limit if one.name == "free tilts"]
    shown, unit = said.partition("tilts by up to ")[2].split()
    assert unit == "µrad."
    assert 1e-6 * float(shown) == pytest.approx(np.hypot(*q[3:]), rel=3e-3)


OIL = {"viscosity": 0.017, "pressure_viscosity": 1.8e-8}


@witness(
    "* bearing: film", "function: film",
    by="Hamrock and Dowson (1977), Pan and Hamrock (1989) as printed, with the ellipse found here",
    compared="thickness and film parameter at both races", within=1e-5,
)  # fmt: skip
@kinds
def test_films(kind: str) -> None:
    case, scene = CASES[kind], CASES[kind].scene
    oil_film = film(scene, **OIL, state=equilibrium(scene, CAGE))
    load, D = heaviest(case), case.rows.element
    pitch = D * math.cos(case.rows.angle) / gamma(case)
    # seen from the cage, the inner race and the ball's surface move alike
    speed = 0.5 * pitch * (1.0 - gamma(case)) * scene.shaft_speed * (1.0 - case.cage)
    for (race, side), (i, _) in zip(RACES, enumerate(RACES), strict=True):
        R = 0.5 * D * (1.0 + side * gamma(case))
        U, G = 0.017 * speed / (PLANE * R), 1.8e-8 * PLANE
        if kind in LENGTH:
            own = 1.714 * R * U**0.694 * G**0.568 * (load / (LENGTH[kind] * PLANE * R)) ** -0.128
        else:
            across, along = case.curvatures[i]
            k = 1.0 if across == along else point_contact(D, across, along)[2]
            W = load / (PLANE * R**2)
            own = 3.63 * R * U**0.68 * G**0.49 * W**-0.073 * (1.0 - math.exp(-0.68 * k))
        ours = getattr(oil_film, race)
        assert ours.thickness == pytest.approx(own, rel=1e-5)
        sigma = math.hypot(0.1e-6, 0.05e-6)  # race and ball, as they are unless given
        assert ours.film_parameter == pytest.approx(own / sigma, rel=1e-5)


INNER_GROOVES = {"ball": 0.52, "rows": 0.52, "self-aligning": 0.53}


@witness(
    "ball bearing: life", "self-aligning bearing: life", "rows bearing: life", "function: life",
    by="ISO 16281, Eqs. for point contact written out here, on loads of `elements`",
    compared="L_10r of the healthy bearing with a ball on the load line, C_r = 30 kN", within=1e-5,
)  # fmt: skip
@pytest.mark.parametrize("kind", INNER_GROOVES)
def test_lives_of_balls(kind: str) -> None:
    case = CASES[kind]
    rows = type(case.rows)(**{**vars(case.rows), "defect": None})
    cage = -0.5 * math.pi
    q = rows.rest(case.force, cage, case.free)
    loads = rows.load(q, cage).reshape(-1, rows.count)
    i, g, D = len(rows.places), gamma(case), rows.element
    inner = INNER_GROOVES[kind]
    sphere = -1.0 / case.curvatures[1][0] / D  # the outer groove, a sphere or not
    ratio = (inner / sphere) * (2.0 * sphere - 1.0) / (2.0 * inner - 1.0)
    B = 1.044 * ((1.0 - g) / (1.0 + g)) ** 1.72 * ratio**0.41
    share = 30e3 / (rows.count * math.cos(rows.angle) * i**0.7)
    Q_ci = share / 0.407 * (1.0 + B ** (10.0 / 3.0)) ** 0.3
    Q_ce = share / 0.389 * (1.0 + B ** (-10.0 / 3.0)) ** 0.3
    # a race that turns against the load averages the third power, the other one Q^(10/3)
    Q_ei = np.mean(loads**3, axis=1) ** (1.0 / 3.0)
    Q_ee = np.mean(loads ** (10.0 / 3.0), axis=1) ** 0.3
    worn = (Q_ei / Q_ci) ** (10.0 / 3.0) + (Q_ee / Q_ce) ** (10.0 / 3.0)
    rated = life(case.scene.healthy(), 30e3, positions="load line")
    assert rated.million_revolutions == pytest.approx(worn.sum() ** -0.9, rel=1e-5)
    turns_an_hour = case.scene.shaft_speed / (2.0 * math.pi) * 3600.0
    assert rated.hours == pytest.approx(worn.sum() ** -0.9 * 1e6 / turns_an_hour, rel=1e-5)


@witness(
    "* bearing: ball-pass frequencies",
    by="rolling without sliding: surface speeds of both races and of the element, written out here",
    compared="cage, both races and the element's spin of each kind", within=1e-12,
)  # fmt: skip
@kinds
def test_frequencies_of_rolling(kind: str) -> None:
    case = CASES[kind]
    bearing, Z = case.scene.bearing, case.rows.count
    D = case.rows.element
    pitch = D * math.cos(case.rows.angle) / gamma(case)
    turn = 2.0 * math.pi  # [rad/s], one turn a second
    contacts = [0.5 * pitch * (1.0 + side * gamma(case)) for _, side in RACES]
    # the cage goes with the middle of the element, halfway between the speeds of the contacts
    cage = 0.5 * turn * contacts[0] / (0.5 * pitch) / turn
    spin = (1.0 - cage) * contacts[0] / (0.5 * D)
    frequencies = [getattr(bearing, name)(turn) for name in ("ftf", "bpfo", "bpfi", "bsf")]
    assert frequencies == pytest.approx([cage, Z * cage, Z * (1.0 - cage), spin], rel=1e-12)
