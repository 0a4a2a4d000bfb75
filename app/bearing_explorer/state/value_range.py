"""Values that a quantity of the page runs through, for maps and speed runs.

What a person asked for is judged here; behind it all is SI.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.state.quantities import Limits, defects_of, in_si, read, values_of
from bearing_explorer.state.quantity_list import QUANTITY_LIST, Quantity
from bearingcore import Scene

SWEEPABLE: Mapping[str, Quantity] = {
    quantity.name: quantity for quantity in QUANTITY_LIST if quantity.of == "scene"
}
"""Quantities that belong to the scene, by name."""

_WHOLE = frozenset({"n_balls"})
#: where a shorter range shows more than all that its slider can do
_USUAL = {"shaft_speed_hz": (4.0, 60.0), "extent_deg": (2.0, 62.0)}


@dataclass(frozen=True)
class Sweep:
    """Evenly spaced values of one quantity, in its own unit."""

    quantity: Quantity
    values: NDArray[np.float64]

    @property
    def in_si(self) -> tuple[str, NDArray[np.float64]]:
        """The field of the scene and its values [SI], as the core takes them."""
        return self.quantity.field, np.array([in_si(self.quantity, v) for v in self.values])

    def every(self, stride: int) -> Sweep:
        """The same with every `stride`-th value, first and last among them, where that is even."""
        count = self.values.size - 1
        if count % stride or count // stride < 2:
            return self
        return Sweep(self.quantity, self.values[::stride])


def sweep(name: str, first: str, last: str, count: int, limits: Mapping[str, Limits]) -> Sweep:
    """`count` values from `first` to `last` as a person typed them; ValueError with a sentence."""
    if name not in SWEEPABLE:
        raise ValueError("There is no such quantity.")
    quantity = SWEEPABLE[name]
    low, high = (read(name, text, limits) for text in (first, last))
    if math.isnan(low) or math.isnan(high) or not low < high:
        raise ValueError(f"{quantity.label}: “to” must be greater than “from”.")
    if name == "shaft_speed_hz" and low == 0.0:
        raise ValueError("The shaft must turn: begin above 0 Hz.")
    if name in _WHOLE:
        step = max(1, math.ceil((high - low) / (count - 1)))
        values = np.arange(math.ceil(low), high + 0.5, step)
        if values.size < 2:
            raise ValueError(f"{quantity.label}: two whole numbers at least.")
        return Sweep(quantity, values)
    return Sweep(quantity, np.linspace(low, high, count))


def usual_range(name: str, limits: Mapping[str, Limits]) -> tuple[float, float]:
    """Where a sweep goes if nobody says otherwise: as far as the slider, or where it shows most."""
    low, high = limits[name].least, limits[name].most
    if name in _USUAL:
        first, last = _USUAL[name]
        if low <= first and last <= high:
            return first, last
    return low, high


def focused(scene: Scene, selected: int) -> Scene:
    """`scene` with the `selected` one of its defects first: sweeps change the first."""
    defects = list(defects_of(scene))
    if len(defects) == 1:
        return scene
    first = defects.pop(min(selected, len(defects) - 1))
    return scene.replace(defect=(first, *defects))


def value_of(scene: Scene, quantity: Quantity) -> float:
    """The number of a quantity in its own unit, of the first defect where it is one's."""
    return values_of(scene)[quantity.name]


def alike_but_for(scene: Scene, other: Scene, sweeps: tuple[Sweep, ...]) -> bool:
    """Whether two scenes differ at most in the quantities of `sweeps`."""
    first = {field: float(values[0]) for field, values in (s.in_si for s in sweeps)}
    try:
        return scene.replace(**first) == other.replace(**first)
    except ValueError:
        return False
