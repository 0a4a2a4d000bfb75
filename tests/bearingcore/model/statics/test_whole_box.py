"""No point of the box, wider than any slider, gives a wrong or an unexplained answer.

Every cage angle is either converged, with a relative residual of 1e-9 and a symmetric, positive
semidefinite stiffness that holds the ring, or has a reason that is true: nothing touches, a
direction is free, the load cannot be carried, contacts would be where there are no races.
`helpers.judge` decides, in extended precision and without the solver's code. A million scenes:
`BOX_SCENES=1000000 pytest -n 0` on this file.
"""

import math
import os
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, Bearing, Defect, Load, Scene, equilibrium, presets
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene._packing import contacts
from bearingcore.model.statics._shortage import descent_direction
from tests.helpers.box import random_scene
from tests.helpers.contact_law import Balls
from tests.helpers.judge import verdict
from tests.helpers.random_rows import KINDS, random_scene as random_rows

TURN = 2.0 * math.pi

PLAIN = presets["fan-rig"].replace(
    bearing=Bearing(
        n_balls=9,
        ball_diameter=8e-3,
        pitch_diameter=40e-3,
        contact_angle=0.0,
        groove_center_radius=20e-3,
        groove_center_distance=50e-6,
        radial_clearance=0.0,
        load_deflection_factor=1e10,
        outer_raceway_radius=24e-3,
        inner_raceway_radius=16e-3,
    ),
    defect=Defect.none(),
    load=Load(fy=-1e3),
    dofs="tilt free",
)
"""An unremarkable bearing, for the cases below to differ from."""


def check(scene: Scene, cage_angles: Sequence[float] | NDArray[np.float64]) -> set[int]:
    """Judge the answers at cage angles [rad]; return the statuses that occur."""
    answer = equilibrium(scene, cage_angles)
    for i in range(len(answer.cage_angles)):
        wrong = verdict(answer, i)
        assert not wrong, f"{scene}, cage angle {i}: {wrong}"
    return set(answer.status.tolist())


def test_scenes_drawn_at_random_meet_every_status() -> None:
    """1000 scenes, or more, with which all five kinds of true answer are met."""
    seen: set[int] = set()
    rng = np.random.default_rng(0)
    for _ in range(int(os.environ.get("BOX_SCENES", "1000"))):
        seen |= check(*random_scene(rng))
    assert seen == {
        kernels.CONVERGED,
        kernels.NOTHING_TOUCHES,
        kernels.FREE_DIRECTION,
        kernels.NOT_CARRIED,
        kernels.BEYOND,
    }


CORNERS: dict[str, tuple[int, float, dict[str, Any]]] = {
    "a moment too light to press stiff balls flat: a long and narrow curved valley": (
        kernels.CONVERGED,
        0.3,
        {"n_balls": 5, "contact_angle": math.radians(25.6), "groove_center_distance": 2.9e-4,
         "load_deflection_factor": 1e11, "load": Load(my=1e-3)},
    ),
    "a ring wedged by its clearance though no load acts along x and y": (
        kernels.CONVERGED,
        0.3,
        {"contact_angle": math.radians(60.0), "radial_clearance": 75e-6, "load": Load(),
         "dofs": ("x", "y")},
    ),
    "a clearance so wide that the grooves of a wedged ring are past each other": (
        kernels.BEYOND,
        0.3,
        {"contact_angle": math.radians(40.0), "radial_clearance": 400e-6, "load": Load(),
         "dofs": ("x", "y")},
    ),
    "a ball right under the load, its neighbours in their clearance": (
        kernels.FREE_DIRECTION,
        0.75 * TURN,
        {"radial_clearance": 5e-4, "fy": -1.0},
    ),
    "two loaded balls hold four directions, not five": (
        kernels.FREE_DIRECTION,
        3.9,
        {"n_balls": 4, "radial_clearance": 4e-4, "fy": 6e4, "dofs": DOF_NAMES},
    ),
    "a moment alone, and a ball across it that touches by rounding only": (
        kernels.CONVERGED,
        0.75 * TURN,
        {"n_balls": 4, "groove_center_distance": 5e-6, "load_deflection_factor": 5e10,
         "defect": Defect(4.8, 1.8e-3, 9.2), "load": Load(mx=-5e-4), "dofs": ("rx",)},
    ),
    "an inner race smaller than its balls, which never reach the floor": (
        kernels.NOT_CARRIED,
        0.3,
        {"n_balls": 2, "ball_diameter": 34.2e-3, "outer_raceway_radius": 37.1e-3,
         "inner_raceway_radius": 2.9e-3,
         "defect": Defect(0.5 * TURN, 8.55e-3, 0.0, "inner", "exact")},
    ),
}  # fmt: skip
"""Status, cage angle [rad] and what differs from `PLAIN`: what went wrong once, or nearly."""


@pytest.mark.parametrize(("status", "cage_angle", "changes"), CORNERS.values(), ids=CORNERS)
def test_corners_of_the_box(status: int, cage_angle: float, changes: dict[str, Any]) -> None:
    scene = PLAIN.replace(**changes)
    angles = cage_angle + np.array([0.0, 0.01, 0.02, 0.03]) * scene.bearing.ball_spacing
    assert status in check(scene, angles)


def test_repeated_and_unordered_cage_angles_are_as_good_as_others() -> None:
    scene = PLAIN.replace(contact_angle=0.5)
    angles = np.array([0.0, 0.0, 0.0, 0.0, 3.0, -5.0, 3.0, 1e3, 0.0])
    answer = equilibrium(scene, angles)
    assert [verdict(answer, i) for i in range(len(angles))] == [""] * len(angles)
    alone = [equilibrium(scene, [angle]).displacement[0] for angle in angles]
    assert answer.displacement == pytest.approx(np.array(alone), rel=1e-8, abs=1e-12)


def test_the_judge_finds_what_is_wrong() -> None:
    """It refuses every spoilt answer: otherwise the tests above could not fail."""
    scene = PLAIN.replace(contact_angle=0.4, load=Load(10.0, -1e3, 200.0, 1.0))
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
    """The way of every scene presses no ball and works, and what the contacts carry does not.

    So F = (what contacts carry) + way with the two at right angles, which makes it the nearest.
    """
    shares = []
    rng = np.random.default_rng(5)
    for _ in range(500):
        scene, (cage_angle, *_) = random_scene(rng)
        balls = Balls(scene, cage_angle)
        active = np.array([DOF_NAMES.index(name) for name in scene.active_dofs])
        F = balls.load[active].astype(float)
        if not F.any():
            continue
        F /= np.linalg.norm(F)
        way, share = descent_direction(contacts(scene.bearing), cage_angle, active, F)
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
        state = equilibrium(random_rows(rng, kind), [float(rng.uniform(0.0, 6.28))])
        fault = verdict(state, 0)
        assert not fault, f"scene {number}: {fault}"
        converged += state.status[0] == kernels.CONVERGED
    assert converged > 150
