"""Random pairs, self-aligning and roller bearings, and unlike rows."""

import dataclasses
import math
from typing import Any

import numpy as np

from bearingcore import EDGES, RACES, Bearing, Defect, Load, Scene, presets
from bearingcore.bearings import Row
from bearingcore.bearings._row import ARRANGEMENTS

OWN_ANGLES = "rows with angles of their own"
UNLIKE = "rows of unlike balls"
KINDS = (*ARRANGEMENTS, "self-aligning", "rollers", OWN_ANGLES, UNLIKE)


def random_scene(rng: np.random.Generator, kind: str) -> Scene:
    """A scene with a bearing of a kind, out of a box wider than what is built."""

    def decades(low: float, high: float) -> float:
        return float(math.exp(rng.uniform(math.log(low), math.log(high))))

    bearing = _bearing(rng, kind, decades)
    loads = [
        decades(1.0, 1e5) * float(rng.choice([-1.0, 1.0])) * (rng.random() < 0.7) for _ in "12345"
    ]
    lever = 0.5 * bearing.pitch_diameter
    load = Load(loads[0], loads[1], loads[2], lever * loads[3], lever * loads[4])
    dofs: tuple[str, ...] | str | None = None
    if kind == "rollers":
        load = Load(loads[0], loads[1])
    elif kind == "self-aligning":
        load = Load(*loads[:3])
    else:
        dofs = ("tilt free", ("x", "y", "z"), ("x", "y"))[int(rng.choice(3, p=[0.7, 0.2, 0.1]))]
    defect = Defect(
        extent=float(rng.uniform(0.0, 1.5)),
        depth=0.2 * bearing.ball_diameter * float(rng.random() ** 3),
        center=float(rng.uniform(0.0, 6.28)),
        race=str(rng.choice(RACES)),
        edge=str(rng.choice(EDGES)),
        row=[None, 0, len(bearing.all_rows) - 1][int(rng.integers(3))],
    )
    return Scene(bearing, defect, load, 100.0, presets["fan-rig"].support, dofs=dofs)


def _bearing(rng: np.random.Generator, kind: str, decades: Any) -> Bearing:
    n = int(rng.integers(3, 25))
    pitch = decades(15e-3, 0.4)
    room = math.sin(math.pi / n)
    ball = pitch * min(0.6, room) * float(rng.uniform(0.3, 0.95))
    clearance = float(rng.choice([0.0, decades(1e-7, 1e-4)]))
    if kind == "rollers":
        return Bearing.cylindrical(n, ball, ball * float(rng.uniform(0.5, 3.0)), pitch, clearance)
    angle = math.radians(float(rng.uniform(3.0, 60.0)))
    groove = ball * float(rng.uniform(0.505, 0.56))
    if kind == "self-aligning":
        angle *= 0.4
        sphere = 0.5 * pitch / math.cos(angle) + 0.5 * ball
        return Bearing.self_aligning(n, ball, sphere, groove, angle, clearance)
    outer = ball * float(rng.uniform(0.505, 0.56))
    bearing = Bearing.from_drawing(n, ball, pitch, groove, outer, contact_angle=angle)
    bearing = dataclasses.replace(
        bearing,
        radial_clearance=clearance,
        load_deflection_factor=bearing.load_deflection_factor * decades(0.1, 10.0),
    )
    arrangement = kind if kind in ARRANGEMENTS else str(rng.choice(ARRANGEMENTS))
    preload = 0.0 if arrangement == "tandem" else float(rng.choice([0.0, decades(1e-7, 3e-5)]))
    pair = bearing.paired(pitch * float(rng.uniform(0.0, 2.0)), arrangement, preload)
    low, high = pair.rows
    if kind == OWN_ANGLES:
        own = [math.radians(float(rng.uniform(0.0, 60.0))) for _ in "12"]
        low = dataclasses.replace(low, contact_angle=own[0] if rng.random() < 0.5 else None)
        high = dataclasses.replace(high, contact_angle=own[1])
    if kind == UNLIKE:
        low, high = (_unlike(rng, row, bearing) for row in (low, high))
    high = dataclasses.replace(high, turn=float(rng.choice([0.0, 0.5 * pair.ball_spacing])))
    return pair.replace(rows=(low, high))


def _unlike(rng: np.random.Generator, row: Row, bearing: Bearing) -> Row:
    """A row with some numbers of its own, near those of the bearing, that fit each other."""
    assert bearing.inner_groove_radius is not None
    ball, pitch = (
        d * float(rng.uniform(0.8, 1.2)) for d in (bearing.ball_diameter, bearing.pitch_diameter)
    )
    own: dict[str, Any] = {"ball_diameter": ball, "pitch_diameter": pitch}
    most = math.floor(math.pi / math.asin(ball / pitch))
    if most < 2:
        return row
    own["n_balls"] = int(rng.integers(2, min(most, 2 * bearing.n_balls) + 1))
    if rng.random() < 0.5:
        own["contact_angle"] = math.radians(float(rng.uniform(0.0, 60.0)))
    if rng.random() < 0.5:
        own["inner_groove_radius"] = ball * float(rng.uniform(0.505, 0.56))
    return dataclasses.replace(row, **own)
