"""The questions about the machine of a signal: which bearing, and how fast the shaft turned."""

from __future__ import annotations

import html
from collections.abc import Callable, Mapping
from typing import Any

import panel as pn

from bearing_explorer.diagnosis.form import LIKELY, WAYS
from bearing_explorer.diagnosis.machine import (
    BY_DESIGNATION,
    BY_FREQUENCIES,
    FIELDS,
    FILE,
    GIVEN,
    ROUGH,
)
from bearing_explorer.diagnosis.measurement_state import MeasurementState
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.widgets.facts import Fact, facts_html
from bearing_explorer.kit.widgets.form import Fields, button, choices, entry, row, select
from bearingcore.bearings import FREQUENCIES

LABELS = {
    "bearing": "Measured bearing",
    "designation": "Designation",
    "bpfo": "BPFO (Hz, or turns of the shaft: 3.1 x)",
    "bpfi": "BPFI",
    "ftf": "FTF",
    "bsf": "BSF",
    "speed": "Measured speed",
    "shaft_speed": "Hz, or with its unit: rpm",
}
NO_BEARINGS = [["", "choose", WAYS]]
HINTS = {"designation": "6205-2RS", "shaft_speed": "1797 rpm"}


KEPT = (
    "<p>Bearing or speed are kept from the file before, {}, and assumed for this one: is it the "
    "same machine?</p>"
)


def kept_html(state: MeasurementState) -> str:
    """Answers that are kept from the file before, and a guess of this file beside them."""
    if not state.kept_from:
        return ""
    own = dict(state.speeds).get(FILE, "")
    doubt = f"<p>Of the shaft speed there is {html.escape(own)}. Choose it if that is right.</p>"
    kept_speed = own and state.values["speed"] in (GIVEN, ROUGH)
    return KEPT.format(html.escape(state.kept_from)) + (doubt if kept_speed else "")


class MachineForm(pn.Column):
    """Bearing and shaft speed of a signal; each answer counts at once.

    Parameters
    ----------
    answer
        called with all values of the form.
    keep, forget
        called to take what was given for the file before as given for this one, or to ask again.
    """

    def __init__(
        self,
        answer: Callable[[Mapping[str, str]], None],
        keep: Callable[[], None],
        forget: Callable[[], None],
    ) -> None:
        self._fields = fields = Fields(lambda _: answer(dict(fields.values)))
        for name in FIELDS:
            if name == "bearing":
                fields.add(name, select(LABELS[name], NO_BEARINGS))
            elif name == "speed":
                fields.add(name, select(LABELS[name], [["", ""]]))
            else:
                fields.add(name, entry(LABELS[name], placeholder=HINTS.get(name, "")))
        self._kept = row(
            button("The same machine", keep), button("Another machine", forget), visible=False
        )
        self._notes = pn.pane.HTML(
            "", stylesheets=[asset_text("measurement.css")], sizing_mode="stretch_width", margin=0
        )
        self._shown: tuple[Any, Any] = (None, None)
        super().__init__(
            row(*(fields.widgets[name] for name in LABELS)), self._notes, self._kept,
            css_classes=["machine"], sizing_mode="stretch_width", margin=(2, 0, 8, 0),
        )  # fmt: skip

    def show(self, state: MeasurementState) -> None:
        """Show the answers on the machine as they are."""
        fields = self._fields
        values = {name: state.values.get(name, "") for name in FIELDS}
        if self._shown != (state.bearings, state.speeds):
            self._shown = state.bearings, state.speeds
            for name, options in (("bearing", state.bearings), ("speed", state.speeds)):
                fields.values[name] = values[name]
                options = options or (NO_BEARINGS if name == "bearing" else [["", ""]])
                fields.widgets[name].param.update(**choices(options), value=values[name])
        fields.put(values)
        by, speed = values["bearing"], values["speed"]
        shown = {
            "bearing": bool(state.bearings),
            "designation": by == BY_DESIGNATION,
            "speed": bool(state.speeds),
            "shaft_speed": speed in (GIVEN, ROUGH) and bool(state.bearings),
        } | dict.fromkeys(FREQUENCIES, by == BY_FREQUENCIES)
        missing = {name for name in ("bearing", "designation", "shaft_speed") if not values[name]}
        for name, widget in fields.widgets.items():
            marks = {"refused": name in state.refused, "open": name in missing}
            widget.css_classes = ["field", f"field-{name}", *(c for c, on in marks.items() if on)]
            widget.visible = shown[name]
        named = _fields_with_notes(state, by, speed, shown)
        words = {name: label.partition(" (")[0] for name, label in LABELS.items()}
        kept = kept_html(state)
        self._kept.visible = bool(kept)
        self._notes.object = kept + notes_html(state, named, words | {"shaft_speed": "Shaft speed"})
        self._notes.visible = bool(self._notes.object)


def _fields_with_notes(
    state: MeasurementState, by: str, speed: str, shown: Mapping[str, bool]
) -> list[str]:
    """Shown fields whose values are of the file, or refused."""
    likely = [value for value, _, heading in state.bearings if heading == LIKELY]
    of_file = {"bearing": by in (*likely, BY_FREQUENCIES), "speed": speed == FILE}
    named = [name for name in LABELS if shown[name] and of_file.get(name, True)]
    return named + [name for name in state.refused if shown.get(name) and name not in named]


def notes_html(state: MeasurementState, fields: list[str], labels: Mapping[str, str]) -> str:
    """Beneath the fields: why they are refused, or where their values come from."""
    facts = []
    for name in fields:
        words = state.refused.get(name) or state.reasons.get(name)
        if words:
            mark = "refused" if name in state.refused else "open" if name in state.open else ""
            facts.append(Fact(html.escape(labels[name]), words, mark=mark))
    return facts_html(facts)
