"""Every kind of bearing, at rest and in motion, against `elements.py`, and its contacts' numbers.

Inside dimensions are those of the presets' notes, written down again here; K is Hertz's or ISO
16281's, found here.
"""

import math
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import pytest

from bearingcore import Scene, equilibrium, modes, presets, simulate
from tests.outside.elements import Array, Defect, Rows, point_contact
from tests.outside.march import Problem
from tests.outside.witness import witness

INCH = 25.4e-3
C = 300.0
"""Damping of a contact [N·s/m] that the scenes are given."""


class Case(NamedTuple):
    """Our scene, the same in `Rows`, its directions, load, cage over shaft, and curvatures.

    `curvatures`: across and along the rolling, of the inner and the outer race; none of rollers.
    """

    scene: Scene
    rows: Rows
    free: list[int]
    force: Array
    cage: float
    curvatures: tuple[tuple[float, float], ...]


def balls(
    name: str, count: int, D: float, pitch: float, angle: float, force: tuple[float, ...],
    clearance: float, defect: tuple[float, float], free: list[int], **rows: Any,
) -> Case:  # fmt: skip
    """Rows of balls in grooves of 0.52 and 0.53 diameters, their middles at `at`."""
    ca, sa = math.cos(angle), math.sin(angle)
    curvatures = tuple(
        (-1.0 / (groove * D), side / (0.5 * (pitch / ca - side * D)))
        for groove, side in ((0.52, 1.0), (0.53, -1.0))
    )
    factors = [point_contact(D, *one)[0] for one in curvatures]
    K = sum(factor ** (-2.0 / 3.0) for factor in factors) ** -1.5
    inner = 0.02 * D
    if "at" in rows:
        facing = rows["facing"]
        middles = zip(rows.pop("at"), facing, strict=True)
        rows["places"] = tuple(z + s * inner * sa for z, s in middles)
    hurt = Defect(math.radians(defect[0]), defect[1], 0.5 * (pitch + D))
    own = Rows(
        count,
        D,
        angle,
        0.5 * pitch + inner * ca,
        0.05 * D,
        clearance,
        (K, 1.5),
        defect=hurt,
        **rows,
    )
    gamma, scene = D * ca / pitch, presets[name].replace(mx=force[3], my=force[4])
    return Case(scene, own, free, np.array(force), 0.5 * (1.0 - gamma), curvatures)


def self_aligning() -> Case:
    """Two rows on one sphere: every outer groove centre is the bearing's middle."""
    D, sphere, angle = 11.0 / 32.0 * INCH, 34.4e-3, math.radians(10.0)
    pitch = 2.0 * (sphere - 0.5 * D) * math.cos(angle)
    curvatures = (
        (-1.0 / (0.53 * D), 1.0 / (0.5 * pitch / math.cos(angle) - 0.5 * D)),
        (-1.0 / sphere, -1.0 / sphere),
    )
    inner = point_contact(D, *curvatures[0])[0]
    plane = 210e9 / 0.91  # a ball in a sphere: a circle, F = 2/3 E' sqrt(R) δ^1.5
    outer = 2.0 / 3.0 * plane / math.sqrt(2.0 / D - 1.0 / sphere)
    K = sum(one ** (-2.0 / 3.0) for one in (inner, outer)) ** -1.5
    apart = sphere + 0.53 * D - D
    z, hurt = apart * math.sin(angle), Defect(math.radians(8.0), 1e-4, sphere)
    own = Rows(
        16, D, angle, apart * math.cos(angle), apart, 5e-6, (K, 1.5), (-z, z), (-1, 1), defect=hurt
    )
    gamma = D * math.cos(angle) / pitch
    force = np.array([0.0, -1000.0, 0.0, 0.0, 0.0])
    return Case(presets["1208"], own, [0, 1, 2], force, 0.5 * (1.0 - gamma), curvatures)


def rollers(
    name: str, count: int, D: float, length: float, pitch: float, angle: float,
    force: tuple[float, ...], defect: tuple[float, float], free: list[int], **rows: Any,
) -> Case:  # fmt: skip
    """ISO 16281: c_L = 35 948 l^(8/9) N/mm^(10/9), l in mm, both contacts of a roller together."""
    K = 35_948.0 * (1e3 * length) ** (8.0 / 9.0) * 1e3 ** (10.0 / 9.0)
    ca = math.cos(angle)
    hurt = Defect(math.radians(defect[0]), defect[1], 0.5 * (pitch + D * ca))
    own = Rows(count, D, angle, 0.5 * pitch, math.inf, law=(K, 10.0 / 9.0), defect=hurt, **rows)
    return Case(presets[name], own, free, np.array(force), 0.5 * (1.0 - D * ca / pitch), ())


CASES = {
    "ball": balls(
        "6205", 9, 7.94e-3, 39.04e-3, 0.0, (0, -1000, 0, 0, 0), 5e-6, (1.3, 279e-6), [0, 1]
    ),
    "self-aligning": self_aligning(),
    "rows": balls(
        "7208-back-to-back", 14, 15 / 32 * INCH, 60e-3, math.radians(25), (0, -3000, 800, 9, -5),
        0.0, (8.0, 1e-4), [0, 1, 2, 3, 4], at=(-9e-3, 9e-3), facing=(1, -1), preload=4e-6,
    ),
    "roller": rollers(
        "nu208", 14, 11e-3, 11e-3, 60.5e-3, 0.0, (0, -3000, 0, 0, 0), (8.0, 1e-4), [0, 1],
        clearance=15e-6,
    ),
    "tapered": rollers(
        "30206-back-to-back", 17, 7.66e-3, 10.3e-3, 46e-3, math.radians(14.0361),
        (0, -4000, 1000, 0, 0), (4.0, 20e-6), [0, 1, 2, 3, 4],
        clearance=0.0, places=(-15e-3, 15e-3), facing=(1, -1), preload=3e-6,
    ),
}  # fmt: skip
CAGE = (0.0, 0.13, 0.29)
kinds = pytest.mark.parametrize("kind", CASES)
GYRATION = 0.05**2 / 2.0
MASS, GROUND, DAMPING = (
    one * np.array([1.0, 1.0, 1.0, GYRATION, GYRATION]) for one in (2.0, 212.2e6, 1648.2)
)


@witness(
    "* bearing: statics", "* bearing: stiffness", "direction: *", "edge: exact",
    "function: equilibrium",
    by="least energy of contacts by SciPy, second derivatives by complex steps",
    compared="loads, contact angles, displacements, all stiffness terms at three cage angles",
    within=1e-5,
)  # fmt: skip
@kinds
def test_loads_and_stiffness(kind: str) -> None:
    case = CASES[kind]
    state = equilibrium(case.scene, CAGE)
    for i, cage in enumerate(CAGE):
        q = case.rows.rest(case.force, cage, case.free)
        loads = case.rows.load(q, cage)
        assert state.ball_load[i] == pytest.approx(loads, abs=1e-5 * loads.max())
        along_the_shaft, carries = case.rows.directions(q, cage)[2], loads > 0.0
        sines = np.sin(state.contact_angle[i])
        assert sines[carries] == pytest.approx(along_the_shaft[carries], abs=1e-5)
        moved = np.abs(q[case.free]).max()
        assert state.displacement[i][case.free] == pytest.approx(q[case.free], abs=1e-5 * moved)
        own = case.rows.stiffness(q, cage)
        size = np.sqrt(np.abs(np.outer(np.diag(own), np.diag(own))))[np.ix_(case.free, case.free)]
        off = (state.stiffness[i] - own)[np.ix_(case.free, case.free)]
        assert np.abs(off / size).max() < 1e-5


@witness(
    "* bearing: natural frequencies", "function: modes",
    by="eigenvalues by SciPy of K, M and C of `elements.py`",
    compared="all damped frequencies at three angles",
    within=1e-5,
)  # fmt: skip
@kinds
def test_natural_frequencies(kind: str) -> None:
    case = CASES[kind]
    vibration = modes(case.scene.replace(contact_damping=C), CAGE)
    at, n = np.ix_(case.free, case.free), len(case.free)
    for i, cage in enumerate(CAGE):
        q = case.rows.rest(case.force, cage, case.free)
        e = case.rows.directions(q, cage) * (case.rows.load(q, cage) > 0.0)
        matrices = []
        for bearing, ground in ((case.rows.stiffness(q, cage), GROUND), (C * e @ e.T, DAMPING)):
            b, o = bearing[at], np.diag(ground[case.free])
            matrices.append(np.block([[b, -b], [-b, b + o]]) / np.tile(MASS[case.free], 2)[:, None])
        zero, one = np.zeros((2 * n, 2 * n)), np.eye(2 * n)
        values = np.linalg.eigvals(np.block([[zero, one], [-matrices[0], -matrices[1]]]))
        own = np.sort(np.abs(values[values.imag > 0.0])) / (2.0 * math.pi)
        assert np.sort(vibration.frequency[i]) == pytest.approx(own, rel=1e-5)


@witness(
    "function: modes",
    by="kinetic energy of NumPy's eigenvectors",
    compared="direction that a mode is named after, rotor and housing of unlike inertia",
    within="each that has 60 % of a mode",
)
def test_a_mode_is_named_after_the_direction_that_has_most_of_its_energy() -> None:
    """A rotor of 0.1 g·m²: tilts move far with little energy."""
    case = CASES["rows"]
    vibration = modes(case.scene.replace(inner_inertia=1e-4, outer_inertia=1e-2), CAGE)
    bearing = np.mean(
        [case.rows.stiffness(case.rows.rest(case.force, one, case.free), one) for one in CAGE],
        axis=0,
    )
    K = np.block([[bearing, -bearing], [-bearing, bearing + np.diag(GROUND)]])
    mass = np.array([2.0] * 3 + [1e-4] * 2 + [2.0] * 3 + [1e-2] * 2)
    shapes = np.linalg.eigh(K / np.sqrt(np.outer(mass, mass)))[1]
    energy = (shapes**2).reshape(2, 5, 10).sum(axis=0).T
    most = energy.max(axis=1) > 0.6
    assert most.sum() >= 8
    named = [label[:-1] for label in vibration.label]
    for name, own in zip(np.array(named)[most], energy[most], strict=True):
        assert name == ("x", "y", "z", "rx", "ry")[own.argmax()]


def problem_of(case: Case, rows: Rows, **more: Any) -> Problem:
    speed, free = case.scene.shaft_speed, case.free
    held = MASS[free], GROUND[free], DAMPING[free]
    return Problem(rows, case.force, tuple(free), *held, case.cage * speed, C, shaft=speed, **more)


@witness(
    "* bearing: motion", "function: simulate", "law: *", "balls: massless", "load: unbalance",
    "load: f*", "load: m*", by="SciPy's DOP853 on the equations of `march.py`",
    compared="displacements of both rings over 2.5 ms, both contact laws, with unbalance",
    within=1e-3,
)  # fmt: skip
@pytest.mark.parametrize("law", ["published", "no tension"])
@kinds
def test_motion(kind: str, law: str) -> None:
    case = CASES[kind]
    unbalance = 2e-3 if law == "published" else 0.0
    # a ball or roller of the load zone enters the defect within the first half of a millisecond
    spacing, hurt = 2.0 * math.pi / case.rows.count, case.rows.defect
    center = math.floor(1.5 * math.pi / spacing) * spacing + 0.5 * hurt.extent + 0.01
    rows = replace(case.rows, defect=replace(hurt, center=center))
    scene = case.scene.replace(
        contact_damping=C, contact_law=law, unbalance=unbalance, center=center
    )
    motion = simulate(scene, 2.5e-3, 65536.0, step_rate=16 * 65536.0)
    turning = unbalance * scene.shaft_speed**2
    one = problem_of(case, rows, no_tension=law == "no tension", unbalance=turning)
    states, n = 1e-6 * one.solved(one.start(), motion.time), len(case.free)
    rings = motion.inner_displacement, motion.outer_displacement
    for actual, expected in zip(rings, (states[:, :n], states[:, n : 2 * n]), strict=True):
        for ours, theirs in zip(actual.T, expected.T, strict=True):
            swing = max(np.ptp(theirs), 1e-2 * np.ptp(expected))
            assert np.abs(ours - theirs).max() < 1e-3 * swing


@witness(
    "race: inner", "function: simulate", by="SciPy's DOP853 on the equations of `march.py`",
    compared="displacements of both rings over 2.5 ms with a defect that turns with the shaft",
    within=1e-3,
)  # fmt: skip
@pytest.mark.parametrize("kind", ["ball", "rows"])
def test_motion_over_a_defect_that_turns(kind: str) -> None:
    """The shaft overtakes the balls: one in the load zone enters within the first millisecond."""
    case, speed = CASES[kind], 300.0
    spacing, hurt = 2.0 * math.pi / case.rows.count, case.rows.defect
    center = math.floor(1.5 * math.pi / spacing) * spacing - 0.5 * hurt.extent - 0.02
    inner = replace(hurt, center=center, race=hurt.race - case.rows.element, inner=True)
    scene = case.scene.replace(
        race="inner", center=center, contact_damping=C, shaft_speed=speed
    )  # fmt: skip
    case = case._replace(scene=scene)
    one = problem_of(case, replace(case.rows, defect=inner))
    motion = simulate(scene, 2.5e-3, 65536.0, step_rate=16 * 65536.0)
    states, n = 1e-6 * one.solved(one.start(), motion.time), len(case.free)
    assert np.ptp(states[:, :n], axis=0).max() > 1e-7
    for actual, expected in (
        (motion.inner_displacement, states[:, :n]),
        (motion.outer_displacement, states[:, n : 2 * n]),
    ):
        swing = np.maximum(np.ptp(expected, axis=0), 1e-2 * np.ptp(expected))
        assert (np.abs(actual - expected).max(axis=0) < 1e-3 * swing).all()
