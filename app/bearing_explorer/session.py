"""The one state object of a session: controls -> Scene -> Results -> the views on screen."""

from __future__ import annotations

import asyncio
import dataclasses
import logging
import math
import time
from collections.abc import Callable, Coroutine, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

import panel as pn

from bearing_explorer.assets import asset_text
from bearing_explorer.measurement.session import Measurement
from bearing_explorer.report import About, now, report
from bearing_explorer.results import compiling
from bearing_explorer.results.cache import Overtaken
from bearing_explorer.results.drawing_loop import DrawingLoop
from bearing_explorer.results.endurance import LifeInputs
from bearing_explorer.results.executors import in_thread
from bearing_explorer.results.jobs import Jobs
from bearing_explorer.results.results import Results
from bearing_explorer.serve import log as write
from bearing_explorer.serve.live import one_message, send_at_once
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.bearing_list import read_table
from bearing_explorer.state.bookmarks import Bookmarks, asked_for, read_asked
from bearing_explorer.state.field_values import CAGE_ANGLE, Values
from bearing_explorer.state.last_state import LastState
from bearing_explorer.state.lessons import Fault, Lesson
from bearing_explorer.state.reference import Reference
from bearing_explorer.state.scene_editor import LARGEST_FILE, SceneEditor, read_file
from bearing_explorer.state.sentences import words_of
from bearing_explorer.state.settings import Settings
from bearing_explorer.views.base import Ranges, SessionParts, Sources, View
from bearing_explorer.widgets.controls import Controls, Rows
from bearing_explorer.widgets.lesson import LessonPanel
from bearing_explorer.widgets.limits import LimitsStrip, rows_of
from bearing_explorer.widgets.share import ShareBar
from bearing_explorer.widgets.status import StatusLine, Tabs, status_of
from bearingcore import Limit, Scene
from bearingcore.bearings.catalogue import MOST_BYTES
from bearingcore.statics.limit import summary

log = logging.getLogger(__name__)

Found = TypeVar("Found")

#: slow views are drawn together with the others while a hand moves, or all would be painted twice.
#: Where they cost more than this [s] they come after them, and may be skipped while newer inputs
#: wait ...
_HEAVY = 0.04
#: ... but not for longer than this [s]
_PATIENCE = 0.25

#: the limits of the model are looked at when the hand rests; while it moves after so long [s], and
#: where many share the machine, after so many pictures: they cost as much as two
_LIMITS_EVERY = 1.0
_LIMITS_PICTURES = 10

_BROKEN = "This could not be computed; what is shown belongs to an earlier position."
_DRAWN_LATER = "This is drawn by itself as soon as that is done."


@dataclass(frozen=True)
class Section:
    """A part of the page that is on screen as a whole: a tab; those of a group stand together."""

    name: str
    title: str
    views: tuple[type[View], ...]
    group: str = ""


@dataclass(frozen=True)
class Inputs:
    """What is to be drawn.

    Parameters
    ----------
    scene, cage_angle
        cage angle in [rad].
    mark
        number of the newest change of the browser that it holds.
    focus
        which of the scene's defects the sliders move.
    settings
        how finely it is computed.
    rested
        whether the slider is at rest, and it is drawn as finely as can be.
    pinned
        a scene that is drawn in grey, instead of the one without the defect.
    before
        the scene before the last change.
    life_inputs
        steel, oil and surfaces as a person has entered them.
    """

    scene: Scene
    cage_angle: float
    mark: int
    focus: int = 0
    settings: Settings = field(default_factory=Settings)
    rested: bool = False
    pinned: Reference | None = None
    before: Scene | None = None
    life_inputs: LifeInputs = field(default_factory=LifeInputs)

    def results(self, give_up: Callable[[], bool] | None = None) -> Results:
        """What is known about them; `give_up` may end long searches."""
        return Results(
            self.scene,
            self.cage_angle,
            self.settings,
            self.focus,
            moving=not self.rested,
            pinned=self.pinned,
            before=self.before,
            life_inputs=self.life_inputs,
            give_up=give_up,
        )


@dataclass(frozen=True)
class Drawing:
    """What a view has to say about some results; without `data` it could not say anything."""

    view: View
    data: tuple[Sources, Ranges] | None
    sentence: str


@dataclass(frozen=True)
class Picture:
    """What some views have to say, how the computation went, and how long it took [s]."""

    results: Results
    drawings: list[Drawing]
    status: dict[str, Any]
    limits: tuple[Limit, ...] | None
    seconds: float


class Explorer:
    """A session. `page.py` puts its parts on a page; the browser's messages arrive here."""

    def __init__(
        self,
        sections: Sequence[Section],
        preset: str = "fan-rig",
        address: str = "",
        lessons: Sequence[Lesson | Fault] = (),
    ) -> None:
        """`address`: what stands behind the question mark, from strangers too."""
        self.packed = PackedSource()
        self._sections = {section.name: section for section in sections}
        self._views: dict[str, list[View]] = {}
        self._containers: dict[str, pn.Column] = {}
        self._mark = 0
        self._drawn_mark = 0
        self._settings = Settings()
        self._life_inputs = LifeInputs()
        self._slow_cost = math.inf
        self._slow_at = self._limits_at = -math.inf
        self._pictures = 0  # since the limits were looked at
        self._doc = pn.state.curdoc
        self._tasks: set[asyncio.Task[None]] = set()
        self._loop: DrawingLoop[Inputs, Picture] = DrawingLoop(
            self._draw_newest, self._fine_picture, self._draw_fine, self._failed
        )
        self._refined: tuple[object, ...] = ()  # what is drawn as finely as can be
        self.jobs = Jobs(lambda change: one_message(self._doc, change))

        self.editor = SceneEditor(preset)
        self.bookmarks = Bookmarks(self.editor, address)
        self._reporting = False
        self.share = ShareBar(self._share_asked, state=self.bookmarks.state())
        self.lesson = LessonPanel(self._lesson_asked, lessons)
        self._open_lesson()
        self._last_state = LastState(self.editor.scene)
        tab = self.bookmarks.tab
        self._shown = tab if tab in self._sections else next(iter(self._sections))
        self.bookmarks.show(self._shown)  # links always say where one stood
        self._show_share()
        self.measurement = Measurement(
            self.editor, lambda change: one_message(self._doc, change), self.draw
        )
        self.measurement.change_scene = self._asked
        self.controls = Controls(self._asked, state=self.editor.state())
        self._panels: list[Rows] = [self.controls]
        self.status = StatusLine(
            folded=True, sizing_mode="stretch_width", margin=0, css_classes=["one-line"]
        )
        self.limits = LimitsStrip(sizing_mode="stretch_width", margin=0)
        self._on_screen = ""
        self.tabs = Tabs(
            self._tab_asked,
            names=[[section.name, section.title, section.group] for section in sections],
            active=self._shown,
        )
        self.main = pn.Column(sizing_mode="stretch_both", margin=0)  # the page gives its height
        self._parts = SessionParts(
            self.editor,
            self.jobs,
            self.measurement,
            draw=self.draw,
            ask=self._asked,
            add_controls=self._panels.append,
            take_steps=self._take_steps,
            fill=self._fill,
            set_life_inputs=self._set_life_inputs,
        )

    @property
    def inputs(self) -> Inputs:
        """What is to be drawn now."""
        angle = math.radians(self.values[CAGE_ANGLE])
        return Inputs(
            self.scene,
            angle,
            self._mark,
            self.editor.focus,
            self._settings,
            pinned=self.bookmarks.pinned,
            before=self._last_state.before,
            life_inputs=self._life_inputs,
        )

    @property
    def scene(self) -> Scene:
        """The scene as the controls have it."""
        return self.editor.scene

    @property
    def values(self) -> Values:
        """The numbers of the controls."""
        return self.editor.values

    def start(self) -> None:
        """The page is up: draw."""
        send_at_once(self._doc)
        self.draw()
        if not compiling.ready():
            self._keep(self._draw_when_compiled())

    def stop(self) -> None:
        """The session is over: nothing is begun any longer, and what waits for its turn is not."""
        self._loop.stop()
        self.jobs.stop()
        self.measurement.stop()
        for task in self._tasks:
            task.cancel()
        for view in [view for views in self._views.values() for view in views]:
            view.end()

    def draw(self) -> None:
        """Bring what is on screen up to date."""
        self._last_state.follow(self.scene, self.bookmarks.moving)
        inputs = self.inputs
        # turning the bearing leaves a fine picture fine
        fine = self._refined == self._what_is_fine(inputs)
        self._loop.submit(dataclasses.replace(inputs, rested=fine))

    def _what_is_fine(self, inputs: Inputs) -> tuple[object, ...]:
        """What a fine picture is of; another needs a fine one of its own."""
        return self._shown, inputs.scene, inputs.settings, inputs.pinned

    async def _draw_when_compiled(self) -> None:
        """Some views have to wait until their kernels are compiled, once a computer."""
        while not compiling.ready():
            await asyncio.sleep(0.5)
        self._refined = ()
        self.draw()

    # What the browser asks for. Its messages are not to be trusted.

    def _asked(self, message: Any) -> None:
        if not isinstance(message, dict):
            return
        mark = message.get("mark")
        if isinstance(mark, int) and 0 <= mark < 2**24:
            self._mark = mark
        try:
            if message.get("reset") is True:
                self.editor.take_preset(self.editor.preset)
                self._show_controls(state=self.editor.state())
            if isinstance(choose := message.get("choose"), dict):
                refused = self.editor.choose(choose)
                self._show_controls(
                    state=self.editor.state(), **({"refused": refused} if refused else {})
                )
            if isinstance(values := message.get("set"), dict):
                self._set(values, confirm=False)
            if isinstance(typed := message.get("typed"), dict):
                self._set(typed, confirm=True)
            rests = "typed" in message or message.get("released") is True
            if rests and (narrowed := self.editor.narrow()):
                self._show_controls(state=self.editor.state(narrowed))
            if isinstance(file := message.get("floor"), dict):
                self._read(file)
            if isinstance(file := message.get("catalogue"), dict):
                self._read_bearings(file)
        finally:
            if self.bookmarks.follow(message):
                self._show_share()
            self.draw()  # even a sentence_of is answered, or the browser would wait for its mark

    def _set(self, given: Mapping[Any, Any], confirm: bool) -> None:
        """Take numbers; what is refused stays as it was, with a sentence.

        A slider knows where it is; what was typed is confirmed as it was understood.
        """
        was_changed, waited = self.editor.changed, bool(self.editor.draft)
        refused, changed = self.editor.set(given)
        names = [name for name in changed if name not in given]
        names += [name for name in self.editor.draft if name not in names]
        if confirm:
            names += [name for name in given if name in self.values and name not in refused]
        if names or waited or was_changed != self.editor.changed:
            self._show_controls(state=self.editor.state(names))
        if refused:
            self._show_controls(refused=refused)

    def _read(self, file: Mapping[Any, Any]) -> None:
        """Take a measured floor out of a file's text: parsed off the event loop, it may be long."""
        name, text = file.get("name"), file.get("text")
        if not (isinstance(name, str) and isinstance(text, str)):
            return
        text = text[: LARGEST_FILE + 1]

        def take(found: Any) -> None:
            self.editor.take_floor(name[:200], *found)
            self.bookmarks.step()
            self._show_controls(state=self.editor.state())
            self._show_share()
            self.draw()

        self._in_background(lambda: read_file(text), take)

    def _read_bearings(self, file: Mapping[Any, Any]) -> None:
        """Take a table of bearings out of a file's text, off the event loop."""
        name, text = file.get("name"), file.get("text")
        if not (isinstance(name, str) and isinstance(text, str)):
            return
        text = text[: MOST_BYTES + 1]

        def take(found: Any) -> None:
            self.editor.listed.take(name[:200], found)
            self._show_controls(state=self.editor.state())

        self._in_background(lambda: read_table(text), take)

    def _in_background(self, compute: Callable[[], Found], take: Callable[[Found], None]) -> None:
        """Compute something off the event loop, then take it."""

        async def work() -> None:
            found = await in_thread(compute)
            await one_message(self._doc, lambda: take(found))

        self._keep(work())

    def _keep(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        """Have something done that nobody waits for; asyncio forgets tasks that nobody holds."""
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    # The bar above the controls

    def _share_asked(self, message: Any) -> None:
        if not isinstance(message, dict):
            return
        if isinstance(name := message.get("keep"), str):
            self.share.answer(kept=self.bookmarks.kept(name))
        if message.get("want") == "toml":
            self.share.answer(file=self.bookmarks.toml())
        if isinstance(base := message.get("report"), str) and not self._reporting:
            self._report(base[:2000], message)
        if "mark" not in message:
            return
        if self.bookmarks.go(message):
            self._show_controls(state=self.editor.state())
        if isinstance(name := message.get("pin_here"), str):
            self.bookmarks.pin_here(name)
        if message.get("unpin") is True:
            self.bookmarks.unpin()
        if (asked := asked_for(message)) is not None:

            def take(found: Any) -> None:
                if self.bookmarks.take(asked, found):
                    self._show_controls(state=self.editor.state())
                self._show_share()
                self.draw()

            self._in_background(lambda: read_asked(asked), take)
        self._asked(message)  # the mark, and a reset

    def _report(self, base: str, words: Mapping[Any, Any]) -> None:
        """Make a report; `base` is the address of the page without what is behind it.

        `words` may hold its title, the machine and remarks, of anybody's.
        """
        title, machine, remarks = (
            str(words.get(name, ""))[:most]
            for name, most in (("title", 120), ("machine", 200), ("remarks", 4000))
        )
        results = dataclasses.replace(self.inputs, rested=True).results()
        kinds = [view for section in self._sections.values() for view in section.views]
        made = [view for views in self._views.values() for view in views]
        found = {view.name: view.found for view in made if view.found is not None}
        link = f"{base}?{self.bookmarks.state()['address']}"
        about = About(self.editor.name, self.editor.note, link, now(), title, machine, remarks)

        def make() -> dict[str, Any] | None:
            try:
                return report(results, kinds, found, about)
            except Exception:
                log.exception("a report failed")
                return None

        def take(made: dict[str, Any] | None) -> None:
            self._reporting = False
            self.share.answer(report=made)

        self._reporting = True
        self._in_background(make, take)

    def _show_share(self) -> None:
        """The bar follows: the address, and what can be undone."""
        if self.share.state != (state := self.bookmarks.state()):
            self.share.state = state

    def _take_steps(self, step_rate: float | None) -> None:
        """March motions with steps [Hz] set by hand, or None: with the program's own."""
        self._settings = dataclasses.replace(self._settings, step_rate=step_rate)
        self.draw()

    def _set_life_inputs(self, inputs: LifeInputs) -> None:
        """Judge life and film with this steel, oil and these surfaces."""
        self._life_inputs = inputs
        self.draw()

    def _show_controls(self, **news: Any) -> None:
        """Show news on all panels of controls; each shows what is its own.

        The mark lets them pass over what a hand has moved on from meanwhile.
        """
        if "state" in news:
            news["state"] = {**news["state"], "mark": self._mark}
        for panel in self._panels:
            panel.show(**news)

    def _open_lesson(self) -> None:
        """The lesson that the address names; with its scene where the address says none."""
        name = self.bookmarks.lesson
        if not name:
            return
        lesson = self.lesson.begin(name)
        if lesson is None:
            self.bookmarks.lesson = ""
            self.bookmarks.say(f"There is no lesson “{name}” here.")
            self.share.state = self.bookmarks.state()
            return
        self.lesson.open_first = True
        if not self.bookmarks.has_scene:
            lesson.begin(self.editor)
            self.bookmarks.begin_anew(lesson.tab)
        self.share.state = self.bookmarks.state()

    def _lesson_asked(self, message: Any) -> None:
        """A lesson begins, its words are asked for, or a button among them is pressed."""
        if not isinstance(message, dict):
            return
        words_only = message.get("words_only") is True
        lesson = self.lesson.begin(message.get("lesson"), again=not words_only)
        if lesson is not None or message.get("lesson") == "":
            self.bookmarks.lesson = "" if lesson is None else lesson.name
        if words_only or message.get("lesson") == "":
            self._asked(message)
            return
        if lesson is not None:
            lesson.begin(self.editor)
            self._show_controls(state=self.editor.state())
        self._tab_asked(message if lesson is None else {"show": lesson.tab})
        self._asked(message)  # the mark, and what a button changes
        if isinstance(wish := message.get("simulate"), dict):
            self.measurement.simulate(
                *(str(wish.get(k, "scene")) for k in ("noise", "machine", "pit"))
            )

    def _tab_asked(self, message: Any) -> None:
        name = message.get("show") if isinstance(message, dict) else None
        if isinstance(name, str) and name in self._sections:
            self._shown = name
            self.bookmarks.show(name)
            self._show_share()
            self.draw()

    def _make(self, name: str) -> list[View]:
        """The views of a section. For any thread: they are in no document yet."""
        return [view(self.packed) for view in self._sections[name].views]

    async def _open_tab(self, name: str) -> None:
        """Put a section on screen; its figures are made when it is first asked for.

        Done by the worker, in the same order of messages as what is drawn on them: the browser
        must know a figure before it hears of its numbers. On the event loop the section only comes
        into the document: figures, models and the message are made in threads.
        """
        if name not in self._views:
            self._views[name] = await in_thread(self._make, name)
        if name not in self._containers:
            self._containers[name] = self._container(self._views[name])
        new = self._containers[name] not in self.main
        await one_message(self._doc, lambda: self._attach_tab(name), new_models=new)

    def _container(self, views: Sequence[View]) -> pn.Column:
        """What holds the views of a section."""
        for view in views:
            view.attach(self._parts)
        return pn.Column(
            *(view.panel for view in views),
            stylesheets=[asset_text("section.css")],
            sizing_mode="stretch_both" if any(v.compact for v in views) else "stretch_width",
            margin=0,
        )

    def _fill(
        self,
        layout: pn.Column,
        make: Callable[[], pn.viewable.Viewable],
        then: Callable[[], None],
    ) -> asyncio.Task[None]:
        """Put what is made into a layout of a view on screen, and then act: turn after turn."""

        async def fill() -> None:
            made = make()
            await asyncio.sleep(0.0)

            def change() -> None:
                layout[:] = [made]
                then()

            await one_message(self._doc, change, new_models=True)

        return self._keep(fill())

    def _attach_tab(self, name: str) -> None:
        if self._containers[name] not in self.main:
            self.main.append(self._containers[name])
        for other, container in self._containers.items():
            shown = "on-screen" if other == name else "off-screen"
            container.css_classes = ["section", f"section-{other}", shown]
            if other != name:
                for view in self._views[other]:
                    view.put_away()
        self.packed.introduce()
        self.tabs.active = self._on_screen = name

    # Drawing: off the event loop to compute, on it to assign.

    async def _draw_newest(self, inputs: Inputs) -> Inputs:
        started = time.perf_counter()
        if self._on_screen != self._shown:
            await self._open_tab(self._shown)
            self._slow_cost = math.inf  # not known yet
        views = self._views[self._on_screen]
        slow = [view for view in views if view.needs & Results.slow]
        quick = [view for view in views if view not in slow]
        # where nothing else follows the slider there is nothing to delay
        heavy = self._slow_cost > _HEAVY and any(view.needs for view in quick)
        if slow and not heavy and math.isfinite(self._slow_cost) and not inputs.rested:
            quick, slow = [], views
        if heavy and self._loop.waiting:
            slow = slow if started - self._slow_at > _PATIENCE else []

        if quick or not slow:
            inputs, picture = await in_thread(self._newest_picture, inputs, quick)
            await self._assign(picture, None if slow else inputs.mark)
        if slow:
            before = time.perf_counter()
            limits = not quick and self._limits_due(inputs)
            picture = await in_thread(_picture, inputs.results(), slow, limits)
            self._slow_at = time.perf_counter()
            self._slow_cost = self._slow_at - before
            await self._assign(picture, inputs.mark)
        write.update(self._doc, inputs.scene, self._on_screen, time.perf_counter() - started)
        if self._on_screen != self._shown:
            # asked for meanwhile, and these inputs may have been the newest
            self.draw()
        return inputs

    def _newest_picture(self, inputs: Inputs, views: Sequence[View]) -> tuple[Inputs, Picture]:
        """A picture of the newest inputs: others may have waited for a thread too."""
        inputs = self._loop.newest(inputs)
        return inputs, _picture(inputs.results(), views, self._limits_due(inputs))

    def _fine_picture(self, inputs: Inputs, give_up: Callable[[], bool]) -> Picture | None:
        """What is on screen as finely as can be; None where it is drawn so already."""
        if inputs.rested:
            return None
        results = dataclasses.replace(inputs, rested=True).results(give_up)
        return _picture(results, self._views[self._on_screen], limits=True)

    async def _draw_fine(self, inputs: Inputs, picture: Picture) -> None:
        await self._assign(picture, inputs.mark)
        self._refined = self._what_is_fine(inputs)

    def _limits_due(self, inputs: Inputs) -> bool:
        now = time.perf_counter()
        self._pictures += 1
        long_ago = now - self._limits_at > _LIMITS_EVERY
        due = inputs.rested or (long_ago and self._pictures >= _LIMITS_PICTURES)
        if due:
            self._limits_at, self._pictures = now, 0
        return due

    async def _assign(self, picture: Picture, mark: int | None) -> None:
        """Send a picture; `mark` where with it all of these inputs is drawn."""
        sources: Sources = {}
        ranges: Ranges = {}
        for drawing in picture.drawings:
            if drawing.data is not None:
                sources |= drawing.data[0]
                ranges |= drawing.data[1]
        self._drawn_mark = self._drawn_mark if mark is None else mark

        def change() -> None:
            self.packed.send(sources, ranges, self._drawn_mark, picture.seconds)
            for drawing in picture.drawings:
                drawing.view.say(picture.results if drawing.data else None, drawing.sentence)
            self.status.put(line={**picture.status, "tab": self.tabs.active})
            if picture.limits is not None:
                self.limits.put(rows=rows_of(picture.limits), summary=summary(picture.limits))

        await one_message(self._doc, change)

    async def _failed(self, error: Exception) -> None:
        """Something no view expected: say so, answer the mark, keep the last good picture."""
        write.log_warning("failed", self._doc, scene=write.scene_name(self.scene), view=self._shown)
        self._drawn_mark = self._mark

        def change() -> None:
            self.packed.send({}, {}, self._drawn_mark)
            self.status.put(line={"mood": "bad", "words": _BROKEN, "details": []})

        await one_message(self._doc, change)


def _picture(results: Results, views: Sequence[View], limits: bool = False) -> Picture:
    """Compute what the views need and have them say it, and what `limits` of the model say."""
    started, worked = time.perf_counter(), time.thread_time()  # of this thread: waiting is no cost
    shown = frozenset[str]().union(*(view.needs for view in views))
    results.prefetch(shown)
    drawings = [_drawing(results, view) for view in views]
    checked = results.limits if limits else None
    status = status_of(results, time.thread_time() - worked, shown)
    return Picture(results, drawings, status, checked, time.perf_counter() - started)


def _drawing(results: Results, view: View) -> Drawing:
    try:
        return Drawing(view, view.data(results), view.sentence(results))
    except Overtaken:
        raise
    except compiling.StillCompiling as wait:
        words = str(wait)
        return Drawing(view, None, f"{words[0].upper()}{words[1:]}. {_DRAWN_LATER}")
    except ValueError as error:
        return Drawing(view, None, f"Not shown for this scene: {words_of(error)}.")
    except Exception:
        log.exception("the view %s failed", view.name)
        return Drawing(view, None, _BROKEN)
