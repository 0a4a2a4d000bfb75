"""The figure of a view for a recording, outside of the page."""

from __future__ import annotations

import dataclasses
from typing import Any

from bearing_explorer.diagnosis.machine import BY_FREQUENCIES, GIVEN, scene_machine
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.session import measurement_of
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.views.still_figure import Figure
from bearingcore import Recording, Scene
from bearingcore.common import choice

BEARINGS = (GIVEN, BY_FREQUENCIES, "unknown")
"""Possible knowledge of the bearing of a recording."""


def figure_of(
    kind: type[View[Model]],
    scene: Scene,
    *,
    recording: Recording | None = None,
    in_si: bool = True,
    speed: str | float = GIVEN,
    bearing: str = GIVEN,
    cage_angle: float = 0.0,
    focus: int = 0,
    **more: Any,
) -> Figure[Model]:
    """The figure of a view for a recording, with the scene as its model.

    Parameters
    ----------
    recording
        the signal that was measured, on the bearing and at the speed of the scene.
    in_si
        True if its numbers are in m/s².
    speed
        knowledge of the shaft speed: "given" (that of the scene), "rough" (good to 10 %),
        "unknown", or another one [rad/s].
    bearing
        knowledge of the bearing: "given" (that of the scene), "frequencies" (the scene has the
        frequencies of its parts alone), or "unknown".
    cage_angle, focus
        of the scene's figures; those of a signal do not depend on them.
    more
        further parameters of `Figure`.
    """
    del cage_angle, focus
    machine = scene_machine(scene, GIVEN).replace_speed(speed)
    if choice("bearing", bearing, BEARINGS) == "unknown":
        machine = dataclasses.replace(machine, bearing=None)
    machine = dataclasses.replace(machine, by_frequencies=bearing == BY_FREQUENCIES)

    def prepare(view: View[Model]) -> None:
        if recording is not None:
            bare = dataclasses.replace(recording, shaft_speed=None)
            measured = Measured(bare, machine, in_si=in_si)
            view.measure(measurement_of(measured, scene))  # type: ignore[attr-defined]

    return Figure(kind, Model(scene), prepare=prepare, **more)
