"""References: named scenes that are drawn beside the scene on screen."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearing_explorer.explorer.state.field_values import defects_of
from bearingcore import Scene
from bearingcore.common import with_prefix
from bearingcore.model.scene import MASSLESS, WITH_MASS


@dataclass(frozen=True)
class Reference:
    """A named scene that is drawn beside the scene on screen.

    Parameters
    ----------
    scene
        scene that is drawn.
    name
        name of its curves on the page.
    label
        words before its numbers in sentences: "without the defect".
    bearing
        name of its bearing, where that is known.
    """

    scene: Scene
    name: str
    label: str = ""
    bearing: str = ""


BEFORE = "the scene before the last change"
"""Name of the reference with that scene."""

MOST_COMPARED = 4
"""Greatest number of compared scenes: more colours are hard to distinguish."""
WITHOUT_DEFECT = "the bearing without its defect"
"""Name of the scene that is usually drawn in grey."""
HEALTHY, OTHER_BALLS = "healthy", "other-balls"
"""Kinds of the scene that is drawn in grey."""


def healthy_reference(scene: Scene) -> Reference:
    """The bearing without its defect; without a label if the scene has no defect."""
    label = "without the defect" if scene.defects else ""
    return Reference(scene.healthy(), WITHOUT_DEFECT, label)


def other_balls_reference(scene: Scene) -> Reference:
    """The same scene with the mass of its balls; if it has that, with massless balls.

    ValueError if the model does not know the mass of the bearing's elements.
    """
    if kind := scene.bearing.kind.mass_unknown:
        raise ValueError(f"the model has no mass of {kind}")
    if scene.balls == WITH_MASS:
        return massless_reference(scene)
    return Reference(
        scene.replace(balls=WITH_MASS), "the same with the mass of its balls", "with mass"
    )


def massless_reference(scene: Scene) -> Reference:
    """The same scene with massless balls; maps use it too."""
    return Reference(scene.replace(balls=MASSLESS), "the same with massless balls", "massless")


def grey_reference(scene: Scene, kind: str) -> Reference:
    """The scene that is drawn in grey; `kind` is HEALTHY or OTHER_BALLS."""
    return other_balls_reference(scene) if kind == OTHER_BALLS else healthy_reference(scene)


def scene_line(bearing: str, scene: Scene) -> str:
    """A scene in a line: "Fan rig: defect 12.9°, 50 µm; load 100 N at 270°; shaft 7 Hz"."""
    defects = [f"defect {usual_name(scene, focus)}" for focus in range(len(scene.defects))]
    load = scene.load
    radial = with_prefix(math.hypot(load.fx, load.fy), "N")
    parts = [
        *(defects or ["no defect"]),
        f"load {radial} at {round(math.degrees(math.atan2(load.fy, load.fx)), 1) % 360.0:.4g}°",
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
