"""Maps over extent and cage angle: the answers of `equilibrium`, known faster."""

import dataclasses

import numpy as np
import pytest

from bearingcore import (
    DOF_NAMES,
    Defect,
    MeasuredFloor,
    RoughFloor,
    Scene,
    equilibrium,
    presets,
    stiffness_maps,
)

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
UPPER = np.triu_indices(5)
# of the geometric mean of the diagonal terms: what the statics promise themselves
TOLERANCE = 1e-10


def two(scene: Scene, **changes: object) -> Scene:
    """The scene with a second defect beside its first."""
    first = scene.defects[0]
    second = dataclasses.replace(first, center=first.center + 0.3, extent=0.2, **changes)
    return scene.replace(defect=(first, second))


SCENES = {
    "angular": LIEW_LIM,
    "radial": FAN_RIG,
    "chord": LIEW_LIM.replace(edge="chord"),
    "exact": FAN_RIG.replace(edge="exact"),
    "inner": LIEW_LIM.replace(race="inner", edge="exact"),
    "deep": FAN_RIG.replace(depth=400e-6),
    "shallow": LIEW_LIM.replace(depth=3e-6),
    "healthy": LIEW_LIM.replace(defect=Defect.none()),
    "held": LIEW_LIM.replace(dofs=("x", "y", "z")),
    "two that run together": two(LIEW_LIM, depth=30e-6),
    "two on two races": two(FAN_RIG, race="inner"),
    "rough": FAN_RIG.replace(floor=RoughFloor(5e-6, 0.3e-3, 3), edge="exact"),
    "measured": LIEW_LIM.replace(floor=MeasuredFloor((-1.0, 0.2, 1.0), (0.1, 1.0, 0.4))),
    "no load": FAN_RIG.replace(fy=0.0),
    "one ball short of rest": FAN_RIG.replace(n_balls=2),
    "sideways only": LIEW_LIM.replace(fx=1.0, fy=0.0, fz=0.0),
}


@pytest.mark.parametrize("name", SCENES)
def test_each_row_is_the_equilibrium_of_its_extent(name: str) -> None:
    scene = SCENES[name]
    extents = np.radians([0.0, 0.5, 6.0, 6.5, 7.0, 29.0, 30.0, 44.0, 63.5, 64.0, 90.0, 360.0])
    # not at symmetric angles, where a ball may just touch and its stiffness be known half as well
    angles = 1e-3 + np.linspace(0.0, scene.bearing.ball_spacing, 41)
    if name.startswith("two"):
        extents = extents[:-1]  # around the whole race the others have no place
    maps = stiffness_maps(scene, extents, angles)
    assert maps.dofs == scene.active_dofs
    for i, extent in enumerate(extents):
        row = equilibrium(scene.replace(extent=extent), angles)
        np.testing.assert_array_equal(maps.status[i], row.status)
        np.testing.assert_array_equal(maps.loaded_balls[i], row.loaded_balls)
        most = row.ball_load.max(axis=1)
        np.testing.assert_allclose(maps.greatest_load[i], most, rtol=TOLERANCE)
        expected = row.stiffness[:, UPPER[0], UPPER[1]].T
        terms = maps.stiffness[:, i]
        np.testing.assert_array_equal(np.isnan(terms), np.isnan(expected))
        if row.converged.any():
            shares = row.shares[row.converged]
            mean = row.loaded_balls[row.converged] @ shares / shares.sum()
            assert maps.mean_loaded_balls[i] == pytest.approx(mean)
            diagonal = np.nanmax([row.term(f"k_{dof}{dof}") for dof in DOF_NAMES], axis=1)
            error = np.abs(terms - expected) / np.sqrt(np.outer(diagonal, diagonal))[UPPER][:, None]
            # two balls that hold a ring of five directions leave all but one of them soft
            soft = name == "sideways only"
            assert error[:, row.converged].max() < (1e-6 if soft else TOLERANCE)


def test_an_extent_at_which_defects_cannot_stand_together_has_a_reason_and_no_number() -> None:
    first = dataclasses.replace(LIEW_LIM.defects[0], extent=0.02)
    other = dataclasses.replace(first, center=first.center + 0.5, edge="exact")
    maps = stiffness_maps(LIEW_LIM.replace(defect=(first, other)), np.radians([5.0, 80.0, 10.0]))
    assert not maps.refusals[0]
    assert "edge model" in maps.refusals[1]
    assert "edge model" in maps.reason(1, 0)
    assert maps.reason(2, 0) == "converged"
    assert np.isnan(maps.stiffness[:, 1]).all()
    assert np.isnan(maps.mean_loaded_balls).tolist() == [False, True, False]
    assert np.isfinite(maps.stiffness[:, [0, 2]]).all()
