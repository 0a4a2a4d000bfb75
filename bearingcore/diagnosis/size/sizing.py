"""The size of a defect from the vibration of the housing: analysis by synthesis.

The time from a ball's entry to a ball's exit gives the extent only up to whole ball spacings
(Petersen, Howard & Prime 2014, Section 4). So every extent is simulated in the scene as given, and
each candidate Δφ + k·360°/N_b judged by how well it explains the signal: the mean ball pass in both
directions and the spectrum. The answer is a probability for each candidate, and a word where there
is no clear result.

First comes the diagnosis, which needs no model of the machine: an extent is looked for only
where it names the outer race. Then the mean ball pass must be one: several harmonics, more than
noise (see `PassQuality`). Last, knocks in the envelope are held against the answer (see `judge`).
A machine whose support is not measured gets no size: natural frequencies count the ball spacings.

Quantity                                   | Symbol | Name           | Unit
------------------------------------------ | ------ | -------------- | ----
extent                                     | Δφ     | extent         | rad
whole ball spacings in it                  | k      | turns          |
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from bearingcore.common import checks
from bearingcore.common.numbers import thousands
from bearingcore.diagnosis.extent.measure import MeasuredExtent, measure_extent
from bearingcore.diagnosis.part.diagnose import MOST_SAMPLES, SLIP, diagnose
from bearingcore.diagnosis.part.parts import INNER, OUTER
from bearingcore.diagnosis.size.answer import Candidate, Sizing, SizingStatus
from bearingcore.diagnosis.size.judge import confirmed, judged
from bearingcore.diagnosis.size.matching import Target
from bearingcore.diagnosis.size.search import GREATEST_EXTENT, LEAST_EXTENT, Guess, Search
from bearingcore.diagnosis.size.simulation import comparison_band
from bearingcore.errors import FieldError
from bearingcore.scene.defect import Defect
from bearingcore.scene.scene import MASSLESS, Scene
from bearingcore.signals.averaging import average_passes
from bearingcore.signals.recording import Recording
from bearingcore.signals.spectrum import check_samples

MOST_STEPS = 100_000_000
"""Steps of integration of all simulations together, by default: thirty times what a usual
scene takes, about a minute of one core."""

TEMPERATURE = 3.0
"""By which scores are divided before they become probabilities."""

WITHIN_TEMPERATURE = 1.0
"""The same for extents nearly as good that are less than half a ball spacing away: it makes the
stated standard deviation that of the errors on rigs drawn by seed."""

SPREAD_FLOOR = math.radians(0.02)
"""[rad] No extent is better known than what is simulated of it."""

_TURNS = (
    "The defect of an inner race turns with the shaft, so its size cannot be estimated this way."
)

FOLLOWED = 3.3 / 1.35
"""Times the highest compared frequency up to which a cage that wanders is followed."""


def size_defect(
    recording: Recording,
    scene: Scene,
    *,
    fault: str | None = None,
    support_known: bool = False,
    most_steps: int = MOST_STEPS,
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
    support_known
        True where masses and stiffness of the support are measured ones, or the signal is a
        simulated one of the scene. Else there is no size, and the status says why.
    most_steps
        steps of integration that may be taken in all. They are counted before the first: where
        there would be more there are no candidates, and the status says how many.

    Raises
    ------
    ValueError
        for a scene that is not fit for it, or a signal too short, too long or sampled too slowly.
    """
    checks.instance("recording", recording, Recording)
    checks.instance("scene", scene, Scene)
    check_samples("acceleration", recording.acceleration, MOST_SAMPLES)
    scene, columns = _prepared(scene.replace(balls=MASSLESS), recording.directions)
    if fault is not None:
        checks.choice("fault", fault, (OUTER,))
    band = comparison_band(scene, recording.sample_rate)
    passes = average_passes(
        recording.acceleration,
        recording.sample_rate,
        scene.bearing.bpfo(scene.shaft_speed),
        SLIP,
        band.lowest,
        band.highest,
        min(FOLLOWED * band.highest, 0.4 * recording.sample_rate),
        follow=True,
        shaft=scene.shaft_speed / (2.0 * math.pi),
    )
    target = Target(passes, band)
    nothing = Sizing(
        (),
        math.nan,
        SizingStatus.OTHER_PART,
        "",
        passes,
        band,
        recording,
        target.quality,
    )
    if fault is None:
        found = diagnose(recording, scene.bearing, scene.shaft_speed)
        why = f"{found.sentence} {_TURNS}" if found.fault == INNER else found.sentence
        nothing = dataclasses.replace(nothing, diagnosis=found, sentence=why)
        if found.fault != OUTER:
            return nothing
    if not support_known:
        status = SizingStatus.SUPPORT_NOT_MEASURED
        return nothing.said(status, status.sentence)
    most_steps = checks.whole_number("most_steps", most_steps, at_least=1, at_most=10**12)
    search = Search(scene, target, columns)
    if search.steps > most_steps:
        cost = (
            f"{SizingStatus.TOO_MANY_STEPS}: about {thousands(search.steps)}, "
            f"allowed are most_steps = {thousands(most_steps)}"
        )
        return nothing.said(SizingStatus.TOO_MANY_STEPS, cost)
    sized = judged(_answer(nothing, search, search.guesses()))
    if sized.bound or sized.conclusive:
        return confirmed(sized, _knocks(sized, scene))
    return sized


def _knocks(sized: Sizing, scene: Scene) -> MeasuredExtent | FieldError:
    """The extent by the envelope, or why there is none under the scene's load or of its kind."""
    best = sized.best
    try:
        return measure_extent(
            sized.recording, scene.bearing, scene.shaft_speed, race="outer", edge=best.edge,
            load=math.hypot(best.scene.load.fx, best.scene.load.fy) or None,
            clearance=scene.bearing.radial_clearance,
        )  # fmt: skip
    except FieldError as refused:
        return refused


def _answer(nothing: Sizing, search: Search, found: list[Guess]) -> Sizing:
    """The candidates among the guesses, not yet judged."""
    best = found[0]
    in_cells: dict[int, Guess] = {}
    for guess in found:
        in_cells.setdefault(search.cell(guess.extent - best.extent), guess)
    chosen = [in_cells[number] for number in sorted(in_cells)]
    scores = np.array([guess.score for guess in chosen])
    weights = np.exp((scores - scores.max()) / TEMPERATURE)
    weights /= weights.sum()
    candidates = tuple(
        _candidate(search, guess, float(weight))
        for guess, weight in zip(chosen, weights, strict=True)
    )
    near = [guess for guess in found if search.cell(guess.extent - best.extent) == 0]
    spread, apart = _spread(best, search.spread(best), near)
    return dataclasses.replace(
        nothing, candidates=candidates, extent_uncertainty=spread, apart=apart
    )


def _prepared(scene: Scene, directions: tuple[str, ...]) -> tuple[Scene, tuple[int, ...]]:
    """The scene with a nominal extent, and the columns of its motion that were measured."""
    if not isinstance(scene.defect, Defect):
        raise checks.refuse("defect", f"{len(scene.defect)} defects", "a single one")
    if scene.defect.race != "outer":
        raise checks.refuse("race", scene.defect.race, "outer: an inner-race defect turns")
    if scene.defect.floor is not None:
        raise checks.refuse("floor", "uneven", "a flat floor")
    checks.real_number("depth", scene.defect.depth, above=0.0, unit="m")
    checks.real_number("shaft_speed", scene.shaft_speed, above=0.0, unit="rad/s")
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
    return Candidate(
        turns=math.floor(guess.extent / search.scene.bearing.ball_spacing),
        extent=guess.extent,
        probability=probability,
        edge=guess.edge,
        waveform_misfit=guess.match.waveform_misfit,
        spectrum_misfit=guess.match.spectrum_misfit,
        level=guess.match.level,
        scene=search.scene.replace(extent=guess.extent, edge=guess.edge),
    )


def _spread(best: Guess, own: float, others: list[Guess]) -> tuple[float, float]:
    """Standard deviation [rad] of the extent, and how far apart extents nearly as good are.

    Of the best guess it is its own, by the curvature of the score; guesses nearly as good add their
    distance. Never more than that of not knowing it at all.
    """
    behind = np.array([g.score for g in others]) - best.score
    away = np.array([g.extent - best.extent for g in others])

    def between(temperature: float) -> float:
        weights = np.exp(behind / temperature)
        return float((weights * away**2).sum() / weights.sum())

    spread = math.sqrt(own**2 + between(WITHIN_TEMPERATURE) + SPREAD_FLOOR**2)
    unknown = (GREATEST_EXTENT - LEAST_EXTENT) / math.sqrt(12.0)
    return min(spread, unknown), math.sqrt(between(TEMPERATURE))
