"""A scene as structs of numbers for the kernels; only this module fills them.

`pack` makes all structs of a scene at rest, and solvers need nothing else. Tilts are times r_d and
moments divided by r_d, where r_d is `Bearing.groove_center_radius`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from bearingcore.bearings import Bearing
from bearingcore.common import Array
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene._defect import path_tables
from bearingcore.model.scene._scene import DOF_NAMES, Scene
from bearingcore.units import STANDARD_GRAVITY

SMALL_TILT = 0.2
"""Greatest rotation [rad] of a ring that counts as small: its sine is 0.7 % less, and the neglected
displacement of its groove centres, r_d θ²/2, is 2 % of their radius."""

HEALTHY_PATH = kernels.Path(np.zeros((0, len(kernels.PATH_COLUMNS))), np.zeros(0))
"""Path of a ball's centre without any defect."""


@dataclass(frozen=True, eq=False)
class PackedScene:
    """A scene whose inner ring is free along `dofs`, as numbers.

    Attributes
    ----------
    scene, dofs
        scene that was packed, and the free directions.
    contacts, path, load
        all contacts, the path of the balls over all defects, load and free directions.
    inner_path
        path over the defects of the inner race alone.
    units : (5,)
        divisors of scaled displacements, see `length_units`.
    rows
        a bearing for each row, with its numbers, see `Bearing.of_row`.
    balls
        contacts, masses, weights and paths of balls with mass; None for massless balls.
    """

    scene: Scene
    dofs: tuple[str, ...]
    contacts: kernels.Contacts
    path: kernels.Path
    inner_path: kernels.Path
    load: kernels.StaticLoad
    units: Array
    rows: tuple[Bearing, ...]
    balls: kernels.StaticBalls | None


@dataclass(frozen=True, eq=False)
class PackedMotion(PackedScene):
    """A scene that moves along `dofs`: `PackedScene` with both bodies."""

    rotor: kernels.Rotor


def pack(scene: Scene, dofs: tuple[str, ...] | None = None, *, balls: bool = False) -> PackedScene:
    """Return a scene whose ring is free along `dofs` as numbers; None takes its active directions.

    balls: True to include balls with mass. Their contacts have the damping 1 N·s/m, see `races`.
    """
    free = scene.active_dofs if dofs is None else dofs
    units = length_units(scene)
    load = kernels.StaticLoad(scene.load.vector / units, direction_numbers(free))
    both = races(scene, 1.0, weight=True) if balls else None
    defects, bearing = scene.defects, scene.bearing
    rows, all_contacts = bearings_of_rows(bearing), contacts(bearing)
    whole = path_tables(defects, bearing)
    paths = []
    for race in ("inner", "outer"):
        on_race = tuple(defect for defect in defects if defect.race == race)
        alone = len(on_race) == len(defects)
        paths.append(whole if alone else path_tables(on_race, bearing) if on_race else HEALTHY_PATH)
    static_balls = None if both is None else kernels.StaticBalls(all_contacts, both, *paths)
    return PackedScene(scene, free, all_contacts, whole, paths[0], load, units, rows, static_balls)


@lru_cache(maxsize=256)
def bearings_of_rows(bearing: Bearing) -> tuple[Bearing, ...]:
    """Return a bearing for each row, with the numbers of that row."""
    return tuple(bearing.of_row(k) for k in range(len(bearing.all_rows)))


@lru_cache(maxsize=256)
def contacts(bearing: Bearing) -> kernels.Contacts:
    """Return all contacts of a bearing."""
    bearings = bearings_of_rows(bearing)
    # a line of contact for each row, and all lengths over the common lever r_d
    counts = [row_bearing.n_balls for row_bearing in bearings]
    lines = [bearing.kind.contact(row_bearing) for row_bearing in bearings]
    rows = list(zip(bearing.all_rows, lines, strict=True))
    lever = bearing.groove_center_radius

    def each(values: Iterable[float]) -> Array:
        """Repeat the value of each row for all contacts of that row."""
        return np.repeat(np.array(list(values), dtype=float), counts)

    return kernels.Contacts(
        angle=np.concatenate(
            [
                row.turn + row_bearing.ball_spacing * np.arange(row_bearing.n_balls)
                for row, row_bearing in zip(bearing.all_rows, bearings, strict=True)
            ]
        ),
        relative_speed=each(bearing.pace(k) for k in range(len(rows))),
        arm=each((row.place + row.facing * line.beyond) / lever for row, line in rows),
        reach=each(line.lever / lever for line in lines),
        line_r=each(math.cos(line.angle) for line in lines),
        line_z=each(row.facing * math.sin(line.angle) for row, line in rows),
        fixed=each(line.center_distance is None for line in lines).astype(bool),
        distance=each(line.center_distance or 0.0 for line in lines),
        clearance=each(bearing.radial_clearance + row.clearance for row, _ in rows),
        offset=each(row.offset for row, _ in rows),
        room=each(line.room for line in lines),
        factor=each(line.factor for line in lines),
        exponent=each(line.exponent for line in lines),
        rows=np.array([[balls.start, balls.stop - balls.start] for balls in bearing.balls_of_rows]),
        most_tilt=SMALL_TILT * lever,
    )


def ball_angles(bearing: Bearing, cage_angles: Array) -> Array:
    """Return the angles (n, balls) [rad] of all balls at cage angles (n,), row after row."""
    return contacts(bearing).angles_at(cage_angles)


def path(scene: Scene, race: str | None = None) -> kernels.Path:
    """Return the path of a ball's centre over all defects of a scene, or over those of one race."""
    defects = tuple(defect for defect in scene.defects if race in (None, defect.race))
    return path_tables(defects, scene.bearing)


def races(scene: Scene, contact_damping: float, *, weight: bool) -> kernels.Races:
    """Return both contacts of each ball, its mass and the loads on it.

    contact_damping: c [N·s/m] of both contacts in series. Both contacts get the same ratio of
    damping and stiffness, as then balls without mass would move by the published law. Two equal
    contacts have 2 c each. weight: True if the weight of the balls acts.
    """
    rows = bearings_of_rows(scene.bearing)
    softer = [(row.race_factors[0] / row.race_factors[1]) ** (1.0 / row.kind.exponent)
              for row in rows]  # fmt: skip

    def each(values: Iterable[float]) -> Array:
        """Repeat the value of each row for all balls of that row."""
        return np.repeat(np.array(list(values), dtype=float), [row.n_balls for row in rows])

    def both(values: Iterable[tuple[float, float]]) -> Array:
        """Repeat the pairs of values (inner, outer) of the rows for all balls."""
        inner, outer = zip(*values, strict=True)
        return np.stack([each(inner), each(outer)])

    return kernels.Races(
        factor=both(row.race_factors for row in rows),
        distance=both(row.kind.race_distances(row) for row in rows),
        damping=both(
            (contact_damping * (1.0 + ratio), contact_damping * (1.0 + 1.0 / ratio))
            for ratio in softer
        ),
        mass=each(row.ball_mass for row in rows),
        inverse_mass=each(1.0 / row.ball_mass for row in rows),
        centrifugal=each(row.centrifugal_load(scene.shaft_speed) for row in rows),
        weight=each(row.ball_mass * STANDARD_GRAVITY if weight else 0.0 for row in rows),
    )


def direction_numbers(dofs: Sequence[str]) -> NDArray[np.int64]:
    """Return the indices of directions in x, y, z, rx, ry."""
    return np.array([DOF_NAMES.index(name) for name in dofs], dtype=np.int64)


def length_units(scene: Scene, dofs: Sequence[str] = DOF_NAMES) -> Array:
    """Return the divisors of scaled displacements: 1, or r_d [m/rad] for tilts."""
    lever = scene.bearing.groove_center_radius
    return np.array([lever if name in ("rx", "ry") else 1.0 for name in dofs])


def rotor(scene: Scene, dofs: tuple[str, ...], contact_damping: float) -> kernels.Rotor:
    """Return both bodies of a scene that moves along `dofs`, and the variables of its motion.

    The published contact law has variables without jumps, and shorter sums for contacts that stay
    in the plane. contact_damping: c [N·s/m] of Eq. 18.

    Raises
    ------
    ValueError
        if the support lacks a number.
    """
    published = scene.contact_law == "published"
    variables = kernels.VELOCITIES
    if published:
        flat = is_planar(scene) and dofs == DOF_NAMES[:2]
        variables = kernels.PLANAR if flat else kernels.SMOOTH
    support, units, active = scene.support, length_units(scene, dofs), direction_numbers(dofs)
    return kernels.Rotor(
        force=scene.load.vector[active] / units,
        inverse_inner=1.0 / (support.inertia("inner", dofs) / units**2),
        inverse_outer=1.0 / (support.inertia("outer", dofs) / units**2),
        stiffness=support.stiffness(dofs) / units**2,
        damping=support.damping(dofs) / units**2,
        active=active,
        cage_speed=float(scene.cage_speed),
        contact_damping=float(contact_damping),
        variables=variables,
        tension=published,
        turning_force=float(scene.turning_force),
        shaft_ratio=1.0 / scene.bearing.cage_ratio,
        samples=np.zeros((0, 5)),
        samples_a_radian=0.0,
    )


def is_planar(scene: Scene) -> bool:
    """Return True if only x and y move, α0 = 0 and the contact law is the published one.

    Such a motion costs less, as its contacts never swivel.
    """
    flat = scene.active_dofs == DOF_NAMES[:2] and scene.bearing.is_flat
    return flat and scene.contact_law == "published"
