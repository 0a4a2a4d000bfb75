"""A session and its halves: newest content -> picture -> views on screen."""

from __future__ import annotations

import asyncio
import logging
import math
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from functools import partial
from typing import Any

import panel as pn

from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.drawing_loop import DrawingLoop
from bearing_explorer.kit.compute.executors import run_in_thread, run_in_turn
from bearing_explorer.kit.compute.jobs import Change, Jobs
from bearing_explorer.kit.pictures import BROKEN, Picture, picture_of
from bearing_explorer.kit.serve import log as write
from bearing_explorer.kit.serve.live import one_message, send_at_once
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearing_explorer.kit.views.content import Content, Warnings
from bearing_explorer.kit.widgets.form import stack
from bearing_explorer.kit.widgets.limits import LimitsStrip, judged
from bearing_explorer.kit.widgets.status import StatusLine, Tabs

log = logging.getLogger(__name__)

#: slow views are drawn together with the others while a slider moves, so that nothing is painted
#: twice. If they cost more than this [s] they come after the others, and may be skipped while
#: newer content waits ...
_HEAVY = 0.04
#: ... but not for longer than this [s]
_PATIENCE = 0.25

#: pictures that took less than this [s] of a processor are made on the event loop: with thirty
#: people on one interpreter, threads that wait for each other take half as long again
_AT_ONCE = 0.025

#: a tab opens together with its fine picture where that takes less than this [s]
_SOON = 0.2

#: warnings are computed when the slider rests, and with the first change after this time [s],
#: because a typed number may be far over a limit. While a slider moves they are computed after this
#: time and this number of pictures: they cost as much as two pictures, and many share the machine
_WARNINGS_EVERY = 1.0
_WARNINGS_PICTURES = 10


@dataclass(frozen=True)
class Section:
    """A part of the page that is on screen as a whole: a tab, or one of the parts of a `tab`."""

    name: str
    title: str
    views: tuple[type[View], ...]
    tab: str = ""
    """Title of the tab, where that has several parts; they stand one after the other."""


class Half:
    """A half of the program. Its methods are called on the event loop of the session."""

    sections: tuple[Section, ...]
    """Its tabs."""
    kind_of_content: type
    """Type of its content; the other half has another one."""
    page: Session
    jobs: Jobs
    """The background jobs of the session."""

    def join(self, page: Session) -> None:
        """Join a session as one of its halves; called once, before anything else."""
        self.page, self.jobs = page, page.jobs

    def content(self) -> Content:
        """Return the content of the next picture, while a slider moves."""
        raise NotImplementedError

    def draw(self) -> None:
        """Draw the views on screen anew."""
        self.page.draw()

    def attach(self, view: View) -> None:
        """Give a view of its tabs this half of the session."""
        view.attach(self)

    def tab_opened(self, name: str) -> None:
        """Note that a tab of either half was opened."""

    def stop(self) -> None:
        """End all work of the half: the session is over."""


class Session:
    """A session. `page.py` puts its parts on a page; the browser's messages arrive in its halves.

    Parameters
    ----------
    halves
        half of the program for each tab; the page has the tabs in this order.
    tab
        tab that is open at first; if there is no such tab, the first one is.
    """

    def __init__(self, halves: Mapping[Section, Half], tab: str = "") -> None:
        self.packed = PackedSource()
        #: number of the newest change of the browser
        self.mark = 0
        self._halves = {section.name: half for section, half in halves.items()}
        self._sections = {section.name: section for section in halves}
        self._views: dict[str, list[View]] = {}
        self._drawn_mark = 0
        self._slow_cost = self._quick_cost = math.inf
        self._slow_at = self._warnings_at = self._moved_at = -math.inf
        self._warnings = Warnings()
        self._pictures = 0  # drawn since warnings were last computed
        self._doc = pn.state.curdoc
        self._compiling: asyncio.Task[None] | None = None
        self._loop: DrawingLoop[Content, Picture] = DrawingLoop(
            self._draw_newest, self._fine_picture, self._draw_fine, self._failed
        )
        self._refined: tuple[object, ...] = ()  # tab and key of the content that is drawn finely
        self.jobs = Jobs(self.assign)
        self._shown = tab if tab in self._sections else next(iter(self._sections))
        self.status = StatusLine(folded=True, css_classes=["one-line"])
        self.limits = LimitsStrip()
        self._on_screen = self._attached = ""  # tab on the server, and in the browser
        self.tabs = Tabs(
            self.show_tab,
            names=[[part.name, part.title, part.tab or part.title] for part in halves],
            active=self._shown,
        )
        # one place for each tab: otherwise the browser would go through all tabs for each new one
        self._containers = {name: _place(name) for name in self._sections}
        places = self._containers.values()
        self.main = pn.Column(*places, sizing_mode="stretch_both", margin=0)  # the page's height
        for half in self._each_half():
            half.join(self)

    def _each_half(self) -> list[Half]:
        return list({id(half): half for half in self._halves.values()}.values())

    @property
    def shown(self) -> str:
        """Name of the tab that is open."""
        return self._shown

    @property
    def content(self) -> Content:
        """The content of the next picture."""
        return self._halves[self._shown].content()

    async def assign(self, change: Change) -> None:
        """Change models of the page, in one message."""
        await one_message(self._doc, change)

    def views_made(self) -> list[View]:
        """Return all views that have been on screen."""
        return [view for views in self._views.values() for view in views]

    def start(self) -> None:
        """Draw for the first time, once the page is up."""
        send_at_once(self._doc)
        self.draw()
        if compiling.left():
            drawing = self._draw_when_compiled()
            self._compiling = asyncio.get_running_loop().create_task(drawing)

    def stop(self) -> None:
        """End the session: begin nothing more, and drop what waits for its turn."""
        self._loop.stop()
        self.jobs.stop()
        if self._compiling is not None:
            self._compiling.cancel()
        for half in self._each_half():
            half.stop()
        for view in self.views_made():
            view.end()

    def draw(self) -> None:
        """Draw the views on screen anew."""
        content = self.content
        self._loop.submit(content.at_rest(self._refined == (self._shown, *content.fine_key)))

    async def _draw_when_compiled(self) -> None:
        """Draw anew whenever a part of the kernels is ready, and show the progress."""
        left: tuple[str, ...] | None = None
        while left != ():
            if left == (left := compiling.left()):
                await asyncio.sleep(0.3)
                continue
            show = partial(self.status.put, progress=compiling.progress())
            await one_message(self._doc, show)
            self._refined = ()
            self.draw()

    def show_tab(self, message: Any) -> None:
        """Open the tab that a message names."""
        name = message.get("show") if isinstance(message, dict) else None
        if isinstance(name, str) and name in self._sections:
            self._shown = name
            for half in self._each_half():
                half.tab_opened(name)
            self.draw()

    async def _make_tab(self, name: str) -> None:
        """Make the figures of a section when it is first opened.

        This holds the interpreter, so it is done on the event loop, one session after the other. If
        30 people come at once, threads that take the interpreter from each other would make the
        last picture a sixth later.
        """
        if name not in self._views:
            kinds = self._sections[name].views
            self._views[name] = await run_in_turn(lambda: [view(self.packed) for view in kinds])
            for view in self._views[name]:
                self._halves[name].attach(view)
        self._on_screen = name

    async def _send(self, change: Callable[[], None]) -> None:
        """Change models of the page, and put the open tab on screen in the same message.

        The browser must have a figure before its numbers arrive.
        """
        name = self._on_screen

        def act() -> None:
            if name != self._attached:
                self._attach_tab(name)
            change()

        await one_message(self._doc, act)

    def _attach_tab(self, name: str) -> None:
        """Put the views of a tab on screen, and hide those of the others."""
        new = not self._containers[name].objects and self._doc is not None
        # frozen, Bokeh counts the models of the document once, before numbers bring more of them
        with self._doc.models.freeze() if new else nullcontext():
            if not self._containers[name].objects:
                self._containers[name].objects = [view.panel for view in self._views[name]]
            for other, container in self._containers.items():
                container.css_classes = _classes(other, shown=other == name)
                if other != name:
                    for view in self._views.get(other, ()):
                        view.put_away()
            self.packed.introduce()
        self.tabs.active = self._attached = name

    async def _open_finely(self, content: Content) -> bool:
        """Open the tab with its fine picture and return True, if that is ready soon; else empty.

        A tab that opens empty is laid out and painted three times: empty, coarsely and finely.
        """
        fine, views = content.at_rest(), self._views[self._on_screen]
        drawing = asyncio.ensure_future(run_in_thread(picture_of, fine, views, True))
        await asyncio.wait({drawing}, timeout=_SOON)
        if not drawing.done():
            drawing.add_done_callback(lambda done: done.cancelled() or done.exception())
            await self._send(lambda: None)
            return False
        await self._draw_fine(content, drawing.result())
        return True

    # Drawing: off the event loop to compute, on it to assign.

    async def _draw_newest(self, content: Content) -> Content:
        started = time.perf_counter()
        opens = self._on_screen != self._shown
        if opens:
            await self._make_tab(self._shown)
            self._slow_cost = self._quick_cost = math.inf  # not known yet
        if not self._is_for_screen(content):  # a tab of the other half was opened meanwhile
            content = self._halves[self._on_screen].content()
        if opens and await self._open_finely(content):
            content = content.at_rest()
        else:
            content = await self._draw_following(content.at_rest(False) if opens else content)
        write.update(self._doc, content.log_name, self._on_screen, time.perf_counter() - started)
        compiling.drawn()
        if self._on_screen != self._shown:
            # another tab was opened meanwhile, and no newer content may be waiting
            self.draw()
        return content

    async def _draw_following(self, content: Content) -> Content:
        """Draw the views that follow a slider, slow ones after the others."""
        quick, slow = self._quick_and_slow(content)
        if quick or not slow:
            run = run_in_turn if self._quick_cost < _AT_ONCE else run_in_thread
            content, picture = await run(self._newest_picture, content, quick)
            self._quick_cost = picture.work
            await self._assign(picture, None if slow else content.mark)
        if slow:
            before = time.perf_counter()
            warnings = not quick and self._warnings_due(content)
            picture = await run_in_thread(picture_of, content, slow, warnings)
            self._slow_at = time.perf_counter()
            self._slow_cost = self._slow_at - before
            await self._assign(picture, content.mark)
        return content

    def _quick_and_slow(self, content: Content) -> tuple[list[View], list[View]]:
        """Return the views that follow a slider, and slow ones to draw after them, if any."""
        started = time.perf_counter()
        views = [view for view in self._views[self._on_screen] if not view.at_rest]
        slow = [view for view in views if view.needs & content.slow]
        quick = [view for view in views if view not in slow]
        # slow views are heavy if they would delay quick ones; others are drawn together with them
        heavy = self._slow_cost > _HEAVY and any(view.needs for view in quick)
        if slow and not heavy and math.isfinite(self._slow_cost) and content.moving:
            quick, slow = [], views
        # while newer content waits, heavy views are skipped, but not for too long
        if heavy and self._loop.waiting:
            slow = slow if started - self._slow_at > _PATIENCE else []
        return quick, slow

    def _is_for_screen(self, content: Content) -> bool:
        """Return True if this is content of the half whose tab is on screen."""
        return isinstance(content, self._halves[self._on_screen].kind_of_content)

    def _newest_picture(self, content: Content, views: Sequence[View]) -> tuple[Content, Picture]:
        """Draw the newest content: it may have changed while this waited for a thread."""
        newest = self._loop.newest(content)
        content = newest if self._is_for_screen(newest) else content
        return content, picture_of(content, views, self._warnings_due(content))

    def _fine_picture(self, content: Content) -> Picture | None:
        """Draw the views that are finer at rest, with warnings; None if all are drawn finely."""
        if not content.moving or not self._is_for_screen(content):
            return None
        on_screen = self._views[self._on_screen]
        # views without needs may have waited for the slider to rest
        finer = [
            view
            for view in on_screen
            if view.at_rest or not view.needs or content.is_finer_at_rest(view.needs)
        ]
        return picture_of(content.at_rest(), finer, warnings=True, on_screen=on_screen)

    async def _draw_fine(self, content: Content, picture: Picture) -> None:
        await self._assign(picture, content.mark)
        self._refined = self._on_screen, *content.fine_key

    def _warnings_due(self, content: Content) -> bool:
        """Return True if warnings are to be computed with this picture; count pictures."""
        now = time.perf_counter()
        self._pictures += 1
        long_ago = now - self._warnings_at > _WARNINGS_EVERY
        paused = now - self._moved_at > _WARNINGS_EVERY
        self._moved_at = now if content.moving else self._moved_at
        due = not content.moving or paused or (long_ago and self._pictures >= _WARNINGS_PICTURES)
        if due:
            self._warnings_at, self._pictures = now, 0
        return due

    async def _assign(self, picture: Picture, mark: int | None) -> None:
        """Send a picture; `mark` is that of its content if all of that is drawn with it."""
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
                drawing.view.put_head(picture.content)
                drawing.view.say(picture.content if drawing.data else None, drawing.sentence)
            if picture.warnings is not None:
                self._warnings = warnings = picture.warnings
                self.limits.put(rows=list(warnings.rows), summary=warnings.summary)
            line = judged(picture.status, self._warnings.rows)
            self.status.put(line={**line, "tab": self.tabs.active})

        await self._send(change)

    async def _failed(self, error: Exception) -> None:
        """After an unexpected error, show a sentence, answer the mark, keep the last picture."""
        name = self.content.log_name()
        write.log_warning("failed", self._doc, scene=name, view=self._shown)
        self._drawn_mark = self.mark

        def change() -> None:
            self.packed.send({}, {}, self._drawn_mark)
            self.status.put(line={"mood": "bad", "words": BROKEN, "details": []})

        await self._send(change)


def _classes(name: str, *, shown: bool) -> list[str]:
    """Return the classes of the place of a tab, for styles and scripts."""
    return ["section", f"section-{name}", "on-screen" if shown else "off-screen"]


def _place(name: str) -> pn.Column:
    """Make the layout of a tab that is not open yet."""
    return stack(css_classes=_classes(name, shown=False), stylesheets=[asset_text("section.css")])
