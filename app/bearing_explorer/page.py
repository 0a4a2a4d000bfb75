"""The page: the two halves of the program and the frame around them.

Only this file knows both halves; each half also works without the other.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import panel as pn

from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.plots.theme import dark_properties, themes
from bearing_explorer.kit.serve.bokeh_internals import PLAIN
from bearing_explorer.kit.serve.live import run_on_loop
from bearing_explorer.kit.serve.panel_internals import PageTemplate
from bearing_explorer.kit.serve.serving import collect_now_and_then
from bearing_explorer.kit.session import Section, Session
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.widgets.form import stack
from bearingcore import presets

try:
    from bearing_explorer.explorer import front as scene
except ModuleNotFoundError as error:
    if error.name != "bearing_explorer.explorer":  # the half exists but is broken
        raise
    scene = None  # type: ignore[assignment]
try:
    from bearing_explorer.diagnosis import front as signal
except ModuleNotFoundError as error:
    if error.name != "bearing_explorer.diagnosis":  # the half exists but is broken
        raise
    signal = None  # type: ignore[assignment]

_LAST = ("accuracy", "explore", "over-speed", "paper")
"""Tabs of the scene that come after those of the measured signal."""


def _ordered_sections() -> tuple[Section, ...]:
    scene_sections = scene.SECTIONS if scene else ()
    return (
        *(section for section in scene_sections if section.name not in _LAST),
        *(signal.SECTIONS if signal else ()),
        *(section for section in scene_sections if section.name in _LAST),
    )


SECTIONS = _ordered_sections()
"""The tabs. Only the views of the open tab are computed and sent."""

TABS = tuple((s.name, tuple(view.name for view in s.views)) for s in SECTIONS)
"""Names of the tabs and of their views, as used in lessons."""

PYTHON_INSTALL = "pip install ."
"""Command that installs the program, as the page shows it."""


class Halves:
    """A session with its halves; a half that is not installed is None.

    `address` is the query of the page's address; it is not trusted.
    """

    def __init__(self, address: str = "", lessons: Any = ()) -> None:
        self.explorer = (
            scene.Explorer(scene.SECTIONS, address=address, lessons=lessons) if scene else None
        )
        self.diagnosis = signal and signal.DiagnosisOfSignal(
            signal.SECTIONS,
            lambda: self.explorer.focused_scene if self.explorer else presets["fan-rig"],
        )
        both: tuple[Any, ...] = self.explorer, self.diagnosis
        half_of = {section: half for half in both if half for section in half.sections}
        halves = {section: half_of[section] for section in SECTIONS}
        self.session = Session(halves, self.explorer.bookmarks.tab if self.explorer else "")
        if self.explorer is not None and self.diagnosis is not None:
            self.explorer.report_on_signal = self.diagnosis.report
            self.explorer.simulate = self.diagnosis.simulate
            self.diagnosis.measurement.can_simulate = True


def half_of(view: type[View]) -> Any:
    """Return the half to which a view belongs."""
    is_of_signal = signal is not None and any(view in tab.views for tab in signal.SECTIONS)
    return signal if is_of_signal else scene


def page_query() -> str:
    """Return the query of this page's address: the part behind the question mark."""
    arguments = pn.state.session_args or {}
    return urlencode([(name, value) for name, values in arguments.items() for value in values])


@cache
def _frame() -> Any:
    """Read the frame of all pages, once per process."""
    return PageTemplate(asset_text("page.html")).template


def lessons_of(folder: Path | None = None) -> Any:
    """Return the lessons of a folder, or the program's own."""
    if scene is None:
        return ()
    return scene.lessons_in(folder, TABS) if folder else scene.shipped_lessons(TABS)


def page(lessons: Path | None = None) -> PageTemplate:
    """Make the page of a new session; lessons of the folder `lessons` replace the program's own."""
    if scene is not None:
        scene.begin_compiling()
    halves = Halves(page_query(), lessons_of(lessons))
    session, explorer = halves.session, halves.explorer
    template = PageTemplate(_frame())
    style = "".join(map(asset_text, ("page.css", "picture.css"))) + dark_properties()
    helps = scene.help_texts() if scene else {}
    for name, text in {
        "style": style,
        "logo": asset_text("logo.svg"),
        "themes": themes(),
        "look_script": asset_text("look.js"),
        "connection_script": asset_text("connection.js"),
        "order_script": "" if PLAIN else asset_text("in_order.js"),
        "figures_script": "" if PLAIN else asset_text("fast_figures.js"),
        "python_install": PYTHON_INSTALL,
        "scene": scene is not None,
        "signal": signal is not None,
        "page_script": scripts("element.js", "pointed.js", "page.js"),
        **{name: helps.get(name, "") for name in ("glossary", "bearing_picture", "python_lines")},
    }.items():
        template.add_variable(name, text)
    lesson = explorer.lesson if explorer else pn.Spacer(width=0, height=0)
    controls = (
        stack(explorer.share, explorer.controls) if explorer else pn.Spacer(width=0, height=0)
    )
    template.add_panel("lesson", lesson)
    template.add_panel("controls", controls)
    template.add_panel("tabs", session.tabs)
    template.add_panel("main", session.main)
    template.add_panel("status", session.status)
    template.add_panel("limits", session.limits)
    template.add_panel("packed", pn.pane.Bokeh(session.packed.anchor, margin=0))
    doc = pn.state.curdoc
    pn.state.onload(lambda: run_on_loop(doc, session.start))
    pn.state.on_session_destroyed(lambda _: session.stop())
    pn.state.on_session_destroyed(lambda _: collect_now_and_then())
    if doc is not None:
        doc.title = "Bearing explorer"
    return template
