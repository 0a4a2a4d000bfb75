"""The Diagnosis tab: the part marked, its lines, the evidence, and what is said about it."""

import dataclasses
import math
import re
from functools import cache

import numpy as np
import pytest
from bearing_explorer.diagnosis.diagnoses import Question, diagnosis_of
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.simulated import simulated
from bearing_explorer.diagnosis.views import part_words
from bearing_explorer.diagnosis.views.diagnosis import PartDiagnosis, panel_state
from bearing_explorer.diagnosis.views.next_steps import work_order
from bearing_explorer.diagnosis.views.part_lines import FAINT, STRONG, PartLines
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import Diagnosis, Recording, presets
from bearingcore.measured.diagnosis import LOUDEST
from tests.helpers.measuring import at, measuring

MOTOR = presets["6205"]
MODEL = Model(MOTOR)
SCENES = {
    "outer race": MOTOR,
    "inner race": MOTOR.replace(race="inner"),
    "none": MOTOR.replace(extent=0.0),
}


@cache
def heard(truth: str, noise_db: float = 20.0) -> Measured:
    return simulated(SCENES[truth], noise_db, 1)


@cache
def diagnosed(truth: str, noise_db: float = 20.0) -> Diagnosis:
    diagnosis = diagnosis_of(Question.about(heard(truth, noise_db)))
    assert isinstance(diagnosis, Diagnosis)
    return diagnosis


def asked(truth: str) -> Question:
    return Question.about(heard(truth))


def view_of(measured: Measured | None = None, answer: Diagnosis | str | None = None):
    view = PartDiagnosis(PackedSource())
    view.measure(measuring(measured))
    if measured is not None and answer is not None:
        view.measurement.diagnoses.keep(Question.about(measured), answer)
    return view


def shown(truth: str):
    """A view that knows its answer and has said it."""
    view = view_of(heard(truth), diagnosed(truth))
    view.all_data(MODEL)
    view.say(MODEL, view.sentence(MODEL))
    return view


# -- the answer ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("truth", "mood", "headline"),
    [
        ("outer race", "fault", "The outer race is probably damaged"),
        ("inner race", "fault", "The inner race is damaged"),
        ("none", "healthy", "No damage seen"),
    ],
)
def test_the_part_is_named_and_marked(truth, mood, headline):
    view = shown(truth)
    state = view.part.state
    assert (state["mood"], state["headline"]) == (mood, headline)
    assert state["part"] == ("" if truth == "none" else truth)
    assert state["bearing"]["n_balls"] == 9
    rests = dict(state["facts"])
    assert rests["Slip"] == "balls up to 2 % slower or faster, assumed"
    assert rests["Bearing"].startswith("9 balls of 7.94 mm on 39.04 mm")
    assert "turns a minute" in rests["Shaft"]
    sentence = view.sentence(MODEL)
    assert diagnosed(truth).detail in sentence
    assert "turns a minute (of the simulation" in sentence
    truthful = "the bearing is healthy" if truth == "none" else f"the {truth} is damaged"
    assert f"The signal is simulated: {truthful}." in sentence


def test_a_step_is_on_the_page_as_long_as_there_is_a_signal():
    """Without one `test_page.py` looks at all that wait for it."""
    view = shown("outer race")
    assert view.panel.visible
    view.measure(measuring(None))
    view.say(MODEL, "")
    assert not view.panel.visible


@pytest.mark.parametrize("truth", list(SCENES))
def test_words_have_sensible_digits_and_nothing_is_certain(truth):
    state = panel_state(asked(truth), diagnosed(truth))
    words = " ".join(
        [
            *(str(state[key]) for key in ("headline", "probability", "plain")),
            order := work_order(measuring(heard(truth)), asked(truth), diagnosed(truth)),
            *(" ".join(row) for row in state["facts"]),
            part_words.evidence_html(diagnosed(truth)),
        ]
    )
    assert not re.search(r"100 %|nan|inf\b|no value|None|e-\d|\d\.\d{4}", words), words
    assert "±" not in order
    names = [line.partition(":")[0] for line in order.splitlines()]
    assert names == ["Finding", "Severity", "To do"]


def test_a_counted_bearing_is_cleared_without_a_word_and_an_estimated_one_is_not():
    question, diagnosis = asked("none"), diagnosed("none")
    bearing = dataclasses.replace(question.bearing, estimated=("n_balls", "ball_diameter"))
    machine = dataclasses.replace(question.measured.machine, bearing=bearing)
    estimated = Question.about(dataclasses.replace(question.measured, machine=machine))
    state = panel_state(estimated, diagnosis)
    assert part_words.COUNTED.format("balls") in state["plain"]
    assert part_words.COUNTED.format("balls") in part_words.finding(diagnosis, estimated)
    assert "estimated from the designation, so BPFO ± " in dict(state["facts"])["Bearing"]
    counted = panel_state(question, diagnosis)
    assert "estimate" not in str([counted[key] for key in ("plain", "facts")])
    assert "estimate" not in part_words.finding(diagnosis, question)


@pytest.mark.parametrize("rises", [True, False])
def test_a_measured_speed_that_changes_is_said_from_least_to_most(rises):
    measured, diagnosis = heard("inner race"), diagnosed("inner race")
    share = np.linspace(0.0, 1.0, len(measured.recording.acceleration))
    turns = measured.recording.duration * 25.0 * share * (0.8 + 0.2 * share if rises else 1.0)
    recording = dataclasses.replace(measured.recording, shaft_angle=2.0 * math.pi * turns)
    machine = measured.machine.replace_speed(2.0 * math.pi * 25.0)
    question = Question.about(dataclasses.replace(measured, recording=recording, machine=machine))
    answer = dataclasses.replace(diagnosis, shaft_speed=2.0 * math.pi * 25.0)
    speed = "1200 to 1800 turns a minute (measured)" if rises else "1500 turns a minute"
    assert f" at {speed}: " in part_words.finding(answer, question)
    assert dict(part_words.facts(answer, question))["Shaft"].startswith(f"{speed}, ")


def test_a_part_that_is_hardly_told_is_only_probably_damaged():
    diagnosis = dataclasses.replace(diagnosed("inner race"), probability=0.8)
    assert part_words.headline(diagnosis) == "The inner race is probably damaged"
    ball = dataclasses.replace(diagnosed("inner race"), fault="ball")
    assert part_words.headline(ball) == "A ball is damaged"
    assert "ball-spin frequency" in part_words.explanation(ball, asked("inner race"))
    assert panel_state(asked("inner race"), ball)["part"] == "ball"


def test_nothing_is_marked_where_it_cannot_be_told():
    short = Measured(Recording(heard("none").recording.acceleration[:1200], 25_600.0), at(MOTOR))
    diagnosis = diagnosis_of(Question.about(short))
    assert isinstance(diagnosis, Diagnosis)
    view = view_of(short, diagnosis)
    sources, ranges = view.all_data(MODEL)
    assert not ranges
    assert all(not column.size for columns in sources.values() for column in columns.values())
    view.say(MODEL, view.sentence(MODEL))
    state = view.part.state
    assert (state["mood"], state["part"], state["probability"]) == ("unknown", "", "")
    assert state["headline"] == "No clear result"
    assert "ball passes" in state["plain"]
    assert view.evidence.object == ""


def test_a_refusal_is_a_sentence():
    still = Measured(heard("none").recording, at(MOTOR, 0.0))
    answer = diagnosis_of(Question.about(still))
    assert isinstance(answer, str)
    assert "shaft speed" in answer
    view = view_of(still, answer)
    assert view.sentence(MODEL) == answer
    view.say(MODEL, answer)
    assert view.part.state["plain"] == answer


# -- the lines -------------------------------------------------------------------------------------


@pytest.mark.parametrize("truth", ["outer race", "inner race"])
def test_lines_that_count_are_strong_where_found_and_others_faint_where_geometry_has_them(truth):
    diagnosis = diagnosed(truth)
    sources, ranges = view_of(heard(truth), diagnosis).all_data(MODEL)
    for part in diagnosis.evidence:
        key = part.part.replace(" ", "_")
        lines = sources[f"diagnosis_{key}_lines"]
        own = part.part == truth
        first = part.frequency if own else part.nominal_frequency
        np.testing.assert_allclose(lines["frequency"], first * np.arange(1, 7))
        assert (lines["alpha"] == (STRONG if own else FAINT)).all()
        assert bool(sources[f"diagnosis_{key}_points"]["frequency"].size) == own
        beside = sources[f"diagnosis_{key}_sidebands"]["frequency"]
        assert bool(beside.size) == (own and truth == "inner race")
    own = diagnosis.of(truth)
    points = sources[f"diagnosis_{truth.replace(' ', '_')}_points"]
    np.testing.assert_allclose(points["level"], own.harmonics)
    spectrum = sources["diagnosis_spectrum"]
    at = np.abs(spectrum["frequency"] - own.frequency).argmin()
    assert spectrum["level"][at - 2 : at + 3].max() > own.noise + 5.0
    low, high = ranges["diagnosis_frequency"]
    assert (low, high > 6.0 * diagnosis.of("inner race").nominal_frequency) == (0.0, True)
    orders = ranges["diagnosis_order"]
    assert orders[1] == pytest.approx(high / 29.95, rel=0.01)
    assert ranges["diagnosis_level"][1] > spectrum["level"][spectrum["frequency"] > 20.0].max()
    cut, lines = dataclasses.replace(own, harmonics=np.full(6, LOUDEST)), diagnosis.spectrum
    raised = dataclasses.replace(lines, level=lines.level + 60.0)
    marks = PartLines(PackedSource())._lead_sources(cut, raised)
    near = np.abs(lines.frequency - own.frequency) < 0.3
    level = marks[f"diagnosis_{truth.replace(' ', '_')}_points"]["level"]
    assert level[0] == 60.0 + lines.level[near].max(), "a mark is on its peak"


# -- the evidence ----------------------------------------------------------------------------------


def test_the_evidence_is_listed_for_each_part():
    diagnosis = diagnosed("inner race")
    rows = part_words.evidence_html(diagnosis).split("<tr")[2:]
    named = [re.search(r"</i>(.*?)<small>", row)[1] for row in rows]
    assert named == ["outer race", "inner race", "ball"]
    (lead,) = [row for row in rows if "leads" in row]
    assert lead is rows[1]
    assert f"<td>{diagnosis.of('inner race').order:.3f}<small>of " in lead
    assert lead.count('class="clear"') == 6
    assert "Hz, shaft</small>" in lead
    assert "none expected" in rows[0]
    assert "leads" not in part_words.evidence_html(diagnosed("none"))
    assert re.search("Probability.*<td>99 %<", part_words.evidence_html(diagnosis))
    # below "No clear result" nothing looks like a verdict
    unclear = dataclasses.replace(diagnosis, fault="cannot tell", probability=0.4)
    assert not re.search("Probability|99 %|leads", part_words.evidence_html(unclear))


def test_the_part_does_not_depend_on_the_unit_and_it_is_said_where_it_is_not_known():
    """Nor on whether it is an acceleration or a velocity: what is whitened has no slope left."""
    truth, known = heard("inner race"), diagnosed("inner race")
    velocity = np.cumsum(truth.recording.acceleration, axis=0)
    velocity = dataclasses.replace(truth.recording, acceleration=velocity - velocity.mean(axis=0))
    unknown = Measured(velocity, truth.machine, in_si=False)
    question = Question.about(unknown)
    diagnosis = diagnosis_of(question)
    assert diagnosis.fault == known.fault
    rests = dict(panel_state(question, diagnosis)["facts"])
    assert rests["Unit"] == "not known; the part does not depend on it"
    assert "Unit" not in dict(panel_state(asked("inner race"), known)["facts"])
