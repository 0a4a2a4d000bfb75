"""Defects that could have given a signal: simulated over all extents, the best ones refined.

The scene is taken as given, but for its edges: those most unlike the given ones are tried too.
"""

from __future__ import annotations

import math
import os
from concurrent.futures import Executor, ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from bearingcore.diagnosis.size.matching import Match, Target
from bearingcore.diagnosis.size.simulation import Simulator
from bearingcore.scene.defect import EDGES
from bearingcore.scene.scene import Scene

LEAST_EXTENT = math.radians(0.2)
GREATEST_EXTENT = math.radians(110.0)
"""Extents [rad] that are looked for."""

EXTENT_STEP = math.radians(0.5)
"""[rad] between simulated extents."""

PITS = np.radians([0.2, 0.28, 0.4, 0.55, 0.75])
"""[rad] Shorter ones than two steps, which are simulated too."""

EXTENTS = np.concatenate([PITS, np.arange(2.0 * EXTENT_STEP, GREATEST_EXTENT, EXTENT_STEP)])
"""[rad] that are simulated."""

STARTS = 10
STARTS_APART = math.radians(0.8)
"""Number of extents that are refined, and their least distance [rad]."""

HOPPING = (4, 2)
"""Number of the best whose neighbouring extents are tried in each round."""

HOPS = np.radians([0.25, 0.5, 0.75, 1.0, 1.5])
OTHER_EDGE_HOPS = np.radians([0.2, 0.45, 0.7, 1.0, 1.3])
"""Distance of neighbours [rad]: edges there excite the resonances a cycle later."""

FINEST = math.radians(0.01)
MOST_TRIALS = 12
"""To how much [rad] an extent is refined, in how many simulations at most."""

SMALL_TURN = math.radians(0.1)
"""Change of the extent [rad] by which the curvature of the score is found."""

OTHER_EDGE = 1.0
"""Taken off the score of an edge model that was not given."""


class Guess(NamedTuple):
    """A defect that could have given the signal.

    `extent` [rad], edge model, `score` (logarithm of how well it explains the signal, before the
    temperature), and the `match` of its ball passes with the measured ones.
    """

    extent: float
    edge: str
    score: float
    match: Match


class Search:
    """Explains a measured mean ball pass by simulated ones.

    Parameters
    ----------
    scene
        with a single defect.
    target
        what was measured.
    columns
        of the active directions that were measured.
    """

    def __init__(self, scene: Scene, target: Target, columns: tuple[int, ...]) -> None:
        self.scene, self.target = scene, target
        (defect,) = scene.defects
        self.edges = defect.edge, "published" if defect.edge == "exact" else EDGES[-1]
        count = int(target.kept[-1]) + 1
        self.simulator = Simulator(scene, target.measured.frequency, count, columns)

    @property
    def steps(self) -> int:
        """Steps of integration of all simulations, about and at most."""
        cells = math.ceil((GREATEST_EXTENT - LEAST_EXTENT) / self.scene.bearing.ball_spacing)
        neighbours = 2 * (len(HOPS) + len(OTHER_EDGE_HOPS))
        refined = MOST_TRIALS * (STARTS + sum(HOPPING) + cells) + neighbours * sum(HOPPING)
        return (len(self.edges) * len(EXTENTS) + refined) * self.simulator.steps

    def cell(self, difference: float) -> int:
        """Number of ball spacings in a difference [rad] of extents: each is a cell of its own."""
        return round(difference / self.scene.bearing.ball_spacing)

    def guess(self, extent: float, edge: str) -> Guess:
        """Simulate a defect and compare it with the signal."""
        extent = min(max(extent, LEAST_EXTENT), GREATEST_EXTENT)
        match = self.target.match(*self.simulator.passes(extent, edge))
        return Guess(extent, edge, match.score - OTHER_EDGE * (edge != self.edges[0]), match)

    def refined(self, guess: Guess) -> Guess:
        """The best extent within a step of a guess."""
        from scipy.optimize import minimize_scalar  # imported late: slow to import

        tried = [guess]

        def against(extent: float) -> float:
            tried.append(self.guess(extent, guess.edge))
            return -tried[-1].score

        low, high = max(guess.extent - EXTENT_STEP, LEAST_EXTENT), guess.extent + EXTENT_STEP
        minimize_scalar(
            against, bounds=(low, high), method="bounded",
            options={"xatol": FINEST, "maxiter": MOST_TRIALS},
        )  # fmt: skip
        return max(tried, key=_score)

    def neighboring(self, guess: Guess) -> Guess:
        """The best of extents a little shorter and longer, and of other edges, refined.

        Refining a guess does not get there: between are extents whose edges excite the resonances
        out of step.
        """
        tried = [
            self.guess(guess.extent + way * hop, edge)
            for edge in self.edges
            for hop in (HOPS if edge == guess.edge else OTHER_EDGE_HOPS).tolist()
            for way in (-1.0, 1.0)
        ]
        return self.refined(max(tried, key=_score))

    def spread(self, guess: Guess) -> float:
        """Standard deviation [rad] of a guess's extent, by the curvature of the score there."""
        turn = min(SMALL_TURN, 0.2 * guess.extent)
        near = [self.guess(guess.extent + way * turn, guess.edge) for way in (-1.0, 1.0)]
        curvature = (2.0 * guess.score - near[0].score - near[1].score) / turn**2
        return 1.0 / math.sqrt(max(curvature, 1e-9))

    def guesses(self) -> list[Guess]:
        """Refined guesses, the best first; and one at least in each cell of extents.

        Threads share the work, most of which holds no interpreter lock; nothing depends on which
        is done first, as everything is taken in its own order.
        """
        usable = (
            len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
        )
        with ThreadPoolExecutor(usable, "size") as threads:
            return self._guesses(threads)

    def _guesses(self, threads: Executor) -> list[Guess]:
        rough = [
            guess
            for edge in self.edges
            for guess in threads.map(lambda extent, e=edge: self.guess(extent, e), EXTENTS.tolist())
        ]
        rough.sort(key=_score, reverse=True)
        starts: list[Guess] = []
        for guess in rough:
            if all(abs(guess.extent - other.extent) > STARTS_APART for other in starts):
                starts.append(guess)
        found = list(threads.map(self.refined, starts[:STARTS]))
        for count in HOPPING:
            found.sort(key=_score, reverse=True)
            found += threads.map(self.neighboring, found[:count])
        best = max(found, key=_score)
        # a cell without a guess would lose for want of refinement, not of likeness
        reached = {self.cell(guess.extent - best.extent) for guess in found}
        alone = []
        for guess in rough:
            if (cell := self.cell(guess.extent - best.extent)) not in reached:
                reached.add(cell)
                alone.append(guess)
        return sorted([*found, *threads.map(self.refined, alone)], key=_score, reverse=True)


def _score(guess: Guess) -> float:
    return guess.score
