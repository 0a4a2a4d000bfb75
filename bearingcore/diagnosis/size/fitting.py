"""Defects that could have given a signal: simulated over all extents, the best ones refined.

What is only roughly known about a scene is varied with the extent: a stiffness that is a tenth off
moves the resonances further than a defect does, and would else be mistaken for one.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from bearingcore.common.processors import processors
from bearingcore.diagnosis.size.chance import ByChance
from bearingcore.diagnosis.size.matching import (
    SPECTRUM_FLOOR,
    SPECTRUM_WEIGHT,
    WAVEFORM_WEIGHT,
    Prepared,
    Target,
)
from bearingcore.diagnosis.size.path_fit import DIRECT, PathModel
from bearingcore.diagnosis.size.synthesis import steps_of, synthesise
from bearingcore.diagnosis.size.variants import Tolerances, variant
from bearingcore.model.defect import EDGES
from bearingcore.model.scene import Scene
from bearingcore.signals.averaging import BallPasses

LEAST_EXTENT = math.radians(1.0)
GREATEST_EXTENT = math.radians(110.0)
"""Extents [rad] that are looked for."""

EXTENT_STEP = math.radians(0.5)
"""[rad] between simulated extents."""

DRAWS = 2
"""Simulations of each extent with its scene's numbers varied, beside the one as given."""

PARTS = 16
"""In which the library is simulated, so that progress can be told and work given up."""

MOST_OFF = 2.5
"""Standard deviations by which a number of a scene may be off."""

STARTS = 10
STARTS_APART = math.radians(0.8)
"""How many extents are refined, and how far apart they are [rad]."""

FURTHER = 4
FURTHER_ROUNDS = 3
"""How many of them are refined further, and how often."""

Stop = Callable[[float], None]


@dataclass(frozen=True)
class Guess:
    """A defect and a scene's numbers that could have given the signal.

    Attributes
    ----------
    extent
        [rad]
    edge
        edge model.
    offsets
        of the scene's numbers in standard deviations, in the order of `Tolerances`.
    score
        logarithm of how well it explains the signal, less what its offsets cost; before the
        temperature.
    lag
        ball-pass phase [rad] of the simulation at which the measured pass begins.
    level
        natural logarithm of simulated over measured power.
    path
        what lies between housing and sensor.
    extent_spread
        standard deviation [rad] of the extent where the scene's numbers may vary; NaN until it was
        refined.
    """

    extent: float
    edge: str
    offsets: NDArray[np.float64]
    score: float
    waveform_misfit: NDArray[np.float64]
    spectrum_misfit: NDArray[np.float64]
    waveform_cost: NDArray[np.float64]
    lag: float
    level: float
    passes: BallPasses
    path: PathModel
    waveform_residual: NDArray[np.complex128]
    spectrum_residual: NDArray[np.float64]
    extent_spread: float = math.nan
    extent_scatter: float = math.nan


@dataclass(frozen=True)
class Search:
    """What stays the same while a signal is explained."""

    scene: Scene
    target: Target
    columns: tuple[int, ...]
    tolerances: Tolerances
    paths: tuple[PathModel, ...] = (DIRECT,)
    """What may lie between housing and sensor."""

    @property
    def count(self) -> int:
        """Harmonics that are compared."""
        return int(self.target.kept[-1]) + 1

    def guess(
        self,
        extent: float,
        edge: str,
        offsets: NDArray[np.float64],
        path: PathModel | None = None,
    ) -> Guess:
        """Simulate a defect and compare it with the signal, behind a path or the best of all."""
        extent = min(max(extent, LEAST_EXTENT), GREATEST_EXTENT)
        offsets = np.where(self.tolerances.spread > 0.0, np.clip(offsets, -MOST_OFF, MOST_OFF), 0.0)
        scene = self.varied(extent, edge, offsets)
        passes = synthesise(scene, self.target.measured.frequency, self.count, self.columns)
        exits = exit_phases(scene, np.array([extent]))
        best: Guess | None = None
        for model in self.paths if path is None else (path,):
            match = self.target.match(passes.harmonics[None], passes.power[None], model, exits)
            score = float(match.score[0]) - 0.5 * float(offsets @ offsets)
            if best is not None and score <= best.score:
                continue
            best = Guess(
                extent,
                edge,
                offsets,
                score,
                match.waveform_misfit[0],
                match.spectrum_misfit[0],
                match.waveform_cost[0],
                float(match.lag[0]),
                float(match.level[0]),
                passes,
                model,
                match.waveform_residual[0],
                match.spectrum_residual[0],
            )
        assert best is not None
        return best

    def varied(self, extent: float, edge: str, offsets: NDArray[np.float64]) -> Scene:
        """The scene with a guess's defect and numbers."""
        return variant(self.scene, extent, edge, offsets * self.tolerances.spread)

    def residuals(self, guess: Guess, about: Guess) -> NDArray[np.float64]:
        """What least squares make small, so weighted that near `about` it does as the score."""
        directions = len(about.waveform_misfit)
        weighed = (np.abs(about.waveform_residual) ** 2).sum(axis=0)
        waveform = np.sqrt(2.0 * WAVEFORM_WEIGHT / directions / (1.0 + weighed))
        bands = len(guess.spectrum_residual)
        floored = SPECTRUM_FLOOR + about.spectrum_misfit
        spectrum = np.sqrt(2.0 * SPECTRUM_WEIGHT / directions / bands / floored)
        left = (guess.waveform_residual * waveform).ravel()
        return np.concatenate(
            [left.real, left.imag, (guess.spectrum_residual * spectrum).ravel(), guess.offsets]
        )

    def refined(self, guess: Guess) -> Guess:
        """One Gauss-Newton step from a guess, or the best of what was tried on the way."""
        here = self.residuals(guess, guess)
        steps = [(0.3 * EXTENT_STEP, np.zeros(len(guess.offsets)))]
        steps += [(0.0, 0.3 * unit) for unit in np.eye(len(guess.offsets))]
        sizes = np.array([0.3 * EXTENT_STEP] + [0.3] * len(guess.offsets))
        tried = [
            self.guess(guess.extent + extent, guess.edge, guess.offsets + offsets, guess.path)
            for extent, offsets in steps
        ]
        slope = np.array([self.residuals(other, guess) - here for other in tried]) / sizes[:, None]
        curvature = slope @ slope.T + 1e-9 * np.eye(len(sizes))
        furthest = np.array([3.0 * EXTENT_STEP] + [1.0] * len(guess.offsets))
        for damping in (0.02, 0.5, 10.0):
            damped = curvature + damping * np.diag(np.diag(curvature))
            move = -np.linalg.solve(damped, slope @ here)
            move *= min(1.0, float(np.min(furthest / np.maximum(np.abs(move), 1e-12))))
            there = self.guess(
                guess.extent + move[0], guess.edge, guess.offsets + move[1:], guess.path
            )
            tried.append(there)
            if there.score > guess.score:
                break
        best = max([guess, *tried], key=lambda other: other.score)
        inverse = np.linalg.inv(curvature)
        spread = math.sqrt(float(inverse[0, 0]))
        # what is left says how far off the residuals are (a sandwich of curvatures)
        left = here.copy()
        left[-len(guess.offsets) :] = 1.0
        lever = inverse[0] @ slope
        scatter = math.sqrt(float(((lever * left) ** 2).sum()))
        return dataclasses.replace(best, extent_spread=spread, extent_scatter=scatter)


def exit_phases(scene: Scene, extents: NDArray[np.float64]) -> NDArray[np.float64]:
    """Phases (m,) [rad] of a simulated ball pass at which balls leave defects of some extents."""
    (defect,) = scene.defects
    return np.asarray(2.0 * math.pi * (defect.center + 0.5 * extents) / scene.bearing.ball_spacing)


@dataclass(frozen=True)
class _Library:
    """Simulated signals over all extents: guesses not yet compared."""

    extents: NDArray[np.float64]
    edges: tuple[str, ...]
    offsets: NDArray[np.float64]
    harmonics: NDArray[np.complex128]
    power: NDArray[np.float64]


@lru_cache(maxsize=8 * PARTS)
def _library_part(
    scene: Scene,
    frequency: float,
    count: int,
    columns: tuple[int, ...],
    tolerances: Tolerances,
    part: int,
) -> _Library:
    """Every PARTS-th of all extents, each as the scene says and DRAWS times with it varied."""
    (defect,) = scene.defects
    edges = (defect.edge, "published" if defect.edge == "exact" else EDGES[-1])
    rng = np.random.default_rng(part)
    spread = tolerances.spread
    made: list[tuple[float, str, NDArray[np.float64]]] = []
    for extent in np.arange(LEAST_EXTENT, GREATEST_EXTENT, EXTENT_STEP)[part::PARTS].tolist():
        made.append((extent, defect.edge, np.zeros(len(spread))))
        for _ in range(DRAWS):
            offsets = np.clip(rng.standard_normal(len(spread)), -2.0, 2.0) * (spread > 0.0)
            near = extent + rng.uniform(-0.5, 0.5) * EXTENT_STEP
            made.append((max(near, LEAST_EXTENT), edges[rng.integers(2)], offsets))
    passes = [
        synthesise(variant(scene, extent, edge, offsets * spread), frequency, count, columns)
        for extent, edge, offsets in made
    ]
    return _Library(
        np.array([extent for extent, _, _ in made]),
        tuple(edge for _, edge, _ in made),
        np.array([offsets for _, _, offsets in made]),
        np.array([each.harmonics for each in passes]),
        np.array([each.power for each in passes]),
    )


def steps_needed(search: Search) -> int:
    """Steps of all simulations of a search, about: those of the scene as it is given, for each."""
    library = math.ceil((GREATEST_EXTENT - LEAST_EXTENT) / EXTENT_STEP) * (1 + DRAWS)
    cells = math.ceil((GREATEST_EXTENT - LEAST_EXTENT) / search.scene.bearing.ball_spacing)
    tries = 2 + len(search.tolerances.spread)
    refined = tries * (STARTS + FURTHER * FURTHER_ROUNDS + 2 * cells)
    frequency = search.target.measured.frequency
    return (library + refined) * steps_of(search.scene, frequency, search.count)


CHANCE_PARTS = 4
"""Every so many parts of the library are also held against chance; behind paths half of them."""


def guesses(
    search: Search, cells: Callable[[float], int], progress: Stop
) -> tuple[list[Guess], float]:
    """Refined guesses, the best first; and one at least in each cell of extents.

    With them: how often chance would explain a pass of such a spectrum as well, see `ByChance`.

    `cells` numbers the cells that extents fall into once the best guess is known: it is asked for
    differences of extents [rad]. `progress` is told the share that is done, and may raise to end.
    """
    scene, target = search.scene, search.target
    # a library serves for all signals of nearly the same speed
    nominal = scene.bearing.bpfo(scene.shaft_speed)
    frequency = nominal * round(target.measured.frequency / nominal, 3)
    by_chance = ByChance(target)

    def explained(part: int) -> tuple[_Library, NDArray[np.float64]]:
        """A part of the library, and how well each path (p, m) makes it explain the signal."""
        library = _library_part(
            scene, frequency, search.count, search.columns, search.tolerances, part
        )
        exits = exit_phases(scene, library.extents)
        tried = []
        for path in search.paths:
            prepared = Prepared(target, library.harmonics, path, exits)
            if part % (CHANCE_PARTS if path.direct else 2 * CHANCE_PARTS) == 0:
                by_chance.look(prepared)
            tried.append(prepared.match(library.power).score)
        return library, np.array(tried)

    threads = ThreadPoolExecutor(processors(), "size")
    try:
        return _searched(search, explained, cells, progress, threads), by_chance.share
    finally:
        threads.shutdown(cancel_futures=True)


def _searched(
    search: Search,
    explained: Callable[[int], tuple[_Library, NDArray[np.float64]]],
    cells: Callable[[float], int],
    progress: Stop,
    threads: Executor,
) -> list[Guess]:
    """What `guesses` finds. Threads share the work, most of which holds no interpreter lock.

    Nothing depends on which is done first: everything is taken in its own order.
    """
    scores, sources = [], []
    for part, (library, score) in enumerate(threads.map(explained, range(PARTS))):
        scores.append(score.max(axis=0) - 0.5 * (library.offsets**2).sum(axis=1))
        sources += [
            (extent, edge, offsets, search.paths[number])
            for extent, edge, offsets, number in zip(
                library.extents.tolist(),
                library.edges,
                library.offsets,
                score.argmax(axis=0).tolist(),
                strict=True,
            )
        ]
        progress(0.5 * (part + 1) / PARTS)
    order = np.argsort(-np.concatenate(scores))

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

    found: list[Guess] = []
    for done, guess in enumerate(threads.map(begun, starts())):
        found.append(guess)
        progress(0.5 + 0.25 * (done + 1) / STARTS)
    for done in range(FURTHER_ROUNDS):
        found.sort(key=lambda guess: -guess.score)
        found[:FURTHER] = threads.map(search.refined, found[:FURTHER])
        progress(0.75 + 0.15 * (done + 1) / FURTHER_ROUNDS)
    best = max(found, key=lambda guess: guess.score)
    # a cell without a guess would lose for want of refinement, not of likeness
    reached = {cells(guess.extent - best.extent) for guess in found}
    alone = []
    for index in order.tolist():
        cell = cells(sources[index][0] - best.extent)
        if cell not in reached:
            reached.add(cell)
            alone.append(index)
    found += threads.map(lambda index: search.refined(begun(index)), alone)
    progress(1.0)
    return sorted(found, key=lambda guess: -guess.score)
