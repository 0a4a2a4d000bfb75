"""Where in the plane of two quantities the periodic steady state holds."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks
from bearingcore.common.progress import Cancelled, Progress, in_turn
from bearingcore.common.table import ResultTable, shown_as_table, table_of
from bearingcore.dynamics.motion import (
    MOST_STEPS,
    MOST_STEPS_IN_ALL,
    too_many_in_all,
)
from bearingcore.dynamics.orbit import (
    Orbit,
    least_steps,
    orbit,
)
from bearingcore.dynamics.status import MapOutcome, OrbitStatus
from bearingcore.scene.scene import Scene

OUTCOMES = tuple(MapOutcome)
"""Meaning of the codes of `StabilityMap.outcome`."""


@shown_as_table
@dataclass(frozen=True)
class StabilityMap:
    """Largest Floquet multiplier over two fields of a scene.

    Attributes
    ----------
    scene
        the scene whose fields vary.
    x_field, y_field
        their names, as `Scene.replace` takes them.
    x (nx,), y (ny,)
        their values, in the fields' own units.
    multiplier : (ny, nx)
        |μ| of the orbit over one ball pass; NaN where there is none.
    outcome : (ny, nx)
        indices into OUTCOMES.
    through : (ny, nx)
        "", "+1", "-1" or "pair": how an unstable orbit leaves.
    completed
        False where it was cancelled; what was not computed says so.
    refusals
        why there is no such scene, by (row, column) of the points that are refused.
    cost
        what the map would have taken, where that was too much to begin; else empty.
    """

    scene: Scene
    x_field: str
    y_field: str
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    multiplier: NDArray[np.float64]
    outcome: NDArray[np.int8]
    through: NDArray[np.str_]
    completed: bool
    refusals: dict[tuple[int, int], ValueError] = field(default_factory=dict)
    cost: str = ""

    def table(self) -> ResultTable:
        """A row a point: both fields, size of the largest multiplier, outcome in words."""
        y, x = np.meshgrid(self.y, self.x, indexing="ij")
        return table_of(
            (self.x_field, "", x, "in the field's own unit"),
            (self.y_field, "", y, "in the field's own unit"),
            ("largest_multiplier", "1", self.multiplier),
            ("outcome", "", np.array(OUTCOMES)[self.outcome]),
            ("through", "", self.through),
        )

    def count(self, outcome: str) -> int:
        """Number of points that ended in one of OUTCOMES."""
        return int(np.sum(self.outcome == OUTCOMES.index(outcome)))


def stability_map(
    scene: Scene,
    x: tuple[str, ArrayLike],
    y: tuple[str, ArrayLike],
    *,
    ball_passes: int | None = None,
    most_steps: int = MOST_STEPS,
    most_steps_in_all: int = MOST_STEPS_IN_ALL,
    progress: Progress | None = None,
    cancelled: Cancelled | None = None,
) -> StabilityMap:
    """Orbits over a grid of two fields, each begun from its neighbour.

    Parameters
    ----------
    scene
        what stays the same.
    x, y
        name of a field as `Scene.replace` takes it, and its values, 2 to 1000 each.
    ball_passes
        period to look for, in ball passes; None takes the shortest.
    most_steps
        steps of integration that may be taken for one point, as in `orbit`.
    most_steps_in_all
        steps of all points. Two periods of each, which is the least, are counted before the first,
        by what its corners take: where that is more nothing is begun, and `cost` says how many.
        Where they are used up, the points that are left say so.
    progress, cancelled
        the first called before each row, the second before each point too.

    Raises
    ------
    ValueError
        for unknown fields, first or last values that the scene refuses, two fields of one name, or
        where every point is refused. A point that is refused among others is an outcome.
    """
    x_field, x_values = _axis(scene, x)
    y_field, y_values = _axis(scene, y)
    if x_field == y_field:
        raise checks.refuse("the fields of a map", x_field, "two different names")
    shape = (y_values.size, x_values.size)
    multiplier = np.full(shape, math.nan)
    outcome = np.full(shape, OUTCOMES.index(MapOutcome.NOT_COMPUTED), dtype=np.int8)
    through = np.full(shape, "", dtype="<U4")
    refusals: dict[tuple[int, int], ValueError] = {}
    steps = _least_of_all(scene, (x_field, x_values), (y_field, y_values), ball_passes)
    cost = too_many_in_all(steps, f"at {multiplier.size} points", most_steps_in_all)
    if cost:
        outcome[:] = OUTCOMES.index(MapOutcome.TOO_MANY_STEPS)
        return StabilityMap(
            scene, x_field, y_field, x_values, y_values, multiplier, outcome, through, False,
            cost=cost,
        )  # fmt: skip
    left = most_steps_in_all
    above: Orbit | None = None
    stopped = False
    rows = list(range(y_values.size))
    done = 0
    for j in in_turn(rows, lambda j: f"{y_field} = {y_values[j]:g}", progress, cancelled):
        nearby = above
        above = None
        for i, value in enumerate(x_values):
            if cancelled is not None and cancelled():
                stopped = True
                break
            done += 1
            if left < 1:
                outcome[j, i] = OUTCOMES.index(MapOutcome.TOO_MANY_STEPS)
                continue
            try:
                at = scene.replace(**{x_field: float(value), y_field: float(y_values[j])})
                found = orbit(
                    at, start=nearby, ball_passes=ball_passes, most_steps=min(most_steps, left)
                )
            except ValueError as error:
                outcome[j, i] = OUTCOMES.index(MapOutcome.REFUSED)
                refusals[j, i] = error
                continue
            left -= found.right_hand_side_calls // 4
            multiplier[j, i] = found.largest_multiplier
            outcome[j, i] = OUTCOMES.index(MapOutcome(found.status))
            through[j, i] = found.through
            nearby = found if found.status in (OrbitStatus.STABLE, OrbitStatus.UNSTABLE) else None
            above = above or nearby
    if len(refusals) == multiplier.size:
        raise refusals[0, 0]
    completed = not stopped and done == multiplier.size
    return StabilityMap(
        scene, x_field, y_field, x_values, y_values, multiplier, outcome, through, completed,
        refusals,
    )  # fmt: skip


def _least_of_all(
    scene: Scene,
    x: tuple[str, NDArray[np.float64]],
    y: tuple[str, NDArray[np.float64]],
    ball_passes: int | None,
) -> float:
    """Steps that all points take at least, by the mean of those corners that are scenes."""
    found = []
    for x_value, y_value in itertools.product(x[1][[0, -1]], y[1][[0, -1]]):
        try:
            at = scene.replace(**{x[0]: float(x_value), y[0]: float(y_value)})
            found.append(least_steps(at, ball_passes))
        except ValueError:  # said where the point is tried
            continue
    return float(np.mean(found)) * x[1].size * y[1].size if found else 0.0


def _axis(scene: Scene, axis: tuple[str, ArrayLike]) -> tuple[str, NDArray[np.float64]]:
    """A field's name and values, each tried on the scene."""
    name, given = axis
    values = np.asarray(given, dtype=float).ravel()
    if not 2 <= values.size <= 1000:
        raise checks.refuse(f"number of values of {name}", int(values.size), "2 to 1000")
    for value in (values[0], values[-1]):
        scene.replace(**{name: float(value)})
    return name, values


def regions(found: StabilityMap) -> Sequence[str]:
    """In sentences, what the map shows: how much of it is stable, and how the rest loses it."""
    size = found.multiplier.size
    sentences = [f"{found.count(MapOutcome.STABLE)} of {size} points have a stable orbit."]
    for how, words in (
        ("-1", "lose it by doubling their period: lines appear at half the ball-pass frequency"),
        ("pair", "lose it to a second frequency: every line gets sidebands"),
        ("+1", "lose it to another orbit"),
    ):
        n = int(np.sum(found.through == how))
        if n:
            sentences.append(f"{n} {words}.")
    lost = found.count(MapOutcome.NOT_CONVERGED)
    if lost:
        sentences.append(
            f"At {lost} shooting finds no orbit; there the motion must be integrated in time."
        )
    long = found.count(MapOutcome.TOO_MANY_STEPS)
    if long:
        sentences.append(f"At {long} the search would take more steps than allowed.")
    refused = found.count(MapOutcome.REFUSED)
    if refused:
        reasons = sorted({str(error) for error in found.refusals.values()})
        verb = "is" if refused == 1 else "are"
        sentences.append(f"{refused} {verb} refused, as there is no such scene: {reasons[0]}.")
    return sentences
