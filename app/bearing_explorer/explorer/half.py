"""The scene's half of a session: messages -> controls -> Scene -> Results -> views.

Messages have a known form: `messages.take` drops everything that the page's scripts do not send.
Words and numbers in messages are not trusted.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

from bearing_explorer.explorer.results.endurance import LifeInputs
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.address import Place
from bearing_explorer.explorer.state.bookmarks import (
    Bookmarks,
    OpenRequest,
    open_request_of,
    read_request,
)
from bearing_explorer.explorer.state.field_values import CAGE_ANGLE
from bearing_explorer.explorer.state.history import LastState
from bearing_explorer.explorer.state.lessons import Fault, Lesson
from bearing_explorer.explorer.state.references import BEFORE, HEALTHY, Reference
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.explorer.state.value_range import focus_first
from bearing_explorer.explorer.widgets.controls import Controls, Rows
from bearing_explorer.explorer.widgets.lesson import LessonPanel
from bearing_explorer.explorer.widgets.share import ShareBar
from bearing_explorer.kit.bearing_list import search_bearings
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.jobs import OPENING, REPORT, SEARCH
from bearing_explorer.kit.report_page import About
from bearing_explorer.kit.session import Half, Section
from bearingcore import Scene

log = logging.getLogger(__name__)


class Explorer(Half):
    """The scene of a session, with the controls, links and lessons that change it.

    The views of its tabs read `editor` and call its methods.

    Parameters
    ----------
    sections
        tabs of this half.
    address
        the query of the page's address; it is not trusted.
    lessons
        lessons that the page offers, with a `Fault` for each file that cannot be read.
    """

    kind_of_content = Results

    def __init__(
        self,
        sections: Sequence[Section],
        preset: str = "fan-rig",
        address: str = "",
        lessons: Sequence[Lesson | Fault] = (),
    ) -> None:
        self.sections = tuple(sections)
        self._settings = Settings()
        self._life_inputs = LifeInputs()
        self._grey = HEALTHY
        self.editor = SceneEditor(preset)
        self.bookmarks = Bookmarks(self.editor, address)
        #: number of the newest change of the browser
        self.mark = 0
        self.share = ShareBar(self.change_links, state=self.bookmarks.state())
        self.lesson = LessonPanel(self.change_lesson, lessons)
        #: returns a function that makes the report on the measured signal, or a reason why there is
        #: none. The page sets this and `simulate`, which simulates a measurement of the scene
        self.report_on_signal: Callable[[About], Callable[[], dict[str, Any]] | str] = lambda _: (
            "this page has no Diagnosis."
        )
        self.simulate: Callable[[str], None] = lambda noise: None
        self._open_lesson_of_link()
        self.controls = Controls(self.change_scene, state=self.editor.state())
        self.panels: list[Rows] = [self.controls]
        self._last_state = LastState(self.editor.scene)

    def tab_opened(self, name: str) -> None:
        self.bookmarks.tab = name  # links always say which tab is open
        self.show_links()

    @property
    def scene(self) -> Scene:
        """The scene that the controls show."""
        return self.editor.scene

    @property
    def focused_scene(self) -> Scene:
        """The scene with the selected defect, which the sliders move, as its first."""
        return focus_first(self.editor.scene, self.editor.selected)

    def content(self) -> Results:
        before = self._last_state.before
        return Results(
            self.scene,
            math.radians(self.editor.values[CAGE_ANGLE]),
            self._settings,
            self.editor.focus,
            moving=True,
            held=self.bookmarks.moving,
            compared=self.bookmarks.compared,
            before=None if before is None else Reference(before, BEFORE),
            grey_kind=self._grey,
            life_inputs=self._life_inputs,
            lesson_term=self.lesson.term if self.bookmarks.lesson else "",
            mark=self.mark,
        )

    def draw(self) -> None:
        self._last_state.follow(self.scene, self.bookmarks.moving)
        self.page.mark = self.mark
        super().draw()

    def set_life_inputs(self, inputs: LifeInputs) -> None:
        """Judge life and film with this steel, oil and these surfaces."""
        self._life_inputs = inputs
        self.draw()

    def set_grey(self, kind: str) -> None:
        """Draw the reference of this kind in grey."""
        self._grey = kind
        self.draw()

    def show_controls(self, **news: Any) -> None:
        """Send news to all panels of controls; each shows its own part.

        `state` moves controls, and `refused` has sentences on refused values. The mark lets a panel
        ignore news that a slider has overtaken.
        """
        if "state" in news:
            news["state"] = {**news["state"], "mark": self.mark}
        for panel in self.panels:
            panel.send(news)

    def show_links(self) -> None:
        """Update the bar above the controls: the address, and the steps that can be undone."""
        if self.share.state != (state := self.bookmarks.state()):
            self.share.state = state

    # The scene

    def change_scene(self, message: Any) -> None:
        """Take a message of the controls: numbers, choices, a reset."""
        if (text := message.get("search")) is not None:
            self.jobs.answer(
                SEARCH,
                lambda: search_bearings(text),
                lambda bearings: self.controls.send({"found": bearings}),
            )
            return
        self.mark = message.get("mark", self.mark)
        if compiling.STATICS in compiling.left():
            self.draw()  # the scene stays as it is, but the browser waits for its mark
            return
        try:
            if "reset" in message:
                self.editor.take_preset(self.editor.preset)
                self._last_state = LastState(self.scene)  # a reset is no change to explain
                self.show_controls(state=self.editor.state())
            if "choose" in message:
                refused = self.editor.choose(message["choose"])
                self.show_controls(
                    state=self.editor.state(), **({"refused": refused} if refused else {})
                )
            if "set" in message:
                self._set(message["set"], confirm=False)
            for name in ("typed", "second"):
                if name in message:
                    numbers = self.editor.read_units(message[name], second=name == "second")
                    self._set(numbers, confirm=True)
        finally:
            if self.bookmarks.follow(message):
                self.show_links()
            self.draw()  # even a refusal is answered, or the browser would wait for its mark

    def _set(self, numbers: Mapping[Any, Any], confirm: bool) -> None:
        """Set numbers; a refused number keeps its value, and a sentence says why.

        `confirm` sends the numbers back as they were read; a slider knows its position.
        """
        editor = self.editor
        was_changed, had_effects = editor.changed, editor.effects
        refused, changed = editor.set(numbers)
        names = [name for name in changed if name not in numbers]
        if confirm:
            names += [name for name in numbers if name in editor.values and name not in refused]
        if had_effects and not editor.effects:
            self.show_controls(state=editor.state())
        elif names or was_changed != editor.changed:
            self.show_controls(state=editor.state(names))
        if refused:
            self.show_controls(refused=refused)

    def _take_place(self, request: OpenRequest, place: Place | str) -> None:
        """Open or compare a place; if it is a sentence instead, show that."""
        self.bookmarks.take(request, place)
        self.show_controls(state=self.editor.state())
        self.show_links()
        self.draw()

    # The bar above the controls

    def change_links(self, message: Any) -> None:
        """Take a message of the bar: steps, links, kept and compared scenes, files, a report."""
        if "keep" in message:
            self.share.answer(kept=self.bookmarks.kept_scene(message["keep"]))
        if message.get("want") == "toml":
            self.share.answer(file=self.bookmarks.toml())
        if "report" in message:
            self._report(message["report"], message)
        if "mark" not in message:
            return
        if self.bookmarks.go(message):
            self.show_controls(state=self.editor.state())
        self.bookmarks.change_compared(message)
        if (request := open_request_of(message)) is not None:
            self.jobs.answer(
                OPENING,
                lambda: read_request(request),
                lambda place: self._take_place(request, place),
            )
        self.change_scene(message)  # for the mark, and a reset

    def open_link(self, name: str, text: str) -> None:
        """Open the scene and the tab of a link that comes with the page."""
        request = OpenRequest("open", name, text)
        self._take_place(request, place := read_request(request))
        if isinstance(place, Place):
            self.page.show_tab({"show": place.tab})

    def _report(self, base: str, words: Mapping[Any, Any]) -> None:
        """Make the report on the measured signal; `base` is the page's address without its query.

        `words` may contain a title, the machine and remarks.
        """
        title, machine, remarks = (words.get(name, "") for name in ("title", "machine", "remarks"))
        link = f"{base}?{self.bookmarks.state()['address']}"
        about = About(self.editor.name, link, datetime.now(UTC), title, machine, remarks)
        make = self.report_on_signal(about)
        if isinstance(make, str):
            self.bookmarks.say(f"No report: {make}")
            self.show_links()
            return

        def report() -> dict[str, Any] | None:
            try:
                return make()
            except Exception:
                log.exception("a report failed")
                return None

        self.jobs.answer(REPORT, report, lambda file: self.share.answer(report=file))

    # Lessons

    def _open_lesson_of_link(self) -> None:
        """Open the lesson that the address names, with its scene if the address has no scene."""
        name = self.bookmarks.lesson
        if not name:
            return
        is_number = name.isdecimal() and len(name) < 4  # Python refuses thousands of digits
        lesson = self.lesson.begin(int(name) - 1 if is_number else name)
        if lesson is None:
            self.bookmarks.lesson = ""
            self.bookmarks.say(f"There is no lesson “{name}” here.")
        else:
            self.bookmarks.lesson = lesson.name
            self.lesson.open_first = True
            if not self.bookmarks.has_scene:
                lesson.begin(self.editor)
                self.bookmarks.begin_anew(lesson.tab)
        self.share.state = self.bookmarks.state()

    def change_lesson(self, message: Any) -> None:
        """Take a message of the lessons: begin, show or close one, or press one of its buttons."""
        words_only = "words_only" in message
        closed = message.get("lesson") == ""
        lesson = self.lesson.begin(message.get("lesson"), again=not words_only)
        begins = not (words_only or closed)
        if lesson is not None or closed:
            self.bookmarks.lesson = "" if lesson is None else lesson.name
        if begins:
            if lesson is not None:
                lesson.begin(self.editor)
                self.show_controls(state=self.editor.state())
            self.page.show_tab(message if lesson is None else {"show": lesson.tab})
        self.change_scene(message)  # for the mark, and the changes of a button
        if "simulate" in message and begins:
            self.simulate(message["simulate"]["noise"])
