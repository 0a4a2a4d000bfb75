"""How the page is put together: which views stand on which tab, and the frame around them."""

from __future__ import annotations

import logging
from functools import cache
from pathlib import Path
from urllib.parse import urlencode

import panel as pn

import bearingcore
from app import compiling
from app.assets import asset_text
from app.explorer import Explorer, Section
from app.lessons import Tabs, lessons_in, own_folder
from app.live import on_loop
from app.template import PageTemplate
from app.views.accuracy import Accuracy
from app.views.bearing import BearingDrawing
from app.views.bearing_editor import BearingEditor
from app.views.depth_profile import DepthProfile
from app.views.dof_comparison import DofDifferences
from app.views.explore import ExplorePlane
from app.views.load_distribution import LoadDistribution
from app.views.maps import StiffnessMaps
from app.views.measured_envelope import MeasuredEnvelope
from app.views.measured_spectrum import MeasuredSpectrum
from app.views.measurement import MeasuredSignal
from app.views.model_editor import ModelEditor
from app.views.modes import NaturalFrequencies
from app.views.orbit import SteadyOrbit
from app.views.plan import PlanInFull
from app.views.sizing import DefectSize
from app.views.speed_run import SpeedRunSpectra
from app.views.stability_map import OrbitStability
from app.views.stiffness import Stiffness
from app.views.theme import dark_properties, themes
from app.views.vibration_spectrum import VibrationSpectra
from app.views.vibration_time import VibrationInTime

log = logging.getLogger(__name__)

SECTIONS = (
    Section("load", "Load", (BearingDrawing, LoadDistribution, DepthProfile), "At rest"),
    Section("stiffness", "Stiffness", (Stiffness,)),
    Section("maps", "Maps", (StiffnessMaps,)),
    Section("modes", "Natural frequencies", (NaturalFrequencies,)),
    Section("vibration", "Vibration", (VibrationInTime, VibrationSpectra), "In motion"),
    Section("orbits", "Orbits", (SteadyOrbit, OrbitStability)),
    Section("speed-run", "Speed run", (SpeedRunSpectra,)),
    Section("explore", "Explore", (ExplorePlane,), "Tools"),
    Section("sizing", "Sizing", (MeasuredSignal, MeasuredSpectrum, MeasuredEnvelope, DefectSize)),
    Section("accuracy", "Accuracy", (PlanInFull, Accuracy)),
    Section("bearing", "Bearing", (BearingEditor,), "Numbers"),
    Section("model", "Model", (ModelEditor, DofDifferences)),
)
"""The tabs; a group goes on until the next begins.

What is not on the tab that is open is neither computed nor sent.
"""


@cache
def warm_once() -> None:
    """Compile the kernels, once a process, before anybody's first drag waits for them."""
    bearingcore.warm(report=log.info)


def address() -> str:
    """What stands behind the question mark in the address of this session's page."""
    given = pn.state.session_args or {}
    return urlencode([(name, value) for name, values in given.items() for value in values])


TABS: Tabs = tuple((s.name, tuple(view.name for view in s.views)) for s in SECTIONS)
"""Names of the tabs and of their views, as lessons speak of them."""


def page(lessons: Path | None = None) -> PageTemplate:
    """The page of a new session; `lessons` is a folder with somebody's own."""
    compiling.begin()
    known = lessons_in(lessons or own_folder(), TABS)
    explorer = Explorer(SECTIONS, address=address(), lessons=known)
    template = PageTemplate(asset_text("page.html"))
    template.add_variable("style", asset_text("page.css") + dark_properties())
    template.add_variable("logo", asset_text("logo.svg"))
    template.add_variable("themes", themes())
    template.add_variable("theme_script", asset_text("theme.js"))
    template.add_variable("page_script", asset_text("page.js"))
    template.add_panel("lesson", explorer.lesson)
    template.add_panel("tabs", explorer.tabs)
    side = pn.Column(explorer.share, explorer.controls, sizing_mode="stretch_width", margin=0)
    template.add_panel("controls", side)
    template.add_panel("main", explorer.main)
    template.add_panel("status", explorer.status)
    template.add_panel("plan", explorer.plan)
    template.add_panel("limits", explorer.limits)
    template.add_panel("wire", pn.pane.Bokeh(explorer.wire.anchor, margin=0))
    doc = pn.state.curdoc
    pn.state.onload(lambda: on_loop(doc, explorer.start))
    pn.state.on_session_destroyed(lambda _: explorer.stop())
    if doc is not None:
        doc.title = "Bearing explorer"
    return template
