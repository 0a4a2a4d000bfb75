"""Scenes that figures draw as curves of their own, under a name, for comparison."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearing_explorer.state.field_values import defects_of
from bearingcore import Scene

MOST_COMPARED = 4
"""Greatest number of compared scenes: more colours are hard to distinguish."""
WITHOUT_DEFECT = "the bearing without its defect"
"""The scene that is drawn in grey."""


@dataclass(frozen=True)
class Compared:
    """A compared scene and the name of its curves."""

    scene: Scene
    name: str


def usual_name(scene: Scene, focus: int = 0) -> str:
    """A name by the size of the defect `focus`: "12.9°, 50 µm"."""
    if not scene.defects:
        return "no defect"
    defect = defects_of(scene)[focus]
    return f"{math.degrees(defect.extent):.4g}°, {defect.depth * 1e6:.4g} µm"
