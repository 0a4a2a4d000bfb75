"""Facts on the page: names and values under headings, as HTML."""

from __future__ import annotations

import html
from collections.abc import Iterable
from typing import Any, NamedTuple

import panel as pn

from bearing_explorer.assets import asset_text


class Fact(NamedTuple):
    """A fact.

    Attributes
    ----------
    name
        its name, as HTML: symbols have subscripts.
    value
        number with its unit, or words.
    note
        its meaning, as a tooltip of the name.
    mark
        class of its line in the style sheet.
    """

    name: str
    value: str
    note: str = ""
    mark: str = ""


class FactGroup(NamedTuple):
    """Facts under a heading, and a sentence below them."""

    title: str
    words: str
    facts: list[Fact]


def facts_pane(content: str = "", **params: Any) -> pn.pane.HTML:
    """A pane for facts and paragraphs."""
    return pn.pane.HTML(content, stylesheets=[asset_text("facts.css")], margin=0, **params)


def facts_html(facts: Iterable[Fact]) -> str:
    """Facts as a list of definitions; names are HTML, everything else is text."""
    rows = "".join(
        f'<div class="{fact.mark}"><dt title="{html.escape(fact.note)}">{fact.name}</dt>'
        f"<dd>{html.escape(fact.value)}</dd></div>"
        for fact in facts
    )
    return f'<dl class="facts">{rows}</dl>'


def groups_html(groups: Iterable[FactGroup]) -> str:
    """Groups of facts with their headings and sentences."""
    return "".join(
        f"<section><h3>{group.title}</h3>{facts_html(group.facts)}"
        f"<p>{html.escape(group.words)}</p></section>"
        for group in groups
    )
