"""The questions about the machine of a signal: its bearing and its shaft speed."""

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
    GROUPS,
    MEASURED,
    TYPED,
)
from bearing_explorer.diagnosis.measurement_state import MeasurementState
from bearing_explorer.diagnosis.signal_form import SignalForm
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
    "ratio": "Gear ratio (turns of the bearing's shaft for one of the measured)",
}
NO_OPTIONS = {"bearing": [["", "choose", WAYS]], "speed": [["", ""]]}
HINTS = {"designation": "6205-2RS", "shaft_speed": "1797 rpm", "ratio": "1, or 23/47"}

KEPT_WORDS = (
    "<p>Bearing or speed is kept from the previous file, {}, and assumed for this one: is it the "
    "same machine?</p>"
)


def kept_html(state: MeasurementState) -> str:
    """Say which answers are kept from the previous file, and what this file has instead."""
    if not state.kept_from:
        return ""
    of_file = dict(state.speeds).get(FILE, "")
    doubt = f"<p>Its file has another speed, {html.escape(of_file)}: choose it if it is right.</p>"
    kept_speed = of_file and state.values["speed"] in TYPED
    return KEPT_WORDS.format(html.escape(state.kept_from)) + (doubt if kept_speed else "")


class MachineForm(pn.Column):
    """Bearing and shaft speed of a signal; each answer counts at once.

    Enter in a field confirms its answer for this file.

    Parameters
    ----------
    form
        returns the form of the signal.
    """

    def __init__(self, form: Callable[[], SignalForm]) -> None:
        def answer(_: str) -> None:
            form().take_form({**form().state.values, **fields.values})

        self._fields = fields = Fields(answer)
        for name in FIELDS:
            if name in GROUPS:
                fields.add(name, select(LABELS[name], NO_OPTIONS[name]))
                continue
            typed = fields.add(name, entry(LABELS[name], placeholder=HINTS.get(name, "")))
            group = next(group for group, names in GROUPS.items() if name in names)
            typed.param.watch(lambda _, group=group: form().confirm(group), "enter_pressed")
        self._kept = row(
            button("The same machine", lambda: form().confirm(*GROUPS)),
            button("Another machine", lambda: form().forget_machine()),
            visible=False,
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
        """Show the current answers on the machine."""
        fields = self._fields
        values = {name: state.values.get(name, "") for name in FIELDS}
        if self._shown != (state.bearings, state.speeds):
            self._shown = state.bearings, state.speeds
            for name, options in (("bearing", state.bearings), ("speed", state.speeds)):
                fields.values[name] = values[name]
                shown_options = choices(options or NO_OPTIONS[name])
                fields.widgets[name].param.update(**shown_options, value=values[name])
        fields.put(values)
        bearing, speed = values["bearing"], values["speed"]
        shown = {
            "bearing": bool(state.bearings),
            "designation": bearing == BY_DESIGNATION,
            "speed": bool(state.speeds),
            "shaft_speed": speed in TYPED and bool(state.bearings),
            "ratio": speed in MEASURED and bool(state.bearings),
        } | dict.fromkeys(FREQUENCIES, bearing == BY_FREQUENCIES)
        missing = {name for name in ("bearing", "designation", "shaft_speed") if not values[name]}
        for name, widget in fields.widgets.items():
            marks = {"refused": name in state.refused, "open": name in missing}
            widget.css_classes = ["field", f"field-{name}", *(c for c, on in marks.items() if on)]
            widget.visible = shown[name]
        named = _fields_with_notes(state, bearing, speed, shown)
        words = {name: label.partition(" (")[0] for name, label in LABELS.items()}
        kept = kept_html(state)
        self._kept.visible = bool(kept)
        self._notes.object = kept + notes_html(state, named, words | {"shaft_speed": "Shaft speed"})
        self._notes.visible = bool(self._notes.object)


def _fields_with_notes(
    state: MeasurementState, bearing: str, speed: str, shown: Mapping[str, bool]
) -> list[str]:
    """Return the shown fields whose values are from the file, or refused."""
    likely = [value for value, _, heading in state.bearings if heading == LIKELY]
    of_file = {"bearing": bearing in (*likely, BY_FREQUENCIES), "speed": speed == FILE}
    named = [name for name in LABELS if shown[name] and of_file.get(name, True)]
    return named + [name for name in state.refused if shown.get(name) and name not in named]


def notes_html(state: MeasurementState, fields: list[str], labels: Mapping[str, str]) -> str:
    """Say beneath the fields why they are refused, or where their values come from."""
    facts = []
    for name in fields:
        words = state.refused.get(name) or state.reasons.get(name)
        if words:
            mark = "refused" if name in state.refused else "open" if name in state.open else ""
            facts.append(Fact(html.escape(labels[name]), words, mark=mark))
    return facts_html(facts)
