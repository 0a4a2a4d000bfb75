"""Defects that could have given a signal: simulated over all extents, the best ones refined.

What is only roughly known about a scene is varied with the extent: a stiffness that is a tenth off
moves the resonances further than a defect does, and would else be mistaken for one.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from bearingcore.common.lazy import cached_property
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
from bearingcore.diagnosis.size.synthesis import Begin, Simulator, steps_of
from bearingcore.diagnosis.size.variants import Tolerances, variant
from bearingcore.scene.defect import EDGES
from bearingcore.scene.scene import Scene
from bearingcore.signals.averaging import BallPasses

LEAST_EXTENT = math.radians(0.2)
GREATEST_EXTENT = math.radians(110.0)
"""Extents [rad] that are looked for."""

EXTENT_STEP = math.radians(0.5)
"""[rad] between simulated extents."""

PITS = np.radians([0.2, 0.28, 0.4, 0.55, 0.75])
"""[rad] Shorter ones than two steps, which are simulated too."""

DRAWS = 2
"""Simulations of each extent with its scene's numbers varied, in addition to the one as given."""

PARTS = 16
"""In which the library is simulated, so that progress can be shown and work given up."""

PROMISING = 0.5
"""Part of the extents that are simulated with the scene's numbers varied too."""

NEIGHBOURS = 3
"""Extents to either side that count for whether one is promising."""

ROUGH_STEPS_A_CYCLE = 7.0
"""Steps in a cycle of the highest natural frequency in the library: they move a few thousandths of
a pass's power, and what it is compared with is never nearer than a twentieth."""

CLOSED_ROUGHLY, CLOSED = 0.05, 0.005
"""Differences between passes, as a share of them, from which a motion has settled: in the library,
and of what is refined."""

MOST_OFF = 2.5
"""Standard deviations by which a number of a scene may be off."""

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

Stop = Callable[[float], None]


SMALL_TURN, SMALL = 0.3 * EXTENT_STEP, 0.3
"""Changes of the extent [rad] and of a number [standard deviations] by which slopes are found."""

DAMPINGS = (0.02, 0.5, 10.0)
"""Of a step's curvature, tried in turn until one leads uphill."""

LEAST_GAIN = 0.2
"""Of a score: less is not worth another step."""

OTHER_EDGE = 1.0
"""Taken off the score of an edge model that was not given."""


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
        path between housing and sensor.
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
    begin: Begin | None
    extent_spread: float = math.nan
    extent_scatter: float = math.nan


@dataclass(frozen=True)
class Search:
    """Everything that stays the same while a signal is explained."""

    scene: Scene
    target: Target
    columns: tuple[int, ...]
    tolerances: Tolerances
    paths: tuple[PathModel, ...] = (DIRECT,)
    """Possible paths between housing and sensor."""

    @property
    def count(self) -> int:
        """Harmonics that are compared."""
        return int(self.target.kept[-1]) + 1

    def guess(
        self,
        extent: float,
        edge: str,
        offsets: NDArray[np.float64],
        like: Guess | None = None,
        path: PathModel | None = None,
    ) -> Guess:
        """Simulate a defect and compare it with the signal, behind a path or the best of all.

        Like a guess nearby, where one is given: behind its path, and its motion goes on.
        """
        extent = min(max(extent, LEAST_EXTENT), GREATEST_EXTENT)
        offsets = np.where(self.tolerances.spread > 0.0, np.clip(offsets, -MOST_OFF, MOST_OFF), 0.0)
        exponents = offsets * self.tolerances.spread
        begin = None if like is None else like.begin
        passes, begin = self.simulator.passes(extent, edge, exponents, CLOSED, begin)
        path = path if like is None else like.path
        exits = exit_phases(self.scene, np.array([extent]))
        best: Guess | None = None
        for model in self.paths if path is None else (path,):
            match = self.target.match(
                passes.harmonics[None],
                passes.power[None],
                model,
                exits,
                None if like is None or like.edge != edge else like.lag,
            )
            score = float(match.score[0]) - 0.5 * float(offsets @ offsets)
            score -= OTHER_EDGE * (edge != self.edges[0])
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
                begin,
            )
        assert best is not None
        return best

    @property
    def edges(self) -> tuple[str, str]:
        """The edge model that was given, and the one most unlike it."""
        (defect,) = self.scene.defects
        return edges_tried(defect.edge)

    @cached_property
    def simulator(self) -> Simulator:
        """Of the scene, at the speed that was measured."""
        return Simulator(self.scene, self.target.measured.frequency, self.count, self.columns)

    def varied(self, extent: float, edge: str, offsets: NDArray[np.float64]) -> Scene:
        """The scene with a guess's defect and numbers."""
        return variant(self.scene, extent, edge, offsets * self.tolerances.spread)

    def residuals(self, guess: Guess, about: Guess) -> NDArray[np.float64]:
        """Residuals of least squares, so weighted that near `about` their sum is as the score."""
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

    def neighbouring(self, guess: Guess) -> Guess:
        """The best of extents a little shorter and longer, and of other edges, refined once.

        Steps from a guess do not get there: between are extents whose edges excite the resonances
        out of step.
        """
        tried = [
            self.guess(guess.extent + way * hop, edge, guess.offsets, guess)
            for edge in self.edges
            for hop in (HOPS if edge == guess.edge else OTHER_EDGE_HOPS).tolist()
            for way in (-1.0, 1.0)
        ]
        return self.refined(max(tried, key=lambda other: other.score))

    def refined(self, guess: Guess) -> Guess:
        """One Gauss-Newton step from a guess, or the best of what was tried on the way."""
        count = len(guess.offsets)
        turned = min(SMALL_TURN, 0.2 * guess.extent)
        tried = [
            self.guess(guess.extent + turned, guess.edge, guess.offsets, guess),
            *(
                self.guess(guess.extent, guess.edge, guess.offsets + SMALL * unit, guess)
                for unit in np.eye(count)
            ),
        ]
        sizes = np.array([turned] + [SMALL] * count)[:, None]
        here = self.residuals(guess, guess)
        slope = np.array([self.residuals(other, guess) - here for other in tried]) / sizes
        curvature = slope @ slope.T + 1e-9 * np.eye(1 + count)
        furthest = np.array([min(3.0 * EXTENT_STEP, guess.extent)] + [1.0] * count)
        best = guess
        for damping in DAMPINGS:
            damped = curvature + damping * np.diag(np.diag(curvature))
            move = -np.linalg.solve(damped, slope @ here)
            move *= min(1.0, float(np.min(furthest / np.maximum(np.abs(move), 1e-12))))
            there = self.guess(guess.extent + move[0], guess.edge, guess.offsets + move[1:], guess)
            if there.score > best.score:
                best = there
                break
        best = max([best, *tried], key=lambda other: other.score)
        inverse = np.linalg.inv(curvature)
        spread = math.sqrt(float(inverse[0, 0]))
        # what is left says how far off the residuals are (a sandwich of curvatures)
        left = here.copy()
        left[-count:] = 1.0
        lever = inverse[0] @ slope
        scatter = math.sqrt(float(((lever * left) ** 2).sum()))
        return dataclasses.replace(best, extent_spread=spread, extent_scatter=scatter)


def edges_tried(given: str) -> tuple[str, str]:
    """An edge model, and the one most unlike it."""
    return given, "published" if given == "exact" else EDGES[-1]


def exit_phases(scene: Scene, extents: NDArray[np.float64]) -> NDArray[np.float64]:
    """Phases (m,) [rad] of a simulated ball pass at which balls leave defects of some extents."""
    (defect,) = scene.defects
    return np.asarray(2.0 * math.pi * (defect.center + 0.5 * extents) / scene.bearing.ball_spacing)


@dataclass(frozen=True)
class _Library:
    """Simulated signals of some extents: guesses not yet compared."""

    extents: NDArray[np.float64]
    edges: tuple[str, ...]
    offsets: NDArray[np.float64]
    harmonics: NDArray[np.complex128]
    power: NDArray[np.float64]
    begins: tuple[Begin | None, ...]


@dataclass(frozen=True)
class _Sought:
    """Arguments of a library: the same for all signals of nearly the same speed."""

    scene: Scene
    frequency: float
    count: int
    columns: tuple[int, ...]
    tolerances: Tolerances


EXTENTS = np.concatenate([PITS, np.arange(2.0 * EXTENT_STEP, GREATEST_EXTENT, EXTENT_STEP)])
"""[rad] that are simulated."""

_OF_PARTS = np.array_split(np.arange(len(EXTENTS)), PARTS)


@lru_cache(maxsize=8)
def _simulator(sought: _Sought) -> Simulator:
    return Simulator(
        sought.scene, sought.frequency, sought.count, sought.columns, ROUGH_STEPS_A_CYCLE
    )


@lru_cache(maxsize=8 * PARTS)
def _as_given(sought: _Sought, part: int) -> _Library:
    """A part of all extents, in a scene as it was given."""
    (defect,) = sought.scene.defects
    simulator = _simulator(sought)
    nothing = np.zeros(len(sought.tolerances.spread))
    begin: Begin | None = None
    begins, passes = [], []
    for index in _OF_PARTS[part].tolist():
        # each begins as its neighbour goes on, and soon goes its own way
        found, begin = simulator.passes(
            float(EXTENTS[index]), defect.edge, nothing, CLOSED_ROUGHLY, begin
        )
        passes.append(found)
        begins.append(begin)
    count = len(passes)
    return _Library(
        EXTENTS[_OF_PARTS[part]],
        (defect.edge,) * count,
        np.zeros((count, len(nothing))),
        np.array([each.harmonics for each in passes]),
        np.array([each.power for each in passes]),
        tuple(begins),
    )


@lru_cache(maxsize=8 * len(EXTENTS))
def _varied(sought: _Sought, index: int) -> _Library:
    """About an extent, DRAWS times with the scene's numbers varied."""
    (defect,) = sought.scene.defects
    edges = edges_tried(defect.edge)
    part = next(number for number, one in enumerate(_OF_PARTS) if index <= one[-1])
    begin = _as_given(sought, part).begins[index - int(_OF_PARTS[part][0])]
    rng = np.random.default_rng(index)
    spread = sought.tolerances.spread
    made, passes = [], []
    for _ in range(DRAWS):
        offsets = np.clip(rng.standard_normal(len(spread)), -2.0, 2.0) * (spread > 0.0)
        extent = float(EXTENTS[index])
        extent += rng.uniform(-0.5, 0.5) * min(EXTENT_STEP, extent)
        made.append((extent, edges[rng.integers(2)], offsets))
        passes.append(
            _simulator(sought).passes(*made[-1][:2], offsets * spread, CLOSED_ROUGHLY, begin)[0]
        )
    return _Library(
        np.array([extent for extent, _, _ in made]),
        tuple(edge for _, edge, _ in made),
        np.array([offsets for _, _, offsets in made]),
        np.array([each.harmonics for each in passes]),
        np.array([each.power for each in passes]),
        (None,) * DRAWS,
    )


def _together(libraries: Sequence[_Library]) -> _Library:
    return _Library(
        np.concatenate([one.extents for one in libraries]),
        tuple(edge for one in libraries for edge in one.edges),
        np.concatenate([one.offsets for one in libraries]),
        np.concatenate([one.harmonics for one in libraries]),
        np.concatenate([one.power for one in libraries]),
        (),
    )


def steps_needed(search: Search) -> int:
    """Steps of all simulations of a search, about and at most: those of the scene as given."""
    library = len(EXTENTS) * (1.0 + PROMISING * DRAWS)
    cells = math.ceil((GREATEST_EXTENT - LEAST_EXTENT) / search.scene.bearing.ball_spacing)
    tries = 2 + len(search.tolerances.spread)
    refined = tries * (STARTS + sum(FURTHER) + 3 * sum(HOPPING) + 2 * cells)
    frequency = search.target.measured.frequency
    return (math.ceil(library) + refined) * steps_of(search.scene, frequency, search.count)


CHANCE_STEP = 2
"""Every so many of all extents are held against chance behind paths, and all of them without."""


@dataclass
class _Compared:
    """Simulated signals, and how well they explain the measured one."""

    search: Search
    scores: list[NDArray[np.float64]] = field(default_factory=list)
    sources: list[tuple[float, str, NDArray[np.float64], PathModel]] = field(default_factory=list)

    def add(self, library: _Library, score: NDArray[np.float64]) -> None:
        """Signals with scores behind each path (p, m)."""
        given, _ = self.search.edges
        other = np.array([edge != given for edge in library.edges])
        cost = 0.5 * (library.offsets**2).sum(axis=1) + OTHER_EDGE * other
        self.scores.append(score.max(axis=0) - cost)
        paths = [self.search.paths[number] for number in score.argmax(axis=0).tolist()]
        self.sources += list(
            zip(library.extents.tolist(), library.edges, library.offsets, paths, strict=True)
        )

    @property
    def score(self) -> NDArray[np.float64]:
        """(m,)"""
        return np.concatenate(self.scores)


def guesses(
    search: Search, cells: Callable[[float], int], progress: Stop
) -> tuple[list[Guess], float]:
    """Refined guesses, the best first; and one at least in each cell of extents.

    With them: how often chance would explain a pass of such a spectrum as well, see `ByChance`.

    `cells` numbers the cells that extents fall into once the best guess is known; it takes
    differences of extents [rad]. `progress` is called with the share done, and may raise to end.
    Threads share the work, most of which holds no interpreter lock; nothing depends on which is
    done first, as everything is taken in its own order.
    """
    by_chance = ByChance(search.target)
    threads = ThreadPoolExecutor(processors(), "size")
    try:
        compared = _library_compared(search, by_chance, progress, threads)
        return _refined(search, compared, cells, progress, threads), by_chance.share
    finally:
        threads.shutdown(cancel_futures=True)


def _library_compared(
    search: Search, by_chance: ByChance, progress: Stop, threads: Executor
) -> _Compared:
    """All extents as the scene is given, and the promising half of them with it varied too."""
    scene, target = search.scene, search.target
    # a library serves for all signals of nearly the same speed
    nominal = scene.bearing.bpfo(scene.shaft_speed)
    frequency = nominal * round(target.measured.frequency / nominal, 3)
    sought = _Sought(scene, frequency, search.count, search.columns, search.tolerances)

    def explained(library: _Library, against_chance: bool) -> NDArray[np.float64]:
        """Score (p, m) of a library for each path."""
        exits = exit_phases(scene, library.extents)
        tried = []
        for path in search.paths:
            prepared = Prepared(target, library.harmonics, path, exits)
            if against_chance:
                by_chance.explain(prepared if path.direct else prepared.some(CHANCE_STEP))
            tried.append(prepared.match(library.power).score)
        return np.array(tried)

    def as_given(part: int) -> tuple[_Library, NDArray[np.float64]]:
        library = _as_given(sought, part)
        return library, explained(library, True)

    def varied(some: NDArray[np.int_]) -> tuple[_Library, NDArray[np.float64]]:
        library = _together([_varied(sought, index) for index in some.tolist()])
        return library, explained(library, False)

    compared = _Compared(search)
    for part, found in enumerate(threads.map(as_given, range(PARTS))):
        compared.add(*found)
        progress(0.3 * (part + 1) / PARTS)
    # where no neighbour is any good, another stiffness or load does not make it so
    near = maximum_of_neighbours(compared.score)
    promising = np.sort(np.argsort(-near, kind="stable")[: round(PROMISING * len(near))])
    for part, found in enumerate(threads.map(varied, np.array_split(promising, PARTS))):
        compared.add(*found)
        progress(0.3 + 0.2 * (part + 1) / PARTS)
    return compared


def maximum_of_neighbours(score: NDArray[np.float64]) -> NDArray[np.float64]:
    """The greatest of each score (n,) and NEIGHBOURS on either side."""
    padded = np.pad(score, NEIGHBOURS, constant_values=-math.inf)
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * NEIGHBOURS + 1)
    return np.asarray(windows.max(axis=1))


def _refined(
    search: Search,
    compared: _Compared,
    cells: Callable[[float], int],
    progress: Stop,
    threads: Executor,
) -> list[Guess]:
    """The best guesses made better, and those of each cell."""
    sources = compared.sources
    order = np.argsort(-compared.score, kind="stable")

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
        extent, edge, offsets, path = sources[index]
        return search.refined(search.guess(extent, edge, offsets, path=path))

    found: list[Guess] = []
    for done, guess in enumerate(threads.map(begun, starts())):
        found.append(guess)
        progress(0.5 + 0.25 * (done + 1) / STARTS)
    for done, count in enumerate(FURTHER):
        found.sort(key=lambda guess: -guess.score)
        if done < len(HOPPING):
            found += threads.map(search.neighbouring, found[: HOPPING[done]])
            found.sort(key=lambda guess: -guess.score)
        before = [guess.score for guess in found[:count]]
        found[:count] = threads.map(search.refined, found[:count])
        progress(0.75 + 0.15 * (done + 1) / len(FURTHER))
        gained = [one.score - old for one, old in zip(found, before, strict=False)]
        if done >= len(HOPPING) and max(gained) < LEAST_GAIN:
            break
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
