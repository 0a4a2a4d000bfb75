"""The damaged part: the bearing with the part marked, and the envelope spectrum behind it."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import panel as pn

from bearing_explorer.diagnosis.diagnoses import BUSY, Question, diagnosis_of
from bearing_explorer.diagnosis.measurement_state import AboutMeasurement, MeasurementState
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views import part_words
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.diagnosis.views.next_steps import work_order
from bearing_explorer.diagnosis.views.part_lines import COLORS, PartLines
from bearing_explorer.diagnosis.widgets.machine_form import MachineForm
from bearing_explorer.diagnosis.widgets.part_panel import PartPanel
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import AS_HIGH_AS_SHOWN, stack
from bearingcore import Diagnosis, Recording
from bearingcore.common import probability
from bearingcore.measured.diagnosis import INNER, OUTER

RACES_NAMED = (OUTER, INNER)

ASKING = (
    "Nothing says which bearing was measured, and without it no part can be named: choose it above "
    "from the list, by its designation, or by its frequencies."
)
MEASURING = "its length is being measured"
NOTHING_NAMED = "No part is named before the bearing is."


def on_records() -> str:
    """Say how often answers on measured records were right, from the files of the tests."""
    board = json.loads(asset_text("scoreboard.json"))
    records, (low, high) = board["records"], board["share_right"]
    answered = [row for row in records if row["verdict"] in ("right", "wrong")]
    sure = [row for row in answered if row["probability"] >= 0.9]
    right, kept = (sum(row["verdict"] == "right" for row in rows) for rows in (answered, sure))
    sized = [row for row in records if row["true_extent_deg"] and "low_deg" in row]
    held = sum(row["low_deg"] <= row["true_extent_deg"] <= row["high_deg"] for row in sized)
    others = json.loads(asset_text("scoreboard_other_machines.json"))["records"]
    unnamed = ("cannot tell", "none seen")
    named = [r for r in others if r["answer"] not in unnamed and r["truth"] != "unknown"]
    sure_elsewhere = [row for row in named if row["probability"] >= 0.9]
    good, hints = (
        sum(row["verdict"] == "right" for row in rows)
        for rows in (sure_elsewhere, [row for row in named if row["probability"] < 0.9])
    )
    alarms = sum(row["truth"] == "healthy" for row in sure_elsewhere)
    healthy = sum(row["truth"] == "healthy" for row in others)
    return (
        f"Of {len(records)} measured records of real machines {len(answered)} were answered, "
        f"{right} of them correctly; of {len(sure)} answers stated with 90 % or more {kept} were "
        f"right (exact 95 % interval: {100.0 * low:.1f} to {100.0 * high:.0f} %). "
        f"{held} of {len(sized)} measured lengths have the true one in their interval. The "
        "records are public, of a motor and three rigs, and the diagnosis was fitted to them. On "
        f"{len(others)} records of three other machines {good} of {len(sure_elsewhere)} such "
        f"answers were right, with alarms on {alarms} of {healthy} healthy records; but of "
        f"{len(named) - len(sure_elsewhere)} parts named with less, {hints}: take those as hints."
    )


class PartDiagnosis(MeasuredView):
    """The answer of `bearingcore.diagnose`, computed in the background, with its evidence."""

    name = "diagnosis"
    title = "2  Which part is damaged?"
    about = (
        "Envelope spectrum of the signal. Each pass over a damaged spot makes the machine ring; "
        "the envelope shows how often. Strong: lines of the part that stands out. Faint: of the "
        "other parts. The strong lines were measured in the signal, the faint ones follow from the "
        f"geometry. {on_records()}"
    )
    computes = True
    finds_speed = True

    def build(self, packed: PackedSource) -> Any:
        self.machine = MachineForm(lambda: self.measurement)
        self.part = PartPanel(self._report_on)
        self._shown_of: Recording | None = None  # recording whose answer the panel shows
        self._work_order = ""
        self.lines = PartLines(packed)
        self.evidence = pn.pane.HTML(
            "", stylesheets=[asset_text("evidence.css")], sizing_mode="stretch_width", margin=0
        )
        self._seen = stack(
            self.lines.plot, self.evidence, visible=False, stylesheets=[AS_HIGH_AS_SHOWN]
        )
        self.hidden = stack(self.machine, self.part, self._seen, visible=False)
        return self.hidden

    # What it is about

    def measure(self, measurement: Measurement) -> None:
        super().measure(measurement)
        measurement.show_machine = self._machine_changed
        self.machine.show(measurement.state)

    def _machine_changed(self, state: MeasurementState) -> None:
        """Show the answers on the machine; mark the diagnosis on screen if it is out of date."""
        self.machine.show(state)
        if why := self.measurement.out_of_date:
            self.part.outdate(why)

    def _report_on(self, words: Mapping[str, str]) -> None:
        self.measurement.about = AboutMeasurement(**words)

    def answer(self) -> Diagnosis | str | None:
        """Return the diagnosis, a sentence why there is none, or None: not yet."""
        question = self.measurement.question()
        return None if question is None else self.measurement.diagnoses.of(question)

    def choose(self, choices: Mapping[str, Any], model: Model) -> None:
        measurement, measured = self.measurement, self.measured
        if measured is None:
            return
        if "speed" in choices:  # exported Python of earlier versions has it
            machine = measured.machine.replace_speed(choices["speed"])
            measurement.measured = dataclasses.replace(measured, machine=machine)
        question = measurement.question()
        if question is not None:
            measurement.diagnoses.keep(question, diagnosis_of(question))

    # The picture

    @property
    def drawn(self) -> bool:
        return self._seen.visible

    def data(self, model: Model) -> tuple[Sources, Ranges]:
        answer = self.answer()
        if not isinstance(answer, Diagnosis) or answer.spectrum is None:
            return {}, {}
        return self.lines.data(answer)

    def say(self, model: Model | None, sentence: str) -> None:
        self._show()
        super().say(model, sentence)

    def _show(self) -> None:
        """Bring the panels up to date, and have an open question answered."""
        measurement, measured = self.measurement, self.measured
        if measured is None:
            self._seen.visible = False
            return
        question, answer = measurement.question(), self.answer()
        diagnosis = answer if isinstance(answer, Diagnosis) else None
        self._seen.visible = diagnosis is not None and diagnosis.spectrum is not None
        stale = measurement.out_of_date
        if question is None:
            self._shown_of = None
            self.part.show(question_state(measured))
        elif answer is None and self._shown_of is measured.recording:
            self.part.outdate(stale)
        else:
            self._shown_of = None if answer is None else measured.recording
            state = self._with_length(panel_state(question, answer), diagnosis)
            if diagnosis is not None:
                state["work_order"] = self._work_order
            self.part.show(state)
            if answer is not None and stale:
                self.part.outdate(stale)
        if question is not None:
            measurement.diagnoses.want(question)
        if diagnosis is not None:
            self.lines.show_orders(diagnosis.shaft_speed is not None)
            self.evidence.object = part_words.evidence_html(diagnosis, len(measured.directions) > 1)

    def _with_length(self, state: dict[str, Any], diagnosis: Diagnosis | None) -> dict[str, Any]:
        """Add the length of the spall on a race to an answer, once it is known."""
        if diagnosis is None or diagnosis.fault not in RACES_NAMED:
            return state
        extent = self.measurement.extent()
        if extent is None:
            return state | {"extent": MEASURING}
        return state | {"extent": part_words.length(extent, self.measurement.sizing())}

    def sentence(self, model: Model) -> str:
        question = self.measurement.question()
        if question is None:
            return "" if self.measured is None else NOTHING_NAMED
        answer = self.answer()
        if answer is None:
            return BUSY
        if isinstance(answer, str):
            return answer
        measurement, length = self.measurement, ""
        extent = measurement.extent() if answer.fault in RACES_NAMED else None
        sizing = measurement.sizing()
        if extent is not None and (extent.size or (sizing is not None and sizing.conclusive)):
            length = part_words.length(extent, sizing)
        # made here, in a thread: the severity takes too long for the loop of the session
        self._work_order = work_order(measurement, question, answer, length)
        return part_words.sentence(answer, question)

    def table(self, model: Model) -> dict[str, np.ndarray]:
        answer = self.answer()
        return answer.table().in_units().named() if isinstance(answer, Diagnosis) else {}


NO_BEARING = {"n_balls": 0, "pitch": 1.0, "ball": 0.24, "outer": 0.62, "inner": 0.38}
"""Sizes of the picture of a bearing that is not known, for its rings alone."""


def question_state(measured: Measured) -> dict[str, Any]:
    """The content of the panel while the bearing is not known."""
    plain = f"{ASKING} {part_words.speed_sentence(measured)}"
    return {
        "mood": "question", "headline": "Which bearing is it?", "plain": plain,
        "bearing": NO_BEARING,
    }  # fmt: skip


def panel_state(question: Question, answer: Diagnosis | str | None) -> dict[str, Any]:
    """The content of the panel for an answer."""
    bearing = question.bearing
    drawn = {
        "n_balls": bearing.n_balls,
        "pitch": bearing.pitch_diameter,
        "ball": bearing.ball_diameter,
        "outer": bearing.outer_raceway_radius,
        "inner": bearing.inner_raceway_radius,
    }
    if answer is None:
        return {"mood": "busy", "headline": "Analysing …", "plain": BUSY, "bearing": drawn}
    if isinstance(answer, str):
        return {
            "mood": "unknown", "headline": "No clear result", "plain": answer, "bearing": drawn,
        }  # fmt: skip
    named = answer.names_a_part
    likely = f"Probability {probability(answer.probability)}"
    return {
        "mood": part_words.mood(answer),
        "part": answer.fault if named else "",
        "color": style.css_color(COLORS[answer.fault]) if named else "",
        "headline": part_words.headline(answer),
        "probability": likely if answer.conclusive else "",
        "plain": part_words.explanation(answer, question) + part_words.assumptions(question),
        "facts": part_words.facts(answer, question),
        "bearing": drawn,
    }
