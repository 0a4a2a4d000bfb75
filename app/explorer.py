"""The one state object of a session: controls -> Scene -> Results -> the views on screen."""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import panel as pn

from app.assets import asset_text
from app.controls import Controls
from app.live import LatestWins, in_thread, one_message, send_at_once
from app.quantities import CAGE_ANGLE, Limits, Values, limits_of, read, scene_with, values_of
from app.results import Results
from app.views.base import Ranges, Sources, View
from app.views.status import StatusLine, Tabs, status_of
from app.wire import Wire
from bearingcore import EDGES, Scene, presets

log = logging.getLogger(__name__)

#: a slow view that cost more than this [s] may be skipped while newer inputs wait ...
_HEAVY = 0.04
#: ... but not for longer than this [s]
_PATIENCE = 0.25

_BROKEN = "This could not be computed; what is shown belongs to an earlier position."


@dataclass(frozen=True)
class Section:
    """A part of the page that is on screen as a whole: a tab."""

    name: str
    title: str
    views: tuple[type[View], ...]


@dataclass(frozen=True)
class Inputs:
    """What is to be drawn; `mark` is the number of the newest change it holds."""

    scene: Scene
    cage_angle: float
    mark: int


@dataclass(frozen=True)
class Drawing:
    """What a view has to say about some results; without `data` it could not say anything."""

    view: View
    data: tuple[Sources, Ranges] | None
    sentence: str


@dataclass(frozen=True)
class Picture:
    """What some views have to say, and how the computation went."""

    drawings: list[Drawing]
    status: dict[str, Any]


class Explorer:
    """A session. `page.py` puts its parts on a page; the browser's messages arrive here."""

    def __init__(self, sections: Sequence[Section], preset: str = "fan-rig") -> None:
        self.wire = Wire()
        self._sections = {section.name: section for section in sections}
        self._views: dict[str, list[View]] = {}
        self._containers: dict[str, pn.Column] = {}
        self._mark = 0
        self._drawn_mark = 0
        self._slow_cost = 0.0
        self._slow_at = -math.inf
        self._doc = pn.state.curdoc
        self._worker: LatestWins[Inputs] = LatestWins(self._work, self._failed)

        self.values: Values
        self.scene: Scene
        self._base: Scene
        self._edge: str
        self._limits: dict[str, Limits]
        self._refused: set[str]
        self._take_preset(preset)
        self.controls = Controls(self._asked)
        self.controls.state = self._state()
        self.status = StatusLine(sizing_mode="stretch_width", margin=0)
        self._shown = next(iter(self._sections))
        self.tabs = Tabs(
            self._tab_asked,
            names=[[section.name, section.title] for section in sections],
            active=self._shown,
        )
        self.main = pn.Column(sizing_mode="stretch_width", margin=0)
        self._bring(self._shown)

    @property
    def inputs(self) -> Inputs:
        """What is to be drawn now."""
        angle = math.radians(self.values[CAGE_ANGLE])
        return Inputs(self.scene, angle, self._mark)

    def start(self) -> None:
        """The page is up: draw."""
        send_at_once(self._doc)
        self.draw()

    def stop(self) -> None:
        """The session is over."""
        self._worker.stop()

    def draw(self) -> None:
        """Bring what is on screen up to date."""
        self._worker.submit(self.inputs)

    # What the browser asks for. Its messages are not to be trusted.

    def _asked(self, message: Any) -> None:
        if not isinstance(message, dict):
            return
        mark = message.get("mark")
        if isinstance(mark, int) and 0 <= mark < 2**24:
            self._mark = mark
        try:
            if message.get("reset") is True:
                self._take_preset(self._preset)
                self.controls.tell(state=self._state())
            if isinstance(choose := message.get("choose"), dict):
                self._choose(choose)
            if isinstance(values := message.get("set"), dict):
                self._set(values)
            if isinstance(typed := message.get("typed"), dict):
                self._set(typed)
                taken = {name: self.values[name] for name in typed if name in self.values}
                if taken and not self._refused & taken.keys():
                    self.controls.tell(state={"values": taken})
        finally:
            self.draw()  # even a refusal is answered, or the browser would wait for its mark

    def _set(self, given: Mapping[Any, Any]) -> None:
        """Take numbers, dragged or typed; what is refused stays as it was, with a sentence."""
        values = dict(self.values)
        refused: dict[str, str] = {}
        for name, value in list(given.items())[: len(values)]:
            try:
                values[str(name)] = read(str(name), value, self._limits)
            except ValueError as error:
                refused[str(name)] = str(error)
        try:
            scene = scene_with(self._base, values, edge=self._edge)
        except ValueError as error:
            refused |= {str(name): f"Not possible: {error}." for name in given}
        else:
            self.values, self.scene = values, scene
        self._refused = set(refused)
        if refused:
            self.controls.tell(refused=refused)

    def _choose(self, choice: Mapping[Any, Any]) -> None:
        preset, edge = choice.get("preset"), choice.get("edge")
        if isinstance(preset, str) and preset in presets:
            self._take_preset(preset)
        if isinstance(edge, str) and edge in EDGES:
            self.scene = scene_with(self._base, self.values, edge=edge)
            self._edge = edge
        self.controls.tell(state=self._state())

    def _tab_asked(self, message: Any) -> None:
        name = message.get("show") if isinstance(message, dict) else None
        if isinstance(name, str) and name in self._sections:
            self._shown = name
            self.draw()

    def _take_preset(self, name: str) -> None:
        self._preset = name
        self._base = presets[name]
        self._edge = next((defect.edge for defect in self._base.defects), EDGES[0])
        self._limits = limits_of(self._base)
        self._refused = set()
        self.values = values_of(self._base)
        self.scene = scene_with(self._base, self.values, edge=self._edge)

    def _state(self) -> dict[str, Any]:
        choices = {"preset": self._preset, "edge": self._edge}
        return Controls.state_of(self.values, self._limits, choices)

    def _bring(self, name: str) -> None:
        """Put a section on screen; its figures are made when it is first asked for.

        Done by the worker, in the same order of messages as what is drawn on them: the browser
        must know a figure before it hears of its numbers.
        """
        if name not in self._containers:
            views = [view(self.wire) for view in self._sections[name].views]
            self._views[name] = views
            self._containers[name] = pn.Column(
                *(view.panel for view in views),
                stylesheets=[asset_text("section.css")],
                sizing_mode="stretch_width",
                margin=0,
            )
            self.main.append(self._containers[name])
        for other, container in self._containers.items():
            shown = "on-screen" if other == name else "off-screen"
            container.css_classes = ["section", f"section-{other}", shown]
        self.tabs.active = name

    # Drawing: off the event loop to compute, on it to assign.

    async def _work(self, inputs: Inputs) -> None:
        started = time.perf_counter()
        results = Results(inputs.scene, inputs.cage_angle)
        if self.tabs.active != self._shown:
            await one_message(self._doc, lambda: self._bring(self._shown))
        views = self._views[self._shown]
        slow = [view for view in views if view.needs & Results.slow]
        quick = [view for view in views if view not in slow]
        if self._worker.waiting and self._slow_cost > _HEAVY:
            slow = slow if started - self._slow_at > _PATIENCE else []

        if quick or not slow:
            picture = await in_thread(_picture, results, quick, started)
            await self._assign(results, picture, None if slow else inputs.mark)
        if slow:
            before = time.perf_counter()
            picture = await in_thread(_picture, results, slow, started)
            self._slow_at = time.perf_counter()
            self._slow_cost = self._slow_at - before
            await self._assign(results, picture, inputs.mark)

    async def _assign(self, results: Results, picture: Picture, mark: int | None) -> None:
        """Send a picture; `mark` where with it all of these inputs is drawn."""
        sources: Sources = {}
        ranges: Ranges = {}
        for drawing in picture.drawings:
            if drawing.data is not None:
                sources |= drawing.data[0]
                ranges |= drawing.data[1]
        self._drawn_mark = self._drawn_mark if mark is None else mark

        def change() -> None:
            self.wire.send(sources, ranges, self._drawn_mark)
            for drawing in picture.drawings:
                drawing.view.say(results if drawing.data else None, drawing.sentence)
            self.status.line = picture.status

        await one_message(self._doc, change)

    async def _failed(self, error: Exception) -> None:
        """Something no view expected: say so, answer the mark, keep the last good picture."""
        self._drawn_mark = self._mark

        def change() -> None:
            self.wire.send({}, {}, self._drawn_mark)
            self.status.line = {"mood": "bad", "words": _BROKEN, "details": []}

        await one_message(self._doc, change)


def _picture(results: Results, views: Sequence[View], started: float) -> Picture:
    """Compute what the views need and have them say it. Runs in a worker thread."""
    drawings = [_drawing(results, view) for view in views]
    return Picture(drawings, status_of(results, time.perf_counter() - started))


def _drawing(results: Results, view: View) -> Drawing:
    try:
        return Drawing(view, view.data(results), view.sentence(results))
    except ValueError as error:
        return Drawing(view, None, f"Not shown for this scene: {error}.")
    except Exception:
        log.exception("the view %s failed", view.name)
        return Drawing(view, None, _BROKEN)
