"""Statics, stiffness, damping and frequencies against computations that share nothing with ours.

Equations of Petersen, Howard & Prime (2014): the energy of all contacts (Eqs. 7-15, `elements.py`)
is minimised by SciPy; stiffness is its derivative by complex steps (Eq. 17), and natural
frequencies are those of K, M and C (Eqs. 24-29).
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigvals

from bearingcore import DOF_NAMES, equilibrium, frequency_bands, modes, presets
from bearingcore.model.dynamics import contact_damping
from bearingcore.model.sweeps import Grid
from tests.outside.elements import Defect, Rows
from tests.outside.plane import Plane, damped
from tests.outside.witness import witness

SUPPORT = {"k": 212.2e6, "c": 1648.2, "m": 2.0}  # of the paper's fan rig


FAN = Rows(14, 8e-3, 0.0, 22.5e-3, 50e-6, 3e-6, (5453e6, 1.5))
LIEW_LIM = Rows(12, 6e-3, math.radians(30.0), 19.65e-3, 50e-6, 0.05e-6, (1.45e10, 1.5))
CASES = {
    # our scene, the bearing's numbers, load, radius of the race, extent of the defect
    "fan rig": (presets["fan-rig"], FAN, (0, -100, 0, 0, 0), 26.5e-3, 12.9),
    "a large defect": (
        presets["fan-rig"].replace(extent=math.radians(38.6), fx=30.0),
        FAN, (30, -100, 0, 0, 0), 26.5e-3, 38.6,
    ),
    "thrust": (
        presets["liew-lim"].replace(extent=math.radians(40.0), depth=50e-6, fy=-2000.0, fz=500.0),
        LIEW_LIM, (0, -2000, 500, 0, 0), 22.65e-3, 40.0,
    ),
    "thrust and moments": (
        presets["liew-lim"].replace(
            extent=math.radians(20.0), depth=50e-6, fx=300.0, fy=-900.0, fz=800.0, mx=4.0, my=-2.0
        ),
        LIEW_LIM, (300, -900, 800, 4, -2), 22.65e-3, 20.0,
    ),
    "three directions": (
        presets["liew-lim"].replace(
            extent=math.radians(20.0), depth=50e-6, fy=-2000.0, fz=700.0, dofs=("x", "y", "z")
        ),
        LIEW_LIM, (0, -2000, 700, 0, 0), 22.65e-3, 20.0,
    ),
}  # fmt: skip
CAGE = np.array([0.0, 0.11, 0.2, 0.37])


def own_state(name: str, cage: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """A case at a cage angle: displacement, stiffness, loads, and directions of loaded contacts."""
    scene, rows, force, race, extent = CASES[name]
    rows = replace(rows, defect=Defect(math.radians(extent), 50e-6, race, "published"))
    free = [DOF_NAMES.index(one) for one in scene.active_dofs]
    q = rows.rest(np.array(force, dtype=float), cage, free)
    loads = rows.load(q, cage)
    K = rows.slopes(q[:, None], np.array([cage]))[0]
    return q, K, loads, rows.directions(q, cage) * (loads > 0.0)


@witness(
    "function: equilibrium",
    "ball bearing: statics",
    "ball bearing: stiffness",
    "edge: published",
    "race: outer",
    "load: f*",
    "load: m*",
    "direction: *",
    by="energy of all contacts (Eqs. 7-15) minimised by SciPy's BFGS, complex steps",
    compared="loads, displacements, 15 stiffness terms of five scenes at four angles",
    within=1e-06,
)
@pytest.mark.parametrize("name", CASES)
def test_loads_displacements_and_15_terms(name: str) -> None:
    """Five scenes against the minimum of an energy written here: 1e-7, or 1e-6 of the stiffness."""
    state = equilibrium(CASES[name][0], CAGE)
    for i, cage in enumerate(CAGE):
        q, K, loads, _ = own_state(name, float(cage))
        size = np.abs(q).max(initial=1e-9)
        np.testing.assert_allclose(state.displacement[i], q, atol=1e-7 * size, rtol=1e-6)
        np.testing.assert_allclose(state.ball_load[i], loads, atol=1e-6 * loads.max())
        scale = np.sqrt(np.outer(np.diag(K), np.diag(K)))
        assert np.abs((state.stiffness[i] - K) / np.where(scale > 0.0, scale, 1.0)).max() < 1e-6


@witness(
    "function: modes",
    "ball bearing: natural frequencies",
    by="eigenvalues by SciPy of K, M, C put together in the test",
    compared="frequencies and damping ratios of three scenes",
    within=1e-05,
)
@pytest.mark.parametrize("name", ["fan rig", "a large defect", "three directions"])
def test_frequencies_and_damping_of_k_m_and_c(name: str) -> None:
    """Eigenvalues by SciPy of matrices put together here; c and the support as given."""
    scene = CASES[name][0]
    vibration = modes(scene, CAGE)
    c = contact_damping(scene)
    for i, cage in enumerate(CAGE):
        _, K, _, e = own_state(name, float(cage))
        n = len(scene.active_dofs)  # the first ones of all
        kb, cb = K[:n, :n], c * e[:n] @ e[:n].T
        ko, co = SUPPORT["k"] * np.eye(n), SUPPORT["c"] * np.eye(n)
        k, d = (np.block([[b, -b], [-b, b + o]]) for b, o in ((kb, ko), (cb, co)))
        A = np.block(
            [[np.zeros((2 * n, 2 * n)), np.eye(2 * n)], [-k / SUPPORT["m"], -d / SUPPORT["m"]]]
        )
        values = eigvals(A)
        values = values[values.imag > 0.0]
        order = np.argsort(np.abs(values))
        own = np.abs(values[order]) / (2.0 * math.pi), (-values.real / np.abs(values))[order]
        ours = np.argsort(vibration.frequency[i])
        np.testing.assert_allclose(vibration.frequency[i, ours], own[0], rtol=1e-6)
        np.testing.assert_allclose(vibration.damping_ratio[i, ours], own[1], rtol=1e-5)


@witness(
    "function: frequency_bands",
    "function: contact_damping",
    "race: outer",
    "output: band_*",
    by="20,001 cage angles by `plane.py`",
    compared="ends of all bands, contact damping",
    within=9e-05,
)
def test_bands_of_an_outer_race_are_those_of_very_many_angles() -> None:
    """20,001 cage angles of a ball spacing by `plane.py`, with damping of its own; 9e-5 or less.

    Damping of a contact: 1e-5 s times the mean stiffness of the healthy bearing a loaded ball.
    """
    for scene, plane, mass, far in (
        (presets["fan-rig"], Plane(14, 8e-3, 45e-3, 5453e6, 3e-6), 2.0, 1e-6),
        (
            presets["fan-rig"].replace(extent=0.3, edge="exact", fy=-400.0),
            Plane(14, 8e-3, 45e-3, 5453e6, 3e-6), 2.0, 9e-5,
        ),
    ):  # fmt: skip
        load, (defect,) = -scene.load.fy, scene.defects
        cage = np.linspace(0.0, 2.0 * math.pi / plane.balls, 20_001)
        none = 0.0, 0.0, "outer", "exact"
        _, k, along = plane.solve(load, cage[:-1], 0.0, none)
        balls = np.trace(along, axis1=1, axis2=2)
        c = 1e-5 * np.trace(k, axis1=1, axis2=2).mean() / balls.mean()
        own = defect.extent, defect.depth, "outer", defect.edge
        _, k, along = plane.solve(load, cage, math.radians(270.0), own)
        frequency = damped(k, c * along, mass, (212.2e6, 1648.2))
        assert contact_damping(scene) == pytest.approx(c, rel=1e-3)
        bands = sorted(frequency_bands(scene).values())
        ends = sorted(zip(frequency.min(axis=0), frequency.max(axis=0), strict=True))
        for actual, expected in zip(bands, ends, strict=True):
            assert actual == pytest.approx(expected, rel=far)


def test_statistics_of_a_sweep_are_those_of_its_samples() -> None:
    """45 statistics: mean by the trapezoidal rule, least, greatest of 121 angles, to 5e-10."""
    scene = presets["liew-lim"]
    _, numbers = Grid.of(scene, {"fz": [500.0]}, ["k_*"]).compute()
    state = equilibrium(scene.replace(fz=500.0), np.linspace(0.0, math.radians(30.0), 121))
    terms = [name.removesuffix("_mean") for name in numbers if name.endswith("_mean")]
    assert len(terms) == 15
    for term in terms:
        values = state.term(term)
        size = np.abs(values).max()
        own = {
            "mean": np.trapezoid(values) / 120.0, "least": values.min(), "greatest": values.max()
        }  # fmt: skip
        for which, value in own.items():
            at = float(numbers[f"{term}_{which}"][0])
            assert at == pytest.approx(value, rel=5e-10, abs=1e-9 * size), (term, which)
