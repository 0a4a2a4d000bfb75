"""Diagnoses of the damaged part in the background: one for each recording and bearing.

Holds no Panel. A diagnosis takes from tenths of a second to seconds; pictures do not wait for it.
A view calls `of` for an answer that is there, and `want` for one that is not; when it has come,
everything is drawn again. Only the newest question is worked on.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field

from bearing_explorer.measurement.signal import Measured
from bearing_explorer.results.executors import JOBS
from bearing_explorer.results.jobs import Change
from bearing_explorer.state.sentences import sentence_of
from bearingcore import Bearing, Diagnosis, diagnose

log = logging.getLogger(__name__)

ROUGH = 0.1
"""By how much a rough shaft speed may be off, as a fraction."""

SPEEDS = {"given": "as given", "rough": "within 10 %", "unknown": "not known"}
"""Knowledge of the shaft speed, in words."""

SLIP = 0.02
"""By how much balls may pass faster or slower than the shaft speed says."""

FAILED = "The signal could not be analysed."

MOST_KNOWN = 12
"""Answers about one recording that are kept."""


@dataclass(frozen=True)
class Question:
    """A recording to diagnose, its bearing, and the knowledge of its shaft speed.

    Two are the same where a bearing's balls, diameters and contact angle are: nothing else of it
    counts.
    """

    measured: Measured
    bearing: Bearing = field(compare=False)
    speed: str = "given"
    geometry: tuple[float, ...] = ()

    @classmethod
    def about(cls, measured: Measured, bearing: Bearing, speed: str = "given") -> Question:
        """The question about a recording and a bearing; `speed` is one of SPEEDS."""
        geometry = (
            float(bearing.n_balls),
            bearing.ball_diameter,
            bearing.pitch_diameter,
            bearing.contact_angle,
            *(number for row in bearing.rows for number in row.own.values()),
        )
        return cls(measured, bearing, speed, geometry)

    @property
    def shaft_speed(self) -> float | tuple[float, float] | None:
        """[rad/s] as `diagnose` wants it."""
        speed = self.measured.shaft_speed
        if self.speed == "unknown":
            return None
        return ((1.0 - ROUGH) * speed, (1.0 + ROUGH) * speed) if self.speed == "rough" else speed


def answered(question: Question) -> Diagnosis | str:
    """The diagnosis, or a sentence where there can be none. For any thread."""
    try:
        return diagnose(
            question.measured.recording, question.bearing, question.shaft_speed, slip=SLIP
        )
    except ValueError as error:
        return sentence_of(error)
    except Exception:
        log.exception("a diagnosis failed")
        return FAILED


class Diagnoses:
    """The diagnoses of one session. `want` and `stop` belong on its event loop.

    Parameters
    ----------
    assign
        runs a change of the page's models and sends it, as `live.one_message` does.
    draw
        requests a drawing.
    """

    def __init__(
        self, assign: Callable[[Change], Awaitable[None]], draw: Callable[[], None]
    ) -> None:
        self._assign = assign
        self._draw = draw
        self._known: dict[Question, Diagnosis | str] = {}
        self._wanted: Question | None = None
        self._task: asyncio.Task[None] | None = None

    def of(self, question: Question) -> Diagnosis | str | None:
        """The answer, a sentence where there can be none, or None: not yet. For any thread."""
        return self._known.get(question)

    def newest(self, measured: Measured, bearing: Bearing) -> Diagnosis | None:
        """The diagnosis of a recording on a bearing, at the speed of the newest question."""
        speed = self._wanted.speed if self._wanted is not None else "given"
        answer = self._known.get(Question.about(measured, bearing, speed))
        return answer if isinstance(answer, Diagnosis) else None

    def keep(self, question: Question, answer: Diagnosis | str) -> None:
        """Keep an answer; those about other recordings leave, and the oldest."""
        kept = {q: a for q, a in self._known.items() if q.measured is question.measured}
        while len(kept) >= MOST_KNOWN:
            kept.pop(next(iter(kept)))
        self._known = kept | {question: answer}

    def want(self, question: Question) -> None:
        """Have it answered, in place of what was wanted before; without a loop nothing is."""
        self._wanted = question
        if question in self._known or not (self._task is None or self._task.done()):
            return
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:  # a view is drawn outside of a session
            return
        self._task = loop.create_task(self._work())

    def stop(self) -> None:
        """The session is over."""
        self._wanted = None
        self._known = {}
        if self._task is not None:
            self._task.cancel()
            self._task = None  # its last error knows where it was, which is in here

    async def _work(self) -> None:
        loop = asyncio.get_running_loop()
        while (question := self._wanted) is not None and question not in self._known:
            answer = await loop.run_in_executor(JOBS, answered, question)
            if self._wanted is None:
                return
            if self._wanted.measured is question.measured:
                self.keep(question, answer)
            if self._wanted == question:
                await self._assign(self._draw)
