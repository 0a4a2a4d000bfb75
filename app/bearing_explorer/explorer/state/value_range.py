"""Ranges of values of a field, for maps and speed runs.

The input of a person is checked here; the results are in SI.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.explorer.state.field_values import (
    SHOWN_FIELDS,
    defects_of,
    number_of,
    read,
    shown_number,
    si_number,
)
from bearingcore import Scene
from bearingcore.fields import Field, Range

SWEEPABLE: Mapping[str, Field] = {field.key: field for field in SHOWN_FIELDS if field.part}
"""Fields that `Scene.replace` changes, by key."""


@dataclass(frozen=True)
class Sweep:
    """Evenly spaced values of one field, in its shown unit and with the sign it is read with."""

    field: Field
    values: NDArray[np.float64]

    @property
    def field_values(self) -> NDArray[np.float64]:
        """The values with the sign that the field has in the core."""
        return self.field.read_sign * self.values

    @property
    def in_si(self) -> tuple[str, NDArray[np.float64]]:
        """Name of the scene's field and its values [SI], for the core."""
        return self.field.full_name, np.array([si_number(self.field, v) for v in self.field_values])

    def every(self, stride: int) -> Sweep:
        """Every `stride`-th value with both ends; all values if the stride does not divide them."""
        count = self.values.size - 1
        if count % stride or count // stride < 2:
            return self
        return Sweep(self.field, self.values[::stride])


def sweep(name: str, first: str, last: str, count: int, limits: Mapping[str, Range]) -> Sweep:
    """`count` values between two typed ends; ValueError with a sentence for the page."""
    if name not in SWEEPABLE:
        raise ValueError("There is no such quantity.")
    field = SWEEPABLE[name]
    sign = field.read_sign
    ends = (text.strip() if sign > 0.0 else _negated(text.strip()) for text in (first, last))
    low, high = (sign * read(name, text, limits) for text in ends)
    if math.isnan(low) or math.isnan(high) or not low < high:
        raise ValueError(f"{field.read_label}: “to” must be greater than “from”.")
    if name == "shaft_speed_hz" and low == 0.0:
        raise ValueError("The shaft must turn: begin above 0 Hz.")
    if field.whole:
        step = max(1, math.ceil((high - low) / (count - 1)))
        values = np.arange(math.ceil(low), high + 0.5, step)
        if values.size < 2:
            raise ValueError(f"{field.read_label}: two whole numbers at least.")
        return Sweep(field, values)
    return Sweep(field, np.linspace(low, high, count))


def _negated(text: str) -> str:
    """The text of a number with the other sign."""
    return text[1:] if text[:1] in ("-", "−") else text and f"-{text.removeprefix('+')}"


def usual_range(name: str, limits: Mapping[str, Range]) -> tuple[float, float]:
    """Usual ends of a sweep: the field's `sweep_range` if it is within those of the slider."""
    low, high = limits[name].least, limits[name].most
    field = SWEEPABLE[name]
    first, last = field.sweep_range or (low, high)
    first, last = (first, last) if low <= first and last <= high else (low, high)
    return (first, last) if field.read_sign > 0.0 else (-last, -first)


def focus_first(scene: Scene, selected: int) -> Scene:
    """Move the `selected` defect of a scene to the front, because sweeps change the first."""
    defects = list(defects_of(scene))
    if len(defects) == 1:
        return scene
    first = defects.pop(min(selected, len(defects) - 1))
    return scene.replace(defect=(first, *defects))


def value_of(scene: Scene, field: Field) -> float:
    """The number of a field as the page reads it; of a defect, that of the first."""
    return field.read_sign * shown_number(field, number_of(scene, field))


def differ_only_in(scene: Scene, other: Scene, sweeps: tuple[Sweep, ...]) -> bool:
    """True if two scenes differ at most in the quantities of `sweeps`."""
    first = {field: float(values[0]) for field, values in (s.in_si for s in sweeps)}
    try:
        return scene.replace(**first) == other.replace(**first)
    except ValueError:
        return False
