"""The page: the views of each tab, and the frame around them."""

from __future__ import annotations

import html
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import panel as pn

from bearing_explorer.diagnosis.views.diagnosis import PartDiagnosis
from bearing_explorer.diagnosis.views.extent import SpallExtent
from bearing_explorer.diagnosis.views.how_sure import HowSure
from bearing_explorer.diagnosis.views.measured_envelope import MeasuredEnvelope
from bearing_explorer.diagnosis.views.measured_indicators import MeasuredIndicators
from bearing_explorer.diagnosis.views.measured_kurtogram import MeasuredKurtogram
from bearing_explorer.diagnosis.views.measured_spectrogram import MeasuredSpectrogram
from bearing_explorer.diagnosis.views.measured_spectrum import MeasuredSpectrum
from bearing_explorer.diagnosis.views.measurement import MeasuredSignal
from bearing_explorer.diagnosis.views.sizing import DefectSize
from bearing_explorer.diagnosis.views.trend import TrendOfFiles
from bearing_explorer.explorer.session import Explorer, Section
from bearing_explorer.explorer.state import glossary
from bearing_explorer.explorer.state.lessons import Tabs, lessons_in, own_folder, text_for_teachers
from bearing_explorer.explorer.views.accuracy import Accuracy
from bearing_explorer.explorer.views.alternatives import OtherModels
from bearing_explorer.explorer.views.bearing import BearingDrawing
from bearing_explorer.explorer.views.bearing_editor import BearingEditor
from bearing_explorer.explorer.views.bearing_picture import bearing_picture
from bearing_explorer.explorer.views.depth_profile import DepthProfile
from bearing_explorer.explorer.views.dof_comparison import DofDifferences
from bearing_explorer.explorer.views.explore import ExplorePlane
from bearing_explorer.explorer.views.life import LifeOfBearing
from bearing_explorer.explorer.views.load_distribution import LoadDistribution
from bearing_explorer.explorer.views.maps import StiffnessMaps
from bearing_explorer.explorer.views.mass_spectrum import MassInSpectrum
from bearing_explorer.explorer.views.mass_time import MassInTime
from bearing_explorer.explorer.views.mechanism import WhichMechanism
from bearing_explorer.explorer.views.model_editor import ModelEditor
from bearing_explorer.explorer.views.modes import NaturalFrequencies
from bearing_explorer.explorer.views.orbit import SteadyOrbit
from bearing_explorer.explorer.views.overview.bearing import OverviewBearing
from bearing_explorer.explorer.views.overview.change import LastChange
from bearing_explorer.explorer.views.overview.spectrum import OverviewSpectrum
from bearing_explorer.explorer.views.overview.stiffness import OverviewStiffness
from bearing_explorer.explorer.views.paper import PaperFigures
from bearing_explorer.explorer.views.slow_passage import SlowPassage
from bearing_explorer.explorer.views.speed_run import SpeedRunSpectra
from bearing_explorer.explorer.views.stability_map import OrbitStability
from bearing_explorer.explorer.views.stiffness import Stiffness
from bearing_explorer.explorer.views.theme import dark_properties, themes
from bearing_explorer.explorer.views.vibration_spectrum import VibrationSpectra
from bearing_explorer.explorer.views.vibration_time import VibrationInTime
from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.serve.fast import PLAIN
from bearing_explorer.kit.serve.live import on_loop
from bearing_explorer.kit.serve.template import PageTemplate
from bearing_explorer.kit.widgets.form import stack
from bearingcore import presets

SECTIONS = (
    Section(
        "overview",
        "Overview",
        (OverviewBearing, LastChange, OverviewStiffness, OverviewSpectrum),
        "Understand",
    ),
    Section("load", "Load", (BearingDrawing, LoadDistribution, DepthProfile)),
    Section("life", "Life", (LifeOfBearing,)),
    Section("stiffness", "Stiffness", (Stiffness,)),
    Section("maps", "Maps", (StiffnessMaps,)),
    Section("explore", "Explore", (ExplorePlane,)),
    Section("modes", "Frequencies", (NaturalFrequencies,), "Dynamics"),
    Section("vibration", "Vibration", (VibrationInTime, VibrationSpectra, SlowPassage)),
    Section("ball-mass", "Ball mass", (MassInTime, MassInSpectrum, WhichMechanism)),
    Section("orbits", "Orbits", (SteadyOrbit, OrbitStability)),
    Section("speed-run", "Speed run", (SpeedRunSpectra,)),
    Section("bearing", "Bearing", (BearingEditor,), "My machine"),
    Section("model", "Model", (ModelEditor, DofDifferences)),
    Section(
        "diagnosis",
        "Diagnosis",
        (
            MeasuredSignal,
            PartDiagnosis,
            SpallExtent,
            DefectSize,
            TrendOfFiles,
            MeasuredIndicators,
            MeasuredSpectrum,
            MeasuredEnvelope,
            MeasuredKurtogram,
            MeasuredSpectrogram,
            HowSure,
        ),
    ),
    Section("accuracy", "Accuracy", (Accuracy, OtherModels), "How sure"),
    Section("paper", "Paper", (PaperFigures,)),
)
"""The tabs; a group goes on until the next begins.

What is not on the tab that is open is neither computed nor sent.
"""


def address() -> str:
    """The part of this page's address behind the question mark."""
    given = pn.state.session_args or {}
    return urlencode([(name, value) for name, values in given.items() for value in values])


@cache
def _frame() -> Any:
    """The frame of all pages, read once a process."""
    return PageTemplate(asset_text("page.html")).template


PYTHON_INSTALL = "pip install ."
"""The page's note on how to install it."""

TABS: Tabs = tuple((s.name, tuple(view.name for view in s.views)) for s in SECTIONS)
"""Names of the tabs and of their views, as lessons speak of them."""


@cache
def _for_teachers() -> str:
    return text_for_teachers(TABS)


def page(lessons: Path | None = None) -> PageTemplate:
    """The page of a new session; `lessons` is a folder with other ones."""
    compiling.begin()
    known = lessons_in(lessons or own_folder(), TABS)
    explorer = Explorer(SECTIONS, address=address(), lessons=known)
    explorer.lesson.teachers = _for_teachers()
    template = PageTemplate(_frame())
    style = "".join(map(asset_text, ("page.css", "picture.css"))) + dark_properties()
    template.add_variable("style", style)
    template.add_variable("logo", asset_text("logo.svg"))
    template.add_variable("themes", themes())
    template.add_variable("look_script", asset_text("look.js"))
    template.add_variable("connection_script", asset_text("connection.js"))
    template.add_variable("order_script", asset_text("in_order.js"))
    template.add_variable("figures_script", "" if PLAIN else asset_text("fast_figures.js"))
    template.add_variable("glossary", glossary.as_html())
    template.add_variable("bearing_picture", bearing_picture(presets["fan-rig"].bearing))
    template.add_variable("python_install", PYTHON_INSTALL)
    template.add_variable("python_lines", html.escape(asset_text("notebooks/first_lines.py")))
    template.add_variable("page_script", scripts("element.js", "page.js"))
    template.add_panel("lesson", explorer.lesson)
    template.add_panel("tabs", explorer.tabs)
    side = stack(explorer.share, explorer.controls)
    template.add_panel("controls", side)
    template.add_panel("main", explorer.main)
    template.add_panel("status", explorer.status)
    template.add_panel("limits", explorer.limits)
    template.add_panel("packed", pn.pane.Bokeh(explorer.packed.anchor, margin=0))
    doc = pn.state.curdoc
    pn.state.onload(lambda: on_loop(doc, explorer.start))
    pn.state.on_session_destroyed(lambda _: explorer.stop())
    if doc is not None:
        doc.title = "Bearing explorer"
    return template
