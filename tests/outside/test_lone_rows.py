"""A row alone on its shaft: what it carries, what it induces, and when there is no equilibrium.

Witnesses: statics at a fixed contact angle by SciPy (forces of rollers are a non-negative
combination of their directions, whatever their stiffness), Sjövall's integrals by quadrature, the
F_r/(2 Y) of makers' catalogues, and `tests.helpers.judge`, which shares no code with the solver.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import fsolve, linprog

from bearingcore import (
    Bearing,
    Equilibrium,
    Limit,
    Load,
    Scene,
    contact_pressures,
    equilibrium,
    life,
    limits,
    modes,
    orbit,
    presets,
    simulate,
    stiffness_maps,
)
from bearingcore.bearings._tapered import USUAL_ANGLE
from bearingcore.common import with_prefix
from bearingcore.model.dynamics import MotionStatus, OrbitStatus
from bearingcore.model.scene import TILT_FREE
from bearingcore.model.statics._status import StaticStatus
from bearingcore.model.sweeps import STATUSES, sweep
from tests.helpers.contact_law import Balls
from tests.helpers.judge import beyond_geometry
from tests.helpers.random_rows import KINDS, random_scene
from tests.outside.test_kinds import INCH, balls
from tests.outside.witness import witness

CONE = presets["30206-back-to-back"].bearing.replace(rows=())
Z, ALPHA = 17, USUAL_ANGLE
BALL = presets["7208-25deg"].healthy()
LEVEL = ("x", "y", "z")
OUT = {
    "free in all directions": (-4000.0, 4000.0, TILT_FREE, "tilts that are held"),
    "pressed out of its cup": (0.0, -500.0, TILT_FREE, "500 N press the inner ring out"),
    "less thrust than F_r tan α": (-4000.0, 500.0, LEVEL, "more axial load: with 500 N the inner"),
    "both": (-4000.0, 500.0, TILT_FREE, "tilts that are held, and more axial load"),
}
"""Loads that no lone cone carries: fy, fz [N], free directions, what is said to be missing."""


def cone(
    fy: float, fz: float, dofs: tuple[str, ...] | str = TILT_FREE, bearing: Bearing = CONE
) -> Scene:
    rig = presets["nu208"].healthy()
    return Scene(bearing, rig.defect, Load(0.0, fy, fz), rig.shaft_speed, rig.support, dofs=dofs)


def directions(n: int, angle: float, cage_angle: float) -> np.ndarray:
    """Forces and moments over r_d (n, 5) of a load of 1 on each roller at a fixed angle."""
    phi = cage_angle + 2.0 * math.pi / n * np.arange(n)
    c, s, ca, sa = np.cos(phi), np.sin(phi), math.cos(angle), math.sin(angle)
    return np.stack([ca * c, ca * s, sa + 0.0 * c, sa * s, -sa * c], axis=1)


def of(limits: tuple[Limit, ...], name: str) -> Limit:
    return next(limit for limit in limits if limit.name == name)


@pytest.mark.parametrize(("fy", "fz", "dofs", "missing"), OUT.values(), ids=OUT.keys())
def test_a_cone_that_leaves_its_cup_has_no_equilibrium_anywhere(
    fy: float, fz: float, dofs: tuple[str, ...] | str, missing: str
) -> None:
    """A cone's lines of contact meet on the shaft: no moment about that point (any textbook)."""
    scene = cone(fy, fz, dofs)
    state = equilibrium(scene, [0.0, 0.1])
    assert (state.status == StaticStatus.NOT_CARRIED).all()
    for values in (state.displacement, state.ball_load, state.stiffness):
        assert np.isnan(values).all()
    assert missing in state.reason(0)
    assert missing in str(state.table().named()["status"][0])
    lasts = life(scene, 43_500.0)
    assert not lasts.known
    assert missing in lasts.sentence
    pressed = contact_pressures(scene, state)
    assert math.isnan(pressed.inner.greatest_pressure)
    assert missing in pressed.reason
    ringing = modes(scene, [0.0])
    assert np.isnan(ringing.frequency).all()
    assert missing in ringing.reason(0)
    moved = simulate(scene, 0.01)
    assert moved.status is MotionStatus.NO_START
    assert missing in moved.detail
    assert np.isnan(moved.history).all()
    circling = orbit(scene)
    assert circling.status is OrbitStatus.NO_START
    assert missing in circling.cost
    drawn = stiffness_maps(scene, [0.0], [0.0])
    assert np.isnan(drawn.stiffness).all()
    assert missing in drawn.reason(0, 0)


def test_a_sweep_says_so_too() -> None:
    dataset = sweep(cone(-4000.0, 4000.0, LEVEL), {"fz": [4000.0, 500.0, -500.0]}, ["k_zz_mean"])
    codes = [STATUSES[int(code)].value for code in dataset["status"].values]
    assert codes == ["complete", "load_not_carried", "load_not_carried"]
    assert np.isfinite(dataset["k_zz_mean"].values).tolist() == [True, False, False]


@pytest.mark.parametrize(
    ("degrees", "heaviest"), [(13.8564, 1471.0), (math.degrees(ALPHA), 1459.0)]
)
def test_a_cone_with_held_tilts_carries_what_statics_at_a_fixed_angle_gives(
    degrees: float, heaviest: float
) -> None:
    """17 rollers, the heaviest under 1471 N at 13.86° (`fsolve`; no stiffness enters)."""
    angle = math.radians(degrees)
    bearing = CONE.replace(contact_angle=angle)
    for cage_angle in np.linspace(0.0, 2.0 * math.pi / Z, 9):
        e = directions(Z, angle, cage_angle)[:, :3]

        def unbalanced(q: np.ndarray, e: np.ndarray = e) -> np.ndarray:
            return np.maximum(e @ q, 0.0) ** (10.0 / 9.0) @ e - [0.0, -4000.0, 4000.0]

        loads = np.maximum(e @ fsolve(unbalanced, [0.0, -200.0, 2000.0], xtol=1e-13), 0.0)
        loads = loads ** (10.0 / 9.0)
        state = equilibrium(cone(-4000.0, 4000.0, LEVEL, bearing), [cage_angle])
        assert state.ball_load[0] == pytest.approx(loads, rel=1e-7)
        assert state.loaded_balls[0] == Z
        if cage_angle == 0.0:
            assert loads.max() == pytest.approx(heaviest, abs=0.5)


def test_random_cones_converge_where_rollers_can_carry_the_load_and_only_there() -> None:
    """A load is carried where it is a non-negative sum of the rollers' directions (`linprog`)."""
    rng = np.random.default_rng(30206)
    carried = 0
    for _ in range(150):
        n, angle = int(rng.integers(5, 25)), math.radians(float(rng.uniform(8.0, 30.0)))
        bearing = CONE.replace(n_balls=n, ball_diameter=4e-3, contact_angle=angle)
        fy, share = -1000.0, float(rng.uniform(-0.5, 3.0))
        cage_angle = float(rng.uniform(0.0, 6.0))
        dofs = LEVEL if rng.random() < 0.7 else TILT_FREE
        scene = cone(fy, share * math.tan(angle) * abs(fy), dofs, bearing)
        free = [0, 1, 2] if dofs == LEVEL else [0, 1, 2, 3, 4]
        e, load = directions(n, angle, cage_angle)[:, free], scene.load.vector[free]
        can = linprog(np.ones(n), A_eq=e.T, b_eq=load).status == 0
        state = equilibrium(scene, [cage_angle])
        assert bool(state.converged[0]) == can, scene
        assert state.status[0] in (StaticStatus.CONVERGED, StaticStatus.NOT_CARRIED)
        carried += can
    assert 30 < carried < 120


@pytest.mark.parametrize("kind", KINDS)
def test_no_converged_state_is_beyond_the_geometry_of_its_contacts(kind: str) -> None:
    """Tilts up to 0.2 rad, half an element of compression, grooves not past each other (judge)."""
    rng = np.random.default_rng([41, KINDS.index(kind)])
    beyond = 0
    for _ in range(150):
        scene = random_scene(rng, kind)
        scene = dataclasses.replace(scene, load=heavier(scene.load, float(rng.choice([1.0, 30.0]))))
        state = equilibrium(scene, [float(rng.uniform(0.0, 6.28))])
        part = share_of_room(state)
        assert part <= 1.0 + 1e-6 or not state.converged[0], scene
        if state.status[0] == StaticStatus.BEYOND_GEOMETRY:
            beyond += 1
            assert part > 1.0 - 1e-6
            assert np.isnan(state.ball_load).all()
            assert np.isnan(state.stiffness).all()
            assert state.reason(0).startswith("no equilibrium that the geometry")
    assert beyond > 0 or kind == "rollers"


def heavier(load: Load, times: float) -> Load:
    return Load(*(times * load.vector))


def share_of_room(state: Equilibrium) -> float:
    return beyond_geometry(Balls(state.scene, float(state.cage_angles[0])), state.state[0])


def sjovall(n: float) -> float:
    """Ja(0.5)/Jr(0.5) of loads (cos φ)^n over half a turn."""
    axial, radial = (quad(lambda a, m=m: math.cos(a) ** m, 0, math.pi / 2)[0] for m in (n, n + 1.0))
    return axial / radial


@witness(
    "function: limits",
    "tapered bearing: limits",
    "ball bearing: limits",
    by="Sjövall's integrals, F_r/(2 Y) of catalogues",
    compared="induced thrust",
    within=5e-3,
)
def test_the_axial_load_below_the_induced_one_is_said_with_the_number() -> None:
    """Sjövall: F_a = F_r tan α Ja/Jr at half a load zone; catalogues: F_r/(2 Y), Y = 0.4 cot α."""
    assert sjovall(10.0 / 9.0) == pytest.approx(0.3091 / 0.2453, rel=3e-3)  # Harris, Table 7.4
    assert sjovall(1.5) == pytest.approx(0.2782 / 0.2288, rel=3e-3)  # Harris, Table 7.1
    induced = 4000.0 * math.tan(ALPHA) * sjovall(10.0 / 9.0)
    assert induced == pytest.approx(4000.0 / (2.0 * 0.4 / math.tan(ALPHA)), rel=0.02)
    name = "axial load against the induced one"
    for fz, below in ((4000.0, False), (1300.0, False), (1200.0, True), (500.0, True)):
        said = of(limits(cone(-4000.0, fz, LEVEL)), name)
        assert said.limit == pytest.approx(induced, rel=3e-3)
        assert said.crossed == below
        assert ("axial load is below the one it induces (1.26 kN)" in said.sentence) == below
    # of balls at a light load, as their contact angle falls under a heavy one
    light = of(limits(BALL.replace(fy=-1.0, fz=0.1)), name)
    assert light.limit == pytest.approx(math.tan(math.radians(25.0)) * sjovall(1.5), rel=5e-3)
    assert light.crossed


def test_half_of_the_rollers_carry_under_the_induced_axial_load() -> None:
    induced = of(limits(cone(-4000.0, 4000.0, LEVEL)), "axial load against the induced one").limit
    angles = np.linspace(0.0, 2.0 * math.pi / Z, 20, endpoint=False)
    loaded = equilibrium(cone(-4000.0, induced, LEVEL), angles).loaded_balls
    assert loaded.mean() == pytest.approx(0.5 * Z, abs=0.8)


def test_a_row_that_carries_thrust_one_way_says_so_when_it_is_pressed_the_other_way() -> None:
    """Single rows of angular contact and tapered rollers carry thrust one way (SKF, Schaeffler)."""
    name = "thrust the wrong way"
    one_way = {
        "7208-25deg": BALL, "tandem": presets["7208-tandem"].healthy(), "cone": cone(0.0, 500.0)
    }  # fmt: skip
    for scene in one_way.values():
        right, wrong = (of(limits(scene.replace(fy=0.0, fz=fz)), name) for fz in (500.0, -500.0))
        assert not right.crossed
        assert wrong.crossed
        assert wrong.value == pytest.approx(500.0, rel=1e-6)
        assert "carries thrust one way only, and here 500 N press the other way" in wrong.sentence
    for preset in ("6205", "nu208", "1208"):
        both = presets[preset].healthy()
        both = both if preset == "nu208" else both.replace(fz=-500.0)
        assert name not in [limit.name for limit in limits(both)]
    pair = presets["30206-back-to-back"].healthy()
    for fz in (1000.0, -1000.0):
        assert not of(limits(pair.replace(fz=fz)), name).crossed


def test_a_moment_presses_one_row_of_a_tandem_pair_the_wrong_way() -> None:
    """ΣQ of each row along the shaft by `elements.py`; no load along the shaft, 100 N·m."""
    force = (0, 0, 0, 100.0, 0)
    pair = balls(
        "7208-tandem", 14, 15 / 32 * INCH, 60e-3, math.radians(25), force, 0.0, (8.0, 1e-4),
        [0, 1, 2, 3, 4], at=(-9e-3, 9e-3), facing=(1, 1),
    )  # fmt: skip
    rows = dataclasses.replace(pair.rows, defect=None)
    scene = presets["7208-tandem"].healthy().replace(load=Load(mx=100.0), dofs="tilt free")
    q = rows.rest(np.array(force), 0.1, [0, 1, 2, 3, 4])
    along = rows.directions(q, 0.1)[2] * rows.load(q, 0.1)
    wrong = max(-along[:14].sum(), -along[14:].sum())
    assert wrong > 500.0
    said = of(limits(scene, equilibrium(scene, [0.1])), "thrust the wrong way")
    assert said.value == pytest.approx(wrong, rel=1e-6)


def test_the_thrust_that_is_missing_is_the_least_that_any_forces_hold() -> None:
    """Σ Q_j sin α of rollers of three and of seventeen, least by `linprog` wherever the cage is."""
    for n in (3, Z):
        bearing = CONE.replace(n_balls=n)
        for cage_angle in np.linspace(0.0, 2.0, 9):
            e = directions(n, ALPHA, cage_angle)
            least = linprog(e[:, 2], A_eq=e[:, :2].T, b_eq=[0.0, -4000.0]).fun
            for share in (0.2, 0.99):
                state = equilibrium(cone(-4000.0, share * least, LEVEL, bearing), [cage_angle])
                said = state.reason(0).partition("and over ")[2].partition(" must")[0]
                assert said == with_prefix(least, "N")
