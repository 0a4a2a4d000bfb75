"""A session's measurement for tests: without a browser, with a signal that is there already."""

from collections.abc import Callable
from functools import cache

from bearing_explorer.diagnosis.machine import GIVEN, Machine, scene_machine
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.simulated import simulated
from bearing_explorer.kit.compute.jobs import Jobs

from bearingcore import Scene, presets


@cache
def signal() -> Measured:
    """A simulated signal of the fan rig, 20 dB above its noise."""
    return simulated(presets["fan-rig"], 20.0, 1)


def at(scene: Scene, shaft_speed: float | None = None) -> Machine:
    """A machine that a person gave: the bearing of a scene, at its speed or another [rad/s]."""
    machine = scene_machine(scene, GIVEN)
    return machine if shaft_speed is None else machine.replace_speed(shaft_speed)


def measuring(
    measured: Measured | None = None, scene: Callable[[], Scene] = lambda: presets["fan-rig"]
) -> Measurement:
    """A measurement that assigns at once and draws nothing."""

    async def assign(change: Callable[[], None]) -> None:
        change()

    made = Measurement(scene, Jobs(assign), lambda: None)
    made.measured = measured
    return made
