"""The signal of a session as it is now, and what has been found out about it.

Holds no Panel and draws nothing.
"""

from __future__ import annotations

import copy
import logging
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Self

from bearing_explorer.diagnosis.diagnoses import (
    Answers,
    Question,
    answered,
    extent_of,
)
from bearing_explorer.diagnosis.machine import FIELDS, of_scene
from bearing_explorer.diagnosis.measurement_state import (
    CHANGED,
    NOT_YET,
    REFUSED,
    MeasurementState,
)
from bearing_explorer.diagnosis.model import NOT_TAKEN, WANTED
from bearing_explorer.diagnosis.series import FoundTrend
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.sized_defect import SizedDefect
from bearing_explorer.kit.compute.jobs import EXTENT, PART, READING, Compute, Jobs, JobState
from bearingcore import Diagnosis, MeasuredExtent, Scene, Sizing, Table

log = logging.getLogger(__name__)


class Findings:
    """The signal of one session, its state, and the answers that are computed in the background.

    Parameters
    ----------
    scene
        gives the scene that may be measured, as it is now.
    jobs
        the background of the session.
    draw
        requests a drawing.
    """

    def __init__(
        self,
        scene: Callable[[], Scene],
        jobs: Jobs,
        draw: Callable[[], None],
    ) -> None:
        self.measured: Measured | None = None
        self.state = MeasurementState()
        #: called with the new state, for the form of the signal and for that of its machine
        self.show: Callable[[MeasurementState], None] = lambda _: None
        self.show_machine: Callable[[MeasurementState], None] = lambda _: None
        self._scene_now = scene
        self._jobs = jobs
        self._draw = draw
        #: which part is damaged, looked for in the background
        self.diagnoses: Answers[Diagnosis] = Answers(jobs, PART, draw, answered)
        #: how long the spall is, when that is known
        self.extents: Answers[MeasuredExtent] = Answers(jobs, EXTENT, draw, extent_of)
        #: the newest trend of files, and the kind of the machine for the zone of its vibration
        self.trend: FoundTrend | None = None
        self.machine_kind = ""
        #: the newest choice between lengths of the spall, of whichever signal
        self.sized: SizedDefect | None = None
        self._scene = of_scene(scene())
        self._table: Table | None = None  # with the roles of its columns as they are given
        self._ended = False

    def stop(self) -> None:
        """The session is over."""
        self._ended = True
        self._table = self.sized = self.trend = None
        self.diagnoses.stop()
        self.extents.stop()
        self._jobs.drop(READING)

    # What was found

    def question(self) -> Question | None:
        """The newest question of which part is damaged.

        None where nothing is measured, or nothing says on which bearing.
        """
        measured = self.measured
        if measured is None or measured.bearing is None:
            return None
        return Question.about(measured)

    def diagnosis(self) -> Diagnosis | None:
        """The answer to it, where there is one already."""
        question = self.question()
        answer = None if question is None else self.diagnoses.of(question)
        return answer if isinstance(answer, Diagnosis) else None

    def extent(self) -> MeasuredExtent | None:
        """The newest answer to how long the spall is, where there is one already."""
        question = self.question()
        answer = None if question is None else self.extents.latest(question)
        return answer if isinstance(answer, MeasuredExtent) else None

    def sizing(self) -> Sizing | None:
        """The choice between lengths of the spall, of this signal on the machine of now."""
        sized = self.sized
        if sized is None or self.measured is None:
            return None
        return sized.sizing if sized.is_of(self.measured, self._scene_now()) else None

    @property
    def shaft_speed(self) -> float | None:
        """[rad/s] that is known, or was found with the bearing; None where neither is.

        It is not looked for without the bearing: knocks of a race repeat more clearly than turns of
        the shaft, and would be taken for them.
        """
        measured = self.measured
        if measured is None:
            return None
        if measured.machine.exact_speed is not None:
            return measured.machine.exact_speed
        diagnosis = self.diagnosis()
        return None if diagnosis is None else diagnosis.shaft_speed

    @property
    def out_of_date(self) -> str:
        """Why the answer that may be on screen is not that of now; empty where it is."""
        question = self.question()
        if self.measured is not None and self.state.refused:
            return REFUSED
        if self.state.settling:
            return CHANGED
        return NOT_YET if question is not None and self.diagnoses.of(question) is None else ""

    @property
    def at_work(self) -> str:
        """Work that is under way, or a refusal, for the status line; empty where nothing is."""
        if self.state.busy:
            return "Reading the signal"
        if self.out_of_date in (CHANGED, NOT_YET) or self.extents.busy:
            return "Analysing the signal"
        state = self.state
        drawn = self._table is None or state.line
        missing = not any(state.values.get(name) for name in state.refused)
        if not drawn and missing and (state.refused or not state.bad):
            return WANTED
        if state.bad:  # what the form on the machine refuses stands in it
            return NOT_TAKEN.format(2 if state.line and set(state.refused) & set(FIELDS) else 1)
        return ""

    def snapshot(self) -> Self:
        """A copy for another thread: what is measured and found by now."""
        made = copy.copy(self)
        made.diagnoses, made.extents = copy.copy(self.diagnoses), copy.copy(self.extents)
        return made

    # Saying and doing

    def _refuse(self, sentence: str, lines: str = "") -> None:
        """Say what is wrong with a file, above its first lines; the signal before it stays."""
        self._tell(words=f"{sentence}{self._what_stays()}", bad=True, busy=False, lines=lines)

    def _what_stays(self) -> str:
        if self.measured is not None:
            return f" {self.measured.recording.name} stays."
        return (
            ""
            if self._table is None
            else f" The questions are still those about {self._table.name}."
        )

    def _tell(self, **news: Any) -> None:
        before, self.state = self.at_work, replace(self.state, **{"lines": "", **news})
        self.show(self.state)
        self.show_machine(self.state)
        if self.at_work != before:
            self._draw()

    def _read(self, compute: Compute, take: Callable[[Any], None]) -> None:
        """Read something in place of what is being read; its refusal is a sentence."""

        def report(state: JobState) -> None:
            if state.mood == "failed":
                self._refuse(state.words)

        self._jobs.start(compute, take, report, READING)
