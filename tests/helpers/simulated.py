"""Defects as machines have them, for simulated measurements."""

import dataclasses
import math

from bearingcore.model.scene import Defect, Scene


def pit(scene: Scene, length: float) -> Defect:
    """A pit of the outer race under the load, `length` [m] along it, so deep that none is met."""
    bearing, load = scene.bearing, scene.load
    depth = min(0.25 * length, 0.5 * bearing.ball_radius)
    made = Defect(0.0, depth, math.atan2(load.fy, load.fx), "outer", "exact")
    return dataclasses.replace(made, extent=length / made.raceway_radius(bearing))
