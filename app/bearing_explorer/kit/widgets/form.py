"""Forms of Panel's own widgets, in the colours of the page and with labels for screen readers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypedDict

import panel as pn

from bearing_explorer.kit.assets import asset_text

LONGEST_TEXT = 60
"""Longest text [characters] that is read from a field."""
SEARCHED = 20
"""Number of options above which a list gets a search field."""


_ROW = ":host { flex-wrap: wrap; align-items: end; gap: 8px 14px; min-width: 0 !important; }"


_OWN_LINE = """@media (max-width: 820px) {
  :host { flex: 1 0 100%; }
  * { align-self: start !important; }
}"""
"""Style for a phone: a list takes the whole line, so that its own fields share the next one."""


class FieldSpec(TypedDict, total=False):
    """A field of a form, or a choice above a figure.

    Without `options` text is typed into it. An option is [value, words] or [value, words, heading].
    If `some` is true, several can be chosen: each is [value, words, colour]. `hint` is the
    placeholder of a text field. `within` describes a number: its name in a sentence, its unit, its
    least and its greatest value.
    """

    name: str
    label: str
    options: Sequence[Sequence[str]]
    some: bool
    hint: str
    within: tuple[str, str, float, float]


def select(label: str, options: Sequence[Sequence[str]], **params: Any) -> pn.widgets.Select:
    """Make a labelled list of [value, words] or [value, words, heading] to choose from."""
    return pn.widgets.Select(label=label, **choices(options), **_common(params))


def choices(options: Sequence[Sequence[str]]) -> dict[str, Any]:
    """Return options for Panel's Select: by their words, under headings where they have any."""
    groups: dict[str, dict[str, str]] = {}
    for value, words, *heading in options:
        groups.setdefault("".join(heading), {})[words] = value
    return {"options": groups.get("", {})} if list(groups) in ([], [""]) else {"groups": groups}


def entry(label: str, **params: Any) -> pn.widgets.TextInput:
    """Make a labelled field for text or a number."""
    return pn.widgets.TextInput(label=label, **_common(params))


def widget_of(spec: FieldSpec, *classes: str) -> pn.widgets.Widget:
    """Make the list or the text field of a specification."""
    if "options" in spec:
        return select(spec["label"], spec["options"], css_classes=list(classes))
    hint = spec.get("hint", "")
    return entry(spec["label"], placeholder=hint, css_classes=[*classes, "number"])


def button(label: str, act: Callable[[], None], **params: Any) -> pn.widgets.Button:
    """Make a button; `act` is called on the event loop of the session."""
    made = pn.widgets.Button(label=label, **_common(params))
    made.on_click(lambda _: act())
    return made


def row(*parts: Any, **params: Any) -> pn.Row:
    """Put parts side by side, on several lines where there is little room."""
    wide: dict[str, Any] = {"sizing_mode": "stretch_width", "margin": 0, "stylesheets": [_ROW]}
    return pn.Row(*parts, **(wide | params))


def stack(*parts: Any, **params: Any) -> pn.Column:
    """Put parts below one another; the stack stretches as its parts do."""
    return pn.Column(*parts, **({"margin": 0} | params))


AS_HIGH_AS_SHOWN = ":host { min-height: min-content !important; }"
"""Style sheet of a stack inside a card: the stack is as high as its visible parts.

Panel adds up the least heights of figures, even of hidden ones, and counts none for text.
"""


def _common(params: Mapping[str, Any]) -> dict[str, Any]:
    common = {"width": None, "margin": 0, "align": "end", "stylesheets": [asset_text("form.css")]}
    return common | dict(params)


class Fields:
    """Widgets by name and their values; `changed(name)` is called for each change by the user.

    Parameters
    ----------
    changed
        called on the event loop of the session, after `values` has the new value.
    """

    def __init__(self, changed: Callable[[str], None]) -> None:
        self.widgets: dict[str, pn.widgets.Widget] = {}
        self.values: dict[str, Any] = {}
        self._changed = changed

    def add(self, name: str, widget: pn.widgets.Widget) -> pn.widgets.Widget:
        """Add a widget to the form and follow its value."""
        self.widgets[name] = widget
        self.values[name] = widget.value
        widget.css_classes = [*widget.css_classes, "field", f"field-{name}"]
        widget.param.watch(lambda event: self._take(name, event.new), "value")
        return widget

    def put(self, values: Mapping[str, Any]) -> None:
        """Set values without calling `changed`."""
        for name, value in values.items():
            self.values[name] = value
            if self.widgets[name].value != value:
                self.widgets[name].value = value

    def _take(self, name: str, value: Any) -> None:
        value = value[:LONGEST_TEXT] if isinstance(value, str) else value
        if self.values[name] != value:
            self.values[name] = value
            self._changed(name)


class SearchedSelect(pn.Column):
    """A long list with a search field, which offers only options that hold all words typed.

    The chosen option always stays.
    """

    def __init__(self, select: pn.widgets.Select, options: Sequence[Sequence[str]]) -> None:
        self._select, self._all = select, options
        search = entry(
            "",
            placeholder=f"Search {len(options)} quantities",
            css_classes=["search"],
            align="start",
        )
        search.param.watch(lambda event: self._filter(event.new), "value_input")
        super().__init__(search, select, align="end", margin=0, stylesheets=[_OWN_LINE])

    def _filter(self, text: str) -> None:
        words = text[:LONGEST_TEXT].lower().split()
        kept = [
            option
            for option in self._all
            if option[0] == self._select.value
            or all(word in " ".join(option[1:]).lower() for word in words)
        ]
        self._select.param.update(**choices(kept))
