"""A page about one scene that stands alone: numbers, warnings, figures, link, version, date.

Made in two halves. The server writes the page, all words escaped, with a mark where each figure
goes, and makes the figures anew with the numbers of the scene, whatever tab is open. The browser,
which alone can paint them, draws each as SVG, puts it in its place and saves the file. The page
that comes out holds no script, and its policy allows none; nothing is fetched.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from bokeh.embed import json_item

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.results.verdict import rows_of
from bearing_explorer.explorer.state.choice_list import OF_DEFECT, OF_SCENE, floor_name
from bearing_explorer.explorer.state.field_values import SHOWN_FIELDS, defects_of, values_of
from bearing_explorer.explorer.views.bearing_editor import facts_of
from bearing_explorer.explorer.views.displacement import Displacement
from bearing_explorer.explorer.views.life import facts_of as facts_of_life
from bearing_explorer.explorer.views.side_by_side import side_by_side_html
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.element_words import extent_words, row_words, with_elements_of
from bearing_explorer.kit.report_page import About, document, heading, mark_of
from bearing_explorer.kit.sentences import words_of
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.views.still_figure import Figure
from bearing_explorer.kit.widgets.facts import html_table, html_text, sentence_html
from bearing_explorer.kit.widgets.limits import judged
from bearingcore import Scene
from bearingcore.fields import Field
from bearingcore.model.scene import DOF_SYMBOLS

log = logging.getLogger(__name__)

FILE = "bearing-report.html"
_LIMIT_COLUMNS = ("name", "value", "limit", "state", "sentence")
_STATES = {"crossed": "exceeded", "kept": "passed", "unknown": "cannot be checked"}
_DEFECT_GROUP = "Defect"


def report(
    results: Results, views: Sequence[type[View]], job_results: Mapping[str, Any], about: About
) -> dict[str, Any]:
    """The report for the browser to finish. For any thread: it touches no models of the page.

    `job_results`: results of jobs, by view; views of jobs without are left out.
    """
    parts: list[str] = []
    items: list[Any] = []
    drawn: list[str] = []
    for kind in views:
        if not (kind.in_report and (kind.needs or kind.name in job_results)):
            continue
        try:
            figure = Figure(kind, results, job_result=job_results.get(kind.name), computed=False)
        except ValueError as error:
            why = f"Not shown for this scene: {words_of(error)}."
            parts.append(_figure(kind, results, [], why))
            continue
        except Exception:
            log.exception("the view %s failed in a report", kind.name)
            continue
        drawable = figure.layout.references()  # a view may have figures for other choices
        if ids := [plot.id for plot in figure.view.figures if plot in drawable]:
            parts.append(_figure(kind, results, ids, figure.sentence))
            items.append(json_item(figure.layout))
            drawn += ids
    return {
        "name": FILE,
        "html": page(results, about, parts),
        "items": items,
        "figures": drawn,
    }


def page(results: Results, about: About, parts: Iterable[str]) -> str:
    """The whole page with its `parts`, each a section of HTML."""
    scene = results.scene
    limits = rows_of(results.limits)
    said = judged(results.status(0.0), limits)
    crossed = [row for row in limits if row["state"] == "crossed"]
    title = about.title.strip() or "Bearing report"
    body = [
        *heading(about, title),
        "<section><h2>Scene</h2>",
        _changes(scene, about),
        f"<p>Grey in the figures: {html_text(results.grey.name)}. {_compared(results)}Cage angle: "
        f"{html_text(style.in_degrees(results.cage_angle))}.</p>",
        f"<p class='{'good' if said['mood'] == 'good' else 'bad'}'>{html_text(said['words'])}; "
        f"{html_text('; '.join(said['details'][:-1]))}.</p></section>",
        _side_by_side(results),
        "<section><h2>Warnings</h2>",
        _list([row["sentence"] for row in crossed]) if crossed else "<p>No limit is exceeded.</p>",
        html_table(
            ["Check", "Value", "Limit", "", "In words"],
            [
                [html_text(_STATES.get(row[key], row[key])) for key in _LIMIT_COLUMNS]
                for row in limits
            ],
        ),
        "</section>",
        *parts,
        "<section><h2>All numbers</h2>",
        "<div class='numbers'>",
        *(f"<div>{part}</div>" for part in _numbers(scene)),
        "</div></section>",
    ]
    return document(about, title, body, asset_text("report.css"))


def _figure(view: type[View], results: Results, ids: Sequence[str], sentence: str) -> str:
    bearing = results.scene.bearing
    caption = html_text(with_elements_of(bearing, view.caption(results)))
    title = html_text(with_elements_of(bearing, view.title))
    drawings = "".join(f"<div class='drawing'>{mark_of(i)}</div>" for i in ids)
    return (
        f"<section><h2>{title}</h2><p class='about'>{caption}</p>"
        f"<figure>{drawings}<figcaption>{sentence_html(sentence)}</figcaption></figure></section>"
    )


def _compared(results: Results) -> str:
    names = style.list_words([f"“{one.name}”" for one in results.compared])
    return html_text(f"Also drawn: {names}. ") if names else ""


def _side_by_side(results: Results) -> str:
    """Given numbers that differ, life, pressure, film and displacement of compared scenes."""
    if not results.compared:
        return ""
    table = side_by_side_html(results, facts_of_life, Displacement.rows)
    return f"<section><h2>Side by side</h2>{table}</section>"


def _changes(scene: Scene, about: About) -> str:
    several = defects_of(scene)
    sentences = [
        f"{defect.race.capitalize()} race at "
        f"{style.in_degrees(defect.center)}{row_words(scene.bearing, defect.row)}: "
        f"{extent_words(defect, scene.bearing)} long, "
        f"{style.with_prefix(defect.depth, 'm')} deep, "
        + "".join(f"{said}, " for choice in OF_DEFECT if (said := choice.sentence(defect)))
        + f"{floor_name(defect.floor)} floor."
        for defect in several
        if not defect.is_none
    ]
    chosen = [f"{said}. " for choice in OF_SCENE if (said := choice.sentence(scene))]
    return (
        f"<p>Bearing: {html_text(about.bearing)}. {html_text(about.note)}</p>"
        + (_list(sentences) if sentences else "<p>There is no defect.</p>")
        + f"<p>{html_text(''.join(chosen))}Directions that can move: "
        f"{html_text(', '.join(DOF_SYMBOLS[dof] for dof in scene.active_dofs))}.</p>"
    )


def _numbers(scene: Scene) -> Iterable[str]:
    """Tables of all numbers, a group each; those of defects once a defect."""
    facts = [[html_text(f["label"]), f["symbol"], html_text(f["value"])] for f in facts_of(scene)]
    yield "<h3>Derived quantities</h3>" + html_table(["Name", "Symbol", "Value"], facts)
    groups = dict.fromkeys(q.group for q in SHOWN_FIELDS if q.part not in ("", "floor"))
    for group in groups:
        count = len(defects_of(scene)) if group == _DEFECT_GROUP else 1
        for number in range(count):
            values = values_of(scene, number)
            rows = [
                _row(q, values[q.key])
                for q in SHOWN_FIELDS
                if q.group == group
                and q.part not in ("", "floor")
                and not math.isnan(values[q.key])
            ]
            name = f"{group} {number + 1}" if count > 1 else group
            if rows:
                head = ["Name", "Symbol", "Value", "Unit"]
                yield f"<h3>{html_text(name)}</h3>" + html_table(head, rows)


def _row(field: Field, value: float) -> list[str]:
    shown = f"{field.read_sign * value:.9g}".replace("-", "−")
    return [
        html_text(field.read_label),
        field.read_symbol_html,
        html_text(shown),
        html_text(field.shown_unit),
    ]


def _list(sentences: Iterable[str]) -> str:
    return "<ul>" + "".join(f"<li>{html_text(sentence)}</li>" for sentence in sentences) + "</ul>"
