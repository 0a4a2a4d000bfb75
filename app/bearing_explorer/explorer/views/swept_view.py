"""Views of results over the values of some fields: computed coarsely first, then finer."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.value_range import Sweep, alike_but_for, focused
from bearing_explorer.explorer.views.scene_job_view import SceneJobView
from bearing_explorer.kit.compute.jobs import Work
from bearingcore import Scene
from bearingcore.common import Progress

FAINT = 0.35
"""Opacity of a result of another scene."""


@dataclass(frozen=True)
class Swept:
    """A result of the core, of its scene but for the fields that `sweeps` run through."""

    result: Any
    sweeps: tuple[Sweep, ...]


def compute_in_levels(
    job: Work,
    levels: Sequence[tuple[Sweep, ...]],
    compute: Callable[[tuple[Sweep, ...], Progress], Any],
    noun: str,
) -> str:
    """Compute one level after another, the coarsest first, and show each. In a job's thread.

    The results of `compute` have a `cost`, a sentence where they would take too long, and say
    whether they are `completed`. `noun` is what their values are, in the returned sentence.

    Raises
    ------
    ValueError
        where the first level cannot be computed.
    """
    started = time.perf_counter()
    sizes = [math.prod(sweep.values.size for sweep in level) for level in levels]
    done = 0
    shown = "Nothing is shown yet."
    for level, size in zip(levels, sizes, strict=True):
        within = job.within(done / sum(sizes), (done + size) / sum(sizes))
        found = compute(level, within)
        if found.cost and not done:
            raise ValueError(found.cost)
        if found.cost:
            return f"{shown} Finer was not begun, {found.cost}."
        if found.completed or not done:
            job.show(Swept(found, level))
            counts = " × ".join(str(sweep.values.size) for sweep in level)
            shown = f"{counts} {noun} after {time.perf_counter() - started:.1f} s."
        if not found.completed:
            break
        done += size
    return shown


class SweptView(SceneJobView[Swept]):
    """A view of such a result; it is faint where it is that of another scene."""

    noun = "map"

    def scene_of(self, results: Results) -> Scene:
        """The scene on screen as the computation takes it."""
        return focused(results.scene, results.focus)

    def opacity(self, results: Results, found: Swept) -> float:
        """Opacity of the result: full where it is of the scene on screen."""
        own = alike_but_for(self.scene_of(results), found.result.scene, found.sweeps)
        return 1.0 if own else FAINT

    def words_of(self, results: Results, found: Swept) -> str:
        """The sentence on a result of the scene on screen."""
        raise NotImplementedError

    def sentence(self, results: Results) -> str:
        if self.found is None:
            return self.words_of_nothing
        words = self.words_of(results, self.found)
        if self.opacity(results, self.found) < 1.0:
            return f"Faint, as the scene has changed since this was computed. Then: {words}"
        return words
