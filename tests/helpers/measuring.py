"""A session's measurement for tests: without a browser, with a signal that is there already."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from bearing_explorer.measurement.session import Measurement, simulated
from bearing_explorer.measurement.signal import Measured
from bearing_explorer.state.scene_editor import SceneEditor

from bearingcore import presets


@cache
def signal() -> Measured:
    """A simulated signal of the fan rig, 20 dB above its noise."""
    return simulated(presets["fan-rig"], 20.0, False, 1)


def measuring(measured: Measured | None = None) -> Measurement:
    """A measurement that assigns at once and draws nothing."""

    async def assign(change: Callable[[], None]) -> None:
        change()

    made = Measurement(SceneEditor("fan-rig"), assign, lambda: None)
    made.measured = measured
    return made
