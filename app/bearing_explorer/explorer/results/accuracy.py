"""Speed against accuracy: measurements that come with a preset, and those on this machine."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cache

from bearing_explorer.kit.assets import asset_path
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.sentences import words_of
from bearingcore import Scene, presets
from bearingcore.model.experiments import (
    MEASURED,
    ORBITS,
    STABILITY,
    Measurements,
    measure,
    measurements_from,
)

SUBJECTS = {"motion": "Motion", "statics": "Statics", STABILITY: "Stability"}
"""Labels of the experiments, by name."""


@dataclass(frozen=True)
class SceneMeasurements:
    """Measurements on this machine, with their scene."""

    scene: Scene
    result: Measurements


@cache
def shipped(preset: str) -> Measurements:
    """The measurements that come with the program for a preset."""
    return measurements_from(asset_path(f"accuracy/{preset}.json").read_text(encoding="utf-8"))


def preset_like(scene: Scene) -> str:
    """The preset that equals `scene`, else one with its bearing, else the fan rig."""
    same = [name for name, preset in presets.items() if preset == scene]
    alike = [name for name, preset in presets.items() if preset.bearing == scene.bearing]
    return (*same, *alike, "fan-rig")[0]


def compute(job: Work, scene: Scene, name: str) -> str:
    """Measure an experiment on a scene and show each point; return a sentence for the job."""
    names = (STABILITY, ORBITS) if name == STABILITY else (name,)
    if not set(names) <= set(MEASURED):
        raise ValueError("There is no such experiment.")
    started = time.perf_counter()
    results = measure(
        scene,
        names,
        slow=False,
        progress=job.progress,
        cancelled=job.cancelled,
        shown=lambda part: job.show(SceneMeasurements(scene, part)),
        words=words_of,
    )
    if not results.count:
        if results.refused:
            raise ValueError(f"Not for this scene: {'; '.join(results.refused.values())}.")
        return "Nothing was measured yet."
    return f"{results.count} points after {time.perf_counter() - started:.1f} s."
