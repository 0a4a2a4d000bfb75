"""A scene as the structs that kernels take: the one place that fills them.

Tilts are carried times r_d and moments over r_d, r_d being the bearing's `groove_center_radius`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.bearings.bearing import Bearing
from bearingcore.scene.defect import path_tables
from bearingcore.scene.scene import DOF_NAMES, Scene

Array = NDArray[np.float64]

SMALL_TILT = 0.2
"""[rad] up to which a rotation of a ring counts as small: its sine is 0.7 % less, and what is left
out of the place of its groove's centres, r_d θ²/2, is 2 % of their radius."""

STANDARD_GRAVITY = 9.80665
"""[m/s²], along −y."""


class BodyNumbers(NamedTuple):
    """Both bodies along n directions, each (n,), tilts scaled to lengths.

    Load [N], inertia of the inner and of the outer body [kg], stiffness [N/m] and damping [N·s/m]
    of the support.
    """

    force: Array
    inner_mass: Array
    outer_mass: Array
    stiffness: Array
    damping: Array


@lru_cache(maxsize=256)
def contacts(bearing: Bearing) -> kernels.Contacts:
    """All contacts of a bearing."""
    rows = bearing.all_rows
    owns = [bearing.of_row(k) for k in range(len(rows))]
    counts = [own.n_balls for own in owns]
    made = [bearing.kind.contact(own) for own in owns]
    lever = bearing.groove_center_radius

    def each(*values: float) -> Array:
        """The values of the rows, once for each of their contacts."""
        return np.repeat(np.array(values, dtype=float), counts)

    return kernels.Contacts(
        angle=np.concatenate(
            [
                row.turn + own.ball_spacing * np.arange(own.n_balls)
                for row, own in zip(rows, owns, strict=True)
            ]
        ),
        pace=each(*(bearing.pace(k) for k in range(len(rows)))),
        arm=each(
            *(
                (row.place + row.facing * one.beyond) / lever
                for row, one in zip(rows, made, strict=True)
            )
        ),
        reach=each(*(one.lever / lever for one in made)),
        line_r=each(*(math.cos(one.angle) for one in made)),
        line_z=each(
            *(row.facing * math.sin(one.angle) for row, one in zip(rows, made, strict=True))
        ),
        fixed=each(*(one.center_distance is None for one in made)).astype(bool),
        distance=each(*(one.center_distance or 0.0 for one in made)),
        clearance=each(*(bearing.radial_clearance + row.clearance for row in rows)),
        offset=each(*(row.offset for row in rows)),
        room=each(*(one.room for one in made)),
        factor=each(*(one.factor for one in made)),
        exponent=each(*(one.exponent for one in made)),
        rows=np.array([[own.start, own.stop - own.start] for own in bearing.balls_of_rows]),
        most_tilt=SMALL_TILT * lever,
    )


def ball_angles(bearing: Bearing, cage_angles: Array) -> Array:
    """Angles (n, balls) [rad] of all balls at cage angles (n,), row after row."""
    one = contacts(bearing)
    return cage_angles[:, None] * one.pace + one.angle


def path(scene: Scene, race: str | None = None) -> kernels.Path:
    """The way of a ball's centre over all defects of a scene, or over those of one race."""
    defects = tuple(defect for defect in scene.defects if race in (None, defect.race))
    return path_tables(defects, scene.bearing)


def races(scene: Scene, contact_damping: float, *, weight: bool) -> kernels.Races:
    """Both contacts of each ball, its mass and the loads on it.

    contact_damping: c [N·s/m] of both contacts in series. It is shared so that balls without mass
    would move as the published law has them: damping over stiffness alike on both sides. Alike
    contacts have 2 c each. `weight`: whether the balls' weight acts.
    """
    bearing = scene.bearing
    owns = [bearing.of_row(k) for k in range(len(bearing.all_rows))]
    softer = [(own.race_factors[0] / own.race_factors[1]) ** (1.0 / own.kind.exponent)
              for own in owns]  # fmt: skip

    def each(values: Iterable[float]) -> Array:
        """The values of the rows, once for each of their balls."""
        return np.repeat(np.array(list(values), dtype=float), [own.n_balls for own in owns])

    def both(values: Iterable[tuple[float, float]]) -> Array:
        """The same of pairs of values, for the inner and the outer race."""
        inner, outer = zip(*values, strict=True)
        return np.stack([each(inner), each(outer)])

    return kernels.Races(
        factor=both(own.race_factors for own in owns),
        distance=both(own.kind.race_distances(own) for own in owns),
        damping=both(
            (contact_damping * (1.0 + one), contact_damping * (1.0 + 1.0 / one)) for one in softer
        ),
        mass=each(own.ball_mass for own in owns),
        inverse_mass=each(1.0 / own.ball_mass for own in owns),
        centrifugal=each(own.centrifugal_load(scene.shaft_speed) for own in owns),
        weight=each(own.ball_mass * STANDARD_GRAVITY if weight else 0.0 for own in owns),
    )


def typical_compression(bearing: Bearing, load: float) -> float:
    """Compression [m] of one contact of a bearing that carries a load [N]."""
    one = contacts(bearing)
    return float((load / one.factor[0]) ** (1.0 / one.exponent[0]))


def direction_numbers(dofs: Sequence[str]) -> NDArray[np.int64]:
    """Indices of directions in x, y, z, rx, ry."""
    return np.array([DOF_NAMES.index(name) for name in dofs], dtype=np.int64)


def length_units(scene: Scene, dofs: Sequence[str] = DOF_NAMES) -> Array:
    """Divisors of scaled displacements: 1 [m], or r_d for tilts [m/rad]."""
    lever = scene.bearing.groove_center_radius
    return np.array([lever if name in ("rx", "ry") else 1.0 for name in dofs])


def static_load(scene: Scene, dofs: Sequence[str]) -> kernels.StaticLoad:
    """The load of a scene whose ring is free along `dofs`."""
    return kernels.StaticLoad(scene.load.vector / length_units(scene), direction_numbers(dofs))


def body_numbers(scene: Scene, dofs: tuple[str, ...]) -> BodyNumbers:
    """Load, inertia and support along `dofs`.

    Raises
    ------
    ValueError
        for a support that lacks a number.
    """
    units = length_units(scene, dofs)
    return BodyNumbers(
        scene.load.vector[direction_numbers(dofs)] / units,
        scene.support.inertia("inner", dofs) / units**2,
        scene.support.inertia("outer", dofs) / units**2,
        scene.support.stiffness(dofs) / units**2,
        scene.support.damping(dofs) / units**2,
    )


def rotor(
    scene: Scene, dofs: tuple[str, ...], contact_damping: float, *, velocities: bool = False
) -> kernels.Rotor:
    """Both bodies of a scene that moves along `dofs`, and what its motion is marched in.

    That is variables without jumps where the contact law has them, with the shorter sums of
    contacts that stay in the plane where they do; `velocities` takes these as they are, which
    adaptive steps and general-purpose integrators take. contact_damping: c [N·s/m] of Eq. 18.
    """
    published = scene.contact_law == "published"
    variables = kernels.VELOCITIES
    if published and not velocities:
        flat = is_planar(scene) and dofs == DOF_NAMES[:2]
        variables = kernels.PLANAR if flat else kernels.SMOOTH
    bodies = body_numbers(scene, dofs)
    return kernels.Rotor(
        force=bodies.force,
        inverse_inner=1.0 / bodies.inner_mass,
        inverse_outer=1.0 / bodies.outer_mass,
        stiffness=bodies.stiffness,
        damping=bodies.damping,
        active=direction_numbers(dofs),
        cage_speed=float(scene.cage_speed),
        contact_damping=float(contact_damping),
        variables=variables,
        tension=published,
        turning_force=float(scene.turning_force),
        shaft_pace=1.0 / scene.bearing.cage_ratio,
    )


def is_planar(scene: Scene) -> bool:
    """True where only x and y move, α0 = 0 and the law is the published one.

    Such a motion is cheaper: its contacts never swivel.
    """
    flat = scene.active_dofs == DOF_NAMES[:2] and scene.bearing.is_flat
    return flat and scene.contact_law == "published"
