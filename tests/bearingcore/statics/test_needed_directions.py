"""Directions that a load does not need are nothing but left out."""

import math

import numpy as np
import pytest

from bearingcore import DOF_NAMES, EDGES, equilibrium, presets

FAN_RIG = presets["fan-rig"]


@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("race", ["outer", "inner"])
def test_two_directions_are_exact_for_a_radial_load_at_zero_contact_angle(
    edge: str, race: str
) -> None:
    scene = FAN_RIG.replace(fx=40.0, edge=edge, race=race, extent=math.radians(38.6))
    assert scene.needed_dofs == ("x", "y")
    few, all_five = equilibrium(scene), equilibrium(scene, dofs=DOF_NAMES)
    assert few.converged.all()
    assert all_five.converged.all()
    assert all_five.displacement[:, :2] == pytest.approx(few.displacement[:, :2], rel=1e-9)
    assert np.all(all_five.displacement[:, 2:] == 0.0)
    assert all_five.ball_load == pytest.approx(few.ball_load, rel=1e-7, abs=1e-7)
    lever = scene.bearing.groove_center_radius
    scale = 1.0 / np.array([1.0, 1.0, 1.0, lever, lever])
    off = (all_five.stiffness - few.stiffness) * np.outer(scale, scale)
    assert np.abs(off).max() <= 1e-7 * np.abs(few.stiffness * np.outer(scale, scale)).max()
