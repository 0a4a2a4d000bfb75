"""Static states turn with the load, and need no directions that the load leaves alone."""

import math

import numpy as np
import pytest

from bearingcore import DOF_NAMES, EDGES, Equilibrium, Load, Scene, equilibrium, presets

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
TILTED = LIEW_LIM.replace(fx=300.0, mx=4.0, my=-3.0, extent=math.radians(50.0))
"""All five loads, and a defect that several balls stand in."""

SCENES = {
    "five loads": TILTED,
    "as printed": LIEW_LIM,
    "healthy": TILTED.healthy(),
    "chord edges": TILTED.replace(edge="chord", depth=200e-6),
    "exact edges": TILTED.replace(edge="exact", depth=20e-6),
    "inner race": TILTED.replace(race="inner", edge="exact"),
    "zero contact angle": TILTED.replace(contact_angle=0.0, radial_clearance=5e-6),
    "steep contact angle": TILTED.replace(contact_angle=math.radians(60.0), fz=5000.0),
    "fan rig, five directions": FAN_RIG.replace(fz=20.0, mx=0.1, my=-0.2),
}
ANGLES = np.array([0.05, 0.23, 0.41])


def solve(scene: Scene, angles: np.ndarray) -> Equilibrium:
    """Return static states, all of which must be there."""
    answer = equilibrium(scene, angles, DOF_NAMES)
    assert answer.converged.all()
    return answer


def assert_close(actual: np.ndarray, expected: np.ndarray, scene: Scene, tolerance: float) -> None:
    """Compare displacements (n, 5) or stiffness (n, 5, 5), relative to the greatest number."""
    lever = scene.bearing.groove_center_radius
    scale = np.array([1.0, 1.0, 1.0, lever, lever])
    if actual.ndim == 3:
        scale = 1.0 / (scale[:, None] * scale)
    size = np.abs(expected * scale).max()
    assert np.abs((actual - expected) * scale).max() <= tolerance * size


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
@pytest.mark.parametrize("turn", [1.0, -2.0])
def test_rotating_load_defect_and_cage_rotates_the_answer(scene: Scene, turn: float) -> None:
    """Forces and moments are vectors of the plane; displacement and stiffness turn with them."""
    c, s = math.cos(turn), math.sin(turn)
    R = np.eye(5)
    R[:2, :2] = R[3:, 3:] = [[c, -s], [s, c]]
    center = scene.defect.center + turn
    if scene.defects and scene.defect.race == "inner":
        # the shaft, and with it the defect, has its own angle: turn it by hand
        center -= turn / scene.bearing.cage_ratio
    turned = scene.replace(load=Load(*(R @ scene.load.vector).tolist()))
    turned = turned.replace(center=center) if scene.defects else turned
    before, after = solve(scene, ANGLES), solve(turned, ANGLES + turn)
    assert_close(after.displacement, before.displacement @ R.T, scene, 1e-9)
    assert_close(after.stiffness, R @ before.stiffness @ R.T, scene, 1e-8)
    assert after.ball_load == pytest.approx(before.ball_load, rel=1e-7, abs=1e-6)


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
    assert_close(all_five.stiffness, few.stiffness, scene, 1e-7)
