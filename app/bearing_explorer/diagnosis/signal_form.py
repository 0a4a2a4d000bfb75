"""The current signal of a session, the known facts on it, and a person's answers about it.

Nothing here uses Panel or draws.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, Self

from bearing_explorer.diagnosis.diagnoses import Answers, Question, diagnosis_of, extent_of
from bearing_explorer.diagnosis.form import (
    SIGNAL_FIELDS,
    SIZES,
    bearings_of,
    bounded_texts,
    columns_of,
    is_unchanged,
    is_voltage,
    load_of,
    machine_of,
    other_facts,
    proposed_unit,
    reasons,
    recordings_of,
    size_questions,
    speeds_of,
)
from bearing_explorer.diagnosis.machine import (
    FIELDS,
    FILE,
    GIVEN,
    GROUPS,
    NOT_KNOWN,
    SCENE,
    FormError,
    Machine,
    scene_machine,
)
from bearing_explorer.diagnosis.measurement_state import (
    CHANGED,
    NOT_YET,
    REFUSED,
    AboutMeasurement,
    MeasurementState,
    about_size,
    line_and_remarks,
    summary,
)
from bearing_explorer.diagnosis.model import NOT_TAKEN, WANTED
from bearing_explorer.diagnosis.reading import Arrival, Read, read_answers
from bearing_explorer.diagnosis.series import ComputedTrend, Series
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.sized_defect import SizedDefect
from bearing_explorer.kit.compute.jobs import EXTENT, PART, READING, Compute, Jobs, JobState, Work
from bearingcore import Diagnosis, MeasuredExtent, Scene, Sizing, Table, Trend

_WAITS = "Nothing is drawn yet:"
AS_GIVEN = "As you gave it."
EARLIER_SCENE = "The scene has changed since this signal was simulated: simulate it again."


class SignalForm:
    """The signal of one session, the form that a file and a person fill in, and the answers on it.

    Parameters
    ----------
    scene
        returns the current scene, which a person can measure instead of a machine.
    jobs
        the background jobs of the session.
    draw
        requests a drawing.
    """

    #: the files that were read
    series = Series()
    #: words for reports
    about = AboutMeasurement()
    #: True if there is a scene that can be simulated
    can_simulate = False
    _arrival: Arrival | None = None
    _as_read: Table | None = None
    # the form as the file filled it in, guesses that a person agreed to, answers that are kept from
    # the previous file, and the form of the drawn signal
    _first: Mapping[str, str] = MappingProxyType({})
    _agreed: Mapping[str, str] = MappingProxyType({})
    _kept: Mapping[str, str] = MappingProxyType({})
    _taken: Mapping[str, str] = MappingProxyType({})
    #: "bearing" and "speed" where a person has answered them for this file
    _answered: frozenset[str] = frozenset()
    _cut_words = ""  # a sentence on rows that were left out

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
        #: diagnoses of the damaged part, computed in the background
        self.diagnoses: Answers[Diagnosis] = Answers(jobs, PART, draw, diagnosis_of)
        #: extents of the spall, computed in the background
        self.extents: Answers[MeasuredExtent] = Answers(jobs, EXTENT, draw, extent_of)
        #: the newest trend of files, and the kind of the machine for the zone of its vibration
        self.trend: ComputedTrend | None = None
        self.machine_kind = ""
        #: the newest choice between lengths of the spall, for this signal or an earlier one
        self.sized: SizedDefect | None = None
        self._scene = scene_machine(scene())
        self._table: Table | None = None  # with the current roles of its columns
        self._ended = False

    def stop(self) -> None:
        """Drop the signal and all jobs: the session is over."""
        self._ended = True
        self._table = self.sized = self.trend = None
        self._as_read = self._arrival = None
        self.series = Series()
        self.diagnoses.stop()
        self.extents.stop()
        self._jobs.drop(READING)

    # What is known

    def question(self) -> Question | None:
        """Return the question about the damaged part of the current signal.

        None without a signal, and while its bearing is not known.
        """
        measured = self.measured
        if measured is None or measured.bearing is None:
            return None
        return Question.about(measured)

    def diagnosis(self) -> Diagnosis | None:
        """Return the answer to `question`, if there is one already."""
        question = self.question()
        answer = None if question is None else self.diagnoses.of(question)
        return answer if isinstance(answer, Diagnosis) else None

    def extent(self) -> MeasuredExtent | None:
        """Return the newest measured extent of the spall, if there is one already."""
        question = self.question()
        answer = None if question is None else self.extents.latest(question)
        return answer if isinstance(answer, MeasuredExtent) else None

    def sizing(self) -> Sizing | None:
        """Return the choice between lengths of the spall for this signal on the current machine."""
        sized = self.sized
        if sized is None or self.measured is None:
            return None
        return sized.sizing if sized.is_of(self.measured, self._scene_now()) else None

    @property
    def shaft_speed(self) -> float | None:
        """Shaft speed [rad/s] that is given or that the diagnosis shows; None without either.

        It is not searched for without the bearing: knocks of a race repeat more clearly than turns
        of the shaft, and would be mistaken for them.
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
        """Reason why the answer on screen is out of date; empty where it is not."""
        question = self.question()
        if self.measured is not None and self.state.refused:
            return REFUSED
        if self.state.settling:
            return CHANGED
        return NOT_YET if question is not None and self.diagnoses.of(question) is None else ""

    @property
    def at_work(self) -> str:
        """Work that is under way, or a refusal, for the status line; empty without either."""
        if self.state.busy:
            return "Reading the signal"
        if self.out_of_date in (CHANGED, NOT_YET) or self.extents.busy:
            return "Analysing the signal"
        state = self.state
        undrawn = self._table is not None and not state.line
        unanswered = not any(state.values.get(name) for name in state.refused)
        if undrawn and unanswered and (state.refused or not state.bad):
            return WANTED
        if state.bad:  # step 2 shows the refusals of the machine's form, step 1 all others
            return NOT_TAKEN.format(2 if state.line and set(state.refused) & set(FIELDS) else 1)
        return ""

    def snapshot(self) -> Self:
        """Return a copy of the current signal and answers for another thread."""
        copied = copy.copy(self)
        copied.diagnoses, copied.extents = copy.copy(self.diagnoses), copy.copy(self.extents)
        return copied

    # States and jobs

    def _refuse(self, sentence: str, lines: str = "") -> None:
        """Show what is wrong with a file, above its first lines; the previous signal stays."""
        self._update(words=f"{sentence}{self._what_stays()}", bad=True, busy=False, lines=lines)

    def _what_stays(self) -> str:
        if self.measured is not None:
            return f" {self.measured.recording.name} stays."
        if self._table is not None:
            return f" The questions are still those about {self._table.name}."
        return ""

    def _update(self, **news: Any) -> None:
        before, self.state = self.at_work, replace(self.state, **{"lines": "", **news})
        self.show(self.state)
        self.show_machine(self.state)
        if self.at_work != before:
            self._draw()

    def _read(self, compute: Compute, take: Callable[[Any], None]) -> None:
        """Start a job that reads, in place of the current one; a failure is shown as a sentence."""

        def report(state: JobState) -> None:
            if state.mood == "failed":
                self._refuse(state.words)

        self._jobs.start(compute, take, report, READING)

    # The form

    def take_scene(self) -> None:
        """Follow the scene: its bearing and speed count where a person chose them."""
        scene = self._scene_now()
        now = scene_machine(scene)
        if now != self._scene:
            self._scene = now
            self._follow()
        true_scene = None if self.measured is None else self.measured.true_scene
        remarks = EARLIER_SCENE if true_scene not in (None, scene) else ""
        if true_scene is not None and self.state.remarks != remarks:
            self._update(remarks=remarks)

    @property
    def trend_now(self) -> ComputedTrend | None:
        """The newest trend, if it belongs to the current files."""
        return self.trend if self.trend is not None and self.trend.series is self.series else None

    @property
    def whole_trend(self) -> Trend | None:
        """The trend, once it has a point for each file."""
        trend = self.trend_now
        return trend.trend if trend is not None and trend.complete else None

    @property
    def known_about(self) -> AboutMeasurement:
        """Machine, point and date of the signal, as typed or as its file states them."""
        typed, measured = self.about, self.measured
        if measured is None or measured.origin is None:
            return typed
        when, date = measured.recording.recorded, ""
        if when is not None:
            time = f", {when:%H:%M}" if when.hour or when.minute else ""
            date = f"{when:%d %B %Y}{time}, by the file"
        return AboutMeasurement(
            typed.machine or measured.origin.machine,
            typed.point or measured.origin.place,
            typed.date or date,
        )

    def _follow(self) -> None:
        """Update the machine of the signal from the form and the scene."""
        table, measured, values = self._table, self.measured, self.state.values
        if table is None or measured is None or self.state.settling:
            return
        if SCENE not in (values["bearing"], values["speed"]):
            return
        try:
            machine = machine_of(table, values, self._scene)
        except FormError as error:  # no bearing has the typed frequencies [Hz] at this speed
            self._update(words=str(error), bad=True, refused=error.sentences)
            return
        machine = self._confirmed(machine)
        if machine != measured.machine or self.state.refused:
            self.measured = replace(measured, machine=machine)
            words = self._summary(about_size(size_questions(table, values)))
            self._update(words=words, bad=False, refused={}, **self._in_short(values))

    def source_of(self, name: str) -> str:
        """Origin of the value of a field, in words; empty where there is no such field."""
        value = self.state.values.get(name, "")
        if not is_unchanged(name, value, self._first.get(name, "")):
            kept = self.state.kept_from if self._kept.get(name) == value else ""
            return f"Assumed, kept from the previous file, {kept}" if kept else "Given"
        return "" if name in self.state.open else self.state.reasons.get(name, "")

    @property
    def _changed(self) -> dict[str, str]:
        """The fields that are not as the file filled them in."""
        first = self._first
        return {name: text for name, text in self.state.values.items() if text != first.get(name)}

    @property
    def _given_machine(self) -> dict[str, str]:
        """The answers on the machine that a person gave for this file or an earlier one."""
        values = self.state.values if self._table is not None else {}
        names = {*self._answered, *self._kept} & set(GROUPS) & set(values)
        answered = [name for name in names if values[name] not in (NOT_KNOWN, FILE)]
        return {field: values[field] for name in answered for field in GROUPS[name]}

    def _confirmed(self, machine: Machine) -> Machine:
        """Return the machine, marked with what is kept from the previous file and what is given."""
        answered, source = self._answered, machine.bearing_source
        return replace(
            machine,
            kept=frozenset(GROUPS) & set(self._kept),
            guessed=machine.guessed - answered,
            bearing_source=GIVEN if "bearing" in answered and source == FILE else source,
        )

    def _take_as_given(self, *names: str) -> None:
        """Mark the current answers "bearing" or "speed" as given for this file."""
        self._answered |= {*names}
        fields = {field for name in names for field in GROUPS[name]}
        self._kept = {name: text for name, text in self._kept.items() if name not in fields}

    def confirm(self, *names: str) -> None:
        """Take the answers "bearing" or "speed" for this file, because a person confirms them."""
        self._take_as_given(*names)
        self.take_form(self.state.values)

    def forget_machine(self) -> None:
        """Ask for bearing and speed again, which were given for the previous file.

        Files of the previous machine are no series with this one.
        """
        self.series = Series() if self._table is None else Series().with_table(self._table)
        names = [name for name in GROUPS if name in self._kept]
        self._kept = {}  # whatever is typed from now on is given for this file
        self.take_form({**self.state.values, **dict.fromkeys(names, NOT_KNOWN)})

    def _take_read(self, read: Read) -> None:
        """Show a file that was just read in place of the previous one.

        The figures of the previous file go with it: none may appear under the new file's name.
        """
        table, before = read.table, "" if self._table is None else self._table.name
        self._table = self._as_read = table
        self._cut_words, self._first, self._agreed = read.cut, read.first, {}
        self._kept, self._answered = read.kept, frozenset()
        self._taken = read.form
        self.measured = None
        if read.signal is not None and not read.asks:
            self.measured = self._measured(read.signal)
            words, bad = self._summary(about_size(read.sizes)), False
        else:
            wanted = {**read.asks, **read.refused, **read.sizes}
            if not wanted.get("columns", "?").endswith(("?", "columns.")):  # there is no signal
                wanted = {"columns": wanted["columns"]}
            words = f"{table.name} is read. {_WAITS} {' '.join(wanted.values())}"
            bad = bool(read.refused) and not read.asks
        kept_from = (self.state.kept_from or before) if read.kept else ""
        self._update(
            **self._news(read, list(read.asks)) | {"kept_from": kept_from},
            words=words,
            bad=bad,
            busy=False,
            columns=columns_of(table),
            facts=other_facts(table),
            load=load_of(table),
            scaled=not table.full_scale_known,
            bearings=bearings_of(table),
            arrival=self.state.arrival + 1,
            **self._in_short(read.form),
        )
        self._follow()
        self._draw()

    def _news(self, read: Read, left: Sequence[str]) -> dict[str, Any]:
        """Return the state of the form after answers; questions on the fields `left` stay open."""
        table, form = read.table, read.form
        origins = {
            name: words if is_unchanged(name, form[name], self._first[name]) else AS_GIVEN
            for name, words in reasons(table).items()
        }
        return {
            "values": form,
            "refused": {name: words for name, words in read.refused.items() if name not in left},
            "reasons": origins | read.asks | read.sizes,
            "open": [*left, *read.sizes],
            "proposed": proposed_unit(table),
            "voltage": is_voltage(table, form),
            "recordings": self.state.recordings if form["part"] else recordings_of(table),
            "speeds": speeds_of(table),
            "settling": False,
            "kept_from": self.state.kept_from if self._kept else "",
        }

    def take_form(self, form: Mapping[str, str], sure: bool = False) -> None:
        """Take changed answers; with `sure`, a person also agrees to the guesses.

        An answer or an agreement settles an open question.
        """
        if self._ended or self._arrival is not None or self._table is None:
            return
        texts = bounded_texts(form, tuple(self.state.values))
        changed = {name: text for name, text in texts.items() if text != self._first[name]}
        if sure:
            agreed = {name: texts[name] for name in self.state.open if name not in SIZES}
            self._agreed = {**self._agreed, **agreed}
        before = self.state.values
        self._take_as_given(
            *(name for name, fields in GROUPS.items() if any(texts[f] != before[f] for f in fields))
        )
        self._update(values=texts, settling=True)
        scene, as_read = self._scene, self._as_read
        assert as_read is not None

        def read(work: Work) -> str:
            work.show(read_answers(as_read, changed, scene))
            return ""

        self._read(read, self._take_answers)

    def _take_answers(self, read: Read) -> None:
        before = self.measured
        if self._table is None:
            return
        if "columns" not in read.refused:
            # later answers start from the current roles of the columns
            self._table, self._first = read.table, {**read.first, "columns": self._first["columns"]}
        left = [name for name in read.asks if self._is_left(name, read.form[name])]
        news = self._news(read, left)
        if read.signal is None:
            stays = " The figures still show the signal as it was before." if before else ""
            self._update(words=f"{' '.join(read.refused.values())}{stays}", bad=True, **news)
            return
        if left:
            words = " ".join(read.asks[name] for name in left)
            self._update(words=f"{_WAITS} {words}", bad=False, **news)
            return
        same_signal = all(read.form[name] == self._taken[name] for name in SIGNAL_FIELDS)
        self._taken = read.form
        signal = self._measured(read.signal)
        if before is not None and same_signal and before.machine.ratio == signal.machine.ratio:
            # keep the results that were computed from the signal
            signal = replace(before, machine=signal.machine)
        self.measured = signal
        words = self._summary(about_size(read.sizes))
        self._update(words=words, bad=False, busy=False, **news, **self._in_short(read.form))
        self._follow()  # the scene may have changed while the form was read
        self._draw()

    def _is_left(self, name: str, text: str) -> bool:
        """True where a question still has its first answer, and nobody has agreed to that."""
        return text == self._first[name] and text != self._agreed.get(name)

    def _measured(self, signal: Measured) -> Measured:
        return replace(signal, machine=self._confirmed(signal.machine))

    def _summary(self, *more: str) -> str:
        notes = self.measured.recording.notes if self.measured is not None else ()
        words = (summary(self.measured), self._cut_words, *notes, *more)
        return " ".join(filter(None, words))

    def _in_short(self, form: Mapping[str, str]) -> dict[str, str]:
        return line_and_remarks(self.measured, self._table, form, self._first, self._cut_words)
