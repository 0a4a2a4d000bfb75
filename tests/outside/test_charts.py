"""Points of the charts of speed against accuracy, by programs written here."""

import json
import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from bearingcore import DOF_NAMES, contact_damping, equilibrium, orbit, presets, simulate
from tests.outside.capabilities import ROOT
from tests.outside.elements import Defect, Rows
from tests.outside.march import Problem, by_runge_kutta
from tests.outside.plane import Plane, damped
from tests.outside.test_kinds import CASES
from tests.outside.witness import witness

RATE = 65_536.0
C = 121.96
"""[N·s/m] of the rig: 1e-5 s times the mean stiffness of the healthy bearing a loaded ball."""
PLANE = Plane(14, 8e-3, 45e-3, 5453e6, 3e-6)
HURT = math.radians(12.9), 50e-6, "outer", "published"
"""The defect for `plane.py`: extent, depth, race, edge."""


TO_BE_MADE_ANEW = ("3208", "7208-face-to-face", "7208-back-to-back")
"""Charts measured before the levers of pairs were mended, off by up to 7 %; they wait for a quiet
machine: `python -m tests.benchmarks.charts --ship --preset 3208 7208-face-to-face`.
The back-to-back pair's was made since, with levels filtered as samples are, unlike the others'."""

every_preset = pytest.mark.parametrize(
    "preset",
    [
        pytest.param(name, marks=[pytest.mark.proof] * (name != "fan-rig"))
        for name in presets
        if name not in TO_BE_MADE_ANEW
    ],
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
def exact(preset: str, duration: float, edge: str = "", extent: float = math.nan) -> np.ndarray:
    """Accelerations of the housing at 65,536 Hz from rest, by DOP853.

    `extent` [rad] in place of the defect's own.
    """
    times, one = np.arange(round(duration * RATE) + 1) / RATE, problem(preset, edge)
    if math.isfinite(extent):
        hurt = replace(one.rows.defect, extent=extent)
        one = replace(one, rows=replace(one.rows, defect=hurt))
    return one.accelerations(times, one.solved(one.start(), times))


def test_the_march_meets_the_stored_reference() -> None:
    """Two families at 1e-12 that stop at every event, c = 122 N·s/m: tests/reference/README.md."""
    stored = np.load(ROOT / "tests/reference/motion_reference.npz")["12.9deg/displacement"][:100]
    one = replace(problem("fan-rig"), c=122.0)
    times = np.arange(len(stored)) * 64.0 / RATE
    found = 1e-6 * one.solved(one.start(), times)[:, :4]
    swing = np.abs(stored - stored.mean(axis=0)).max()
    assert np.abs(found - stored).max() < 1e-6 * swing


@witness(
    "chart: motion",
    by="classical Runge-Kutta against SciPy's DOP853, both on equations written out in `march.py`",
    compared="three points of 14 presets' charts: RK4 in velocities from 65,536 Hz on, L2 error",
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
        found = by_runge_kutta(one.start(), 1.0 / point["value"], steps, keep, *one.packed())
        off = np.sum((size * (found - true)) ** 2)
        error = math.sqrt(off / np.sum((size * true) ** 2))
        assert error == pytest.approx(point["errors"]["series L2"], rel=2e-3), point["setting"]


@witness(
    "chart: stability",
    by="the polynomial of RK4 at the eigenvalues of K, M and C by `plane.py`",
    compared="least step rate of the fan rig by linear theory, its highest frequency", within=0.01,
)  # fmt: skip
def test_linear_limit_of_the_stability_chart() -> None:
    cage = np.linspace(0.0, 2.0 * math.pi / 14, 361)
    _, k, along = PLANE.solve(100.0, cage, 1.5 * math.pi, HURT)
    assert chart("stability")["highest_frequency"] == pytest.approx(
        damped(k, C * along, 2.0, (212.2e6, 1648.2)).max(), rel=0.01
    )
    rates_of_all = []
    for bearing, dampers in zip(k, C * along, strict=True):
        K, D = (
            np.block([[one, -one], [-one, one + ground * np.eye(2)]]) / 2.0
            for one, ground in ((bearing, 212.2e6), (dampers, 1648.2))
        )
        values = np.linalg.eigvals(np.block([[np.zeros((4, 4)), np.eye(4)], [-K, -D]]))

        def grows(rate: float, values: np.ndarray = values) -> bool:
            z = values / rate
            return bool(np.abs(1.0 + z + z**2 / 2.0 + z**3 / 6.0 + z**4 / 24.0).max() > 1.0)

        low, high = 1e3, 1e5
        while high / low > 1.0001:
            middle = math.sqrt(low * high)
            low, high = (middle, high) if grows(middle) else (low, middle)
        rates_of_all.append(high)
    limit = chart("stability")["linear_limit"]["RK4"]
    assert limit == pytest.approx(max(rates_of_all), rel=0.01)


@witness(
    "chart: statics", "function: equilibrium",
    by="Newton's method of `plane.py`, stiffness in closed form",
    compared="loads and stiffness of the fan rig at 31 angles, to what the chart says", within=1e-7,
)  # fmt: skip
def test_points_of_the_statics_chart() -> None:
    cage = np.linspace(0.0, 2.0 * math.pi / 14, 31)
    loads, k, _ = PLANE.solve(100.0, cage, 1.5 * math.pi, HURT)
    state = equilibrium(presets["fan-rig"], cage)
    assert np.abs(state.ball_load - loads).max() < 1e-7 * loads.max()
    assert np.abs(state.stiffness[:, :2, :2] - k).max() < 1e-6 * k.max()
    for point in chart("statics")["points"]:
        if point.get("in_use"):
            assert point["errors"]["stiffness"] < 1e-8
            assert point["errors"]["load"] < 1e-8


@witness(
    "edge: exact", "edge: chord", "edge: published",
    by="SciPy's DOP853 on the equations of `march.py` with three edge models, 0.2 s from rest",
    compared="levels of the housing's vibration with each edge model, 14 presets [dB]",
    within="0.05 dB",
)  # fmt: skip
@every_preset
def test_levels_of_edge_models(preset: str) -> None:
    for edge in ("exact", "chord", "published"):
        true, scene = exact(preset, 0.2, edge)[:, :2], presets[preset].replace(edge=edge)
        found = simulate(scene, 0.2, RATE, step_rate=4.0 * RATE).instant_acceleration("outer")
        powers = [np.mean(one[: len(true), :2] ** 2) for one in (found, true[: len(found)])]
        assert abs(10.0 * math.log10(powers[0] / powers[1])) < 0.05, edge


@witness(
    "chart: orbits", "function: orbit", "output: floquet_multiplier_greatest",
    by="differences of one ball pass by SciPy's DOP853, Newton's method on its closing",
    compared="largest multiplier at the highest stable speeds of 14 presets' charts",
    within=1e-3,
)  # fmt: skip
@every_preset
def test_points_of_the_orbits_charts(preset: str) -> None:
    known = [one for one in chart("orbits", preset) if one["status"] == "stable orbit"]
    last = 3 if len(presets[preset].active_dofs) == 2 else 1  # a pass is short at high speed
    for point in known[-last:]:
        found = problem(preset, shaft=point["shaft_speed"]).multipliers()
        here = orbit(presets[preset].replace(shaft_speed=point["shaft_speed"]))
        assert here.largest_multiplier == pytest.approx(abs(found[0]), abs=1e-3)
        shown = np.abs([complex(*one) for one in point["multipliers"]]).max()
        assert shown == pytest.approx(abs(found[0]), abs=1e-3), point["shaft_speed"]
