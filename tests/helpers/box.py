"""The box of all scenes of one row that a solution has to be right in, wider than any slider."""

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, EDGES, RACES, Bearing, Defect, Load, Scene, presets

DOF_SETS = tuple(
    chosen for count in range(1, 6) for chosen in itertools.combinations(DOF_NAMES, count)
)
"""All 31 of them."""


def random_scene(rng: np.random.Generator) -> tuple[Scene, NDArray[np.float64]]:
    """Return a scene of the box and four cage angles, each near enough to start from the last.

    Corners come more often than their volume would have them. A third have no clearance, no contact
    angle, no depth; each load is absent in half of them; half let the scene choose its directions;
    in a third a ball stands right at 270° or at the middle of the defect.
    """

    def either(special: float, often: float, usual: float) -> float:
        return float(special if rng.random() < often else usual)

    def decades(low: float, high: float) -> float:
        return math.exp(rng.uniform(math.log(low), math.log(high)))

    n_balls = int(either(rng.integers(1, 5), 0.2, rng.integers(1, 41)))
    pitch = decades(5e-3, 1.0)
    room = math.sin(math.pi / n_balls) if n_balls > 2 else 0.9
    ball = pitch * min(0.9, room) * rng.uniform(0.05, 0.95)
    center = rng.uniform(-math.pi, 3.0 * math.pi)
    sizes = [decades(1e-3, 1e6) for _ in range(5)]
    if rng.random() < 0.125:  # as heavy in each direction as in the first: no load drowns
        sizes = sizes[:1] * 5
    loads = [either(0.0, 0.5, size * rng.choice([-1.0, 1.0])) for size in sizes]
    scene = Scene(
        bearing=Bearing(
            n_balls=n_balls,
            ball_diameter=ball,
            pitch_diameter=pitch,
            contact_angle=either(0.0, 0.33, rng.uniform(0.0, math.radians(75.0))),
            groove_center_radius=0.5 * pitch * rng.uniform(0.8, 1.2),
            groove_center_distance=decades(5e-6, 2e-3),
            radial_clearance=either(0.0, 0.33, 500e-6 * rng.random() ** 3),
            load_deflection_factor=decades(1e8, 1e12),
            outer_raceway_radius=0.5 * (pitch + ball),
            inner_raceway_radius=0.5 * (pitch - ball),
        ),
        defect=Defect(
            extent=either(2.0 * math.pi, 0.05, rng.uniform(0.0, 2.0 * math.pi)),
            depth=either(0.0, 0.33, 0.25 * ball * rng.random() ** 3),
            center=center,
            race=str(rng.choice(RACES)),
            edge=str(rng.choice(EDGES)),
        ),
        load=Load(*loads[:3], *(0.5 * pitch * load for load in loads[3:])),
        shaft_speed=100.0,  # speed and support do not enter the statics
        support=presets["fan-rig"].support,
        dofs=None if rng.random() < 0.5 else DOF_SETS[int(rng.integers(len(DOF_SETS)))],
    )
    places = (1.5 * math.pi, center, rng.uniform(0.0, 2.0 * math.pi))
    cage_angle = rng.choice(places, p=(0.17, 0.17, 0.66))
    return scene, cage_angle + np.array([0.0, 0.01, 0.02, 0.03]) * scene.bearing.ball_spacing
