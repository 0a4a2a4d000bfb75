"""Diagnoses of the damaged part, and extents of spalls, in the background.

Nothing here uses Panel. An answer takes from tenths of a second to seconds, and pictures do not
wait for it. A view calls `Answers.of` for an answer that is known, and `want` for one that is not.
When an answer arrives, everything is drawn again. Only the newest question is worked on.
"""

from __future__ import annotations

import asyncio
import dataclasses
import logging
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Generic, Self, TypeVar

from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.kit.compute.jobs import Jobs, Kind
from bearing_explorer.kit.sentences import sentence_of
from bearingcore import Bearing, Diagnosis, MeasuredExtent, diagnose, measure_extent

Result = TypeVar("Result")

log = logging.getLogger(__name__)

WHICH_BEARING = "Which bearing is it? Without it no damaged part can be named."

FAILED = "The signal could not be analysed."

BUSY = "The signal is being analysed."

MOST_KNOWN = 12
"""Largest number of answers about one recording that are kept."""


@dataclass(frozen=True)
class Question:
    """A recording to diagnose, its bearing, and the knowledge of its shaft speed.

    Two questions are equal if the recording, the speed, and the bearing's balls, diameters and
    contact angle are the same.

    Attributes
    ----------
    measured
        the signal, with the known facts on its machine.
    speed
        [rad/s] as `diagnose` takes it: a pair where it is rough, None where it is not known.
    geometry
        numbers of the bearing; empty where it is not known.
    """

    measured: Measured = field(compare=False)
    speed: float | tuple[float, float] | None
    geometry: tuple[float, ...]
    _recording: int

    @classmethod
    def about(cls, measured: Measured, **more: Any) -> Self:
        """The question about a recording and its machine."""
        bearing = measured.bearing
        numbers: tuple[float, ...] = ()
        if bearing is not None:
            numbers = (
                float(bearing.n_balls),
                bearing.ball_diameter,
                bearing.pitch_diameter,
                bearing.contact_angle,
                *(number for row in bearing.rows for number in row.own.values()),
            )
        speed = measured.machine.speed_range
        return cls(measured, speed, numbers, id(measured.recording), **more)

    @property
    def bearing(self) -> Bearing:
        """The measured bearing; ValueError where it is not known."""
        if self.measured.bearing is None:
            raise ValueError(WHICH_BEARING)
        return self.measured.bearing

    def is_like(self, other: Question) -> bool:
        """True where recording, bearing and knowledge of the speed are the same."""
        mine, theirs = ((q._recording, q.speed, q.geometry) for q in (self, other))
        return mine == theirs


@dataclass(frozen=True)
class ExtentQuestion(Question):
    """A diagnosed recording whose spall is to be measured; equal ones have equal bearings.

    `race`: "outer" or "inner" where it is known to be damaged, "" for what the diagnosis names;
    `load`: radial load on the bearing [N], where it is known.
    """

    whole: Bearing | None = None
    race: str = ""
    load: float | None = None
    diagnosis: Diagnosis | None = field(default=None, compare=False)


def diagnosis_of(question: Question) -> Diagnosis | str:
    """Return the diagnosis, or a sentence why there is none. For any thread."""
    recording = question.measured.recording
    return _result_or_reason(lambda: diagnose(recording, question.bearing, question.speed))


def extent_of(question: ExtentQuestion) -> MeasuredExtent | str:
    """Return the extent, or a sentence why there is none. For any thread."""

    def measure() -> MeasuredExtent:
        measured, bearing = question.measured, question.bearing
        extent = measure_extent(
            measured.recording,
            bearing,
            question.speed,
            race=question.race or None,
            load=measured.true_load or question.load,
            clearance=bearing.radial_clearance if measured.true_edge else None,
            edge=measured.true_edge,
            diagnosis=question.diagnosis,
        )
        unsized = measured.machine.by_frequencies
        return dataclasses.replace(extent, length=math.nan) if unsized else extent

    return _result_or_reason(measure)


def _result_or_reason(compute: Callable[[], Result]) -> Result | str:
    """Return the result; after a failure, a sentence with its reason."""
    try:
        return compute()
    except ValueError as error:
        return sentence_of(error)
    except Exception:
        log.exception("the analysis of a signal failed")
        return FAILED


class Answers(Generic[Result]):
    """The answers of one session. Call `want` and `stop` on its event loop.

    Parameters
    ----------
    jobs, kind
        the background jobs of the session, and the kind of these answers among them.
    draw
        requests a drawing.
    compute
        answers a question, in a thread of its own.
    """

    def __init__(
        self,
        jobs: Jobs,
        kind: Kind,
        draw: Callable[[], None],
        compute: Callable[[Any], Result | str],
    ) -> None:
        self._jobs, self._kind = jobs, kind
        self._draw = draw
        self._compute = compute
        self._known: dict[Question, Result | str] = {}
        self.wanted: Question | None = None

    def of(self, question: Question) -> Result | str | None:
        """Return the answer, a sentence why there is none, or None: not yet. For any thread."""
        return self._known.get(question)

    @property
    def busy(self) -> bool:
        """True while a question waits for its answer."""
        return self.wanted is not None and self.wanted not in self._known

    def latest(self, about: Question) -> Result | str | None:
        """Return the newest answer about a recording with its bearing and speed, if any."""
        known = reversed(self._known.items())
        alike = (answer for question, answer in known if about.is_like(question))
        return next(alike, None)

    def keep(self, question: Question, answer: Result | str) -> None:
        """Keep an answer; drop the oldest beyond `MOST_KNOWN`, and all about other recordings."""
        recording = question.measured.recording
        kept = {q: a for q, a in self._known.items() if q.measured.recording is recording}
        while len(kept) >= MOST_KNOWN:
            kept.pop(next(iter(kept)))
        self._known = kept | {question: answer}

    def want(self, question: Question) -> None:
        """Have a question answered in place of the previous one; needs a running event loop."""
        before, self.wanted = self.wanted, question
        if question in self._known or (question == before and self._jobs.busy(self._kind)):
            return
        try:
            asyncio.get_running_loop()
        except RuntimeError:  # a view is drawn outside of a session
            return
        self._jobs.answer(
            self._kind, lambda: self._compute(question), lambda answer: self._take(question, answer)
        )
        self._draw()  # the status says that something is under way

    def _take(self, question: Question, answer: Result | str) -> None:
        wanted = self.wanted
        if wanted is not None and wanted.measured.recording is question.measured.recording:
            self.keep(question, answer)
        self._draw()

    def stop(self) -> None:
        """Forget all answers: the session is over."""
        self.wanted = None
        self._known = {}
        self._jobs.drop(self._kind)
