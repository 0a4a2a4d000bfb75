"""Choices beside a figure: one of several, some of several, or a number."""

from __future__ import annotations

import html
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import panel as pn

from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.sentences import number_of
from bearing_explorer.kit.widgets.form import Fields, FieldSpec, choices, row, widget_of


def checked(fields: Sequence[FieldSpec], name: str, value: Any) -> Any:
    """Check the value of a choice; ValueError with a sentence if there is no such choice.

    Returns a string, or a list of strings if several can be chosen. A number has no unit.
    """
    field = next((field for field in fields if field["name"] == name), None)
    if field is None:
        raise ValueError(f"There is no choice {name!r}.")
    options = [option[0] for option in field.get("options", ())]
    if "options" in field and not field.get("some"):
        if value not in options:
            raise ValueError(f"{name} is {value!r}; it can be {' or '.join(options)}")
        return value
    if options:
        return [option for option in options if option in value]
    text = str(value)[:20].strip()
    if not text:
        return ""
    words, unit, least, most = field["within"]
    number = number_of(text, words, unit, least, most)
    short = f"{number:g}"
    return short if float(short) == number else repr(number)


class LookPanel(pn.Column):
    """Choices of the look of a figure; `changed(name, value)` is called for each change.

    The value is a string, or a list of strings if several can be chosen.
    """

    def __init__(self, changed: Callable[[str, Any], None], fields: Sequence[FieldSpec]) -> None:
        self._fields = Fields(lambda name: changed(name, self._fields.values[name]))
        self._specs = fields
        self._disabled: dict[str, Sequence[str]] = {}
        self._refusal = _text("", visible=False, css_classes=["refused"])
        parts = [self._widget(spec) for spec in fields]
        super().__init__(
            row(*parts), self._refusal, css_classes=["look"], sizing_mode="stretch_width",
            margin=(2, 0, 6, 0),
        )  # fmt: skip

    def _widget(self, spec: FieldSpec) -> pn.viewable.Viewable:
        if not spec.get("some"):
            return self._fields.add(spec["name"], widget_of(spec, "beside"))
        colors = "".join(
            f"label:nth-of-type({n}) {{ --swatch: {option[2]}; }}\n"
            for n, option in enumerate(spec["options"], 1)
        )
        boxes = pn.widgets.CheckBoxGroup(
            options={words: value for value, words, *_ in spec["options"]},
            inline=True,
            width=None,
            margin=0,
            stylesheets=[asset_text("form.css"), colors],
        )
        self._fields.add(spec["name"], boxes)
        return row(_text(spec["label"]), boxes, css_classes=["checks"], sizing_mode=None)

    def show(
        self,
        values: Mapping[str, Any],
        disabled: Mapping[str, Sequence[str]] | None = None,
    ) -> None:
        """Show choices.

        Parameters
        ----------
        values
            of the fields, by name.
        disabled
            options that cannot be chosen now, by field.
        """
        for spec in self._specs:
            name, hidden = spec["name"], (disabled or {}).get(spec["name"], ())
            if self._disabled.get(name, ()) == hidden:
                continue
            self._disabled[name] = hidden
            kept = [option for option in spec["options"] if option[0] not in hidden]
            self._fields.values[name] = values[name]
            self._fields.widgets[name].param.update(
                **choices(kept), value=values[name], visible=len(kept) > 1
            )
        self._fields.put({name: v for name, v in values.items() if name in self._fields.values})

    def refuse(self, sentence: str) -> None:
        """Show why a number is refused; an empty sentence removes the words."""
        self._refusal.param.update(object=html.escape(sentence), visible=bool(sentence))


def _text(words: str, **params: Any) -> pn.pane.HTML:
    return pn.pane.HTML(words, margin=0, stylesheets=[asset_text("form.css")], **params)
