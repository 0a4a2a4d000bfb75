"""Speed against accuracy: the measurements that are shipped, and of which preset they are shown."""

from __future__ import annotations

from functools import cache

from bearing_explorer.kit.assets import asset_path
from bearingcore import Scene, presets
from bearingcore.experiments import Measurements, measurements_from


@cache
def shipped(preset: str) -> Measurements:
    """The measurements that come with the program for a preset."""
    return measurements_from(asset_path(f"accuracy/{preset}.json").read_text(encoding="utf-8"))


def preset_like(scene: Scene) -> str:
    """The preset that is `scene`, or has its bearing, or else the fan rig."""
    same = [name for name, preset in presets.items() if preset == scene]
    alike = [name for name, preset in presets.items() if preset.bearing == scene.bearing]
    return (*same, *alike, "fan-rig")[0]
