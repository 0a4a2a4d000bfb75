"""Structs of bearings that the kernels are compared on, beyond what a scene can say today."""

from __future__ import annotations

import math

import numpy as np

from bearingcore import Defect, RoughFloor, Scene, kernels, presets
from bearingcore.bearings.rows import Row
from bearingcore.scene import packing

FAN_RIG, LIEW_LIM = presets["fan-rig"], presets["liew-lim"]
ROUGH = RoughFloor(rms_height=5e-6, correlation_length=3e-4, seed=3)

SCENES: dict[str, Scene] = {
    "planar": FAN_RIG,
    "five directions": LIEW_LIM,
    "inner race": LIEW_LIM.replace(race="inner", edge="exact"),
    "rough floor": LIEW_LIM.replace(floor=ROUGH),
    "both races": FAN_RIG.replace(
        defect=(FAN_RIG.defects[0], Defect(0.2, 3e-5, 5.6, "inner", "exact"))
    ),
    "chord": FAN_RIG.replace(edge="chord"),
    "no tension": LIEW_LIM.replace(contact_law="no tension"),
    "three directions": LIEW_LIM.replace(dofs=("x", "y", "z")),
}

UNLIKE = presets["7208-back-to-back"].replace(
    rows=(
        Row(-9e-3, 1, offset=4e-6),
        Row(
            9e-3, -1, offset=-4e-6, turn=0.1, contact_angle=math.radians(40.0),
            n_balls=11, ball_diameter=10e-3, pitch_diameter=55e-3,
        ),
    ),
    extent=0.25,
    row=None,
)  # fmt: skip
"""Rows of unlike balls, whose cages turn at speeds of their own; both meet the defect."""


def system_of(scene: Scene, *, velocities: bool = False) -> kernels.System:
    """A scene with a damping of its own, so that nothing else has to be solved first."""
    return kernels.System(
        packing.rotor(scene, scene.active_dofs, 122.0, velocities=velocities),
        packing.contacts(scene.bearing),
        packing.path(scene),
    )


def rollers(contacts: kernels.Contacts) -> kernels.Contacts:
    """Line contacts: exponent 10/9, about as stiff at 1 µm."""
    factor = contacts.factor * 1e-6**1.5 / 1e-6 ** (10.0 / 9.0)
    return contacts._replace(factor=factor, exponent=np.full_like(factor, 10.0 / 9.0))


def two_rows(
    contacts: kernels.Contacts, places: tuple[float, float], signs: tuple[float, float]
) -> kernels.Contacts:
    """The row twice, at axial places over r_d, with contact angles of these signs.

    The second row is turned by a third of a spacing.
    """
    n = contacts.angle.size
    both = {name: np.tile(getattr(contacts, name), 2) for name in contacts._fields[:-1]}
    both["angle"] = np.concatenate([contacts.angle, contacts.angle + 2.0 * math.pi / n / 3.0])
    both["arm"] = np.repeat(places, n)
    both["line_z"] = np.concatenate([sign * contacts.line_z for sign in signs])
    return kernels.Contacts(**both, rows=np.array([[0, n], [n, n]]))


def in_row(path: kernels.Path, row: int) -> kernels.Path:
    """The same defects, met by the balls of one row only."""
    defects = path.defects.copy()
    defects[:, kernels.PATH_COLUMNS.index("row")] = row
    return path._replace(defects=defects)
