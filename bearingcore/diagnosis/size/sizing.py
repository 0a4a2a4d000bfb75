"""The size of a defect from the vibration of the housing: analysis by synthesis.

The time from a ball's entry to a ball's exit gives the extent only up to whole ball spacings
(Petersen, Howard & Prime 2014, Section 4). So every extent is simulated, what is only roughly known
about the scene is varied with it, and each candidate Δφ + k·360°/N_b judged by how well it explains
the signal: the mean ball pass in both directions and the spectrum. The answer is a probability for
each candidate, and a word where there is no clear result.

First comes the diagnosis, which needs no model of the machine: an extent is looked for only
where it names the outer race. Then the mean ball pass must be one: several harmonics, more than
noise, and explained better than chance would (see `chance`).

Quantity                                   | Symbol | Name           | Unit
------------------------------------------ | ------ | -------------- | ----
extent                                     | Δφ     | extent         | rad
whole ball spacings in it                  | k      | turns          |
time from entry to exit                    | Δt     | (events)       | s
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks
from bearingcore.common.lazy import cached_property
from bearingcore.common.numbers import probability, thousands, with_deviation
from bearingcore.common.table import ResultTable, table_of
from bearingcore.diagnosis.part.diagnose import MOST_SAMPLES, diagnose
from bearingcore.diagnosis.part.evidence import Diagnosis
from bearingcore.diagnosis.size.chance import PassQuality, pass_quality
from bearingcore.diagnosis.size.events import Events, find_events
from bearingcore.diagnosis.size.fitting import (
    EXTENT_STEP,
    GREATEST_EXTENT,
    LEAST_EXTENT,
    Guess,
    Search,
    guesses,
    steps_needed,
)
from bearingcore.diagnosis.size.matching import Target
from bearingcore.diagnosis.size.path_fit import DIRECT, PathModel
from bearingcore.diagnosis.size.supports import SupportTrial, dependence, other_supports
from bearingcore.diagnosis.size.synthesis import Band, comparison_band
from bearingcore.diagnosis.size.variants import PathTolerances, Tolerances
from bearingcore.dynamics.modes import frequency_bands
from bearingcore.dynamics.status import MotionStatus
from bearingcore.scene.defect import Defect
from bearingcore.scene.scene import MASSLESS, Scene
from bearingcore.scene.support import Support
from bearingcore.signals.averaging import BallPasses, average_passes
from bearingcore.signals.recording import Recording
from bearingcore.signals.spectrum import check_samples
from bearingcore.statics.passes import crossings

MOST_STEPS = 100_000_000
"""Steps of integration of all simulations together, by default: ten times what a usual
scene takes, about a minute of one core."""

TEMPERATURE = 3.0
"""By which scores are divided before they become probabilities."""

WITHIN_TEMPERATURE = 1.0
"""The same for extents nearly as good that are less than half a ball spacing away: it makes the
stated standard deviation that of the errors (`python -m tests.benchmarks.path_effects`)."""

SLACK = 0.25
"""Of the variance that the extent has where what is left is all that models err by: it counts with
what is left by its lever on the extent. Both, and `WITHIN_TEMPERATURE`, were chosen on scenes other
than those that are scored."""

SPREAD_FLOOR = math.radians(0.02)
"""[rad] No extent is better known than what is simulated of it."""

WIDEST = 0.1
"""Of a ball spacing: where extents that are nearly as good differ by more than this (their
standard deviation at `TEMPERATURE`), no size is given."""

CLEAR = 0.9
"""Probability from which a candidate counts as found."""

MUCH_UNEXPLAINED = 0.2
"""Part of the mean ball pass without noise: where the best candidate leaves more, none is it."""

PIT = math.radians(2.0)
"""[rad] Extents up to which a defect counts as a pit."""

PIT_UNEXPLAINED = 0.45
"""The same for pits, of which only a bound or a small extent is given."""

MOST_IN_ONE, FEWEST_HARMONICS = 0.5, 2.5
"""Part of the mean ball pass that one harmonic may carry, and by how many it is carried at least:
a tone that happens to be on a harmonic is not a defect."""

LEAST_CHANCE = 0.05
"""Part of passes with phases drawn anew that may be explained as well as the measured one."""

OUTER, INNER = "outer race", "inner race"
AT_MOST, AT_LEAST = "at most", "at least"

LEAST_PROMINENCE = 6.0
"""Of the ball-pass lines, in standard deviations: noise alone reaches 5."""

EVENTS_REACH = 3.3
"""Times the highest compared frequency over 1.35 up to which knocks are looked for."""


@dataclass(frozen=True)
class Candidate:
    """An extent that the time between entry and exit allows.

    Attributes
    ----------
    turns
        k, whole ball spacings in the extent.
    extent
        [rad]
    probability
        that this candidate is the true one, among all candidates.
    edge
        the edge model that fits best.
    factors
        by what the scene's numbers are multiplied to fit best, by name.
    waveform_misfit, spectrum_misfit : (d,)
        what is left unexplained of the mean ball pass; mean squared natural logarithm of the ratio
        of the smoothed spectra.
    level
        natural logarithm of simulated over measured power.
    scene
        the fitted scene: its modes, bands, motion and spectrum are the candidate's.
    passes
        its simulated ball passes.
    lag
        ball-pass phase [rad] of the simulation at which the measured signal begins.
    path
        path between housing and sensor, of those that were tried.
    """

    turns: int
    extent: float
    probability: float
    edge: str
    factors: dict[str, float]
    waveform_misfit: NDArray[np.float64]
    spectrum_misfit: NDArray[np.float64]
    level: float
    scene: Scene = field(repr=False)
    passes: BallPasses = field(repr=False)
    lag: float = field(repr=False)
    path: PathModel = DIRECT

    @cached_property
    def bands(self) -> dict[str, tuple[float, float]]:
        """Least and greatest natural frequency [Hz] of each mode, by label."""
        return frequency_bands(self.scene)

    def waveform(self, n: int, lowest: float = 0.0) -> NDArray[np.float64]:
        """The simulated mean pass (n, d), laid over the measured one."""
        turn = np.exp(1j * self.lag * np.arange(1, len(self.passes.harmonics) + 1))
        moved = dataclasses.replace(self.passes, harmonics=self.passes.harmonics * turn[:, None])
        return moved.waveform(n, lowest)

    def phases(self) -> tuple[float, float]:
        """Phases [rad] of the measured ball pass at which balls enter and leave."""
        spacing = self.scene.bearing.ball_spacing
        found = {}
        for crossing in crossings(self.scene, 0.0, spacing):
            found[crossing.enters] = 2.0 * math.pi * crossing.cage_angle / spacing - self.lag
        return found[True] % (2.0 * math.pi), found[False] % (2.0 * math.pi)


@dataclass(frozen=True)
class Sizing:
    """Result of sizing a defect by a signal.

    Attributes
    ----------
    candidates
        by rising extent; their probabilities add up to 1. None where no extent was looked for.
    extent_uncertainty
        standard deviation [rad] of the extent if the most probable candidate is the true one.
    status
        a sentence: how sure the answer is, or why there is none.
    conclusive
        whether one candidate is clearly ahead of all the others, and its extent is not a bound.
    bound
        "at most" or "at least" where the best extent is at an end of the search; else "".
    diagnosis
        which part the signal names; None where it was given by hand.
    quality
        what the mean ball pass consists of.
    chance
        how often a pass of such a spectrum is explained as well with its phases drawn anew.
    apart
        spread [rad] of extents that explain it nearly as well, in half a ball spacing.
    path
        what was allowed for between housing and sensor.
    events
        entry and exit as found in the signal alone, and the paper's Δt.
    passes
        the measured mean ball pass and spectrum.
    band
        frequencies that were compared.
    recording
        the signal.
    supports
        what each support that was tried makes of the signal, where it is not known; else none.
    """

    candidates: tuple[Candidate, ...]
    extent_uncertainty: float
    status: str
    conclusive: bool
    events: Events
    passes: BallPasses
    band: Band
    recording: Recording = field(repr=False)
    scores: NDArray[np.float64] = field(repr=False)
    """(candidates,) before the temperature."""
    quality: PassQuality
    chance: float = math.nan
    apart: float = 0.0
    bound: str = ""
    diagnosis: Diagnosis | None = None
    supports: tuple[SupportTrial, ...] = ()
    path: PathTolerances = field(default_factory=PathTolerances)

    def table(self) -> ResultTable:
        """A row a candidate: extent, probability, edges, misfits, what was varied with it."""
        candidates = self.candidates
        return table_of(
            ("extent", "rad", [c.extent for c in candidates]),
            ("ball_spacings", "", [c.turns for c in candidates], "whole ball spacings in it"),
            ("probability", "1", [c.probability for c in candidates]),
            ("edge", "", [c.edge for c in candidates]),
            ("waveform_misfit", "1", [c.waveform_misfit.mean() for c in candidates]),
            ("spectrum_misfit", "1", [c.spectrum_misfit.mean() for c in candidates]),
            *(
                (f"{name}_factor", "1", [c.factors[name] for c in candidates])
                for name in (candidates[0].factors if candidates else ())
            ),
        )

    @property
    def time_difference(self) -> float:
        """Δt [s] from a ball entering to the next that leaves, by the most probable candidate.

        What its extent leaves over whole ball spacings, at the speed of the measured cage. The
        knocks in the signal are closer together (`events`): a ball loses its load a little inside
        the edge and takes it up again before the other.
        """
        best = self.best
        spacing = best.scene.bearing.ball_spacing
        return (best.extent - best.turns * spacing) / (spacing * self.passes.frequency)

    @property
    def resolved(self) -> float:
        """The extent [rad] that a ball passes in a cycle of the highest compared frequency."""
        spacing = self.best.scene.bearing.ball_spacing
        return spacing * self.passes.frequency / self.band.highest

    def end(self, bound: str) -> float:
        """Length [rad] of the defect at most, or at least, by `bound`."""
        room = 2.0 * self.extent_uncertainty
        if bound == AT_MOST:
            return max(self.best.extent + room, self.resolved)
        return self.best.extent - room

    @property
    def best(self) -> Candidate:
        """The most probable candidate. ValueError, with the status, where there is none."""
        if not self.candidates:
            raise ValueError(self.status)
        return max(self.candidates, key=lambda candidate: candidate.probability)

    def event_times(
        self, candidate: Candidate | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Times [s] in the recording at which balls enter and leave the defect.

        By a candidate's simulation, or by the signal alone where it is None.
        """
        entry, leave = (
            candidate.phases()
            if candidate is not None
            else (self.events.entry_phase, self.events.exit_phase)
        )
        duration, frequency = self.recording.duration, self.passes.frequency
        turns = np.arange(-1.0, math.floor(duration * frequency) + 2.0)

        def times(phase: float) -> NDArray[np.float64]:
            all_times = self.passes.time_of(turns + phase / (2.0 * math.pi))
            return np.asarray(all_times[(all_times >= 0.0) & (all_times <= duration)])

        return times(entry), times(leave)


def size_defect(
    recording: Recording,
    scene: Scene,
    *,
    fault: str | None = None,
    tolerances: Tolerances | None = None,
    path: PathTolerances | None = None,
    support_known: bool = True,
    slip: float = 0.02,
    most_steps: int = MOST_STEPS,
    most_samples: int = MOST_SAMPLES,
    progress: Callable[[float], None] | None = None,
) -> Sizing:
    """Candidates for the extent of a defect on the outer race, and their probabilities.

    Where the diagnosis does not name the outer race there are none, and the status says why.
    Inner races are not sized: their defect turns through the load zone, and no ball pass is like
    the next.

    Parameters
    ----------
    recording
        acceleration of the housing along y, or x and y: two directions say more.
    scene
        bearing, load, support and shaft speed of the machine, and a defect whose centre and
        nominal depth are taken as known; its extent is not looked at. Balls are taken to be
        massless: what is compared is far below their resonances.
    fault
        "outer race" where that is known from elsewhere: then there is no diagnosis. None: there
        is.
    tolerances
        how well the scene is known; None for the usual.
    path
        effects between the bearing's motion and its measurement; None for all that is known.
    support_known
        False where the scene's support is a guess: then others are tried, five times the work, and
        the answer holds what they differ by.
    slip
        by how much balls may pass faster or slower than the shaft speed says, as a fraction.
    most_steps
        steps of integration that may be taken in all. They are counted before the first: where
        there would be more there are no candidates, and the status says how many.
    most_samples
        of all directions that may be looked at.
    progress
        is called with the share of the work done, and may raise an exception to end it.

    Raises
    ------
    ValueError
        for a scene that is not fit for it, or a signal too short, too long or sampled too slowly.
    """
    check_samples("acceleration", recording.acceleration, most_samples)
    scene, columns = _prepared(scene.replace(balls=MASSLESS), recording.directions)
    slip = checks.number("slip", slip, at_least=0.0, at_most=0.1)
    tolerances = tolerances if tolerances is not None else Tolerances()
    path = path if path is not None else PathTolerances()
    if fault is not None:
        checks.choice("fault", fault, (OUTER,))
    band = comparison_band(scene, recording.sample_rate)
    passes = average_passes(
        recording.acceleration,
        recording.sample_rate,
        scene.bearing.bpfo(scene.shaft_speed),
        slip,
        band.lowest,
        band.highest,
        min(EVENTS_REACH * band.highest / 1.35, 0.4 * recording.sample_rate),
        follow=path.wandering_cage,
        coloured=path.coloured_noise,
        shaft=scene.shaft_speed / (2.0 * math.pi) if path.shaft_tones else None,
    )
    target = Target(passes, band)
    events = find_events(passes, scene, recording.directions)
    nothing = Sizing(
        (),
        math.nan,
        "",
        False,
        events,
        passes,
        band,
        recording,
        np.zeros(0),
        pass_quality(target),
        path=path,
    )
    if fault is None:
        found_fault = diagnose(
            recording, scene.bearing, scene.shaft_speed, slip=slip, most_samples=most_samples
        )
        nothing = dataclasses.replace(nothing, diagnosis=found_fault, status=_no_size(found_fault))
        if found_fault.fault != OUTER:
            return nothing
    spacing = scene.bearing.ball_spacing

    def cell(difference: float) -> int:
        return round(difference / spacing)

    most_steps = checks.whole_number("most_steps", most_steps, at_least=1, at_most=10**12)
    progress = progress if progress is not None else _go_on
    tried = [("as given", scene.support)] if support_known else other_supports(scene.support)
    steps = len(tried) * steps_needed(Search(scene, target, columns, tolerances, path.models))
    if steps > most_steps:
        cost = (
            f"{MotionStatus.TOO_MANY_STEPS}: about {thousands(steps)}, allowed are most_steps = "
            f"{thousands(most_steps)}"
        )
        return dataclasses.replace(nothing, status=cost)
    answers: list[Sizing] = []
    for number, (_, support) in enumerate(tried):
        search = Search(
            dataclasses.replace(scene, support=support), target, columns, tolerances, path.models
        )
        part = _share_of(progress, number, len(tried))
        found, chance = guesses(search, cell, part)
        answers.append(_answer(nothing, search, found, chance, cell))
    sized = answers[0]
    if not support_known:
        sized = _over_supports(answers, tried, cell)
    conclusive, bound, status = judged(sized)
    if sized.supports:
        status += dependence(sized.supports)
    return dataclasses.replace(sized, conclusive=conclusive, bound=bound, status=status)


def _share_of(
    progress: Callable[[float], None], number: int, count: int
) -> Callable[[float], None]:
    """Progress of one of several parts of the work."""
    return lambda share: progress((number + share) / count)


def _answer(
    nothing: Sizing,
    search: Search,
    found: list[Guess],
    chance: float,
    cell: Callable[[float], int],
) -> Sizing:
    """The candidates among the guesses, not yet judged."""
    best = found[0]
    in_cells: dict[int, Guess] = {}
    for guess in found:
        in_cells.setdefault(cell(guess.extent - best.extent), guess)
    chosen = [in_cells[number] for number in sorted(in_cells)]
    scores = np.array([guess.score for guess in chosen])
    weights = np.exp((scores - scores.max()) / TEMPERATURE)
    weights /= weights.sum()
    candidates = tuple(
        _candidate(search, guess, float(weight))
        for guess, weight in zip(chosen, weights, strict=True)
    )
    spread, apart = _spread(best, [g for g in found if cell(g.extent - best.extent) == 0])
    return dataclasses.replace(
        nothing,
        candidates=candidates,
        extent_uncertainty=spread,
        apart=apart,
        scores=scores,
        chance=chance,
    )


def _over_supports(
    answers: list[Sizing], tried: list[tuple[str, Support]], cell: Callable[[float], int]
) -> Sizing:
    """The answer of the support that explains the signal best, and what the others say to it.

    Supports count by how well they explain the signal: a candidate's probability is that over all
    of them, and its uncertainty holds what they differ by.
    """
    heights = np.array([float(one.scores.max()) for one in answers])
    weights = np.exp((heights - heights.max()) / TEMPERATURE)
    # of a support whose candidates share the probability all of them count
    weights *= [1.0 / one.best.probability for one in answers]
    weights /= weights.sum()
    leading = answers[int(heights.argmax())]
    middle = leading.best.extent
    inside: dict[int, float] = {}
    variance = total = 0.0
    for weight, one in zip(weights.tolist(), answers, strict=True):
        for candidate in one.candidates:
            place = cell(candidate.extent - middle)
            inside[place] = inside.get(place, 0.0) + weight * candidate.probability
            if place == 0:
                share = weight * candidate.probability
                total += share
                variance += share * (one.extent_uncertainty**2 + (candidate.extent - middle) ** 2)
    candidates = tuple(
        dataclasses.replace(c, probability=inside[cell(c.extent - middle)])
        for c in leading.candidates
    )
    trials = tuple(
        SupportTrial(
            words,
            support,
            one.best.extent,
            one.extent_uncertainty,
            one.best.probability,
            float(one.best.waveform_misfit.mean()),
            weight,
        )
        for (words, support), one, weight in zip(tried, answers, weights.tolist(), strict=True)
    )
    spread = math.sqrt(variance / total)
    return dataclasses.replace(
        leading, candidates=candidates, extent_uncertainty=spread, supports=trials
    )


def _go_on(share: float) -> None:
    """Progress that is not shown."""


def _prepared(scene: Scene, directions: tuple[str, ...]) -> tuple[Scene, tuple[int, ...]]:
    """The scene with a nominal extent, and the columns of its motion that were measured."""
    if not isinstance(scene.defect, Defect):
        raise checks.refuse("defect", f"{len(scene.defect)} defects", "a single one")
    if scene.defect.race != "outer":
        raise checks.refuse("race", scene.defect.race, "outer: an inner-race defect turns")
    if scene.defect.floor is not None:
        raise checks.refuse("floor", "uneven", "a flat floor")
    checks.number("depth", scene.defect.depth, above=0.0, unit="m")
    checks.number("shaft_speed", scene.shaft_speed, above=0.0, unit="rad/s")
    if not scene.bearing.rows_are_alike:
        raise ValueError(
            "rows are not alike; allowed: rows alike: else no ball pass is like the next"
        )
    if scene.bearing.n_balls < 3:
        raise checks.refuse("n_balls", scene.bearing.n_balls, "at least 3")
    missing = [name for name in directions if name not in scene.active_dofs]
    if missing:
        raise checks.refuse("dofs", scene.active_dofs, "with " + ", ".join(missing))
    columns = tuple(scene.active_dofs.index(name) for name in directions)
    return scene.replace(extent=0.5), columns


def _candidate(search: Search, guess: Guess, probability: float) -> Candidate:
    names = [f.name for f in dataclasses.fields(search.tolerances)]
    exponents = guess.offsets * search.tolerances.spread
    factors = {name: math.exp(x) for name, x in zip(names, exponents.tolist(), strict=True)}
    return Candidate(
        turns=math.floor(guess.extent / search.scene.bearing.ball_spacing),
        extent=guess.extent,
        probability=probability,
        edge=guess.edge,
        factors=factors,
        waveform_misfit=guess.waveform_misfit,
        spectrum_misfit=guess.spectrum_misfit,
        level=guess.level,
        scene=search.varied(guess.extent, guess.edge, guess.offsets),
        passes=guess.passes,
        lag=guess.lag,
        path=guess.path,
    )


def _spread(best: Guess, others: list[Guess]) -> tuple[float, float]:
    """Standard deviation [rad] of the extent, and how far apart extents nearly as good are.

    Of the best guess it is what is left unexplained, by the lever that it has on the extent (the
    sandwich of curvatures); guesses nearly as good add their distance. Never more than that of not
    knowing it at all.
    """
    behind = np.array([g.score for g in others]) - best.score
    away = np.array([g.extent - best.extent for g in others])

    def between(temperature: float) -> float:
        weights = np.exp(behind / temperature)
        return float((weights * away**2).sum() / weights.sum())

    own = best.extent_scatter**2 + SLACK * best.extent_spread**2
    spread = math.sqrt(own + between(WITHIN_TEMPERATURE) + SPREAD_FLOOR**2)
    unknown = (GREATEST_EXTENT - LEAST_EXTENT) / math.sqrt(12.0)
    return min(spread, unknown), math.sqrt(between(TEMPERATURE))


def _no_size(found: Diagnosis) -> str:
    """Why no extent is looked for where the outer race is not named."""
    words = found.status
    if found.fault == INNER:
        words += (
            " The defect of an inner race turns with the shaft, so its size cannot be estimated "
            "this way."
        )
    return words


def judged(sized: Sizing) -> tuple[bool, str, str]:
    """Whether an answer is conclusive, whether it is a bound, and the sentence that says so."""
    best, passes, quality = sized.best, sized.passes, sized.quality
    spread = sized.extent_uncertainty
    size = with_deviation(math.degrees(best.extent), math.degrees(spread), "°")
    unexplained = float(best.waveform_misfit.mean())
    beside_noise = unexplained - quality.noise_share
    none = "The signal cannot tell the size of the defect: "
    refusal = ""
    if passes.prominence < LEAST_PROMINENCE and unexplained > 0.6:
        refusal = "no lines stand out at the ball-pass frequency of an outer-race defect."
    elif quality.strongest > MOST_IN_ONE or quality.harmonics < FEWEST_HARMONICS:
        refusal = (
            f"one harmonic carries {100.0 * quality.strongest:.0f} % of the mean ball pass, as a "
            "tone would; a defect's entry and exit show in many."
        )
    elif sized.chance > LEAST_CHANCE:
        refusal = (
            "no extent explains it better than it would explain a signal of the same spectrum "
            "by chance. Load, speed, support or bearing may not be those of this machine."
        )
    elif beside_noise > (MUCH_UNEXPLAINED if best.extent > PIT else PIT_UNEXPLAINED):
        refusal = (
            f"the best extent leaves {100.0 * unexplained:.0f} % of the mean ball pass "
            f"unexplained, of which {100.0 * quality.noise_share:.0f} % are noise. Load, "
            "speed, support or bearing may not be those of this machine."
        )
    elif abs(best.level) > math.log(10.0):
        decibels = 10.0 / math.log(10.0) * abs(best.level)
        than = "weaker" if best.level > 0.0 else "stronger"
        refusal = (
            f"most like {size}, but the signal is {decibels:.0f} dB {than} than such a defect "
            "gives: it may be in another unit, or have another cause."
        )
    if refusal:
        return False, "", none + refusal
    if best.probability < CLEAR:
        likely = [c for c in sized.candidates if c.probability >= 0.05]
        each = ", ".join(
            f"{math.degrees(c.extent):.1f}° ({probability(c.probability)})" for c in likely
        )
        return False, "", f"The signal cannot tell these apart: {each}."
    if sized.apart > WIDEST * best.scene.bearing.ball_spacing:
        low, high = (math.degrees(best.extent + way * sized.apart) for way in (-1.0, 1.0))
        return False, "", (
            f"The signal cannot tell the size of the defect: most like {size}, but extents from "
            f"{max(low, 0.0):.0f}° to {high:.0f}° explain it nearly as well."
        )  # fmt: skip
    pit = _like_a_pit(sized)
    if pit:
        return False, "", (
            f"The signal cannot tell the size of the defect: most like {size}, but as one ball "
            f"enters another leaves then, and a pit shorter than {math.degrees(pit):.1f}° gives "
            "nearly the same."
        )  # fmt: skip
    if best.extent < max(sized.resolved, LEAST_EXTENT + 2.0 * spread):
        most = math.degrees(sized.end(AT_MOST))
        words = f"The defect extends over {most:.1f}° at most: shorter ones are not told apart."
        return False, AT_MOST, words
    if GREATEST_EXTENT - best.extent < max(2.0 * spread, EXTENT_STEP):
        least = math.degrees(sized.end(AT_LEAST))
        return False, AT_LEAST, f"The defect extends over {least:.1f}° at least."
    return (
        True,
        "",
        (
            f"The defect extends over {size}, {best.turns} whole ball spacings and a rest; "
            f"probability {probability(best.probability)}."
        ),
    )


def _like_a_pit(sized: Sizing) -> float:
    """Length [rad] of a pit that knocks as the best extent does; 0 where there is none.

    Whole ball spacings long, a defect is entered by one ball as another leaves it. The difference
    from a pit is how the rings swing between, and that rests on the support alone, which is never
    known so well; and pits are common.
    """
    best = sized.best
    spacing = best.scene.bearing.ball_spacing
    whole = round(best.extent / spacing)
    reach = PIT + 2.0 * sized.extent_uncertainty + 0.5 * sized.resolved
    return reach if whole >= 1 and abs(best.extent - whole * spacing) < reach else 0.0
