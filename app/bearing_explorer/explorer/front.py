"""Names of the scene's half that the page uses: tabs, session, lessons, help, kernels."""

from __future__ import annotations

import html
from collections.abc import Callable

from bearing_explorer.explorer.half import Explorer
from bearing_explorer.explorer.results import default_results
from bearing_explorer.explorer.state.field_values import SHOWN_FIELDS
from bearing_explorer.explorer.state.lessons import (
    Fault,
    Tabs,
    lessons_in,
    shipped_lessons,
)
from bearing_explorer.explorer.views.accuracy import Accuracy
from bearing_explorer.explorer.views.alternatives import OtherModels
from bearing_explorer.explorer.views.bearing import BearingDrawing
from bearing_explorer.explorer.views.bearing_editor import BearingEditor
from bearing_explorer.explorer.views.bearing_picture import bearing_picture
from bearing_explorer.explorer.views.depth_profile import DepthProfile
from bearing_explorer.explorer.views.displacement import Displacement, OperatingPoint
from bearing_explorer.explorer.views.explore import ExplorePlane
from bearing_explorer.explorer.views.life import LifeOfBearing
from bearing_explorer.explorer.views.load_distribution import LoadDistribution
from bearing_explorer.explorer.views.maps import StiffnessMaps
from bearing_explorer.explorer.views.mass_time import MassInTime
from bearing_explorer.explorer.views.mechanism import WhichMechanism
from bearing_explorer.explorer.views.model_editor import ModelEditor
from bearing_explorer.explorer.views.modes import NaturalFrequencies
from bearing_explorer.explorer.views.overview.bearing import OverviewBearing
from bearing_explorer.explorer.views.overview.change import LastChange
from bearing_explorer.explorer.views.overview.spectrum import OverviewSpectrum
from bearing_explorer.explorer.views.overview.stiffness import OverviewStiffness
from bearing_explorer.explorer.views.paper import PaperFigures
from bearing_explorer.explorer.views.scene_figure import figure_of
from bearing_explorer.explorer.views.slow_passage import SlowPassage
from bearing_explorer.explorer.views.speed_run import SpeedRunSpectra
from bearing_explorer.explorer.views.stiffness import Stiffness
from bearing_explorer.explorer.views.vibration_spectrum import VibrationSpectra
from bearing_explorer.explorer.views.vibration_time import VibrationInTime
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.session import Section
from bearingcore import presets

__all__ = [
    "SECTIONS",
    "Explorer",
    "Fault",
    "Tabs",
    "begin_compiling",
    "figure_of",
    "help_texts",
    "lessons_in",
    "shipped_lessons",
]

SECTIONS = (
    Section(
        "overview",
        "Overview",
        (OverviewBearing, LastChange, OverviewStiffness, OverviewSpectrum),
    ),
    Section("load", "Load", (BearingDrawing, LoadDistribution, Displacement, DepthProfile)),
    Section("stiffness", "Curves", (Stiffness,), "Stiffness"),
    Section("maps", "Maps", (StiffnessMaps,), "Stiffness"),
    Section("modes", "Frequencies", (NaturalFrequencies,)),
    Section(
        "vibration",
        "Vibration",
        (VibrationInTime, VibrationSpectra, SlowPassage, MassInTime, WhichMechanism),
    ),
    Section("bearing", "Bearing", (BearingEditor,), "Machine"),
    Section("model", "Rotor and support", (ModelEditor, OperatingPoint), "Machine"),
    Section("life", "Life", (LifeOfBearing,), "Machine"),
    Section("accuracy", "Accuracy", (Accuracy, OtherModels)),
    Section("explore", "Explore", (ExplorePlane,), "More"),
    Section("over-speed", "Over speed", (SpeedRunSpectra,), "More"),
    Section("paper", "Paper", (PaperFigures,), "More"),
)
"""Tabs of the scene, and their parts."""

EXPLAINED = ("Defect", "Turning", "Load", "Balls", "Rows", "Drawing", "Contact", "Races", "Bodies")
"""Groups of fields in the glossary of the help; the other groups are springs and dampers."""


def begin_compiling(**report: Callable[..., object]) -> None:
    """Begin to compile the kernels; until that ends, the stored default results are drawn."""
    compiling.begin(default_results.keep, **report)


def help_texts() -> dict[str, str]:
    """Parts of the page's help about the scene: HTML by name."""
    return {
        "glossary": _quantities(),
        "bearing_picture": bearing_picture(presets["fan-rig"].bearing),
        "python_lines": html.escape(asset_text("notebooks/first_lines.py")),
    }


def _quantities() -> str:
    """Fields with label, symbol, unit and meaning, as the rows of a table."""
    fields = [field for field in SHOWN_FIELDS if field.group in EXPLAINED]
    return "".join(
        f"<tr><th scope=row>{html.escape(field.read_label)}</th>"
        f"<td><i>{field.read_symbol_html}</i></td>"
        f"<td>{field.shown_unit}</td><td>{html.escape(field.meaning)}</td></tr>"
        for field in sorted(fields, key=lambda field: field.read_label.casefold())
    )
