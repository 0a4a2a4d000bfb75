"""What symmetry, mechanics and dimension demand of the statics and of the motion, whatever the
numbers are.
"""

import math

import numpy as np
import pytest

from bearingcore import DOF_NAMES, EDGES, Equilibrium, Scene, equilibrium, presets

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
every_scene = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())

ANGLES = np.array([0.05, 0.23, 0.41])


def solve(scene: Scene, angles: np.ndarray = ANGLES) -> Equilibrium:
    """Static states, all of which must be there."""
    answer = equilibrium(scene, angles, DOF_NAMES)
    assert answer.converged.all()
    return answer


def lengths(scene: Scene) -> np.ndarray:
    """Factors that turn metres and radians into lengths: r_d along the tilts."""
    lever = scene.bearing.groove_center_radius
    return np.array([1.0, 1.0, 1.0, lever, lever])


def assert_close(actual: np.ndarray, expected: np.ndarray, scene: Scene, tolerance: float) -> None:
    """Equal as displacements (n, 5) or stiffness (n, 5, 5), relative to the greatest number."""
    scale = lengths(scene)
    if actual.ndim == 3:
        scale = 1.0 / (scale[:, None] * scale)
    size = np.abs(expected * scale).max()
    assert np.abs((actual - expected) * scale).max() <= tolerance * size


def transformed(scene: Scene, matrix: np.ndarray, defect_center: float) -> Scene:
    """The scene with its load vector multiplied by `matrix` and its defect moved."""
    fx, fy, fz, mx, my = (matrix @ scene.load.vector).tolist()
    moved = scene.replace(fx=fx, fy=fy, fz=fz, mx=mx, my=my)
    return moved if scene.defect.is_none else moved.replace(center=defect_center)


def check_alike(
    scene: Scene, after: Equilibrium, matrix: np.ndarray, ball_load: np.ndarray
) -> None:
    """The answer of `scene` times a matrix is the other one, ball by ball in the order given."""
    before = solve(scene)
    assert_close(after.displacement, before.displacement @ matrix.T, scene, 1e-9)
    assert_close(after.stiffness, matrix @ before.stiffness @ matrix.T, scene, 1e-8)
    assert ball_load == pytest.approx(before.ball_load, rel=1e-7, abs=1e-6)


@every_scene
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
    after = solve(transformed(scene, R, center), ANGLES + turn)
    check_alike(scene, after, R, after.ball_load)


@every_scene
def test_mirror_symmetry_about_the_vertical(scene: Scene) -> None:
    """Mirrored x → −x: a moment about y turns over, one about x does not, as they are axial
    vectors; balls are counted the other way round.
    """
    M = np.diag([-1.0, 1.0, 1.0, 1.0, -1.0])
    center = math.pi - scene.defect.center
    if scene.defects and scene.defect.race == "inner":
        center -= math.pi / scene.bearing.cage_ratio  # by which it has turned at cage angle π
    after = solve(transformed(scene, M, center), math.pi - ANGLES)
    check_alike(scene, after, M, np.roll(after.ball_load[:, ::-1], 1, axis=1))


def test_reflection_along_the_shaft_at_zero_contact_angle() -> None:
    """Reflected z → −z: axial force and both moments change sign, and so do their displacements."""
    Z = np.diag([1.0, 1.0, -1.0, -1.0, -1.0])
    scene = SCENES["zero contact angle"]
    before = solve(scene)
    after = solve(transformed(scene, Z, scene.defect.center))
    assert np.abs(before.displacement[:, 2]).min() > 1e-7
    check_alike(scene, after, Z, after.ball_load)
    assert after.contact_angle == pytest.approx(-before.contact_angle, rel=1e-7, nan_ok=True)


@every_scene
def test_a_ball_spacing_later_the_next_ball_stands_there(scene: Scene) -> None:
    """The curves of an outer-race defect have this period; an inner one turns on by the shaft."""
    later = scene
    spacing = scene.bearing.ball_spacing
    if scene.defects and scene.defect.race == "inner":
        later = scene.replace(center=scene.defect.center - spacing / scene.bearing.cage_ratio)
    after = solve(later, ANGLES + spacing)
    check_alike(scene, after, np.eye(5), np.roll(after.ball_load, 1, axis=1))


def scaled(scene: Scene, stiffer: float, larger: float) -> Scene:
    """The scene with its load-deflection factor and with all its lengths multiplied."""
    bearing = scene.bearing
    return scene.replace(
        load_deflection_factor=stiffer * bearing.load_deflection_factor,
        **{
            name: larger * getattr(bearing, name)
            for name in (
                "ball_diameter",
                "pitch_diameter",
                "groove_center_radius",
                "groove_center_distance",
                "radial_clearance",
                "outer_raceway_radius",
                "inner_raceway_radius",
            )
        },
        depth=larger * scene.defect.depth,
    )


@every_scene
@pytest.mark.parametrize(("stiffer", "larger"), [(2.0, 1.0), (1.0, 3.0)], ids=["stiffer", "larger"])
def test_a_stiffer_or_larger_bearing_scales(scene: Scene, stiffer: float, larger: float) -> None:
    """Twice the factor K under twice the load moves alike; of all lengths times 3, under forces
    times 3^1.5 and moments times 3^2.5, displacements are three times as long.
    """
    power = stiffer * larger**1.5
    load = np.diag([power, power, power, larger * power, larger * power])
    before = solve(scene)
    after = solve(transformed(scaled(scene, stiffer, larger), load, scene.defect.center))
    grown = np.array([larger, larger, larger, 1.0, 1.0])
    assert_close(after.displacement, before.displacement * grown, scene, 1e-9)
    factor = np.diag(load)[:, None] / grown
    assert_close(after.stiffness, before.stiffness * factor, scene, 1e-8)


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
