"""The measured signal of a session: an uploaded file, or a simulated measurement.

Holds no Panel and draws nothing. A file comes in pieces, is read in a thread of its own, and
opens a form with questions; its faults are sentences, and the signal before it stays.
"""

from __future__ import annotations

import asyncio
import cmath
import copy
import logging
import math
from collections.abc import Awaitable, Callable, Coroutine, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from bearing_explorer.diagnosis.background import noise_level, true_part
from bearing_explorer.diagnosis.diagnoses import (
    Answers,
    ListQuestion,
    Progress,
    Question,
    answered,
    extent_of,
    listed_of,
)
from bearing_explorer.diagnosis.form import (
    LIKELY,
    SIGNAL_FIELDS,
    SIZES,
    FormResult,
    ShownColumns,
    as_texts,
    bearings_of,
    columns_of,
    fill,
    is_voltage,
    load_of,
    machine_of,
    proposed_unit,
    questions,
    read_form,
    reasons,
    said,
    size_questions,
    speeds_of,
    usable,
)
from bearing_explorer.diagnosis.machine import FIELDS as MACHINE_FIELDS
from bearing_explorer.diagnosis.machine import (
    GIVEN,
    GROUPS,
    NOT_KNOWN,
    ROUGH,
    SCENE,
    SIMULATED,
    SPEED_SOURCES,
    FormError,
    Machine,
    answers_of,
    find_published,
    kept_answers,
    of_scene,
)
from bearing_explorer.diagnosis.model import motion as motion_of
from bearing_explorer.diagnosis.series import (
    MOST_FILES,
    Series,
    SeriesRecordings,
    recordings_of,
)
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.upload import NAME_IN_LINE, Upload, without_middle
from bearing_explorer.kit.bearing_list import BearingTable
from bearing_explorer.kit.compute.executors import FILES, in_thread
from bearing_explorer.kit.compute.jobs import Change
from bearing_explorer.kit.sentences import sentence_of
from bearing_explorer.kit.simulated_signals import MACHINES, NOISES, PITS
from bearingcore import (
    CatalogueBearing,
    Diagnosis,
    MeasuredExtent,
    Recording,
    Scene,
    Sizing,
    Table,
    join_tables,
    read_table,
)
from bearingcore.common import number, thousands, with_prefix
from bearingcore.diagnosis import ListedBearing, Tolerances, time_in, variant
from bearingcore.errors import FieldError
from bearingcore.files import files_inside
from bearingcore.scene import WITH_MASS, pit

log = logging.getLogger(__name__)

MOST_NUMBERS = 4_000_000
"""Numbers of a table that a session keeps; later rows are left out."""

RATE = 25_600.0
"""[Hz] of simulated measurements."""

PASSES = 200.0
"""Ball passes in one, where that is neither very short nor very long: enough to separate lines that
are one shaft frequency apart."""

SHORTEST, LONGEST = 1.0, 5.0  # [s]
SETTLING = 0.3  # [s] before a simulated measurement begins

FIRST_WORDS = (
    "No signal yet: choose a file with the acceleration of the housing, or simulate one with the "
    "current scene. Then the damaged part, the length of its spall, trend, indicators and spectra "
    "appear here."
)

_WITHOUT_SIZE = (
    "The diagnosis of the damaged part does not depend on it. The size of the defect and the "
    "comparison with the model wait for the answer."
)

NOT_SAID = "not said"
"""In a report, where nothing is known."""

NO_FILE_TO_COMPARE = "A file is compared with a file: choose the one to compare first."

REFUSED = "An answer on bearing, speed or columns is refused; this is for the one before."
CHANGED = "Your answers have changed since."
NOT_YET = "The signal is being analysed with the newest answers."
"""Why an answer is out of date, or not there yet."""


@dataclass(frozen=True)
class MeasurementState:
    """The state of the panels of a measurement."""

    words: str = FIRST_WORDS
    bad: bool = False
    busy: bool = False
    columns: ShownColumns | None = None
    values: dict[str, str] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)
    #: why the fields are filled in as they are
    reasons: dict[str, str] = field(default_factory=dict)
    #: fields that a person has to answer: before the signal is taken, or before it has a size
    open: list[str] = field(default_factory=list)
    #: the unit that is likely where the file does not say it, "" where none is; None if it does
    proposed: str | None = None
    #: other numbers and words of the file
    said: str = ""
    #: [N] in the file, None where it has none
    load: float | None = None
    scaled: bool = False
    #: whether the sensitivity of a sensor is needed
    voltage: bool = False
    #: bearings to choose from, as [value, words, heading], and answers on the speed
    bearings: list[list[str]] = field(default_factory=list)
    speeds: list[list[str]] = field(default_factory=list)
    #: whether changed answers are still being read
    settling: bool = False
    #: the file before, where bearing or speed are those that a person gave for that
    kept_from: str = ""
    #: files that can be joined to one signal
    parts: int = 0
    #: the signal in a line, as it is drawn; a guess has a question mark. Empty without a signal
    line: str = ""
    #: the whole name of its file, where the line has less of it
    whole_name: str = ""
    #: what is odd about the signal; empty where nothing is
    remarks: str = ""
    #: number of the file or simulation that is shown
    arrival: int = 0


@dataclass(frozen=True)
class AboutMeasurement:
    """Words for reports, which a person types once for all files of a session."""

    machine: str = ""
    point: str = ""
    date: str = ""


@dataclass(frozen=True)
class Sized:
    """The size that was found for a defect, with its signal and its scene."""

    measured: Measured
    scene: Scene
    sizing: Sizing


class Measurement:
    """The measurement of one session. Call its methods on the event loop of the session.

    Parameters
    ----------
    scene
        gives the scene that may be measured, as it is now.
    bearings
        to choose from.
    assign
        runs a change of the page's models and sends it, as `live.one_message` does.
    draw
        requests a drawing.
    """

    def __init__(
        self,
        scene: Callable[[], Scene],
        bearings: BearingTable,
        assign: Callable[[Change], Awaitable[None]],
        draw: Callable[[], None],
    ) -> None:
        self.measured: Measured | None = None
        self.sized: Sized | None = None
        self.state = MeasurementState()
        #: called with the new state, and with the first byte of the next piece of a file; the
        #: number `of` comes back with the piece, by which files are kept apart
        self.show: Callable[[MeasurementState], None] = lambda _: None
        #: the same, for the panel of the diagnosis
        self.show_machine: Callable[[MeasurementState], None] = lambda _: None
        self.want: Callable[[int, int], None] = lambda begin, of: None
        #: called when the next of several files may come
        self.more: Callable[[], None] = lambda: None
        #: words for reports
        self.about = AboutMeasurement()
        #: the files that were read
        self.series = Series()
        #: takes a message as the controls send it; None where there are no controls
        self.change_scene: Callable[[dict[str, Any]], None] | None = None
        self._scene_now, self._bearings = scene, bearings
        self._assign = assign
        self._draw = draw
        #: which part is damaged, looked for in the background
        self.diagnoses: Answers[Diagnosis] = Answers(assign, draw, answered)
        #: how long the spall is, when that is known
        self.extents: Answers[MeasuredExtent] = Answers(assign, draw, extent_of)
        #: listed bearings, where the one that is given does not explain the signal
        self.listed: Answers[tuple[ListedBearing, ...]] = Answers(assign, draw, listed_of)
        self._scene = of_scene(scene())
        self._arrival: _Arrival | None = None
        self._table: Table | None = None  # with the roles of its columns as they are given
        self._as_read: Table | None = None
        self._first: dict[str, str] = {}  # the form as it was filled in
        self._agreed: dict[str, str] = {}  # guesses that a person agreed to
        self._kept: dict[str, str] = {}  # answers that were given for the file before
        self._taken: dict[str, str] = {}  # the form of the signal as it is drawn
        self._parts: tuple[str, ...] = ()  # files that were joined to the one that is shown
        self._cut = ""
        self._upload: Upload | None = None
        self._latest = 0  # number of what was asked for last: what it overtook is dropped
        self._uploads = 0
        self._simulations = 0
        self._tasks: set[asyncio.Task[None]] = set()
        self._ended = False

    def stop(self) -> None:
        """The session is over."""
        self._ended = True
        self._upload = self._table = self._as_read = self._arrival = None
        self.series = Series()
        self.diagnoses.stop()
        self.extents.stop()
        self.listed.stop()
        for task in self._tasks:
            task.cancel()

    # The machine

    def take_scene(self) -> None:
        """Follow the scene: its bearing and speed count where a person chose them."""
        now = of_scene(self._scene_now())
        if now != self._scene:
            self._scene = now
            self._follow()

    def _follow(self) -> None:
        """Have the machine of the signal be as the form and the scene say it now."""
        table, measured, values = self._table, self.measured, self.state.values
        if table is None or measured is None or self.state.settling:
            return
        if SCENE not in (values["bearing"], values["speed"]):
            return
        try:
            machine = machine_of(table, values, self._scene, self._bearings.find)
        except FormError as error:  # frequencies in Hz that are those of no bearing at this speed
            self._tell(words=str(error), bad=True, refused=error.sentences)
            return
        machine = replace(machine, kept=self._kept_of(values))
        if machine != measured.machine or self.state.refused:
            self.measured = replace(measured, machine=machine)
            words = self._summary(_about_size(size_questions(table, values)))
            self._tell(words=words, bad=False, refused={}, **self._in_short(values))

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
        found = None if question is None else self.diagnoses.of(question)
        return found if isinstance(found, Diagnosis) else None

    def extent(self) -> MeasuredExtent | None:
        """The newest answer to how long the spall is, where there is one already."""
        question = self.question()
        found = None if question is None else self.extents.latest(question)
        return found if isinstance(found, MeasuredExtent) else None

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
        found = self.diagnosis()
        return None if found is None else found.shaft_speed

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
        """Work that is under way, for the status line; empty where nothing is."""
        if self.state.busy:
            return "Reading the signal"
        if self.out_of_date in (CHANGED, NOT_YET) or self.extents.busy:
            return "Analysing the signal"
        return "Searching the list of bearings" if self.listed.busy else ""

    def listed_question(self, about: Question) -> ListQuestion:
        """The question which of the listed bearings explain a recording."""
        named = {one.name: one.bearing for one, _ in self._bearings.all()}
        try:
            loop = asyncio.get_running_loop()
            progress = Progress(lambda: loop.call_soon_threadsafe(self._draw))
        except RuntimeError:  # a view is drawn outside of a session
            progress = Progress()
        return ListQuestion.about(about.measured, bearings=named, progress=progress)

    def snapshot(self) -> Measurement:
        """A copy for another thread: what is measured and found by now."""
        made = copy.copy(self)
        made.diagnoses, made.extents = copy.copy(self.diagnoses), copy.copy(self.extents)
        made.listed = copy.copy(self.listed)
        return made

    def source_of(self, name: str) -> str:
        """Where the value of a field comes from; empty where there is no such field."""
        value = self.state.values.get(name, "")
        if value != self._first.get(name, ""):
            kept = self.state.kept_from if self._kept.get(name) == value else ""
            return f"Given for the file before, {kept}" if kept else "Given"
        return "" if name in self.state.open else self.state.reasons.get(name, "")

    def origin_of(self, name: str) -> str:
        """Whether a field is given, from the file or assumed, with its reason, for a report."""
        words = self.source_of(name)
        for before, after in _ORIGINS.items():
            if words.startswith(before):
                return f"{after} {words.removeprefix(before).strip()}".strip()
        if words.startswith("Given") or not words:
            return words
        return f"From the file, {words[0].lower()}{words[1:]}"

    @property
    def recorded(self) -> str:
        """When the signal was recorded, as a person or the name of the file says."""
        if self.about.date:
            return self.about.date
        when = None if self.measured is None else time_in(self.measured.recording.name)
        return NOT_SAID if when is None else f"{when:%d %B %Y, %H:%M}, by the name of the file"

    # Files

    def begin_upload(
        self,
        name: str,
        size: int,
        number: int = 1,
        count: int = 1,
        chosen: int = 1,
        baseline: bool = False,
    ) -> None:
        """A file is about to come, so long [bytes]; the `number`th of `count`, see `UploadBegins`.

        The last of several that can be read is the one that is shown. A `baseline` is put before
        the others, and the one that is shown stays.
        """
        if self._ended:
            return
        if baseline and self._table is None:
            self._refuse(NO_FILE_TO_COMPARE)
            return
        if number == 1:
            self._latest += 1
            # a file that comes alone is a series with those before it
            several = 1 < count <= MOST_FILES
            series = Series(together=True) if several else replace(self.series, together=False)
            self._arrival = _Arrival(count if several else 1, chosen, series, baseline=baseline)
        arrival = self._arrival
        if arrival is None or number not in (1, arrival.number + 1):
            return  # of files that were given up
        self._uploads += 1
        arrival.number = number
        try:
            self._upload = Upload(name, size)
        except ValueError as error:
            self._upload = None
            self._take_next(arrival, [(name, str(error))])
        else:
            words = f"Uploading {arrival.words}{self._upload.name} …"
            self._tell(words=words, bad=False, busy=True)
            self.want(0, self._uploads)

    def cancel(self) -> None:
        """Give up the files that are being uploaded or read; the signal before them stays."""
        self._latest += 1
        self._uploads += 1
        self._upload = self._arrival = None
        self._tell(words=f"Cancelled.{self._what_stays()}", bad=False, busy=False)

    def take_piece(self, content: bytes, of: int) -> None:
        """A piece of the file of the upload with the number `of`."""
        upload, arrival = self._upload, self._arrival
        if upload is None or arrival is None or of != self._uploads:
            return
        try:
            upload.take(content)
        except ValueError as error:
            self._upload = None
            self._take_next(arrival, [(upload.name, str(error))])
            return
        if not upload.whole:
            self.want(upload.length, self._uploads)
            return
        self._upload = None
        words = f"Reading {arrival.words}{upload.name} …"
        self._tell(words=words, bad=False, busy=True)
        scene, find, kept = self._scene, self._bearings.find, self._given_machine
        content, request = upload.content, self._latest

        def read_or_why(name: str) -> _Read | str:
            try:
                return read_file(name, content, scene, find, kept)
            except ValueError as error:
                return str(error)
            except Exception:
                log.exception("a file could not be read")
                return f"{name} could not be read."

        def read_all() -> list[tuple[str, _Read | str]]:
            try:
                names = files_inside(upload.name, content)[:MOST_FILES]
            except ValueError:
                names = [upload.name]  # which says why
            return [(name, read_or_why(name)) for name in names if request == self._latest]

        take = lambda found: self._take_next(arrival, found)  # noqa: E731
        self._in_background(read_all, take, upload.name)

    def _take_next(self, arrival: _Arrival, files: Sequence[tuple[str, _Read | str]]) -> None:
        """Take what came: each file, or a sentence on why it cannot be read."""
        if len(files) > 1 and arrival.count == 1 and not arrival.baseline:  # in a zip
            arrival.series = Series(together=True)
        for name, found in files:
            arrival.take(name, found, len(files))
        if arrival.number < arrival.count:
            self.more()
            return
        self._arrival = None
        if arrival.newest is None:
            none = f"None of {arrival.count} files can be read. "
            self._refuse(f"{none if arrival.count > 1 else ''}{arrival.why}")
            return
        self.series = arrival.series
        if arrival.baseline:
            self._take_baseline(arrival.newest.table.name)
        else:
            self._take_read(arrival.newest)

    def _take_baseline(self, name: str) -> None:
        """The files of the series are compared with the first one, which came now."""
        self.series = replace(self.series, together=True)
        words = (
            f"{name} is what {'' if self._table is None else self._table.name} is compared with."
        )
        self._tell(words=f"{words} See the trend below.", bad=False, busy=False)
        self._draw()

    def recordings(self, shown: Measured, direction: str) -> SeriesRecordings:
        """The recordings of the series; for any thread."""
        given = self.state.values
        kept = {name: text for name, text in self._kept.items() if given.get(name) == text}
        changed = {name: text for name, text in self._changed.items() if name not in kept}
        return recordings_of(
            self.series, shown, changed, kept, direction, self._scene, self._bearings.find
        )

    @property
    def _changed(self) -> dict[str, str]:
        """The fields that are not as the file filled them in."""
        first = self._first
        return {name: text for name, text in self.state.values.items() if text != first.get(name)}

    @property
    def _given_machine(self) -> dict[str, str]:
        """The answers on the machine that a person gave for this file or for one before."""
        values = self.state.values
        return answers_of(values, self._first) if self._table is not None else {}

    def _kept_of(self, form: Mapping[str, str]) -> frozenset[str]:
        """The answers on the machine that are still those for the file before."""
        kept = self._kept
        return frozenset(
            name for name, fields in GROUPS.items()
            if name in kept and all(form[field] == kept[field] for field in fields)
        )  # fmt: skip

    def forget_machine(self) -> None:
        """Ask for bearing and speed again, which were given for the file before."""
        names = (name for name in GROUPS if name in self._kept)
        self.take_form({**self.state.values, **dict.fromkeys(names, NOT_KNOWN)})

    def join_parts(self) -> None:
        """Make one signal of the files of the series, in their order."""
        tables = self.series.tables
        if self._ended or self._arrival is not None or self.state.parts < 2:
            return
        self._latest += 1
        self._tell(words=f"Joining {len(tables)} files …", bad=False, busy=True)
        scene, find, changed = self._scene, self._bearings.find, self._changed

        def join() -> _Read:
            try:
                joined = join_tables([fill(table, changed)[0] for table in tables])
            except FieldError as error:
                raise ValueError(f"These files are not joined: {sentence_of(error)}") from None
            found = read_of(joined, scene, find, {}, changed)
            return replace(found, parts=tuple(table.name for table in tables))

        def take(found: _Read) -> None:
            self.series = Series((found.table,))
            self._take_read(found)

        self._in_background(join, take, "The files")

    def _take_read(self, found: _Read) -> None:
        """Take a file that was read in place of the one before.

        The figures of the one before leave with it, so that none is shown under another's name.
        """
        table, before = found.table, "" if self._table is None else self._table.name
        self._table = self._as_read = table
        self._cut, self._first, self._agreed = found.cut, found.first, {}
        self._kept, self._parts = found.kept, found.parts
        self._taken = found.form
        self.measured = self.sized = None
        if found.asked is not None:
            self.measured = self._measured(found.asked, found.form)
            words, bad = self._summary(_about_size(found.sizes)), False
        else:
            words = f"{table.name} is read. {_WAITS} " + " ".join(
                {**found.asks, **found.refused, **found.sizes}.values()
            )
            bad = bool(found.refused) and not found.asks
        self._tell(
            words=words,
            bad=bad,
            busy=False,
            columns=columns_of(table),
            values=found.form,
            refused={name: text for name, text in found.refused.items() if name not in found.asks},
            reasons={**reasons(table), **found.asks, **found.sizes},
            open=[*found.asks, *found.sizes],
            voltage=is_voltage(table, found.form),
            proposed=proposed_unit(table),
            said=said(table),
            load=load_of(table),
            scaled=not table.full_scale_known,
            bearings=bearings_of(table, own=self._own_bearings),
            speeds=speeds_of(table),
            settling=False,
            kept_from=before if found.kept else "",
            parts=0
            if self.series.shortened or not self.series.together
            else len(self.series.tables),
            arrival=self.state.arrival + 1,
            **self._in_short(found.form),
        )
        self._follow()
        self._draw()

    def take_form(self, form: Mapping[str, str], sure: bool = False) -> None:
        """An answer has changed, or a person is `sure` of the guesses.

        Open questions are settled by an answer or by agreement.
        """
        table, measured = self._table, self.measured
        if self._ended or self._arrival is not None:
            return
        if table is None:
            if measured is not None and measured.origin is None:
                self._take_simulated_form(measured, form.get("speed", SIMULATED))
            return
        texts = as_texts(form, tuple(self.state.values))
        changed = {name: text for name, text in texts.items() if text != self._first[name]}
        if sure:
            self._agreed |= {name: texts[name] for name in self.state.open if name not in SIZES}
        self._latest += 1
        self._tell(values=texts, settling=True)
        scene, as_read = self._scene, self._as_read
        assert as_read is not None
        self._in_background(
            lambda: _answered(as_read, changed, scene, self._bearings.find),
            lambda found: self._take_answers(texts, found),
            table.name,
        )

    def _take_answers(self, texts: dict[str, str], answers: _Answers | FormError) -> None:
        before, table = self.measured, self._table
        if table is None:
            return
        found = answers if isinstance(answers, FormError) else answers.found
        if isinstance(answers, _Answers):
            # what follows from the roles of the columns follows from those of now
            texts, table = answers.form, answers.table
            self._table, self._first = table, {**answers.first, "columns": self._first["columns"]}
        asks, sizes = questions(table), size_questions(table, texts)
        left = [
            name for name in asks
            if texts[name] == self._first[name] and texts[name] != self._agreed.get(name)
        ]  # fmt: skip
        refused = found.sentences if isinstance(found, FormError) else {}
        news = {
            "values": texts,
            "refused": {name: words for name, words in refused.items() if name not in left},
            "reasons": {**reasons(table), **asks, **sizes},
            "open": [*left, *sizes],
            "proposed": proposed_unit(table),
            "voltage": is_voltage(table, texts),
            "speeds": speeds_of(table),
            "settling": False,
            "kept_from": self.state.kept_from if self._kept_of(texts) else "",
        }
        if isinstance(found, FormError):
            stays = " The figures still show the signal as it was before." if before else ""
            self._tell(words=f"{found}{stays}", bad=True, **news)
            return
        if left:
            words = " ".join(asks[name] for name in left)
            self._tell(words=f"{_WAITS} {words}", bad=False, **news)
            return
        same = all(texts[name] == self._taken[name] for name in SIGNAL_FIELDS)
        self._taken = texts
        if before is not None and same:  # what was computed of the signal stays
            machine = replace(found.machine, kept=self._kept_of(texts))
            self.measured = replace(before, machine=machine)
        else:
            self.measured = self._measured(found, texts)
        self._tell(
            words=self._summary(_about_size(sizes)), bad=False, busy=False, **news,
            **self._in_short(texts),
        )  # fmt: skip
        self._follow()  # the scene may have changed while the form was read
        self._draw()

    def _measured(self, asked: FormResult, form: Mapping[str, str]) -> Measured:
        origin = replace(asked.origin, parts=self._parts)
        machine = replace(asked.machine, kept=self._kept_of(form))
        return Measured(asked.recording, machine, origin=origin, in_si=asked.in_si)

    def _take_simulated_form(self, measured: Measured, speed: str) -> None:
        """Take whether the speed of a simulated signal is known: exactly, roughly, or not."""
        if speed not in (SIMULATED, ROUGH, NOT_KNOWN) or measured.bearing is None:
            return
        true = measured.true_speed
        machine = replace(
            measured.machine, speed_source=speed, shaft_speed=None if speed == NOT_KNOWN else true
        )
        if machine == measured.machine:
            return
        self.measured = replace(measured, machine=machine)
        self._tell(values={"speed": speed}, words=self._summary(), **self._in_short({}))
        self._draw()

    @property
    def _own_bearings(self) -> list[str]:
        """Names of the bearings of a person's table."""
        return list(self._bearings.own)

    def take_bearing(self, name: str) -> None:
        """Take a listed bearing as the one that was measured."""
        measured = self.measured
        if self._table is None:
            if measured is not None:
                bearing = self._bearings.find(name).bearing
                machine = replace(measured.machine, bearing=bearing, bearing_source=GIVEN,
                                  bearing_name=name)  # fmt: skip
                self.measured = replace(measured, machine=machine)
                self._tell(words=self._summary(), **self._in_short({}))
                self._draw()
            return
        named = [value for value, _, heading in self.state.bearings if heading == LIKELY]
        self._tell(bearings=bearings_of(self._table, [*named, name], self._own_bearings))
        self.take_form({**self.state.values, "bearing": name})

    def cancel_search(self) -> None:
        """End the search for listed bearings."""
        if isinstance(self.listed.wanted, ListQuestion):
            self.listed.wanted.progress.cancelled = True

    def take_load(self) -> None:
        """Put the load of the file, downwards, into the scene."""
        load = None if self._table is None else load_of(self._table)
        if load is not None and self.change_scene is not None:
            self.change_scene({"typed": {"fy_n": f"{-load:.6g}"}})

    def _summary(self, *more: str) -> str:
        notes = self.measured.recording.notes if self.measured is not None else ()
        words = (summary(self.measured), self._cut, *notes, *more)
        return " ".join(filter(None, words))

    def _in_short(self, form: Mapping[str, str]) -> dict[str, str]:
        """The signal in a line, and what is odd about it."""
        measured, table = self.measured, self._table
        if measured is None:
            return {"line": "", "whole_name": "", "remarks": ""}
        recording, machine = measured.recording, measured.machine
        long = len(recording.name) if table is None else NAME_IN_LINE
        name = without_middle(recording.name, long)
        sure = set(SIGNAL_FIELDS) if table is None else _sure(table, form, self._first)
        unit = form.get("unit", "m/s²") or "unit"
        speed = "speed"
        if machine.shaft_speed is not None:
            speed = f"{number(30.0 / math.pi * machine.shaft_speed, 4)} rpm"
        facts = {
            "": name,
            "duration": with_prefix(recording.duration, "s", 3),
            "sample_rate": with_prefix(recording.sample_rate, "Hz", 4),
            "speed": speed,
            "unit": unit,
            "bearing": machine.bearing_name
            or ("bearing" if machine.bearing is None else "the scene's bearing"),
        }
        asked = {name for name in ("unit", "sample_rate") if name not in sure} | machine.guessed
        asked |= {"speed"} if machine.shaft_speed is None else set()
        asked |= {"bearing"} if machine.bearing is None else set()
        words = [text + "?" * (name in asked) for name, text in facts.items()]
        return {
            "line": " · ".join(words),
            "whole_name": recording.name if name != recording.name else "",
            "remarks": " ".join((self._cut, *recording.notes)),
        }

    # Simulated ones

    def simulate(self, noise: str, machine: str, pit_name: str = "scene") -> None:
        """Simulate a measurement; the choices are keys of NOISES, MACHINES and PITS."""
        if self._ended or noise not in NOISES or machine not in MACHINES or pit_name not in PITS:
            return
        self._upload = self._arrival = None
        self._latest += 1
        self._simulations += 1
        seed, scene = self._simulations, self._scene_now()
        self._tell(words="Simulating a measurement.", bad=False, busy=True)

        def make() -> Measured:
            return simulated(
                with_pit(scene, PITS[pit_name]), NOISES[noise], machine == "different", seed
            )

        self._in_background(make, self._take_simulated, "The scene")

    def _take_simulated(self, found: Measured) -> None:
        self._table, self._cut, self.measured, self.sized = None, "", found, None
        self.state = MeasurementState(
            arrival=self.state.arrival + 1,
            values={"speed": SIMULATED},
            speeds=[[SIMULATED, SPEED_SOURCES[SIMULATED]], [ROUGH, "known to 10 %"],
                    [NOT_KNOWN, "not known: find it"]],
        )  # fmt: skip
        self._tell(words=self._summary(), **self._in_short({}))
        self._draw()

    # Saying and doing

    def _refuse(self, sentence: str) -> None:
        """Say what is wrong with a file; the signal before it stays."""
        self._tell(words=f"{sentence}{self._what_stays()}", bad=True, busy=False)

    def _what_stays(self) -> str:
        if self.measured is not None:
            return f" {self.measured.recording.name} stays."
        return (
            ""
            if self._table is None
            else f" The questions are still those about {self._table.name}."
        )

    def _tell(self, **news: Any) -> None:
        before, self.state = self.at_work, replace(self.state, **news)
        self.show(self.state)
        self.show_machine(self.state)
        if self.at_work != before:
            self._draw()

    def _in_background(
        self, compute: Callable[[], Any], take: Callable[[Any], None], name: str
    ) -> None:
        """Compute in a thread and take the result, unless a newer request has come."""
        number = self._latest

        async def run() -> None:
            try:
                found = await in_thread(compute, pool=FILES)
            except ValueError as error:
                sentence = str(error)
                change = lambda: self._refuse(sentence)  # noqa: E731
            except Exception:
                log.exception("a measurement could not be read")
                change = lambda: self._refuse(f"{name} could not be read.")  # noqa: E731
            else:
                change = lambda: take(found)  # noqa: E731
            if number == self._latest and not self._ended:
                await self._assign(change)

        self._keep(run())

    def _keep(self, coroutine: Coroutine[Any, Any, None]) -> None:
        task = asyncio.get_running_loop().create_task(coroutine)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)


_WAITS = "Nothing is drawn yet:"


_ORIGINS = {
    "Said by": "From the file,", "A guess:": "Assumed:", "The file does not say it.": "Assumed",
}  # fmt: skip


@dataclass
class _Arrival:
    """Files that come one after the other, and what was read of them.

    `why`: the sentence on the first that cannot be read.
    """

    count: int
    chosen: int
    series: Series
    number: int = 1
    newest: _Read | None = None
    why: str = ""
    baseline: bool = False

    @property
    def words(self) -> str:
        """Which of how many it is; empty of one alone."""
        if self.count == 1:
            return ""
        of = f" (some of {self.chosen}, from first to last)" if self.chosen > self.count else ""
        return f"{self.number} of {self.count} files{of}: "

    def take(self, name: str, found: _Read | str, inside: int = 1) -> None:
        """Take what was read, or why nothing was; one of so many `inside` one file."""
        if isinstance(found, str):
            sentence = found if name in found else f"{name}: {found}"
            self.series, self.why = self.series.without(sentence), self.why or sentence
        else:
            self.series, self.newest = (
                self.series.with_table(found.table, self.count * inside, first=self.baseline),
                found,
            )


@dataclass(frozen=True)
class _Read:
    """A file's table, the values of its form, and the recording or why there is none yet.

    `first` is the form as the file alone says; `kept` are answers for the file before that it has
    besides. `asks` are the questions before there is a recording, `sizes` those before it has a
    size. `parts` are the files that were joined.
    """

    table: Table
    first: dict[str, str]
    form: dict[str, str]
    cut: str
    asked: FormResult | None
    refused: dict[str, str]
    asks: dict[str, str]
    sizes: dict[str, str]
    kept: dict[str, str] = field(default_factory=dict)
    parts: tuple[str, ...] = ()


def read_file(
    name: str,
    content: bytes,
    scene: Machine,
    find: Callable[[str], CatalogueBearing] = find_published,
    kept: Mapping[str, str] = MappingProxyType({}),
) -> _Read:
    """A file with guesses at what it holds. For any thread; ValueError with a sentence.

    `kept`: answers on the machine for the file before, used where this one says nothing.
    """
    try:
        table = read_table(name, content)
    except FieldError as error:
        about = error.field == "file" and error.value == name
        why = f"needed is {error.allowed_text}" if about else str(error)
        raise ValueError(f"{name} cannot be used: {why}.") from None
    except ValueError as error:
        raise ValueError(f"{name} cannot be used: {error}.") from None
    except MemoryError:
        raise ValueError(f"{name} is too large for this server.") from None
    return read_of(table, scene, find, kept)


def read_of(
    table: Table,
    scene: Machine,
    find: Callable[[str], CatalogueBearing],
    kept: Mapping[str, str],
    changed: Mapping[str, str] = MappingProxyType({}),
) -> _Read:
    """The same of a table that was read; what a person `changed` stays so."""
    name = table.name
    table, cut = _shortened(table)
    (_, first), asks = fill(table, {}), questions(table)
    kept = kept_answers(first, kept)
    form = {**first, **kept, **changed}
    asks = {field: words for field, words in asks.items() if field not in changed}
    sizes = size_questions(table, form)
    found, refused = _tried(table, form, scene, find), {}
    if isinstance(found, FormError) and set(found.sentences) <= set(MACHINE_FIELDS):
        # the signal is one, whatever the file says of its bearing
        refused = found.sentences
        found = _tried(table, {**form, "bearing": NOT_KNOWN}, scene, find)
    if isinstance(found, FormError):
        if not usable(table):
            raise ValueError(f"{name} cannot be used. {found}")
        refused |= found.sentences
        return _Read(table, first, form, cut, None, refused, asks, sizes, kept)
    return _Read(table, first, form, cut, None if asks else found, refused, asks, sizes, kept)


@dataclass(frozen=True)
class _Answers:
    """Answers as they were read: the recording, or why there is none.

    `table` has the roles as they are given; `form` is as answered, `first` as the file alone says.
    """

    table: Table
    form: dict[str, str]
    first: dict[str, str]
    found: FormResult | FormError


def _answered(
    table: Table,
    changed: Mapping[str, str],
    scene: Machine,
    find: Callable[[str], CatalogueBearing],
) -> _Answers | FormError:
    try:
        told, form = fill(table, changed)
    except FormError as refused:
        return refused
    return _Answers(told, form, fill(told, {})[1], _tried(told, form, scene, find))


def _about_size(sizes: Mapping[str, str]) -> str:
    """The questions about a signal's size, and what waits for the answers."""
    return " ".join([*sizes.values(), _WITHOUT_SIZE]) if sizes else ""


def _sure(table: Table, form: Mapping[str, str], first: Mapping[str, str]) -> set[str]:
    """Fields that the file says itself, or that a person has answered."""
    contents = table.contents
    said = {"unit": contents.unit, "sample_rate": contents.sample_rate}
    sure = {name for name, found in said.items() if found is not None and found.stated}
    return sure | {name for name in form if form[name] != first.get(name)}


def _tried(
    table: Table,
    form: Mapping[str, str],
    scene: Machine,
    find: Callable[[str], CatalogueBearing],
) -> FormResult | FormError:
    try:
        return read_form(table, form, scene, find)
    except FormError as refused:
        return refused


def _shortened(table: Table) -> tuple[Table, str]:
    """The table with no more numbers than a session may keep, and a sentence if that is less."""
    rows, columns = table.columns.shape
    most = MOST_NUMBERS // columns
    if rows <= most:
        return table, ""
    kept = replace(table, columns=table.columns[:most].copy())
    return kept, f"Only the first {thousands(most)} of {thousands(rows)} rows are used."


def summary(measured: Measured | None) -> str:
    """The signal in a sentence."""
    if measured is None:
        return FIRST_WORDS
    recording, machine = measured.recording, measured.machine
    along = " and ".join(recording.directions)
    words = (
        f"{recording.name}: {with_prefix(recording.duration, 's')} along {along} at "
        f"{thousands(recording.sample_rate)} Hz"
    )
    if machine.bearing is None or machine.shaft_speed is None:
        return f"{words}."
    passes = recording.duration * machine.bearing.bpfo(machine.shaft_speed)
    pass_ = "ball passes" if round(passes) == 1 else "balls pass"
    return f"{words}, {thousands(passes)} {pass_} a point of the outer race."


def with_pit(scene: Scene, length: float | None) -> Scene:
    """The scene with a small pit so long [m] in place of its defects, and balls with mass.

    On the race of its first defect, or the outer one, under the load. None leaves it as it is;
    ValueError with a sentence where there can be no such pit.
    """
    if length is None:
        return scene
    race = scene.defects[0].race if scene.defects else "outer"
    try:
        return scene.replace(defect=pit(scene, length, race), balls=WITH_MASS)
    except ValueError as error:
        raise ValueError(sentence_of(error)) from None


def load_on_defect(scene: Scene) -> float | None:
    """Radial load [N] of a scene towards its defect; None where it has several, or presses none.

    A defect of the inner race turns through the load zone, and is met where that is loaded most.
    """
    if len(scene.defects) != 1:
        return None
    (defect,), force = scene.defects, complex(scene.load.fx, scene.load.fy)
    towards = (force * cmath.rect(1.0, -defect.center)).real
    load = abs(force) if defect.race == "inner" else towards
    return load if load > 1e-6 * abs(force) else None


def simulated(scene: Scene, noise_db: float, different: bool, seed: int) -> Measured:
    """A measurement of a scene as a sensor with noise would make it, its extent known.

    Parameters
    ----------
    noise_db
        signal over noise [dB], each direction against its own.
    different
        whether the machine's stiffnesses, load, damping and depth are off what the scene says, as
        far as the sizing expects them to be.

    Raises
    ------
    ValueError
        with a sentence, where the scene does not move.
    """
    rng = np.random.default_rng(seed)
    truth = scene
    single = len(scene.defects) == 1 and scene.defects[0].race == "outer"
    if different and single:
        (defect,) = scene.defects
        exponents = np.clip(rng.standard_normal(5), -1.5, 1.5) * Tolerances().spread
        truth = variant(scene, defect.extent, defect.edge, exponents)
    passing = scene.bearing.bpfo(scene.shaft_speed)
    duration = min(max(PASSES / passing, SHORTEST), LONGEST) if passing > 0.0 else SHORTEST
    duration += SETTLING
    try:
        motion = motion_of(truth, duration, RATE)
    except ValueError as error:
        raise ValueError(sentence_of(error)) from None
    columns = [index for index, dof in enumerate(motion.dofs) if dof in ("x", "y")]
    # not a whole number of anything: the page must find where the ball passes begin
    first = round((SETTLING - rng.uniform(0.0, 0.1)) * RATE)
    signal = motion.outer_acceleration[first:, columns]
    if not columns or len(signal) < 0.5 * SHORTEST * RATE or not np.isfinite(signal).all():
        raise ValueError("Not possible: the simulated housing does not move along x or y.")
    level = noise_level(truth, signal, columns, noise_db, duration, RATE)
    noisy = signal + level * rng.standard_normal(signal.shape)
    name = "Simulated" + (", balls with mass" if scene.balls == WITH_MASS else "")
    name += f", noise {noise_db:.0f} dB below" if math.isfinite(noise_db) else ""
    directions = tuple(motion.dofs[index] for index in columns)
    try:
        recording = Recording(noisy, motion.sample_rate, directions, name)
    except ValueError:
        raise ValueError("Not possible: the simulated housing does not move.") from None
    extent = scene.defects[0].extent if single else None
    edge = scene.defects[0].edge if len(scene.defects) == 1 else None
    return Measured(
        recording, of_scene(scene, SIMULATED), extent,
        true_part=true_part(scene), noiseless=math.isinf(noise_db),
        true_speed=scene.shaft_speed, true_load=load_on_defect(scene), true_edge=edge,
    )  # fmt: skip
