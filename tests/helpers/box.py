"""The box of all scenes that a solution has to be right in, wider than any slider.

A point of the box is a `Point`: plain numbers, drawn by hypothesis or by a random generator, from
which `scene_at` makes a scene and `cage_angles_at` the cage angles to look at.
"""

import itertools
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, EDGES, RACES, Bearing, Defect, Load, Scene, presets

MOST_BALLS = 40
GREATEST_CONTACT_ANGLE_DEG = 75.0
GREATEST_CLEARANCE = 500e-6
GROOVE_DISTANCES = (5e-6, 2e-3)
FACTORS = (1e8, 1e12)
FORCES = (1e-3, 1e6)
PITCH_DIAMETERS = (5e-3, 1.0)

DOF_SETS = tuple(
    chosen for count in range(1, 6) for chosen in itertools.combinations(DOF_NAMES, count)
)
"""All 31 of them."""


class Point(NamedTuple):
    """One point of the box; where a number is a part it lies between 0 and 1."""

    n_balls: int
    pitch_diameter: float
    """[m]"""
    ball_size: float
    """part of the greatest ball that fits"""
    contact_angle: float
    """[rad]"""
    groove_center_radius: float
    """part of the pitch radius, 0.8 to 1.2"""
    groove_center_distance: float
    """[m]"""
    radial_clearance: float
    """[m]"""
    load_deflection_factor: float
    """[N/m^1.5]"""
    extent: float
    """[rad]"""
    depth: float
    """part of half the ball radius"""
    center: float
    """[rad]"""
    race: str
    edge: str
    loads: tuple[float, float, float, float, float]
    """Fx, Fy, Fz [N], and Mx, My over the pitch radius [N]"""
    dofs: tuple[str, ...] | None
    cage_angle: float
    """[rad]"""


def scene_at(point: Point) -> Scene:
    """The scene of a point; speed and support do not enter the statics."""
    D_p = point.pitch_diameter
    room = math.sin(math.pi / point.n_balls) if point.n_balls > 2 else 0.9
    D_b = D_p * min(0.9, room) * (0.05 + 0.9 * point.ball_size)
    fx, fy, fz, *moments = point.loads
    mx, my = (0.5 * D_p * moment for moment in moments)
    return Scene(
        bearing=Bearing(
            n_balls=point.n_balls,
            ball_diameter=D_b,
            pitch_diameter=D_p,
            contact_angle=point.contact_angle,
            groove_center_radius=0.5 * D_p * point.groove_center_radius,
            groove_center_distance=point.groove_center_distance,
            radial_clearance=point.radial_clearance,
            load_deflection_factor=point.load_deflection_factor,
            outer_raceway_radius=0.5 * (D_p + D_b),
            inner_raceway_radius=0.5 * (D_p - D_b),
        ),
        defect=Defect(
            extent=point.extent,
            depth=0.25 * D_b * point.depth,
            center=point.center,
            race=point.race,
            edge=point.edge,
        ),
        load=Load(fx, fy, fz, mx, my),
        shaft_speed=100.0,
        support=presets["fan-rig"].support,
        dofs=point.dofs,
    )


def cage_angles_at(point: Point) -> NDArray[np.float64]:
    """Four cage angles in order, near enough for each to start from those before it."""
    return point.cage_angle + np.array([0.0, 0.01, 0.02, 0.03]) * 2.0 * math.pi / point.n_balls


def draw(rng: np.random.Generator, n: int) -> list[Point]:
    """N points at random, corners of the box more often than their volume would have them.

    A third have no clearance, no contact angle, no depth; each load is absent in half of them;
    half let the scene choose its directions; in a third a ball stands right at 270° or at the
    middle of the defect.
    """

    def either(special: float, often: float, usual: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.where(rng.random(n) < often, special, usual)

    def decades(limits: tuple[float, float]) -> NDArray[np.float64]:
        return np.exp(rng.uniform(*np.log(limits), n))

    n_balls = rng.integers(1, MOST_BALLS + 1, n).astype(float)
    few = rng.random(n) < 0.2
    n_balls[few] = rng.integers(1, 5, np.count_nonzero(few))
    center = rng.uniform(-math.pi, 3.0 * math.pi, n)
    loads = np.empty((n, 5))
    for k in range(5):
        loads[:, k] = either(0.0, 0.5, decades(FORCES) * rng.choice([-1.0, 1.0], n))
    # an eighth are as heavy in each direction as in the first: no load drowns
    alike = rng.random(n) < 0.125
    loads[alike] = np.sign(loads[alike]) * decades(FORCES)[alike, None]
    kinds = list(itertools.product((*DOF_SETS, None), EDGES, RACES))
    n_sets, per_set = len(DOF_SETS), len(EDGES) * len(RACES)
    chosen = np.where(rng.random(n) < 0.5, n_sets, rng.integers(0, n_sets, n))
    pick = chosen * per_set + rng.integers(0, per_set, n)
    place = rng.random(n)
    cage_angle = rng.uniform(0.0, 2.0 * math.pi, n)
    cage_angle = np.where(place < 0.17, 1.5 * math.pi, cage_angle)
    cage_angle = np.where(place > 0.83, center, cage_angle)
    columns = [
        decades(PITCH_DIAMETERS),
        rng.random(n),
        either(0.0, 0.33, rng.uniform(0.0, math.radians(GREATEST_CONTACT_ANGLE_DEG), n)),
        rng.uniform(0.8, 1.2, n),
        decades(GROOVE_DISTANCES),
        either(0.0, 0.33, GREATEST_CLEARANCE * rng.random(n) ** 3),
        decades(FACTORS),
        either(2.0 * math.pi, 0.05, rng.uniform(0.0, 2.0 * math.pi, n)),
        either(0.0, 0.33, rng.random(n) ** 3),
        center,
    ]
    points = []
    for i, numbers in enumerate(np.stack(columns, axis=1).tolist()):
        dofs, edge, race = kinds[pick[i]]
        forces = tuple(loads[i].tolist())
        angle = float(cage_angle[i])
        points.append(Point(int(n_balls[i]), *numbers, race, edge, forces, dofs, angle))
    return points
