"""The extent of a spall on the Diagnosis tab: measured once the part is named."""

import asyncio
import dataclasses
import math
from functools import cache

import pytest
from bearing_explorer.diagnosis.diagnoses import (
    BUSY,
    ExtentQuestion,
    Question,
    diagnosis_of,
    extent_of,
)
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.simulated import load_on_defect, simulated
from bearing_explorer.diagnosis.views.extent import BEFORE, SpallExtent
from bearing_explorer.diagnosis.views.signal_figure import figure_of
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import MeasuredExtent, Recording, presets
from tests.bearingcore.sizing.test_measure_extent import MOTOR, RATE, SPEED, signal
from tests.helpers.loops import run
from tests.helpers.measuring import at, measuring

SCENE = presets["6205"].replace(shaft_speed=SPEED)
MODEL = Model(SCENE)
diagnosis, measured_extent = cache(diagnosis_of), cache(extent_of)


@cache
def measured(entry: float = 1.0) -> Measured:
    return Measured(Recording(signal(entry=entry), RATE, ("y",)), at(SCENE), in_si=False)


def view_of(entry: float = 1.0) -> SpallExtent:
    """The view with the answer it asks for."""
    made = SpallExtent(PackedSource())
    made.measure(measuring(measured(entry)))
    about = Question.about(measured(entry))
    made.measurement.diagnoses.keep(about, diagnosis(about))
    question = made.question()
    made.measurement.extents.keep(question, measured_extent(question))
    made.say(MODEL, made.sentence(MODEL))
    return made


def test_the_answer_is_one_line_with_entry_and_exit_marked():
    view = view_of()
    extent = view.answer()
    assert extent.measured
    assert view.sentence(MODEL).startswith(extent.answer)
    apart = math.degrees(extent.separation)
    assert f"{extent.n_passes} ball passes, with {apart:.1f}° between" in view.sentence(MODEL)
    sources, ranges = view.all_data(MODEL)
    spacing = math.degrees(MOTOR.ball_spacing)
    assert ranges["extent_angle"] == pytest.approx((-BEFORE * spacing, (1 - BEFORE) * spacing))
    entry, leave = sources["extent_edges"]["angle"]
    assert entry == 0.0
    assert leave == pytest.approx(math.degrees(extent.separation), abs=0.3)
    best = sources["extent_pass_0"]
    highest = best["angle"][best["envelope"].argmax()]
    assert min(abs(highest - entry), abs(highest - leave)) < 0.3
    assert view.csv().startswith("race,status,extent_deg")
    assert view.job_result is extent


@pytest.mark.proof
def test_a_simulated_signal_is_measured_with_its_own_load_and_edges():
    """Edges as published lose the load over twice the angle, which no measured spall does."""
    truth = math.radians(14.3)
    made = simulated(presets["6203"].replace(race="inner", extent=truth, edge="published"), 20.0, 1)
    assert made.true_load == pytest.approx(700.0)

    def held(about: Measured) -> list[bool]:
        question = ExtentQuestion.about(about, whole=about.bearing, race="inner")
        return [low <= truth <= high for _, low, high in extent_of(question).alternatives]

    assert held(made) == [True, False]
    assert held(dataclasses.replace(made, true_load=None, true_edge=None)) == [False, False]


@pytest.mark.parametrize(
    ("race", "center", "load"),
    [("outer", 270.0, 100.0), ("outer", 330.0, 50.0), ("outer", 90.0, None), ("inner", 0.0, 100.0)],
)
def test_the_load_of_a_simulated_signal_is_that_towards_its_defect(race, center, load):
    scene = presets["fan-rig"].replace(race=race, center=math.radians(center))
    assert load_on_defect(scene) == (load and pytest.approx(load))
    assert load_on_defect(scene.replace(fy=0.0)) is None
    assert load_on_defect(scene.replace(defect=())) is None


def test_where_there_is_none_the_page_says_why_and_draws_the_pass():
    view = view_of(entry=0.0)
    assert view.sentence(MODEL).startswith(view.answer().sentence)
    assert not view.all_data(MODEL)[0]["extent_edges"]["angle"].size
    assert view.all_data(MODEL)[0]["extent_pass_0"]["angle"].size


def test_it_waits_for_the_diagnosis_and_is_worked_on_once_it_is_there():
    async def go():
        view = SpallExtent(PackedSource())
        view.measure(measuring(measured()))
        view.say(MODEL, view.sentence(MODEL))
        assert view.measurement.extents.wanted is None
        assert view._sentence.text == BUSY
        about = Question.about(measured())
        view.measurement.diagnoses.keep(about, diagnosis(about))
        view.say(MODEL, view.sentence(MODEL))
        question = view.measurement.extents.wanted
        while view.measurement.extents.of(question) is None:
            await asyncio.sleep(0.02)
        return view.answer()

    assert run(go()).measured


def test_the_race_may_be_known_and_a_figure_alone_needs_no_session():
    view = view_of()
    view.look_changed("race", "inner")
    assert view.choices() == {"race": "inner"}
    assert view.question().race == "inner"
    drawn = figure_of(SpallExtent, SCENE, recording=measured().recording, choices={"race": "outer"})
    assert "outer race" in drawn.sentence
    assert isinstance(drawn.view.job_result, MeasuredExtent)
