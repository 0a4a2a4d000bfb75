"""Small pits, as test rigs are given on purpose."""

from __future__ import annotations

import dataclasses
import math

from bearingcore.common import checks
from bearingcore.scene.defect import Defect
from bearingcore.scene.scene import Scene


def pit(scene: Scene, length: float, race: str = "outer", depth: float | None = None) -> Defect:
    """A small pit of a race, in the middle of the load zone, with the edges that geometry requires.

    Parameters
    ----------
    scene
        whose bearing and load it is for.
    length
        along the race [m]; seeded pits of test rigs are 0.2 to 0.5 mm.
    race
        "outer" or "inner".
    depth
        [m]; None: deep enough that no ball reaches the floor, as far as a ball goes.

    Raises
    ------
    ValueError
        for a length that is not above 0, or a depth that the ball does not roll over.
    """
    length = checks.real_number("length", length, above=0.0, unit="m")
    bearing = scene.bearing
    if depth is None:
        depth = min(0.25 * length, 0.5 * bearing.ball_radius)
    center = math.atan2(scene.load.fy, scene.load.fx) if scene.load.vector[:2].any() else 0.0
    made = Defect(0.0, depth, center, race, "exact")
    extent = min(length / made.raceway_radius(bearing), 2.0 * math.pi)
    return dataclasses.replace(made, extent=extent)
