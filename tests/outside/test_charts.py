"""Points of the charts of speed against accuracy, by programs written here."""

import json
import math
from functools import cache

import numpy as np
import pytest
from numba import njit
from scipy.integrate import solve_ivp
from scipy.signal import welch

from bearingcore import equilibrium, orbit, presets
from tests.outside.capabilities import ROOT
from tests.outside.plane import Plane, damped
from tests.outside.test_sampling import CAGE, EXTENT, rates
from tests.outside.witness import witness

RATE, DURATION = 65_536.0, 0.1
C = 121.96
"""[N·s/m] of the rig: 1e-5 s times the mean stiffness of the healthy bearing a loaded ball."""
PLANE = Plane(14, 8e-3, 45e-3, 5453e6, 3e-6)
HURT = EXTENT, 50e-6, "outer", "published"
"""The defect for `plane.py`: extent, depth, race, edge."""


@cache
def chart(name: str, preset: str = "fan-rig") -> dict:
    text = (ROOT / f"assets/accuracy/{preset}.json").read_text(encoding="utf-8")
    whole = json.loads(text)
    return whole["experiments"][name] if name in whole["experiments"] else whole[name]


@cache
def at_rest(extent: float = EXTENT) -> np.ndarray:
    """State [µm, mm/s] at cage angle 0: inner ring, then the outer one on its spring."""
    hurt = extent, *HURT[1:]
    loads, _, _ = PLANE.solve(100.0, np.zeros(1), 1.5 * math.pi, hurt)
    down = -100.0 / 212.2
    free = np.array([0.0, down, 0.0, down, 0.0, 0.0, 0.0, 0.0])
    phi = 2.0 * math.pi / 14 * np.arange(14)
    # the displacement that the loads say: two balls that carry, in the plane
    carries = np.argsort(loads[0])[-2:]
    gap = 3e-6 + PLANE.drop(
        0.5 * extent - np.abs((phi - 1.5 * math.pi + math.pi) % (2 * math.pi) - math.pi),
        "outer", "published", 50e-6,
    )  # fmt: skip
    e = np.stack([np.cos(phi), np.sin(phi)], axis=1)[carries]
    delta = (loads[0, carries] / 5453e6) ** (2.0 / 3.0) + gap[carries]
    free[:2] += 1e6 * np.linalg.solve(e, delta)
    return free


@njit
def marched(y: np.ndarray, h: float, steps: int, keep: int, extent: float, c: float) -> np.ndarray:
    """Accelerations (steps // keep + 1, 2) [m/s²] of the housing by the classical Runge-Kutta."""
    out = np.empty((steps // keep + 1, 2))
    for i in range(steps + 1):
        t = i * h
        k1 = rates(t, y, extent, CAGE, c)
        if i % keep == 0:
            out[i // keep] = 1e-3 * k1[6:]
        k2 = rates(t + 0.5 * h, y + 0.5 * h * k1, extent, CAGE, c)
        k3 = rates(t + 0.5 * h, y + 0.5 * h * k2, extent, CAGE, c)
        k4 = rates(t + h, y + h * k3, extent, CAGE, c)
        y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return out


@cache
def exact(corner: float = 0.5, duration: float = DURATION, extent: float = EXTENT) -> np.ndarray:
    """The same by DOP853."""
    time = np.arange(round(duration * RATE)) / RATE
    made = solve_ivp(
        rates, (0.0, time[-1]), at_rest(extent), "DOP853", time, args=(extent, CAGE, C, corner),
        rtol=1e-9, atol=1e-9, max_step=1e-4,
    )  # fmt: skip
    return np.array(
        [1e-3 * rates(t, y, extent, CAGE, C, corner)[6:]
         for t, y in zip(time, made.y.T, strict=True)]
    )  # fmt: skip


def spectra_apart(found: np.ndarray, true: np.ndarray, highest: float = 1841.0) -> float:
    """[dB], up to 1.25 times the highest frequency, within 40 dB of a direction's best line."""
    length = round(RATE / 32.0)
    f, mine = welch(found, RATE, nperseg=length, axis=0)
    _, own = welch(true, RATE, nperseg=length, axis=0)
    counts = ((f > 80.0) & (f <= 1.25 * highest))[:, None] & (own > 1e-4 * own.max(axis=0))
    return float(np.abs(10.0 * np.log10(mine[counts] / own[counts])).max())


@witness(
    "chart: motion",
    by="classical Runge-Kutta against SciPy's DOP853, both on Eqs. 6, 18 and 19 written here",
    compared="three points of the fan rig's chart: RK4 in velocities at 65, 131, 262 kHz, L2 error",
    within=0.02,
)  # fmt: skip
@pytest.mark.proof
def test_points_of_the_motion_chart() -> None:
    true = exact()
    for point in chart("motion")["points"]:
        if point["method"] != "RK4 in velocities" or point["value"] < RATE:
            continue
        keep = round(point["value"] / RATE)
        steps = (len(true) - 1) * keep
        found = marched(at_rest(), 1.0 / point["value"], steps, keep, EXTENT, C)
        error = math.sqrt(np.sum((found - true) ** 2) / np.sum(true**2))
        assert error == pytest.approx(point["errors"]["series L2"], rel=0.02), point["setting"]
        apart = spectra_apart(found, true)
        assert apart == pytest.approx(point["errors"]["spectrum"], rel=0.05), point["setting"]


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
    "chart: angles",
    by="stiffness by `plane.py` at so many angles and at 20,001, trapezoidal rule",
    compared="error of the mean at three points of the fan rig's chart", within=2e-3,
)  # fmt: skip
def test_points_of_the_angles_chart() -> None:
    def curves(count: int) -> np.ndarray:
        """Σ Q/A sideways of the line of contact, too: groove centres are 50 µm apart."""
        cage = np.linspace(0.0, 2.0 * math.pi / 14, count)
        loads, k, _ = PLANE.solve(100.0, cage, 1.5 * math.pi, HURT)
        phi = cage[:, None] + 2.0 * math.pi / 14 * np.arange(14)
        turn = loads / (50e-6 + (loads / 5453e6) ** (2.0 / 3.0))
        sides = [(turn * part).sum(axis=1) for part in (1.0, np.sin(phi) ** 2, np.cos(phi) ** 2)]
        return np.stack([k[:, 0, 0], k[:, 1, 1], *sides], axis=1)

    def mean(values: np.ndarray) -> np.ndarray:
        return np.trapezoid(values, axis=0) / (len(values) - 1)

    dense = curves(20_001)
    shown = {p["value"]: p["errors"]["mean"] for p in chart("angles")["points"]
             if p["method"] == "equally spaced"}  # fmt: skip
    for count in (17, 33, 65):
        off = np.abs(mean(curves(count)) - mean(dense)) / dense.max(axis=0)
        assert shown[count] == pytest.approx(off.max(), rel=2e-3), count


@witness(
    "chart: models", "edge: exact", "edge: chord",
    by="SciPy's DOP853 with three edge models, 0.2 s from rest",
    compared="level of published and chord edges against exact ones [dB]", within="0.01 dB",
)  # fmt: skip
@pytest.mark.proof
def test_points_of_the_models_chart() -> None:
    levels = {}
    for edge, corner in (("published", 0.5), ("chord", 1.0), ("exact", 0.0)):
        levels[edge] = 10.0 * math.log10(np.mean(exact(corner, 0.2) ** 2))
    for point in chart("models")["points"]:
        name = point["method"].removesuffix(" edges")
        if name in ("published", "chord"):
            apart = abs(levels[name] - levels["exact"])
            assert point["errors"]["level"] == pytest.approx(apart, abs=0.01), name


@witness(
    "chart: orbits", "function: orbit", "output: floquet_multiplier_greatest",
    by="differences of one ball pass integrated by SciPy's DOP853",
    compared="largest Floquet multiplier at four shaft speeds, two of them of the chart; closure",
    within=5e-3,
)  # fmt: skip
@pytest.mark.parametrize("shaft", [21.99, 25.0 * 2.0 * math.pi, 30.0 * 2.0 * math.pi, 300.0])
def test_multipliers(shaft: float) -> None:
    scene = presets["fan-rig"].replace(shaft_speed=shaft)
    found = orbit(scene, step_rate=4.0 * RATE)
    cage = 0.5 * shaft * (1.0 - 8.0 / 45.0)
    period = 2.0 * math.pi / 14 / cage

    def passed(y: np.ndarray) -> np.ndarray:
        made = solve_ivp(
            rates, (0.0, period), y, "DOP853", args=(EXTENT, cage, C), rtol=1e-11, atol=1e-11,
            max_step=period / 200.0,
        )  # fmt: skip
        return made.y[:, -1]

    start = np.concatenate(
        [1e6 * found.history[0, [0, 3]].ravel(), 1e3 * found.history[0, [1, 4]].ravel()]
    )
    after = passed(start)
    assert np.abs(after - start).max() < 1e-3 * np.abs(start).max()
    steps = 1e-4 * np.eye(8)
    monodromy = np.stack([(passed(start + h) - passed(start - h)) / 2e-4 for h in steps], axis=1)
    largest = np.abs(np.linalg.eigvals(monodromy)).max()
    assert found.largest_multiplier == pytest.approx(largest, rel=5e-3, abs=1e-3)
