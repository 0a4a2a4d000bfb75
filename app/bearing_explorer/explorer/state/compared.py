"""Scenes that figures draw as curves of their own, under a name, for comparison."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearing_explorer.explorer.state.field_values import defects_of
from bearingcore import Scene
from bearingcore.common.numbers import with_prefix

MOST_COMPARED = 4
"""Greatest number of compared scenes: more colours are hard to distinguish."""
WITHOUT_DEFECT = "the bearing without its defect"
"""The scene that is drawn in grey."""


@dataclass(frozen=True)
class Compared:
    """A compared scene and the name of its curves."""

    scene: Scene
    name: str


def scene_line(bearing: str, scene: Scene) -> str:
    """The scene in a line: "Fan rig: defect 12.9°, 50 µm; load 100 N at 270°; shaft 7 Hz"."""
    defects = [f"defect {usual_name(scene, focus)}" for focus in range(len(scene.defects))]
    load = scene.load
    radial = with_prefix(math.hypot(load.fx, load.fy), "N")
    parts = [
        *(defects or ["no defect"]),
        f"load {radial} at {math.degrees(math.atan2(load.fy, load.fx)) % 360.0:.4g}°",
        *([f"axial {with_prefix(load.fz, 'N')}"] if load.fz else []),
        f"shaft {scene.shaft_speed / (2.0 * math.pi):.4g} Hz",
    ]
    return f"{bearing}: {'; '.join(parts)}"


def usual_name(scene: Scene, focus: int = 0) -> str:
    """A name by the size of the defect `focus`: "12.9°, 50 µm"."""
    if not scene.defects:
        return "no defect"
    defect = defects_of(scene)[focus]
    return f"{math.degrees(defect.extent):.4g}°, {defect.depth * 1e6:.4g} µm"
