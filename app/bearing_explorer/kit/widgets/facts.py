"""Facts and tables on the page, as HTML."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import zip_longest
from typing import Any, ClassVar, NamedTuple

import numpy as np
import panel as pn
import param
from numpy.typing import NDArray

from bearing_explorer.kit.assets import asset_path, asset_text
from bearing_explorer.kit.serve.panel_internals import LiveComponent
from bearingcore.common import count, number
from bearingcore.units import UNITS


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


class LiveFacts(LiveComponent):
    """Facts that follow a slider; with a pane, each step would lay out the card anew."""

    text = param.String()

    _esm = asset_path("facts.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("facts.css")]


def facts_pane(content: str = "", **params: Any) -> pn.pane.HTML:
    """Make a pane for facts and paragraphs."""
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


def html_text(words: str) -> str:
    """Escape words for HTML."""
    return html.escape(words, quote=True)


def sentence_html(words: str) -> str:
    """Return a sentence as HTML, with the directions of a stiffness, ``k_yy``, as subscripts."""
    return re.sub(r"\bk_([xyzθ]+)", r"k<sub>\1</sub>", html_text(words))


def html_table(heads: Iterable[str], rows: Iterable[Sequence[str]], named: bool = False) -> str:
    """Return a table of cells that are HTML already; if `named`, rows begin with their name."""
    head = "".join(f"<th scope='col'>{html_text(word)}</th>" for word in heads)
    body = ""
    for row in rows:
        names = [f"<th scope='row'>{cell}</th>" for cell in row[:named]]
        body += "".join(["<tr>", *names, *(f"<td>{cell}</td>" for cell in row[named:]), "</tr>"])
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


MOST_ROWS = 300
"""Largest number of rows of a table on the page; the CSV file has all."""
NOISE = 1e-12
"""Share of a unit's largest number: less is rounding noise."""
_PLACES = ("angle", "frequency", "time")
"""Words in the names of columns that give the place of a row."""
_UNITS = {unit.suffix: name for name, unit in UNITS.items() if unit.suffix}


def table_to_read(columns: Mapping[str, NDArray[Any]]) -> tuple[str, str]:
    """Return the numbers behind a figure as an HTML table, and words on the rows that it has.

    It begins where values begin: columns may be zero up to a time or an angle.
    """
    if not columns:
        return "", "Nothing is drawn yet."
    size = max(np.size(column) for column in columns.values())
    begins = [
        k for n, v in columns.items() if not any(word in n for word in _PLACES) for k in _begin(v)
    ]
    first = max(0, min(begins, default=0) - 1)
    end = min(size, first + MOST_ROWS)
    shown = [
        [_cell(value) for value in np.ravel(v)[first:end]] for v in _drop_noise(columns).values()
    ]
    table = html_table(map(_heading, columns), zip_longest(*shown, fillvalue=""))
    if end - first == size:
        return table, count(size, "row")
    zero = "; before them all values are zero" if first else ""
    return table, f"Rows {first + 1} to {end} of {size}{zero}; the CSV file has all."


def _drop_noise(columns: Mapping[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Replace rounding noise, relative to the largest number of the same unit, by zero."""
    numbers = {name: v for name, v in columns.items() if np.asarray(v).dtype.kind == "f"}
    largest: dict[str, float] = {}
    for name, values in numbers.items():
        unit = _suffix(name) or name
        size = np.max(np.abs(values), where=np.isfinite(values), initial=0.0)
        largest[unit] = max(largest.get(unit, 0.0), float(size))
    return {**columns} | {
        name: np.where(np.abs(values) < NOISE * largest[_suffix(name) or name], 0.0, values)
        for name, values in numbers.items()
    }


def _begin(values: NDArray[Any]) -> NDArray[np.intp]:
    """Return the first row, if any, in which a column is neither zero nor NaN nor empty."""
    flat = np.ravel(values)
    return np.flatnonzero(np.nan_to_num(flat) if flat.dtype.kind in "fiu" else flat != "")[:1]


def _heading(name: str) -> str:
    """Return a heading: "ball load (N)" for ``ball_load_n``."""
    suffix = _suffix(name)
    bare = name.removesuffix(f"_{suffix}").replace("_", " ")
    return f"{bare} ({_UNITS[suffix]})" if suffix else bare


def _suffix(name: str) -> str:
    """Return the unit at the end of a column's name, as it is written there."""
    suffixes = [suffix for suffix in _UNITS if name.endswith(f"_{suffix}")]
    return max(suffixes, key=len, default="")


def _cell(value: Any) -> str:
    """Write a number with six digits, and everything else as it is."""
    if isinstance(value, float | np.number):
        return number(float(value), 6)
    return html_text(str(value))
