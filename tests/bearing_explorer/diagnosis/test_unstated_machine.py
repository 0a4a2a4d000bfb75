"""What nothing says of a machine is not known: no number of the scene enters a diagnosis unsaid."""

import math
from datetime import UTC, datetime
from functools import cache

import numpy as np
import pytest
from bearing_explorer.diagnosis.diagnoses import Question, diagnosis_of
from bearing_explorer.diagnosis.measurement_state import CHANGED, NOT_YET, REFUSED
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.report import measured_report
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.simulated import simulated
from bearing_explorer.diagnosis.views import part_words
from bearing_explorer.diagnosis.views.diagnosis import PartDiagnosis
from bearing_explorer.diagnosis.views.extent import SpallExtent
from bearing_explorer.diagnosis.views.measured_envelope import MeasuredEnvelope
from bearing_explorer.diagnosis.views.measured_indicators import MeasuredIndicators
from bearing_explorer.diagnosis.views.measured_kurtogram import MeasuredKurtogram
from bearing_explorer.diagnosis.views.measured_spectrogram import MeasuredSpectrogram
from bearing_explorer.diagnosis.views.measured_spectrum import MeasuredSpectrum
from bearing_explorer.diagnosis.views.measured_view import WITHOUT_BEARING
from bearing_explorer.diagnosis.views.measurement import MeasuredSignal
from bearing_explorer.diagnosis.views.trend import TrendOfFiles
from bearing_explorer.diagnosis.widgets.part_panel import part_html
from bearing_explorer.kit.report_page import About
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.page import Halves

from bearingcore import Diagnosis, presets
from tests.bearing_explorer.diagnosis.test_measurement import answer, bring, brought, settled
from tests.helpers.loops import run
from tests.helpers.measuring import measuring
from tests.helpers.saved import saved

pytestmark = pytest.mark.usefixtures("files_read_here")

MOTOR, RIG = presets["6205"], presets["fan-rig"]
MODEL = Model(RIG)
NOW = datetime(2026, 11, 26, tzinfo=UTC)
TURN = 2.0 * math.pi


@cache
def silent() -> bytes:
    """An outer race of a 6205 at 1797 rpm, in a file that says neither bearing nor speed."""
    recording = simulated(MOTOR, 20.0, 1).recording
    time = np.arange(len(recording.acceleration)) / recording.sample_rate
    columns = np.column_stack([time, recording.acceleration[:, 1]])
    return saved(np.savetxt, columns, "%.7g", ",", header="time (s),y (m/s2)", comments="")


def shown(made: Measurement) -> PartDiagnosis:
    """The view of it, as it is drawn."""
    view = PartDiagnosis(PackedSource())
    view.measure(made)
    redraw(view)
    return view


def redraw(view: PartDiagnosis) -> None:
    view.all_data(MODEL)
    view.say(MODEL, view.sentence(MODEL))


def diagnosed(made: Measurement) -> Diagnosis:
    """The answer of now, which the session then has."""
    question = made.question()
    assert question is not None
    diagnosis = diagnosis_of(question)
    assert isinstance(diagnosis, Diagnosis)
    made.diagnoses.keep(question, diagnosis)
    return diagnosis


def test_a_file_without_bearing_and_speed_names_no_part() -> None:
    made = brought("silent.csv", silent())
    assert made.measured is not None
    assert (made.measured.bearing, made.measured.shaft_speed) == (None, None)
    assert made.state.line.endswith("· speed? · m/s² · bearing?")
    assert made.question() is None
    view = shown(made)
    assert view.part.state["headline"] == "Which bearing is it?"
    assert view.part.state.get("part", "") == ""
    assert not view._seen.visible
    assert view.table(MODEL) == {}
    assert made.diagnoses.wanted is None
    html = part_html(view.part.state)
    assert not any(number in html for number in ("420", "14 balls", "damaged</h3>"))


@pytest.mark.parametrize(
    "kind",
    [
        MeasuredSignal, MeasuredSpectrum, MeasuredEnvelope, MeasuredKurtogram,
        MeasuredSpectrogram, MeasuredIndicators,
    ],
)  # fmt: skip
def test_what_needs_no_bearing_is_shown_and_the_scene_changes_nothing_of_it(kind: type) -> None:
    view = kind(PackedSource())
    view.measure(brought("silent.csv", silent()))
    sentence = view.sentence(MODEL)
    sources, _ = view.all_data(MODEL)
    other = Model(RIG.replace(n_balls=9, shaft_speed=30.0 * TURN))
    assert view.sentence(other) == sentence
    assert "420" not in sentence
    again, _ = view.all_data(other)
    for name, columns in sources.items():
        for column, values in columns.items():
            np.testing.assert_array_equal(values, again[name][column], err_msg=f"{name} {column}")
    view.say(MODEL, sentence)
    lines = view.python()
    assert 'speed="unknown"' in lines
    assert 'bearing="unknown"' in lines


def test_the_extent_waits_for_the_bearing() -> None:
    extent = SpallExtent(PackedSource())
    extent.measure(brought("silent.csv", silent()))
    assert WITHOUT_BEARING in extent.sentence(MODEL)


def test_a_bearing_that_is_then_said_has_its_answer_at_once() -> None:
    made = brought("silent.csv", silent())
    answer(made, bearing="designation", designation="6205-2RS")
    question = made.question()
    assert question is not None
    assert question.speed is None  # it is looked for
    diagnosis = diagnosed(made)
    assert diagnosis.fault != "ball"
    facts = dict(part_words.facts(diagnosis, question))
    assert "given" not in facts["Shaft"].replace("not given", "")
    assert facts["Bearing"].endswith("estimated from the designation, so BPFO ± 1.5 %")
    assert ", 6205-2RS, given, " in facts["Bearing"]
    answer(made, speed="given", shaft_speed="1797 rpm")
    assert diagnosed(made).fault == "outer race"
    assert "given" in dict(part_words.facts(diagnosed(made), made.question()))["Shaft"]
    answer(made, speed="")
    assert made.question() == question


def test_the_scene_is_followed_at_once_where_it_is_chosen_and_only_there() -> None:
    scene = MOTOR
    made = brought("silent.csv", silent(), scene=lambda: scene)
    made.take_scene()
    assert made.question() is None
    answer(made, bearing="scene", speed="scene")
    first = made.question()
    assert first is not None
    assert (first.speed, first.bearing) == (MOTOR.shaft_speed, MOTOR.bearing)
    diagnosis = diagnosed(made)
    assert diagnosis.fault == "outer race"
    facts = dict(part_words.facts(diagnosis, first))
    assert "the scene's, as chosen" in facts["Shaft"]
    assert facts["Bearing"].endswith("the scene's, as chosen")
    scene = MOTOR.replace(extent=0.1, fy=-50.0)  # nothing of that counts
    made.take_scene()
    assert made.question() == first
    view = shown(made)
    assert "stale" not in view.part.state
    scene = MOTOR.replace(shaft_speed=25.0 * TURN)
    made.take_scene()
    assert made.question().speed == pytest.approx(25.0 * TURN)
    assert "1500 rpm" in made.state.line
    assert view.part.state["stale"] == NOT_YET
    scene = RIG
    made.take_scene()
    assert made.question().bearing == RIG.bearing
    scene = MOTOR  # which has its answer already
    made.take_scene()
    redraw(view)
    assert "stale" not in view.part.state
    answer(made, bearing="6203, Paderborn", speed="given", shaft_speed="900 rpm")
    given = made.question()
    scene = RIG
    made.take_scene()
    assert made.question() == given


def test_an_answer_that_is_out_of_date_is_marked_and_cannot_be_taken() -> None:
    about = About("fan-rig", "http://localhost", NOW, "", "", "")

    async def steps() -> None:
        made = measuring()
        await bring(made, "silent.csv", silent())
        values = {**made.state.values, "bearing": "designation", "designation": "6205",
                  "speed": "given", "shaft_speed": "1797 rpm"}  # fmt: skip
        made.take_form(values)
        await settled(made)
        diagnosed(made)
        view = shown(made)
        panel = view.part
        assert not any(button.disabled for button in (panel._copy, panel._report))
        assert panel._summary.object
        measured_report(MODEL, made.snapshot(), {}, about)
        made.take_form({**values, "shaft_speed": "1500 rpm"})  # is being read
        marked(view, made, CHANGED)
        await settled(made)
        redraw(view)  # and is being analysed
        marked(view, made, NOT_YET)
        made.diagnoses.stop()
        diagnosed(made)
        redraw(view)
        assert not any(button.disabled for button in (panel._copy, panel._report))
        assert "stale" not in panel.state
        made.take_form({**values, "shaft_speed": "fast"})
        await settled(made)
        marked(view, made, REFUSED)

    def marked(view: PartDiagnosis, made: Measurement, why: str) -> None:
        panel = view.part
        assert panel.state["stale"] == why
        assert panel._copy.disabled
        assert panel._report.disabled
        assert panel._summary.object == ""
        html = part_html(panel.state)
        assert "Out of date." in html
        assert "Work order to copy" not in html
        with pytest.raises(ValueError, match=why):
            measured_report(MODEL, made.snapshot(), {}, about)

    run(steps())


def test_the_status_says_what_is_under_way_until_it_is_done() -> None:
    halves = Halves()
    measurement = halves.diagnosis.measurement
    measurement._draw = lambda: None

    def words() -> str:
        return str(halves.diagnosis.content().status(0.0, frozenset())["words"])

    assert words() == "Ready"
    measurement.measured = simulated(MOTOR, 20.0, 1)
    question = measurement.question()
    assert question is not None
    assert words() == "Analysing the signal"
    measurement.diagnoses.keep(question, "none")
    assert words() == "Ready"
    measurement.extents.wanted = question
    assert words() == "Analysing the signal"
    measurement.extents.keep(question, "none")
    assert words() == "Ready"
    measurement.begin_upload("signal.csv", 100)
    assert words() == "Reading the signal"


def test_frequencies_in_hertz_need_a_speed_and_a_wrong_name_says_so() -> None:
    made = brought("silent.csv", silent())
    answer(made, bearing="frequencies", bpfo="107.3")
    assert made.question() is None  # one is not enough, and nothing is wrong yet
    assert not made.state.refused
    answer(made, bearing="frequencies", bpfo="107.3", bpfi="162.2")
    assert "need the shaft speed" in made.state.refused["bearing"]
    answer(made, speed="given", shaft_speed="1797 rpm")
    assert not made.state.refused
    assert made.question().bearing.n_balls == 9
    answer(made, bearing="designation", designation="furlong")
    assert "designation" in made.state.refused
    answer(made, bearing="designation", designation="")
    assert made.question() is None


def test_a_trend_without_bearing_and_speed_has_levels_and_no_part() -> None:
    from bearing_explorer.kit.compute.jobs import Work

    made = brought("silent.csv", silent())
    view = TrendOfFiles(PackedSource())
    view.measure(made)
    work = Work()
    view.prepare({}, MODEL)(work)
    (view.job_result,) = work.take_results()
    assert view.drawn
    table = view.table(MODEL)
    assert table["rms_m_per_s2"][0] > 0.0
    assert table["fault"].tolist() == ["cannot tell"]
    assert np.isnan(table["bpfo_line_m_per_s2"]).all()
    assert "is not known before the bearing is" in view.sentence(MODEL)


def test_two_questions_about_one_recording_share_what_is_computed_of_it() -> None:
    made = brought("silent.csv", silent())
    before = made.measured
    assert before is not None
    before.spectrum("y", 8.0)
    answer(made, bearing="6203, Paderborn")
    assert made.measured is not None
    assert made.measured.recording is before.recording
    assert made.measured._known is before._known
    assert Question.about(before) != Question.about(made.measured)
