"""What holds for every view of the page."""

import csv
import io
import math
import re
from functools import cache

import numpy as np
import pytest
from bearing_explorer.diagnosis.diagnoses import Question, answered, extent_of
from bearing_explorer.diagnosis.views.diagnosis import PartDiagnosis
from bearing_explorer.diagnosis.views.extent import SpallExtent
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.control_view import ControlView
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.pictures import BROKEN, drawing_of
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View, parts_of
from bearing_explorer.kit.views.job_view import JobView
from bearing_explorer.page import SECTIONS

from bearingcore import Defect, RoughFloor, presets
from tests.helpers.measuring import measuring, signal

VIEWS = [view for section in SECTIONS for view in section.views]
ALIKE = {
    *("6203", "6206", "209", "seven-ball", "7208-15deg", "7208-40deg"),
    *("7208-face-to-face", "7208-tandem", "3208"),
}
"""Presets of a kind that another one stands for."""
EVERY_DAY = ("fan-rig", "7208-back-to-back", "nu208", "1208", "axial", "both races")
"""Scenes of each kind that stand for the others where time is short."""
WITH_A_SIGNAL = ("fan-rig", "both races")
"""Scenes beside which views of a measured signal are drawn, of which little depends on them."""
SCENES = {
    **{name: scene for name, scene in presets.items() if name not in ALIKE},
    "healthy": presets["fan-rig"].healthy(),
    "axial": presets["fan-rig"].replace(fz=50.0),
    "inner": presets["fan-rig"].replace(race="inner"),
    "both races": presets["fan-rig"].replace(
        defect=(Defect(0.3, 50e-6, 4.7), Defect(0.2, 30e-6, 1.0, "inner"))
    ),
    "rough": presets["fan-rig"].replace(floor=RoughFloor(5e-6, 100e-6)),
    "all around": presets["fan-rig"].replace(extent=2.0 * math.pi),
}

diagnosed, measured_extent = cache(answered), cache(extent_of)
"""Answers about a bearing, which several scenes have."""


def test_captions_begin_with_a_short_sentence_and_the_rest_opens() -> None:
    """It fits one line on a phone too; the key of a figure is seen."""
    views = [view for view in VIEWS if not view.compact]
    lines = {view.name: re.split(r"(?<=\.) ", view.about)[0] for view in views}
    assert {name: line for name, line in lines.items() if not 8 < len(line) <= 54} == {}
    text = "One, 0.5 of it. More. Grey: re 1 (m/s²)². “Three”."
    assert parts_of(text, key_alone=False) == (
        "One, 0.5 of it. Grey: re 1 (m/s²)².",
        "More. “Three”.",
    )
    assert parts_of(text, key_alone=True)[0] == "Grey: re 1 (m/s²)²."
    for view in VIEWS:
        rest = parts_of(view.about, key_alone=True)[1]
        assert not re.search(r"\b(Grey|Shaded|Dashed|Blue|Dots): ", rest)


@pytest.mark.parametrize(
    ("name", "view"),
    [
        pytest.param(
            name,
            view,
            id=f"{name}-{view.name}",
            marks=[pytest.mark.proof]
            * (name not in EVERY_DAY or ("ball_mass" in view.needs and name != "fan-rig")),
        )
        for name in SCENES
        for view in VIEWS
        if name in WITH_A_SIGNAL or not issubclass(view, MeasuredView)
    ],
)
def test_every_view_draws_every_scene(name: str, view: type[View]) -> None:
    """It fills the sources it declared, in words and as a table.

    Of slow answers it reads those alone that it says it needs: others would be computed among the
    quick ones and hold them up.
    """
    asked: set[str] = set()

    class Watched(Results):
        def __getattribute__(self, name: str) -> object:
            asked.add(name)
            return super().__getattribute__(name)

    results = Watched(SCENES[name], 0.1)
    packed = PackedSource()
    made = view(packed)
    if isinstance(made, MeasuredView):
        made.measure(measuring(signal()))
    if isinstance(made, PartDiagnosis | SpallExtent):  # whose answers come from the background
        about = Question.about(signal())
        made.measurement.diagnoses.keep(about, diagnosed(about))
    if isinstance(made, SpallExtent):
        question = made.question()
        made.measurement.extents.keep(question, measured_extent(question))
    if "ball_mass" in view.needs and results.scene.bearing.kind.mass_unknown:
        drawing = drawing_of(results, made)
        assert drawing.data is None
        assert drawing.sentence == (
            "Not shown for this scene: the model has no mass of tapered rollers: a rib holds them, "
            "which is left out."
        )
        return
    for plot in made.figures:
        for drawn in (plot.x_range, plot.y_range):
            way_back = drawn.reset_start, drawn.reset_end
            assert way_back == (drawn.start, drawn.end), "two clicks lead to the whole figure"
    data, ranges = made.all_data(results)
    assert packed.pack(data, ranges).size > 3 or isinstance(made, ControlView)
    assert all(np.isfinite(limits).all() and limits[0] != limits[1] for limits in ranges.values())
    assert made.sentence(results).endswith(".")
    assert asked & Results.slow <= view.needs
    made.say(results, "")
    rows = list(csv.reader(io.StringIO(made.csv())))
    if not isinstance(made, JobView):  # which has numbers when its job has been asked for
        assert len(rows) > 1
    assert len({len(row) for row in rows}) == 1


@pytest.mark.parametrize("view", VIEWS, ids=lambda view: view.name)
def test_a_scene_without_an_answer_gets_words_from_every_view(view: type[View]) -> None:
    results = Results(presets["fan-rig"].replace(fy=0.0), 0.1)
    made = view(PackedSource())
    if isinstance(made, MeasuredView):  # which say nothing before there is a signal
        made.measure(measuring(signal()))
    drawing = drawing_of(results, made)
    assert drawing.sentence.endswith(".")
    assert drawing.sentence != BROKEN


@pytest.mark.parametrize(
    "view", [view for view in VIEWS if issubclass(view, MeasuredView)], ids=lambda view: view.name
)
def test_that_there_is_no_signal_is_said_once_by_what_asks_for_it(view: type[MeasuredView]) -> None:
    results = Results(presets["fan-rig"])
    made = view(PackedSource())
    made.measure(measuring())
    assert made.sentence(results) == ""
    assert made.table(results) == {}
    drawn = [column for own in made.all_data(results)[0].values() for column in own.values()]
    assert not any(np.size(column) for column in drawn)
    made.say(results, "")
    assert not made.hidden.visible


def test_the_lines_of_python_on_the_first_page_run(capsys: pytest.CaptureFixture[str]) -> None:
    exec(compile(asset_text("notebooks/first_lines.py"), "first_lines.py", "exec"), {})
    said = capsys.readouterr().out
    assert "N at most on a ball" in said
    assert "y1" in said
    assert "loudest lines" in said
