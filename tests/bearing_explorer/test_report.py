"""The report on a signal: complete, from the page's numbers, and closed to what strangers write."""

import dataclasses
from datetime import UTC, datetime
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest
from bearing_explorer.diagnosis.diagnoses import ExtentQuestion, Question, diagnosis_of, extent_of
from bearing_explorer.diagnosis.measurement_state import AboutMeasurement
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.report import NOT_FORESEEN, NOT_JUDGED, measured_report
from bearing_explorer.diagnosis.simulated import simulated
from bearing_explorer.diagnosis.views import part_words
from bearing_explorer.diagnosis.views.measured_indicators import severity, zone_of
from bearing_explorer.diagnosis.views.next_steps import ONE_RECORD, PRACTICE, next_steps
from bearing_explorer.diagnosis.views.trend import growth
from bearing_explorer.kit.report_page import About, document, heading, mark_of

from bearingcore import presets
from bearingcore.common import number, probability
from bearingcore.measured.diagnosis import DiagnosisStatus
from tests.helpers.measuring import measuring

NASTY = "</title><script>alert('1')</script>\"><img src=x onerror=alert(2)>{{7*7}}"


def about(link: str = "http://localhost:5006/?v=1&preset=fan-rig&fy_n=-120") -> About:
    return About("fan-rig", link, datetime(2026, 5, 4, 12, 30, tzinfo=UTC))


class Reader(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.words = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs

    def handle_data(self, data: str) -> None:
        self.words += data


def test_the_head_of_a_report_has_the_words_of_whoever_makes_it() -> None:
    head = dataclasses.replace(about(), machine="Hall B", remarks="Loud.\nSince May.")
    words = Reader(document(head, "Pump 3", heading(head, "Pump 3"), "")).words
    for part in ("Pump 3", "Machine: Hall B", "Loud.", "Since May.", "04 May 2026, 12:30 UTC"):
        assert part in words


def test_words_of_strangers_stay_text() -> None:
    nasty = dataclasses.replace(
        about(f"http://x/?{NASTY}"), title=NASTY, machine=NASTY, remarks=NASTY
    )
    reader = Reader(document(nasty, NASTY, heading(nasty, NASTY), ""))
    assert NASTY in reader.words
    assert not {"script", "img", "iframe", "object", "link", "base", "form"} & set(reader.tags)
    assert not [name for name, _ in reader.attributes if name.startswith("on")]
    assert "default-src 'none'" in str(
        [value for name, value in reader.attributes if name == "content"]
    )
    fetched = [value for name, value in reader.attributes if name in ("src", "href")]
    assert fetched == [f"http://x/?{NASTY}"]


@pytest.mark.parametrize(
    "link", ["javascript:alert(1)", "data:text/html,x", "//x/y", "", "http://[", "file:///etc"]
)
def test_a_link_is_one_of_the_web_or_none(link: str) -> None:
    assert "href" not in "".join(heading(about(link), ""))


def test_a_measured_signal_has_its_answer_pictures_and_assumptions_on_one_page() -> None:
    """With a unit that is guessed and a speed that is typed in; a journey prints the sheet."""
    scene = presets["6205"]
    measured = simulated(scene.replace(race="outer", extent=0.2), 20.0, 1)
    recording = dataclasses.replace(measured.recording, name=NASTY)
    measured = dataclasses.replace(measured, recording=recording, true_load=None, true_edge=None)
    session = measuring(measured)
    question = Question.about(measured)
    own = dataclasses.replace(about(), machine="Pump 3")
    with pytest.raises(ValueError, match="is being analysed"):
        measured_report(Model(scene), session.snapshot(), {}, own)
    answer = diagnosis_of(question)
    asked = ExtentQuestion.about(measured, whole=scene.bearing)
    extent = extent_of(dataclasses.replace(asked, diagnosis=answer))
    session.diagnoses.keep(question, answer)
    session.extents.keep(asked, extent)
    session.state = dataclasses.replace(
        session.state,
        values={"unit": "g", "shaft_speed": "30 Hz"},
        reasons={"unit": "A guess: it looks so"},
    )
    session.about = AboutMeasurement(point="drive end, up", date="2 March")
    session._first = {"unit": "g"}
    session.machine_kind = "medium, rigid"
    made = measured_report(Model(scene), session.snapshot(), {}, own)
    reader = Reader(made["html"])
    for said in (
        "Pump 3, drive end, up",
        "Machine: Pump 3",
        NASTY,
        "Measuring point: drive end, up. Recorded: 2 March.",
        part_words.headline(answer),
        f"Probability {probability(answer.probability)}",
        part_words.length(extent),
        part_words.explanation(answer, question),
        next_steps(answer, question, zone_of(measured, "medium, rigid")),
        severity(measured, "medium, rigid"),
        f"BPFO {number(scene.bearing.bpfo(scene.shaft_speed), 4)} Hz",
        part_words.sentence(answer, question),
        "of the simulation",
        "Assumed: it looks so",
        "typical loads, used for the extent",
        NOT_JUDGED,
        NOT_FORESEEN,
        ONE_RECORD,
    ):
        assert said in reader.words, said
    assert not {"script", "img"} & set(reader.tags)
    assert all(made["html"].count(mark_of(figure)) == 1 for figure in made["figures"])
    assert len(made["figures"]) == len(made["items"]) == 4


@pytest.mark.parametrize(
    ("fault", "zone", "change", "begins", "says"),
    [
        ("outer race", "D", None, "Now: the vibration is in zone D", ONE_RECORD),
        ("outer race", "C", None, "Soon: the vibration is in zone C", "measure every day"),
        ("outer race", "A", None, "Measure again within a week", "does not clear a bearing"),
        ("outer race", "", 2.5, "Soon: the vibration has clearly grown", "is 2.5 times"),
        ("outer race", "", 1.1, "Soon: the vibration has clearly grown", "outer race grew to 4.4"),
        ("outer race", "", 1.2, "Soon: the vibration has clearly grown", "May 2026, 9 days before"),
        ("none seen", "A", None, "Measure again at the usual interval.", ""),
        ("none seen", "D", None, "Measure again at the usual", "look now for its cause"),
        ("cannot tell", "", 3.0, "This record decides nothing", "grew to 3 times"),
    ],
)
def test_the_next_step_rests_on_part_zone_and_growth(
    fault: str, zone: str, change: float | None, begins: str, says: str
) -> None:
    question = Question.about(simulated(presets["6205"], 20.0, 1))
    diagnosis = dataclasses.replace(diagnosis_of(question), fault=fault, probability=0.99)
    grown = None
    if change is not None:
        points = [
            SimpleNamespace(fault=fault, name=f"{day}.csv", recorded=datetime(2026, 5, day))
            for day in (1, 3, 12)
        ]
        changes = np.array([1.0, 1.0, change])
        grown = SimpleNamespace(
            points=points, baseline=0, rms_change=changes, line_change=lambda part: 4.0 * changes,
            seen_since=lambda part: 1, hours=24.0 * np.array([0.0, 2.0, 11.0]),
        )  # fmt: skip
    words = next_steps(diagnosis, question, zone, grown)
    assert words.startswith(begins)
    assert says in (growth(grown) if grown is not None and fault == "outer race" else words)
    assert (PRACTICE in words) == (fault == "outer race")
    assert (ONE_RECORD in words) == (fault == "outer race" and change is None)
    if fault == "outer race":
        unsure = next_steps(dataclasses.replace(diagnosis, probability=0.6), question, zone, grown)
        assert "confirm it" in unsure.lower()
        assert "onfirm it" not in words
    if fault == "cannot tell":
        dropped = dataclasses.replace(diagnosis, status=DiagnosisStatus.DROPPED_OUT)
        assert next_steps(dropped, question, zone, grown).startswith("Check sensor, cable")
        open_speed = dataclasses.replace(diagnosis, status=DiagnosisStatus.SPEED_OPEN)
        assert next_steps(open_speed, question, zone).startswith("Read the shaft speed")
