"""Defects that could have given a signal: simulated over all extents, the best ones refined.

The scene is taken as given, but for its edges: those most unlike the given ones are tried too.
"""

from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from bearingcore.common.arrays import Array
from bearingcore.common.lazy import cached_property
from bearingcore.diagnosis.size.matching import (
    SPECTRUM_FLOOR,
    SPECTRUM_WEIGHT,
    WAVEFORM_WEIGHT,
    Match,
    Target,
)
from bearingcore.diagnosis.size.synthesis import Begin, Simulator, steps_of
from bearingcore.scene.defect import EDGES
from bearingcore.scene.scene import Scene

LEAST_EXTENT = math.radians(0.2)
GREATEST_EXTENT = math.radians(110.0)
"""Extents [rad] that are looked for."""

EXTENT_STEP = math.radians(0.5)
"""[rad] between simulated extents."""

PITS = np.radians([0.2, 0.28, 0.4, 0.55, 0.75])
"""[rad] Shorter ones than two steps, which are simulated too."""

PARTS = 16
"""In which the library is simulated, side by side."""

ROUGH_STEPS_A_CYCLE = 7.7
"""Steps in a cycle of the highest natural frequency in the library: they move a few thousandths of
a pass's power, and what it is compared with is never nearer than a twentieth."""

CLOSED_ROUGHLY, CLOSED = 0.05, 0.005
"""Differences between passes, as a share of them, from which a motion has settled: in the library,
and of what is refined."""

STARTS = 10
STARTS_APART = math.radians(0.8)
"""Number of extents that are refined, and their least distance [rad]."""

FURTHER = (4, 4, 2, 2, 2, 2)
"""Number of them refined further in each round; the last only while they gain by it."""

HOPPING = (4, 2)
"""Number of the best whose neighbouring extents are tried in each round."""

HOPS = np.radians([0.25, 0.5, 0.75, 1.0, 1.5])
OTHER_EDGE_HOPS = np.radians([0.2, 0.45, 0.7, 1.0, 1.3])
"""Distance of neighbours [rad]: edges there excite the resonances a cycle later."""

SMALL_TURN = 0.3 * EXTENT_STEP
"""Change of the extent [rad] by which slopes are found."""

DAMPINGS = (0.02, 0.5, 10.0)
"""Of a step's curvature, tried in turn until one leads uphill."""

LEAST_GAIN = 0.2
"""Of a score: less is not worth another step."""

OTHER_EDGE = 1.0
"""Taken off the score of an edge model that was not given."""


@dataclass(frozen=True)
class Guess:
    """A defect that could have given the signal.

    Attributes
    ----------
    extent
        [rad]
    edge
        edge model.
    score
        logarithm of how well it explains the signal, before the temperature.
    match
        of its one pass with the measured one.
    begin
        state in which its motion ended, for that of a guess nearby.
    extent_spread
        standard deviation [rad] of the extent if what is left is noise; NaN until it was refined.
    """

    extent: float
    edge: str
    score: float
    match: Match
    begin: Begin | None
    extent_spread: float = math.nan
    extent_scatter: float = math.nan


@dataclass(frozen=True)
class Search:
    """Everything that stays the same while a signal is explained."""

    scene: Scene
    target: Target
    columns: tuple[int, ...]

    @property
    def count(self) -> int:
        """Harmonics that are compared."""
        return int(self.target.kept[-1]) + 1

    def guess(self, extent: float, edge: str, like: Guess | None = None) -> Guess:
        """Simulate a defect and compare it with the signal.

        The motion of a guess nearby goes on, where one is given.
        """
        extent = min(max(extent, LEAST_EXTENT), GREATEST_EXTENT)
        begin = None if like is None else like.begin
        passes, begin = self.simulator.passes(extent, edge, CLOSED, begin)
        match = self.target.match(passes.harmonics[None], passes.power[None])
        score = float(match.score[0]) - OTHER_EDGE * (edge != self.edges[0])
        return Guess(extent, edge, score, match, begin)

    @property
    def edges(self) -> tuple[str, str]:
        """The edge model that was given, and the one most unlike it."""
        (defect,) = self.scene.defects
        return defect.edge, "published" if defect.edge == "exact" else EDGES[-1]

    def cell(self, difference: float) -> int:
        """Number of ball spacings in a difference [rad] of extents: each is a cell of its own."""
        return round(difference / self.scene.bearing.ball_spacing)

    @cached_property
    def simulator(self) -> Simulator:
        """Of the scene, at the speed that was measured."""
        return Simulator(self.scene, self.target.measured.frequency, self.count, self.columns)

    def residuals(self, guess: Guess, about: Guess) -> Array:
        """Residuals of least squares, so weighted that near `about` their sum is as the score."""
        own, of = guess.match, about.match
        bands, directions = own.spectrum_residual.shape[1:]
        weighed = (np.abs(of.waveform_residual) ** 2).sum(axis=1)
        waveform = np.sqrt(2.0 * WAVEFORM_WEIGHT / directions / (1.0 + weighed))
        floored = SPECTRUM_FLOOR + of.spectrum_misfit
        spectrum = np.sqrt(2.0 * SPECTRUM_WEIGHT / directions / bands / floored)
        left = (own.waveform_residual * waveform).ravel()
        return np.concatenate([left.real, left.imag, (own.spectrum_residual * spectrum).ravel()])

    def neighbouring(self, guess: Guess) -> Guess:
        """The best of extents a little shorter and longer, and of other edges, refined once.

        Steps from a guess do not get there: between are extents whose edges excite the resonances
        out of step.
        """
        tried = [
            self.guess(guess.extent + way * hop, edge, guess)
            for edge in self.edges
            for hop in (HOPS if edge == guess.edge else OTHER_EDGE_HOPS).tolist()
            for way in (-1.0, 1.0)
        ]
        return self.refined(max(tried, key=lambda other: other.score))

    def refined(self, guess: Guess) -> Guess:
        """One Gauss-Newton step from a guess, or the best of what was tried on the way."""
        turned = min(SMALL_TURN, 0.2 * guess.extent)
        tried = self.guess(guess.extent + turned, guess.edge, guess)
        here = self.residuals(guess, guess)
        slope = (self.residuals(tried, guess) - here) / turned
        curvature = float(slope @ slope) + 1e-9
        furthest = min(3.0 * EXTENT_STEP, guess.extent)
        best = max((guess, tried), key=lambda other: other.score)
        for damping in DAMPINGS:
            move = -float(slope @ here) / ((1.0 + damping) * curvature)
            move = min(max(move, -furthest), furthest)
            there = self.guess(guess.extent + move, guess.edge, guess)
            if there.score > guess.score:
                best = max((best, there), key=lambda other: other.score)
                break
        # what is left says how far off the residuals are (a sandwich of curvatures)
        scatter = math.sqrt(float(((slope * here) ** 2).sum())) / curvature
        return dataclasses.replace(
            best, extent_spread=1.0 / math.sqrt(curvature), extent_scatter=scatter
        )


EXTENTS = np.concatenate([PITS, np.arange(2.0 * EXTENT_STEP, GREATEST_EXTENT, EXTENT_STEP)])
"""[rad] that are simulated."""

_OF_PARTS = np.array_split(EXTENTS, PARTS)


@lru_cache(maxsize=8)
def _rough_simulator(
    scene: Scene, frequency: float, count: int, columns: tuple[int, ...]
) -> Simulator:
    """The same for all signals of nearly the same speed."""
    return Simulator(scene, frequency, count, columns, ROUGH_STEPS_A_CYCLE)


@lru_cache(maxsize=16 * PARTS)
def _library(simulator: Simulator, edge: str, part: int) -> tuple[NDArray[np.complex128], Array]:
    """Harmonics and power (m, N, d) of ball passes over a part of all extents."""
    begin: Begin | None = None
    passes = []
    for extent in _OF_PARTS[part].tolist():
        # each begins as its neighbour goes on, and soon goes its own way
        found, begin = simulator.passes(extent, edge, CLOSED_ROUGHLY, begin)
        passes.append(found)
    return np.array([one.harmonics for one in passes]), np.array([one.power for one in passes])


def steps_needed(search: Search) -> int:
    """Steps of all simulations of a search, about and at most."""
    library = len(search.edges) * len(EXTENTS)
    cells = math.ceil((GREATEST_EXTENT - LEAST_EXTENT) / search.scene.bearing.ball_spacing)
    refined = 3 * (STARTS + sum(FURTHER) + 5 * sum(HOPPING) + 2 * cells)
    frequency = search.target.measured.frequency
    return (library + refined) * steps_of(search.scene, frequency, search.count)


def guesses(search: Search) -> list[Guess]:
    """Refined guesses, the best first; and one at least in each cell of extents, from the best on.

    Threads share the work, most of which holds no interpreter lock; nothing depends on which is
    done first, as everything is taken in its own order.
    """
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    with ThreadPoolExecutor(usable, "size") as threads:
        return _refined(search, _library_scores(search, threads), threads)


def _library_scores(search: Search, threads: Executor) -> Array:
    """Likeness of the signal and that of each of EXTENTS, with one edge and then the other."""
    scene, target = search.scene, search.target
    # a library serves for all signals of nearly the same speed
    nominal = scene.bearing.bpfo(scene.shaft_speed)
    frequency = nominal * round(target.measured.frequency / nominal, 3)
    simulator = _rough_simulator(scene, frequency, search.count, search.columns)
    tasks = [(edge, part) for edge in search.edges for part in range(PARTS)]

    def explained(task: tuple[str, int]) -> Array:
        score = target.match(*_library(simulator, *task)).score
        return score - OTHER_EDGE * (task[0] != search.edges[0])

    return np.concatenate(list(threads.map(explained, tasks)))


def _refined(search: Search, scores: Array, threads: Executor) -> list[Guess]:
    """The best guesses made better, and those of each cell."""
    sources = [(extent, edge) for edge in search.edges for extent in EXTENTS.tolist()]
    order = np.argsort(-scores, kind="stable")

    def starts() -> Iterator[int]:
        taken: list[float] = []
        for index in order.tolist():
            extent = sources[index][0]
            if all(abs(extent - other) > STARTS_APART for other in taken):
                taken.append(extent)
                yield index
                if len(taken) == STARTS:
                    return

    def begun(index: int) -> Guess:
        return search.refined(search.guess(*sources[index]))

    found = list(threads.map(begun, starts()))
    for done, count in enumerate(FURTHER):
        found.sort(key=lambda guess: -guess.score)
        if done < len(HOPPING):
            found += threads.map(search.neighbouring, found[: HOPPING[done]])
            found.sort(key=lambda guess: -guess.score)
        before = [guess.score for guess in found[:count]]
        found[:count] = threads.map(search.refined, found[:count])
        gained = [one.score - old for one, old in zip(found, before, strict=False)]
        if done >= len(HOPPING) and max(gained) < LEAST_GAIN:
            break
    best = max(found, key=lambda guess: guess.score)
    # a cell without a guess would lose for want of refinement, not of likeness
    reached = {search.cell(guess.extent - best.extent) for guess in found}
    alone = []
    for index in order.tolist():
        cell = search.cell(sources[index][0] - best.extent)
        if cell not in reached:
            reached.add(cell)
            alone.append(index)
    found += threads.map(lambda index: search.refined(begun(index)), alone)
    return sorted(found, key=lambda guess: -guess.score)
