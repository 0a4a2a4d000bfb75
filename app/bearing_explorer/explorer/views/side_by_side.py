"""The scene and those it is compared with in one table: a column each, what was given first."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.field_values import SCENE_GROUPS, SHOWN_FIELDS, values_of
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.element_words import with_elements_of
from bearing_explorer.kit.widgets.facts import html_table, html_text
from bearingcore import Scene

THIS_SCENE = "this scene"

GROUPS = (*SCENE_GROUPS, "Balls", "Rows", "Second row", "Contact")
"""Groups of fields that decide answers at rest; radii of grooves and races follow the contact's."""

Rows = Iterable[tuple[str, str]]
"""Names as HTML, and values as text."""


def scenes_of(results: Results) -> Sequence[tuple[str, Results]]:
    """The scene, and those that it is compared with, each with a name where there are several."""
    compared = [
        (one.name, other)
        for one, other in zip(results.compared, results.compared_results, strict=True)
    ]
    return [(THIS_SCENE if compared else "", results), *compared]


def side_by_side(results: Results, *answers: Callable[[Results], Rows]) -> list[tuple[str, ...]]:
    """Rows of a name and a value of each scene: what was given that differs, then the answers."""
    several = [one for _, one in scenes_of(results)]
    given = [_given(one.scene) for one in several]
    columns = []
    for one, own in zip(several, given, strict=True):
        cells = {(name, 0): value for name, value in own.items() if _differs(given, name)}
        times = Counter(own)
        for name, value in (row for answer in answers for row in answer(one)):
            cells[name, times[name]] = value  # both races have rows of the same name
            times[name] += 1
        columns.append(cells)
    keys = dict.fromkeys(key for cells in columns for key in cells)
    rows = [(key[0], *(cells.get(key, "–") for cells in columns)) for key in keys]
    bearing = results.scene.bearing
    return [
        (with_elements_of(bearing, name), *cells) for name, *cells in rows if set(cells) != {"0"}
    ]


def side_by_side_html(results: Results, *answers: Callable[[Results], Rows]) -> str:
    """These rows as a table under the names of the scenes."""
    rows = [(name, *map(html_text, cells)) for name, *cells in side_by_side(results, *answers)]
    return html_table(("", *(name for name, _ in scenes_of(results))), rows, named=True)


def _given(scene: Scene) -> dict[str, str]:
    """Given numbers of a scene that decide its answers at rest, as the page shows them."""
    values = values_of(scene)
    return {
        f"{field.read_label} {field.read_symbol_html}": (
            f"{style.number(field.read_sign * values[field.key])} {field.shown_unit}".rstrip()
        )
        for field in SHOWN_FIELDS
        if field.part not in ("", "floor")
        and field.group in GROUPS
        and not math.isnan(values[field.key])
    }


def _differs(given: Sequence[dict[str, str]], name: str) -> bool:
    return len({one.get(name) for one in given}) > 1
