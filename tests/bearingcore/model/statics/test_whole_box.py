"""No point of the box, wider than any slider, gives a wrong or an unexplained answer.

Every cage angle is either converged, with a relative residual of 1e-9 and a symmetric, positive
semidefinite stiffness that holds the ring, or has a reason that is true: nothing touches, a
direction is free, the load cannot be carried, contacts would be where there are no races.
`helpers.judge` decides, in extended precision and without the solver's code. A million scenes:
`BOX_SCENES=1000000 pytest -n 0` on this file.
"""

import math
import os
from dataclasses import replace

import numpy as np
import pytest

from bearingcore import DOF_NAMES, equilibrium
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene._packing import contacts
from bearingcore.model.statics._shortage import descent_direction
from tests.helpers.box import Point, cage_angles_at, draw, scene_at
from tests.helpers.contact_law import Balls
from tests.helpers.judge import verdict
from tests.helpers.random_rows import KINDS, random_scene

TURN = 2.0 * math.pi

PLAIN = Point(
    n_balls=9,
    pitch_diameter=0.04,
    ball_size=0.6,
    contact_angle=0.0,
    groove_center_radius=1.0,
    groove_center_distance=50e-6,
    radial_clearance=0.0,
    load_deflection_factor=1e10,
    extent=0.0,
    depth=0.0,
    center=0.0,
    race="outer",
    edge="published",
    loads=(0.0, -1e3, 0.0, 0.0, 0.0),
    dofs="tilt free",
    cage_angle=0.3,
)
"""An unremarkable bearing, for the cases below to differ from."""


def check(point: Point) -> set[int]:
    """Judge the answers at a point; the statuses that occur."""
    answer = equilibrium(scene_at(point), cage_angles_at(point))
    for i in range(len(answer.cage_angles)):
        wrong = verdict(answer, i)
        assert not wrong, f"cage angle {i}: {wrong}"
    return set(answer.status.tolist())


def test_points_drawn_at_random_meet_every_status() -> None:
    """1000 scenes, or more, with which all five kinds of true answer are met."""
    seen: set[int] = set()
    for thousand in range(int(os.environ.get("BOX_SCENES", "1000")) // 1000):
        for point in draw(np.random.default_rng([0, thousand]), 1000):
            seen |= check(point)
    assert seen == {
        kernels.CONVERGED,
        kernels.NOTHING_TOUCHES,
        kernels.FREE_DIRECTION,
        kernels.NOT_CARRIED,
        kernels.BEYOND,
    }


CORNERS = {
    "a moment too light to press stiff balls flat: a long and narrow curved valley": (
        PLAIN._replace(
            n_balls=5,
            contact_angle=math.radians(25.6),
            groove_center_distance=2.9e-4,
            load_deflection_factor=1e11,
            loads=(0.0, 0.0, 0.0, 0.0, 0.05),
        ),
        kernels.CONVERGED,
    ),
    "a ring wedged by its clearance though no load acts along x and y": (
        PLAIN._replace(
            contact_angle=math.radians(60.0),
            radial_clearance=75e-6,
            dofs=("x", "y"),
            loads=(0.0,) * 5,
        ),
        kernels.CONVERGED,
    ),
    "a clearance so wide that the grooves of a wedged ring are past each other": (
        PLAIN._replace(
            contact_angle=math.radians(40.0),
            radial_clearance=400e-6,
            dofs=("x", "y"),
            loads=(0.0,) * 5,
        ),
        kernels.BEYOND,
    ),
    "a ball right under the load, its neighbours in their clearance": (
        PLAIN._replace(radial_clearance=5e-4, cage_angle=0.75 * TURN, loads=(0.0, -1.0, 0, 0, 0)),
        kernels.FREE_DIRECTION,
    ),
    "two loaded balls hold four directions, not five": (
        PLAIN._replace(
            n_balls=4,
            radial_clearance=4e-4,
            dofs=DOF_NAMES,
            cage_angle=3.9,
            loads=(0, 6e4, 0, 0, 0),
        ),
        kernels.FREE_DIRECTION,
    ),
    "a moment alone, and a ball across it that touches by rounding only": (
        PLAIN._replace(
            n_balls=4,
            groove_center_distance=5e-6,
            load_deflection_factor=5e10,
            extent=4.8,
            center=9.2,
            depth=0.5,
            loads=(0.0, 0.0, 0.0, -0.025, 0.0),
            dofs=("rx",),
            cage_angle=0.75 * TURN,
        ),
        kernels.CONVERGED,
    ),
    "an inner race smaller than its balls, which never reach the floor": (
        PLAIN._replace(
            n_balls=2, ball_size=1.0, race="inner", edge="exact", extent=TURN / 2, depth=1.0
        ),
        kernels.NOT_CARRIED,
    ),
}
"""What went wrong once, or nearly."""


@pytest.mark.parametrize(("point", "status"), CORNERS.values(), ids=CORNERS.keys())
def test_corners_of_the_box(point: Point, status: int) -> None:
    assert status in check(point)


def test_repeated_and_unordered_cage_angles_are_as_good_as_others() -> None:
    scene = scene_at(PLAIN._replace(contact_angle=0.5))
    angles = np.array([0.0, 0.0, 0.0, 0.0, 3.0, -5.0, 3.0, 1e3, 0.0])
    answer = equilibrium(scene, angles)
    assert [verdict(answer, i) for i in range(len(angles))] == [""] * len(angles)
    alone = [equilibrium(scene, [angle]).displacement[0] for angle in angles]
    assert answer.displacement == pytest.approx(np.array(alone), rel=1e-8, abs=1e-12)


def test_the_judge_finds_what_is_wrong() -> None:
    """It refuses every spoilt answer: otherwise the tests above could not fail."""
    scene = scene_at(PLAIN._replace(contact_angle=0.4, loads=(10.0, -1e3, 200.0, 50.0, 0.0)))
    good = equilibrium(scene, [0.1])
    assert verdict(good, 0) == ""
    kick = 1.0 + 1e-6 * np.arange(1, 6)
    assert "residual" in verdict(replace(good, displacement=good.displacement * kick), 0)
    assert "residual" in verdict(replace(good, residual=np.array([1e-8])), 0)
    assert "loads" in verdict(replace(good, ball_load=good.ball_load * (1.0 + 1e-6)), 0)
    assert "stiffness off" in verdict(replace(good, stiffness=good.stiffness * (1 + 1e-6)), 0)
    for status, said in (
        (kernels.NOTHING_TOUCHES, "a load acts"),
        (kernels.FREE_DIRECTION, "every direction is held"),
        (kernels.NOT_CONVERGED, "not converged"),
    ):
        assert said in verdict(replace(good, status=np.array([status], dtype=np.int8)), 0)


def test_a_way_out_lies_in_the_cone_of_motions_that_press_no_ball() -> None:
    """Of every scene with a load: the way presses no ball, works, and what contacts carry does not.

    So F = (what contacts carry) + way with the two at right angles, which makes it the nearest.
    """
    shares = []
    for point in draw(np.random.default_rng([5, 0]), 500):
        scene = scene_at(point)
        balls = Balls(scene, point.cage_angle)
        active = np.array([DOF_NAMES.index(name) for name in scene.active_dofs])
        F = balls.load[active].astype(float)
        if not F.any():
            continue
        F /= np.linalg.norm(F)
        way, share = descent_direction(contacts(scene.bearing), point.cage_angle, active, F)
        along, across = (rows[:, active].astype(float) for rows in balls.along_across)
        assert np.max(along @ way, initial=0.0) <= 1e-10
        assert np.max(np.abs(across @ way), initial=0.0) <= 1e-10
        assert F @ way == pytest.approx(share**2, abs=1e-10)
        shares.append(share)
    assert min(shares) == pytest.approx(0.0, abs=1e-12)
    assert max(shares) > 0.9


@pytest.mark.parametrize("kind", KINDS)
def test_random_pairs_self_aligning_and_roller_bearings_have_right_answers(kind: str) -> None:
    rng = np.random.default_rng([20_261_122, KINDS.index(kind)])
    converged = 0
    for number in range(200):
        state = equilibrium(random_scene(rng, kind), [float(rng.uniform(0.0, 6.28))])
        fault = verdict(state, 0)
        assert not fault, f"scene {number}: {fault}"
        converged += state.status[0] == kernels.CONVERGED
    assert converged > 150
