"""The form of a measurement: a file, or a simulation, and questions about the file's columns."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Mapping
from dataclasses import asdict
from functools import partial
from typing import Any

import panel as pn

from bearing_explorer.diagnosis.form import (
    AS_HEADED,
    DIRECTIONS,
    ROLES,
    USUAL_SENSITIVITY,
    change_role,
    roles_and_units,
)
from bearing_explorer.diagnosis.measurement_state import MeasurementState
from bearing_explorer.diagnosis.series import MOST_FILES
from bearing_explorer.diagnosis.session import RECORDS, Measurement
from bearing_explorer.diagnosis.upload import MOST_BYTES, PIECE
from bearing_explorer.diagnosis.widgets.column_table import ColumnTable
from bearing_explorer.diagnosis.widgets.file_upload import FileUpload, UploadBegins, UploadPiece
from bearing_explorer.diagnosis.widgets.machine_form import MachineForm, notes_html
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.simulated_signals import NOISES
from bearing_explorer.kit.widgets.form import Fields, button, choices, entry, row, select
from bearingcore.measured.files import UNITS

LABELS = {
    "columns": "Columns",
    "part": "Recording in the file",
    "unit": "Unit of the signal",
    "full_scale": "1 in the file is",
    "sensitivity": "Sensor (mV/g)",
    "sample_rate": "Sample rate (Hz)",
}
FORMATS = (
    "CSV or other text, WAV, MATLAB (.mat), HDF5, NumPy, UFF, TDMS, Parquet, Excel "
    f"(.xlsx), or a zip of some of them; at most {MOST_BYTES // 2**20} MB. Or drop it here. "
    "Several, or a folder, become a trend."
)
_WIDE: dict[str, Any] = {"sizing_mode": "stretch_width", "margin": 0}


class MeasurementForm(pn.Column):
    """A file to choose, a measurement to simulate, and questions about the file.

    Once there is a signal and no open question, the form folds to a line; a button unfolds it. The
    fields about a file are made with the first file. Bearing and speed are among the questions
    until there is a signal; then step 2 asks for them. The form takes no input before `attach`.
    """

    _measurement: Measurement

    def __init__(self, unfolded: Callable[[], None] = lambda: None) -> None:
        self.folded = self._agreed = False
        self._unfolded = unfolded
        self._fields: Fields | None = None
        self._shown = MeasurementState()
        self.upload = FileUpload(
            self._uploaded, largest=MOST_BYTES, piece=PIECE, most=MOST_FILES, note=FORMATS
        )
        self._about_file = pn.Column(visible=False, **{**_WIDE, "margin": (10, 0, 6, 0)})
        self._facts = _text("", visible=False, css_classes=["note"])
        self._words = _text("")
        self._line = _text("", css_classes=["line"])
        self._change = button("Change", self._fold_or_unfold, css_classes=["change"])
        self._cancel = button(
            "Cancel", lambda: self._measurement.cancel(), visible=False, align="start"
        )
        self._in_short = row(self._line, self._change, visible=False)
        self._simulation = self._way("No file at hand?", self._simulation_form(), "9 1 420px")
        self._ways = row(
            self._way("Files of your own", self.upload, "5 1 260px"),
            self._simulation,
            css_classes=["ways"],
        )
        self._in_full = pn.Column(self._ways, self._about_file, self._facts, **_WIDE)
        super().__init__(self._in_short, self._in_full, self._words, self._cancel, **_WIDE)
        self.show(MeasurementState())

    def attach(self, measurement: Measurement) -> None:
        """Show a measurement, and send it the choices made here."""
        self._measurement = measurement
        measurement.show, measurement.want = self.show, self.upload.want
        measurement.more = self.upload.more
        self._simulation.visible = measurement.can_simulate
        self.show(measurement.state)

    def _way(self, title: str, content: pn.viewable.Viewable, flex: str) -> pn.Column:
        head = _text(f"<h3>{title}</h3>")
        return pn.Column(
            head, content, margin=0, css_classes=["way"], styles={"flex": flex},
            stylesheets=[asset_text("measurement.css")],
        )  # fmt: skip

    def _simulation_form(self) -> pn.Column:
        noises = {
            name: "none" if math.isinf(level) else f"{level:.0f} dB"
            for name, level in sorted(NOISES.items(), key=lambda item: item[0] != "20")
        }
        noise = select("Noise below the signal", list(noises.items()), css_classes=["beside"])
        act = button(
            "Simulate a signal", lambda: self._measurement.simulate(noise.value),
            css_classes=["simulate"],
        )  # fmt: skip
        note = "Uses the current scene; the true size is shown for comparison."
        records = [
            button(words, partial(self._open_record, name), css_classes=["record"])
            for name, words in RECORDS.items()
        ]
        about = "Or open the record of a motor on a 6205, simulated by another program."
        return pn.Column(
            row(act, noise),
            _text(note, css_classes=["note"]),
            row(*records),
            _text(about, css_classes=["note"]),
            **_WIDE,
        )

    # Choices

    def _open_record(self, name: str) -> None:
        self._measurement.open_record(name)

    def _uploaded(self, message: UploadBegins | UploadPiece) -> None:
        if isinstance(message, UploadBegins):
            self._measurement.begin_upload(
                message.name, message.size, message.number, message.count, message.chosen
            )
        else:
            self._measurement.take_piece(message.content, message.of)

    def _answer(self, answers: Mapping[str, str], sure: bool = False) -> None:
        """Send the shown answers, with new `answers` in their place."""
        self._agreed = sure
        self._measurement.take_form({**self._shown.values, **answers}, sure)

    # Display

    def show(self, state: MeasurementState) -> None:
        """Show the state of the measurement."""
        if state.arrival != self._shown.arrival or (self._agreed and not state.bad):
            self.folded, self._agreed = bool(state.line) and not state.open, False
        self._fold(state)
        self._about_file.visible = state.columns is not None
        if state.columns is not None:
            self._show_fields(state)
        self._facts.param.update(object=html.escape(state.facts), visible=bool(state.facts))
        self._shown = state

    def _fold(self, state: MeasurementState) -> None:
        """Show the line alone or the whole form, and the words that belong to it."""
        mood = "bad" if state.bad else "busy" if state.busy else "good"
        words = state.words if mood != "good" or not self.folded else state.remarks
        lines = f'<pre tabindex="0">{html.escape(state.lines)}</pre>' if state.lines else ""
        # a refusal stands above the files, where it is seen at once
        self._words.styles = {"order": "-1" if mood == "bad" else "0"}
        paragraph = f'<p class="words {mood}" role="status">{html.escape(words)}</p>{lines}'
        self._words.object = paragraph if words else ""
        whole = f' title="{html.escape(state.whole_name)}"' if state.whole_name else ""
        self._line.object = f"<p{whole}>{html.escape(state.line)}</p>"
        self._in_short.visible = bool(state.line)
        self._in_full.visible = not self.folded
        self._change.label = "Change" if self.folded else "Fold"
        self._cancel.visible = state.busy

    def _fold_or_unfold(self) -> None:
        self.folded = not self.folded
        self._fold(self._shown)
        self._unfolded()

    def _change_role(self, index: int, role: str, unit: str) -> None:
        """Take another role or unit of a column."""
        assert self._fields is not None, "columns are shown only beside the fields"
        now = columns_as_said(self._shown)
        if index < len(now[0]):
            changed = change_role(*now, index, role, unit)
            self._answer({**self._fields.values, **changed})

    def _make_fields(self) -> Fields:
        fields = Fields(lambda _: self._answer(fields.values))
        fields.values |= {"columns": "", "unit": ""}
        self._table = ColumnTable(
            self._change_role,
            roles=[list(role) for role in ROLES],
            signals=[*DIRECTIONS],
        )
        for name in LABELS:
            if name == "part":
                fields.add(name, select(LABELS[name], [["", "the longest"]]))
            elif name not in ("columns", "unit"):
                hint = f"{USUAL_SENSITIVITY} is usual" if name == "sensitivity" else ""
                fields.add(name, entry(LABELS[name], placeholder=hint))
        self._agree = button("Use these answers", lambda: self._answer(fields.values, sure=True))
        self._notes = _text("")
        self._machine = MachineForm(lambda: self._measurement)
        self._about_file[:] = [
            self._table, row(*fields.widgets.values(), self._agree), self._notes
        ]  # fmt: skip
        return fields

    def _show_fields(self, state: MeasurementState) -> None:
        assert state.columns is not None
        fields = self._fields = self._fields or self._make_fields()
        values = {name: state.values.get(name, "") for name in LABELS}
        fields.values.update(values)
        marks = {
            name: "refused" if name in state.refused else "open" if name in state.open else ""
            for name in ("columns", "unit")
        }
        self._table.units = units(state)
        self._table.show(asdict(state.columns), *columns_as_said(state), marks)
        if state.recordings != self._shown.recordings or not self._shown.columns:
            fields.widgets["part"].param.update(
                **choices(state.recordings or [["", "the longest"]]), value=values["part"]
            )
        fields.put({name: values[name] for name in fields.widgets})
        for name, widget in fields.widgets.items():
            on = {"refused": name in state.refused, "open": name in state.open}
            widget.css_classes = ["field", f"field-{name}", *(mark for mark in on if on[mark])]
        fields.widgets["part"].visible = bool(state.recordings)
        fields.widgets["full_scale"].visible = state.scaled or values["full_scale"] != "1"
        fields.widgets["sensitivity"].visible = state.voltage
        self._agree.visible = "sample_rate" in state.open
        if (not state.line) != (self._machine in self._about_file):
            self._about_file[3:] = [] if state.line else [self._machine]
        self._machine.show(state)
        shown = ["columns", "unit", *(n for n, widget in fields.widgets.items() if widget.visible)]
        labels = {name: label.partition(" (")[0] for name, label in LABELS.items()}
        self._notes.object = notes_html(state, shown, labels)


def _text(words: str, **params: Any) -> pn.pane.HTML:
    return pn.pane.HTML(words, stylesheets=[asset_text("measurement.css")], **_WIDE, **params)


def units(state: MeasurementState) -> list[list[str]]:
    """Options of the unit; one that the file does not state has to be chosen."""
    known = [[unit, unit] for unit in UNITS]
    if state.proposed is None and state.values.get("unit") not in ("", AS_HEADED):
        return known
    words = f"choose ({state.proposed} is likely)" if state.proposed else "choose"
    return [["", words], *known]


def columns_as_said(state: MeasurementState) -> tuple[list[str], list[str]]:
    """Return the role of each column, and the unit that it has, or would have as a signal."""
    assert state.columns is not None
    roles, typed = roles_and_units(state.values["columns"])
    unit = state.values["unit"]
    headed = state.columns.headed if unit == AS_HEADED else [unit] * len(roles)
    return roles, [unit or other for unit, other in zip(typed, headed, strict=False)]
