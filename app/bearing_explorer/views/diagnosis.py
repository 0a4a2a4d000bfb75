"""The damaged part: the bearing with the part marked, and the envelope spectrum behind it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import panel as pn

from bearing_explorer.assets import asset_text
from bearing_explorer.measurement.diagnoses import (
    BUSY,
    SPEEDS,
    ListQuestion,
    Question,
    answered,
)
from bearing_explorer.measurement.session import Measurement
from bearing_explorer.plots import style
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views import part_words
from bearing_explorer.views.base import Ranges, Sources
from bearing_explorer.views.look_view import LookView
from bearing_explorer.views.measured_view import MeasuredView
from bearing_explorer.views.part_lines import COLORS, PartLines, Zoom
from bearing_explorer.widgets.form import FieldSpec
from bearing_explorer.widgets.part_panel import ListedBearings, PartPanel, evidence_html
from bearingcore import Bearing, Diagnosis
from bearingcore.common.numbers import probability
from bearingcore.diagnosis.part.combs import HARMONICS
from bearingcore.diagnosis.part.parts import INNER, OUTER, PARTS
from bearingcore.diagnosis.part.status import DiagnosisStatus

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results
from bearing_explorer.widgets.form import AS_HIGH_AS_SHOWN, stack

FIELDS: list[FieldSpec] = [
    {
        "name": "speed",
        "label": "Shaft speed is",
        "options": [[name, words] for name, words in SPEEDS.items()],
    },
    {
        "name": "zoom",
        "label": "Zoom to",
        "options": [
            ["", "all lines"],
            *(
                [f"{part} {k}", f"{part}, {k}×" if k > 1 else part]
                for part in PARTS
                for k in range(1, HARMONICS + 1)
            ),
        ],
    },
]
"""Choices above the figure."""


RACES_NAMED = (OUTER, INNER)

UNEXPLAINED = (DiagnosisStatus.OTHER_SOURCE, DiagnosisStatus.NOT_ALONE, DiagnosisStatus.ALIKE)
"""Outcomes where another bearing may explain the lines."""

MOST_LISTED = 4
"""Listed bearings that are named."""

MEASURING = "its length is being measured"
LOOKING = "Looking for listed bearings that explain these lines: {done} of {of} …"
CANCELLED = "The search was cancelled after {done} of {of} listed bearings. "
FOUND_IN_LIST = (
    "This bearing does not explain the signal. Listed bearings that do, the strongest lines first; "
    "others may have the same lines, so read the number on the bearing:"
)
NONE_IN_LIST = "No listed bearing explains it either."


class PartDiagnosis(LookView, MeasuredView):
    """The answer of `bearingcore.diagnose`, found in the background, with its evidence."""

    name = "diagnosis"
    title = "2  Which part is damaged?"
    about = (
        "Envelope spectrum of the signal. Each pass over a damaged spot makes the machine ring; "
        "the envelope shows how often. Strong: lines of the part that stands out. Faint: of the "
        "other parts. The strong ones were found within the slip, the faint ones follow from the "
        "geometry."
    )
    without_size = True
    computes = True
    look_fields = FIELDS
    first_look: ClassVar[dict[str, Any]] = {"speed": "given", "zoom": ""}

    def build(self, packed: PackedSource) -> Any:
        self.part = PartPanel()
        self.lines = PartLines(packed)
        self.evidence = pn.pane.HTML(
            "", stylesheets=[asset_text("evidence.css")], sizing_mode="stretch_width", margin=0
        )
        self._seen = stack(
            self.lines.plot, self.evidence, visible=False, stylesheets=[AS_HIGH_AS_SHOWN]
        )
        self.candidates = ListedBearings(self._take_listed, self._end_search)
        self.hidden = stack(
            self.part, self.candidates, self.panel_of_look, self._seen, visible=False
        )
        return self.hidden

    # What it is about

    def measure(self, measurement: Measurement) -> None:
        super().measure(measurement)
        if (newest := measurement.diagnoses.wanted) is not None:
            self.take_look({"speed": newest.speed})

    def question(self, bearing: Bearing) -> Question | None:
        """The question about a bearing; None where nothing is measured."""
        measured = self.measured
        return None if measured is None else Question.about(measured, bearing, self.look["speed"])

    def answer(self, bearing: Bearing) -> Diagnosis | str | None:
        """The diagnosis, a sentence why there is none, or None: not yet."""
        question = self.question(bearing)
        if question is None or self.measurement is None:
            return None
        return self.measurement.diagnoses.of(question)

    def diagnosis(self, bearing: Bearing) -> Diagnosis | None:
        """The diagnosis, where there is one already."""
        answer = self.answer(bearing)
        return answer if isinstance(answer, Diagnosis) else None

    def choose(self, choices: Mapping[str, Any], results: Results) -> None:
        super().choose(choices, results)
        question = self.question(results.scene.bearing)
        if question is not None and self.measurement is not None:
            self.measurement.diagnoses.keep(question, answered(question))

    # The picture

    @property
    def drawn(self) -> bool:
        return self._seen.visible

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        found = self.diagnosis(results.scene.bearing)
        if found is None or found.spectrum is None:
            return {}, {}
        return self.lines.data(found, Zoom.of(self.look["zoom"]))

    def say(self, results: Results | None, sentence: str) -> None:
        shown = results or self._results
        if shown is not None:
            self._show(shown.scene.bearing)
        super().say(results, sentence)

    def _show(self, bearing: Bearing) -> None:
        """Bring the panels up to date, and have the question answered if it is not."""
        question, answer = self.question(bearing), self.answer(bearing)
        if question is None or self.measurement is None:
            self._seen.visible = False
            return
        self.measurement.diagnoses.want(question)
        found = answer if isinstance(answer, Diagnosis) else None
        self._seen.visible = found is not None and found.spectrum is not None
        self.part.show(panel_state(question, answer) | self._extent_state(bearing, found))
        self._look_in_list(question, found)
        if found is not None:
            self.lines.show_orders(found.shaft_speed is not None)
            self.evidence.object = evidence_html(part_words.evidence_rows(found))

    def _extent_state(self, bearing: Bearing, found: Diagnosis | None) -> dict[str, Any]:
        """The length of the spall, once it is known; it is measured for a race alone."""
        if found is None or self.measurement is None or found.fault not in RACES_NAMED:
            return {}
        extent = self.measurement.extent(bearing)
        return {"extent": part_words.extent(extent) if extent is not None else MEASURING}

    def _look_in_list(self, about: Question, found: Diagnosis | None) -> None:
        """Listed bearings with which a part would be named, where with this one none is."""
        if self.measurement is None or found is None or found.status not in UNEXPLAINED:
            self.candidates.show("")
            return
        listed = self.measurement.listed
        answer, wanted = listed.latest(about), listed.wanted
        if not isinstance(wanted, ListQuestion) or not wanted.is_like(about):
            wanted = self.measurement.listed_question(about)
            if answer is None:
                listed.want(wanted)
        progress = wanted.progress
        counted = {"done": progress.done, "of": progress.of or len(wanted.bearings)}
        if answer is None:
            self.candidates.show(LOOKING.format(**counted), searching=not progress.cancelled)
        elif isinstance(answer, str):
            self.candidates.show(answer)
        else:
            rows = [(one.name, part_words.explained(one)) for one in answer[:MOST_LISTED]]
            before = CANCELLED.format(**counted) if progress.cancelled else ""
            after = "" if progress.cancelled and not rows else NONE_IN_LIST
            self.candidates.show(before + (FOUND_IN_LIST if rows else after), rows)

    def _end_search(self) -> None:
        wanted = None if self.measurement is None else self.measurement.listed.wanted
        if isinstance(wanted, ListQuestion):
            wanted.progress.cancelled = True

    def _take_listed(self, name: str) -> None:
        if self.measurement is not None:
            self.measurement.take_bearing(name)

    def sentence(self, results: Results) -> str:
        question = self.question(results.scene.bearing)
        if question is None:
            return self.why_nothing
        answer = self.answer(results.scene.bearing)
        if answer is None:
            return BUSY
        if isinstance(answer, str):
            return answer
        return answer.sentence + part_words.truth(question)

    def table(self, results: Results) -> dict[str, np.ndarray]:
        found = self.diagnosis(results.scene.bearing)
        return {} if found is None else found.table().in_units().named()


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
        "plain": part_words.plain(answer, question),
        "pass_on": part_words.pass_on(answer, question),
        "facts": part_words.facts(answer, question),
        "bearing": drawn,
    }
