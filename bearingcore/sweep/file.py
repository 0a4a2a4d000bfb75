"""The file of a sweep: a scene's TOML with a table that says what varies; not trusted.

::

    ... the scene, as `bearingcore.common.scene_file` has it ...

    [sweep]
    outputs = ["k_yy_mean", "loaded_balls_*", "band_*"]
    cage_angles = 121             # these three may be left out
    duration = 1.4
    sample_rate = 65536.0

    [sweep.over]                  # the dimensions, in SI units
    extent = {start = 0.0, stop = 1.5, num = 91}
    fy = [-50.0, -100.0, -200.0]
    edge = ["published", "exact"]
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

from bearingcore.common import checks, scene_file
from bearingcore.scene.scene import Scene
from bearingcore.sweep.grid import MOST_AXES, MOST_VALUES, Grid
from bearingcore.sweep.outputs import Settings

_RANGE = ("start", "stop", "num")
_SETTINGS = tuple(field.name for field in dataclasses.fields(Settings))
_FIELDS = ("outputs", "over", *_SETTINGS)


def grid_from_toml(text: str) -> Grid:
    """The sweep that a text describes.

    Raises
    ------
    ValueError
        that names the table and field, what stands there and what is allowed.
    """
    data = scene_file.from_toml(text)
    asked = scene_file.table("sweep", data.pop("sweep", None))
    scene = Scene.from_data(data)
    for name in asked:
        if name not in _FIELDS:
            raise checks.refuse("field of sweep", scene_file.short(name), ", ".join(_FIELDS))
    outputs = asked.get("outputs")
    if not isinstance(outputs, list) or not all(isinstance(name, str) for name in outputs):
        raise checks.refuse("outputs of sweep", scene_file.short(outputs), "a list of names")
    if len(outputs) > 1000:
        raise checks.refuse("number of outputs of sweep", len(outputs), "at most 1000")
    over = scene_file.table("over of sweep", asked.get("over"))
    if len(over) > MOST_AXES:
        raise checks.refuse("number of fields in over", len(over), f"at most {MOST_AXES}")
    values = {name: _values(name, given) for name, given in over.items()}
    settings = {name: _number(name, asked[name]) for name in _SETTINGS if name in asked}
    return Grid.of(scene, values, outputs, Settings(**settings))


def _values(name: str, given: Any) -> list[Any]:
    """A list as it stands, or the values of a range, both ends included."""
    if isinstance(given, list):
        return given
    span = scene_file.table(
        f"{scene_file.short(name)} in over", given, "a list, or {start, stop, num}"
    )
    if set(span) != set(_RANGE):
        raise checks.refuse(
            f"fields of {scene_file.short(name)} in over",
            sorted(span),
            ", ".join(_RANGE) + ", all three",
        )
    num = checks.whole_number(f"num of {name}", span["num"], at_least=1, at_most=MOST_VALUES)
    start, stop = (
        checks.real_number(f"{end} of {name}", _number(f"{end} of {name}", span[end]))
        for end in ("start", "stop")
    )
    if not math.isfinite(stop - start):
        raise checks.refuse(f"stop of {name}", stop, "a range that is finite")
    return np.linspace(start, stop, num).tolist()


def _number(name: str, value: Any) -> Any:
    """`value` if TOML has it as a number: text that reads like one is not."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise checks.refuse(name, scene_file.short(value), "a number")
    return value
