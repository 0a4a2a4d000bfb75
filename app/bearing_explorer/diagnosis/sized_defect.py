"""The length of a spall by simulation: the machine that is simulated, and the answer."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from bearing_explorer.diagnosis.signal import Measured
from bearingcore import MeasuredExtent, Scene, Sizing

BY_FREQUENCIES = (
    "The bearing is known by its frequencies alone, so its stiffness is not: name the bearing in "
    "step 2."
)
WITHOUT_UNIT = "The unit of the signal is not known: say it in step 1."
WITHOUT_DEFECT = (
    "The scene has no defect: give it one on the outer race, because its place, depth and edges "
    "are needed."
)
CLEAR_RATIO = 1.5
"""Ratio of two misfits from which the length with the smaller one is likelier."""


@dataclass(frozen=True, eq=False)
class SizedDefect:
    """The choice between lengths of a spall, and what was compared.

    Attributes
    ----------
    sizing
        the answer.
    measured
        the signal.
    machine
        the scene that was simulated with each length.
    scene
        the scene of the controls when it was asked for.
    """

    sizing: Sizing
    measured: Measured
    machine: Scene
    scene: Scene

    def is_of(self, measured: Measured, scene: Scene) -> bool:
        """True for the signal that was compared, on the machine that was simulated.

        A simulated signal keeps its machine. The machine of a file is the scene of the controls,
        where the length of the defect does not count.
        """
        if measured is not self.measured:
            return False
        before, now = (
            other.replace(extent=1.0) if len(other.defects) == 1 else other
            for other in (self.scene, scene)
        )
        return measured.true_scene is not None or before == now


def machine_of(measured: Measured, scene: Scene, race: str, shaft_speed: float | None) -> Scene:
    """The machine of a signal: its bearing, speed and damaged race; all else is from a scene.

    Parameters
    ----------
    scene
        with the load and the support of the machine; a simulated signal has its own.
    race
        damaged race; empty where it is not known, for the race of the scene.
    shaft_speed
        [rad/s] that is given or that the diagnosis shows; None for the speed of the scene.

    Raises
    ------
    ValueError
        with a sentence, where the machine is not known well enough.
    """
    if measured.machine.by_frequencies:
        raise ValueError(BY_FREQUENCIES)
    if not measured.in_si:
        raise ValueError(WITHOUT_UNIT)
    machine = measured.scene(measured.true_scene or scene)
    if not machine.defects:
        raise ValueError(WITHOUT_DEFECT)
    changes: dict[str, Any] = {} if shaft_speed is None else {"shaft_speed": shaft_speed}
    if race and len(machine.defects) == 1:
        changes["race"] = race
    return machine.replace(**changes)


def size_in_words(sizing: Sizing) -> str:
    """The length with its interval: "38.6° (38.5 to 38.8°), 17 mm"; empty where it is open."""
    best = sizing.best
    if best is None or not sizing.conclusive:
        return ""
    low, extent, high = (math.degrees(end) for end in (best.low, best.extent, best.high))
    length = 1e3 * best.extent * best.scene.bearing.outer_raceway_radius
    return f"{extent:.1f}° ({low:.1f} to {high:.1f}°), {length:.1f} mm"


def nearest_way_round(length: float, extent: MeasuredExtent) -> int | None:
    """Index of the alternative of entry and exit that a length [rad] fits; None without just one.

    An alternative stands for itself and the lengths that are whole ball spacings longer.
    """
    spacing = extent.ball_spacing
    fitting = [
        number
        for number, (middle, low, high) in enumerate(extent.alternatives)
        if low <= length - spacing * max(round((length - middle) / spacing), 0) <= high
    ]
    return fitting[0] if len(fitting) == 1 else None


def likelier(sizing: Sizing, extent: MeasuredExtent) -> str:
    """A sentence on which of the two lengths of entry and exit is the likelier, and why.

    Empty where entry and exit leave no choice; both stay possible where the sizing is open.
    """
    if not extent.alternatives or extent.measured:
        return ""
    first, second = (f"{math.degrees(length):.0f}°" for length, _, _ in extent.alternatives)
    ways = np.array([nearest_way_round(length, extent) for length in sizing.extents.tolist()])
    least, other = (sizing.misfits[ways == way].min(initial=math.inf) for way in (0, 1))
    if not math.isfinite(least + other):
        return (
            f"Entry and exit alone do not say whether {first} or {second} is likelier: either "
            "impact can be the sharper one."
        )
    if other < least:
        first, second, least, other = second, first, other, least
    if other < CLEAR_RATIO * least:
        return f"{first} and {second} explain the signal about equally well."
    return (
        f"Of {first} and {second}, each also with whole ball spacings more, {first} is likelier: "
        f"its misfit is {least:.2f}, that of the other {other:.2f}."
    )
