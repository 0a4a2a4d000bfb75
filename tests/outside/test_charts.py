"""Points of the charts of speed against accuracy, by programs written here."""

import json
import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.optimize import least_squares, root

from bearingcore import DOF_NAMES, contact_damping, equilibrium, orbit, presets, simulate
from tests.outside.capabilities import ROOT
from tests.outside.elements import Defect, Rows
from tests.outside.march import Problem, by_runge_kutta
from tests.outside.test_kinds import CASES
from tests.outside.witness import witness

RATE = 65_536.0

every_preset = pytest.mark.parametrize(
    "preset",
    [pytest.param(name, marks=[pytest.mark.proof] * (name != "fan-rig")) for name in presets],
)
"""One of them in the quick tests."""


@cache
def chart(name: str, preset: str = "fan-rig") -> dict:
    text = (ROOT / f"assets/accuracy/{preset}.json").read_text(encoding="utf-8")
    whole = json.loads(text)
    return whole["experiments"][name] if name in whole["experiments"] else whole[name]


SOLVED_THERE = {"1208": "self-aligning", "nu208": "roller", "30206-back-to-back": "tapered"}
"""Presets whose rows `test_kinds.py` has written down already."""


@cache
def problem(preset: str, edge: str = "", shaft: float = math.nan) -> Problem:
    """A preset's scene for `march.py`: of the scene are its numbers, and the damping c.

    `edge` in place of its own, `shaft` [rad/s] in place of its speed.
    """
    scene = presets[preset]
    bearing, hurt, held, load = scene.bearing, scene.defect, scene.support, scene.load
    angle, facing = bearing.contact_angle, [row.facing for row in bearing.all_rows]
    if preset in SOLVED_THERE:
        rows = CASES[SOLVED_THERE[preset]].rows
    else:
        inner = (bearing.inner_groove_radius or 0.0) - 0.5 * bearing.ball_diameter
        single = len(facing) == 1
        places = [row.place + row.facing * inner * math.sin(angle) for row in bearing.all_rows]
        rows = Rows(
            bearing.n_balls, bearing.ball_diameter, angle, bearing.groove_center_radius,
            bearing.groove_center_distance, bearing.radial_clearance,
            (bearing.load_deflection_factor, 1.5), (0.0,) if single else tuple(places),
            tuple(facing), bearing.all_rows[0].facing * bearing.all_rows[0].offset,
        )  # fmt: skip
    race = rows.defect.race if rows.defect else bearing.outer_raceway_radius
    defect = Defect(hurt.extent, hurt.depth, race, edge or hurt.edge)
    gamma = bearing.ball_diameter * math.cos(angle) / bearing.pitch_diameter
    cage = 0.5 * (1.0 - gamma) * (scene.shaft_speed if math.isnan(shaft) else shaft)
    free = [DOF_NAMES.index(name) for name in scene.active_dofs]
    mass, stiffness, damping = (
        np.array([getattr(held, f"{what}_{name}") for name in names])[free]
        for what, names in (
            ("inner", ["mass"] * 3 + ["inertia"] * 2), ("stiffness", DOF_NAMES),
            ("damping", DOF_NAMES),
        )
    )  # fmt: skip
    force = np.array([load.fx, load.fy, load.fz, load.mx, load.my])
    return Problem(
        replace(rows, defect=defect), force, tuple(free), mass, stiffness, damping, cage,
        contact_damping(scene),
    )  # fmt: skip


@cache
def exact(
    preset: str, duration: float, edge: str = "", extent: float = math.nan, tolerance: float = 1e-10
) -> np.ndarray:
    """Accelerations of the housing at 65,536 Hz from rest, by DOP853.

    `extent` [rad] in place of the defect's own.
    """
    times, one = np.arange(round(duration * RATE) + 1) / RATE, problem(preset, edge)
    if math.isfinite(extent):
        hurt = replace(one.rows.defect, extent=extent)
        one = replace(one, rows=replace(one.rows, defect=hurt))
    return one.accelerations(times, one.solved(one.start(), times, tolerance))


def test_the_march_meets_the_stored_reference() -> None:
    """Two families at 1e-12 that stop at every event, c = 122 N·s/m: tests/reference/README.md."""
    stored = np.load(ROOT / "tests/reference/motion_reference.npz")["12.9deg/displacement"][:100]
    one = replace(problem("fan-rig"), c=122.0)
    times = np.arange(len(stored)) * 64.0 / RATE
    history = 1e-6 * one.solved(one.start(), times)[:, :4]
    swing = np.abs(stored - stored.mean(axis=0)).max()
    assert np.abs(history - stored).max() < 1e-6 * swing


@witness(
    "chart: motion",
    by="classical Runge-Kutta against SciPy's DOP853, both on equations written out in `march.py`",
    compared="three points of 17 presets' charts: RK4 in velocities from 65,536 Hz on, L2 error",
    within=2e-3,
)  # fmt: skip
@every_preset
def test_points_of_the_motion_charts(preset: str) -> None:
    true, one = exact(preset, 0.1), problem(preset)
    lever = presets[preset].bearing.groove_center_radius  # a rotation counts as a length
    size = np.array([1.0, 1.0, 1.0, lever, lever])[list(one.free)]
    motion = simulate(presets[preset], 0.1, RATE, step_rate=4.0 * RATE)
    off = size * (motion.instant_acceleration("outer") - true[: len(motion.time)])
    assert math.sqrt(np.sum(off**2) / np.sum((size * true) ** 2)) < 5e-3
    points = [p for p in chart("motion", preset)["points"] if p["method"] == "RK4 in velocities"]
    for point in [p for p in points if p["value"] >= RATE][:3]:
        keep = round(point["value"] / RATE)
        steps = (len(true) - 1) * keep
        history = by_runge_kutta(one.start(), 1.0 / point["value"], steps, keep, *one.packed())
        off = np.sum((size * (history - true)) ** 2)
        error = math.sqrt(off / np.sum((size * true) ** 2))
        assert error == pytest.approx(point["errors"]["series L2"], rel=2e-3), point["setting"]


@witness(
    "chart: stability",
    by="the polynomial of RK4 at the eigenvalues of K, M and C of `elements.py`; RK4 of `march.py`",
    compared="17 presets: highest frequency, least step rate by linear theory; RK4 in velocities "
    "diverges at the trials at which the chart says so, next to its limit",
    within=2e-3,
)  # fmt: skip
@every_preset
def test_points_of_the_stability_charts(preset: str) -> None:
    one, shown = problem(preset), chart("stability", preset)
    free, n = list(one.free), len(one.free)
    cage = np.linspace(0.0, 2.0 * math.pi / one.rows.count, 31)
    q, loads, stiffness = one.rows.states(one.force, cage, free)
    _, directions = one.rows.contacts(q[:, :, None], cage[:, None])
    pressed = np.where(loads > 0.0, directions, 0.0)
    dampers = one.c * np.einsum("imj,kmj->mik", pressed, pressed)
    highest, limit = 0.0, 0.0
    for k, c in zip(stiffness[:, free][:, :, free], dampers[:, free][:, :, free], strict=True):
        K, D = (
            np.block([[b, -b], [-b, b + np.diag(ground)]]) / np.tile(one.mass, 2)[:, None]
            for b, ground in ((k, one.stiffness), (c, one.damping))
        )
        highest = max(highest, math.sqrt(np.linalg.eigvals(K).real.max()) / (2.0 * math.pi))
        whole = np.block([[np.zeros((2 * n, 2 * n)), np.eye(2 * n)], [-K, -D]])
        limit = max(limit, least_rate(np.linalg.eigvals(whole)))
    assert shown["highest_frequency"] == pytest.approx(highest, rel=1e-3)
    assert shown["linear_limit"]["RK4"] == pytest.approx(limit, rel=2e-3)
    trials = [trial for trial in shown["trials"] if trial["method"] == "RK4 in velocities"]
    last = max((i for i, t in enumerate(trials) if t["verdict"] == "diverged"), default=0)
    for trial in trials[last : last + 3]:
        rate = trial["step_rate"]
        with np.errstate(all="ignore"):
            history = by_runge_kutta(one.start(), 1.0 / rate, round(0.25 * rate), 1, *one.packed())
            grown = not np.abs(history).max() < 1e6 * np.abs(history[: len(history) // 100]).max()
        assert grown == (trial["verdict"] == "diverged"), rate


def least_rate(values: np.ndarray) -> float:
    """The least step rate [Hz] at which RK4 lets no motion with these eigenvalues [1/s] grow."""
    low, high = 1e2, 1e7
    while high / low > 1.0001:
        rate = math.sqrt(low * high)
        z = values / rate
        grows = np.abs(1.0 + z + z**2 / 2.0 + z**3 / 6.0 + z**4 / 24.0).max() > 1.0
        low, high = (rate, high) if grows else (low, rate)
    return high


@witness(
    "chart: statics", "function: equilibrium",
    by="SciPy's solvers on the forces of `elements.py`, against Newton's method on them",
    compared="17 presets: errors of hybr and least squares at three tolerances from 1e-2 on; loads "
    "and stiffness of `equilibrium` at the chart's 31 angles to what it says",
    within=1e-2,
)  # fmt: skip
@every_preset
def test_points_of_the_statics_charts(preset: str) -> None:
    one = problem(preset)
    rows, free, force = one.rows, list(one.free), one.force
    cage = np.linspace(0.0, 2.0 * math.pi / rows.count, 31)
    _, loads, stiffness = rows.states(force, cage, free)
    units = np.array([1.0, 1.0, 1.0, rows.lever, rows.lever])
    stiffness = stiffness / np.outer(units, units)
    size = np.abs(stiffness).max(axis=0)
    neighbors = np.sqrt(np.outer(np.diag(size), np.diag(size)))
    size = np.where(size > 1e-6 * neighbors, size, neighbors)
    size = np.where(size > 0.0, size, 1.0)

    def errors(loads_found: np.ndarray, slopes: np.ndarray) -> dict[str, float]:
        off = np.abs(slopes - stiffness) / size
        return {"stiffness": off.max(), "load": np.abs(loads_found - loads).max() / loads.max()}

    state = equilibrium(presets[preset], cage)
    ours = errors(state.ball_load, state.stiffness / np.outer(units, units))
    assert max(ours.values()) < 1e-8
    total = np.linalg.norm(force[free])
    reach = rows.clearance / math.cos(rows.angle) + (total / rows.law[0]) ** (1.0 / rows.law[1])

    def full(u: np.ndarray) -> np.ndarray:
        q = np.zeros((5, 1))
        q[free, 0] = reach * u
        return q / units[:, None]

    def solved(method: str, tolerance: float, at: float) -> np.ndarray:
        angle = np.array([at])

        def unbalanced(u: np.ndarray) -> np.ndarray:
            return ((rows.pushes(full(u), angle)[:, 0] - force) / units)[free] / total

        def jacobian(u: np.ndarray) -> np.ndarray:
            slopes = rows.slopes(full(u), angle)[0] / np.outer(units, units)
            return slopes[np.ix_(free, free)] * reach / total

        start = force[free] / total
        if method == "scipy hybr":
            return full(root(unbalanced, start, jac=jacobian, tol=tolerance).x)[:, 0]
        kept = {"ftol": tolerance, "xtol": tolerance, "gtol": tolerance}
        return full(least_squares(unbalanced, start, jac=jacobian, **kept).x)[:, 0]

    points = {
        (p["method"], p["value"]): p["errors"]
        for p in chart("statics", preset)["points"]
        if not p.get("against") and p["errors"]
    }
    wanted = (("scipy hybr", 1e-2), ("scipy least squares", 1e-2), ("scipy least squares", 1e-4))
    for method, tolerance in wanted:
        q = np.stack([solved(method, tolerance, at) for at in cage], axis=1)
        slopes = rows.slopes(q, cage) / np.outer(units, units)
        gaps = errors(rows.load(q[:, :, None], cage[:, None]), slopes)
        for name, error in points.get((method, tolerance), {}).items():
            assert error == pytest.approx(gaps[name], rel=1e-2, abs=1e-9), (method, tolerance)


NOT_YET_OF_ORDER_2 = ("209", "liew-lim")
"""At their finest two steps what is left of the fourth order still counts: slopes of 2.4."""


@witness(
    "chart: motion",
    by="theory: a step of Runge-Kutta across a jump of a force errs by h, across a kink by h²",
    compared="17 presets: slope of RK4 in velocities, whose damper jumps, over the finest four "
    "steps, and of RK4 in variables with kinks alone over the finest two",
    within=0.3,
)  # fmt: skip
@pytest.mark.parametrize("preset", presets)
def test_orders_of_convergence_of_the_motion_charts(preset: str) -> None:
    def order(method: str, count: int) -> float:
        known = [(p["value"], p["errors"]["series L2"])
                 for p in chart("motion", preset)["points"] if p["method"] == method]  # fmt: skip
        return -float(np.polyfit(*np.log(np.array(known[-count:])).T, 1)[0])

    assert order("RK4 in velocities", 4) == pytest.approx(1.0, abs=0.3)
    within = 0.5 if preset in NOT_YET_OF_ORDER_2 else 0.3
    assert order("RK4", 2) == pytest.approx(2.0, abs=within)


@witness(
    "edge: exact", "edge: chord", "edge: published",
    by="SciPy's DOP853 on the equations of `march.py` with three edge models, 0.2 s from rest",
    compared="levels of the housing's vibration with each edge model, a preset of each kind [dB]",
    within="0.05 dB",
)  # fmt: skip
@pytest.mark.proof
@pytest.mark.parametrize(
    "preset", ["fan-rig", "1208", "nu208", "30206-back-to-back", "7208-back-to-back"]
)
def test_levels_of_edge_models(preset: str) -> None:
    for edge in ("exact", "chord", "published"):
        true = exact(preset, 0.2, edge, tolerance=1e-7)[:, :2]
        scene = presets[preset].replace(edge=edge)
        ours = simulate(scene, 0.2, RATE, step_rate=4.0 * RATE).instant_acceleration("outer")
        powers = [np.mean(one[: len(true), :2] ** 2) for one in (ours, true[: len(ours)])]
        assert abs(10.0 * math.log10(powers[0] / powers[1])) < 0.05, edge


@witness(
    "chart: orbits", "function: orbit", "output: floquet_multiplier_greatest",
    by="differences of one ball pass by SciPy's DOP853, Newton's method on its closing",
    compared="largest multiplier at the highest stable speeds of 17 presets' charts",
    within=1e-3,
)  # fmt: skip
@pytest.mark.proof
@pytest.mark.parametrize("preset", presets)
def test_points_of_the_orbits_charts(preset: str) -> None:
    known = [one for one in chart("orbits", preset) if one["status"] == "stable orbit"]
    last = 3 if len(presets[preset].active_dofs) == 2 else 1  # a pass is short at high speed
    for point in known[-last:]:
        multipliers = problem(preset, shaft=point["shaft_speed"]).multipliers()
        here = orbit(presets[preset].replace(shaft_speed=point["shaft_speed"]))
        assert here.largest_multiplier == pytest.approx(abs(multipliers[0]), abs=1e-3)
        shown = np.abs([complex(*one) for one in point["multipliers"]]).max()
        assert shown == pytest.approx(abs(multipliers[0]), abs=1e-3), point["shaft_speed"]
