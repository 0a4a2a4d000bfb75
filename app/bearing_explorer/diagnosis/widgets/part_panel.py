"""A diagnosis on the page: the bearing with the damaged part marked, the answer, the evidence."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Mapping
from typing import Any

import panel as pn

from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.widgets.facts import Fact, facts_html
from bearing_explorer.kit.widgets.form import Fields, button, entry, row

_PICTURES = {
    "busy": "Bearing; the signal is being analysed",
    "healthy": "Bearing, no part marked: no damage seen",
    "unknown": "Bearing with a question mark: no clear result",
    "question": "Bearing with a question mark: which one is not known",
}
_COPY_JS = """
navigator.clipboard?.writeText(summary.text)
button.label = navigator.clipboard ? "Copied" : "Select the text to copy it"
"""
NOT_NOW = "Work order and report have to wait until the answer is up to date."
_CHOOSE_JS = "window.dispatchEvent(new CustomEvent('explorer-choose-files'))"
_REPORT_JS = "window.dispatchEvent(new CustomEvent('explorer-measured-report'))"
_MOST_BALLS = 60


REPORTED = {
    "machine": ("Name of the machine", "fan 3, motor side"),
    "point": ("Measuring point", "drive end, vertical"),
    "date": ("Date of the recording", "26 November 2026"),
}
"""Label and example of each field that a person fills in for the report."""


class PartPanel(pn.Column):
    """The bearing with the damaged part marked, the answer in words, and its assumptions.

    Parameters
    ----------
    report_on
        called with the texts typed for the report, by the names in `REPORTED`.
    """

    def __init__(
        self,
        report_on: Callable[[Mapping[str, str]], None] = lambda _: None,
    ) -> None:
        wide: dict[str, Any] = {"sizing_mode": "stretch_width", "margin": 0}
        self._answer = pn.pane.HTML("", stylesheets=[asset_text("part.css")], **wide)
        self._summary = pn.pane.Str("", visible=False)
        self._copy = button("Copy the work order", lambda: None)
        self._copy.js_on_click(args={"summary": self._summary, "button": self._copy}, code=_COPY_JS)
        self._report = button("Report on one page", lambda: None)
        self._report.js_on_click(code=_REPORT_JS)
        self._why_not = _words("")
        fields = Fields(lambda _: report_on(dict(fields.values)))
        for name, (label, example) in REPORTED.items():
            fields.add(name, entry(label, placeholder=example))
        several = button("Is it getting worse? Several files …", lambda: None)
        several.js_on_click(code=_CHOOSE_JS)
        self._actions = row(
            self._copy, *fields.widgets.values(), self._report, several, self._why_not,
            visible=False, margin=(0, 0, 8, 0),
        )  # fmt: skip
        super().__init__(self._answer, self._actions, self._summary, **wide)
        self.state: Mapping[str, Any] = {}

    def show(self, state: Mapping[str, Any]) -> None:
        """Show an answer in the form that `views.diagnosis.panel_state` returns."""
        if state == self.state:
            return
        self.state = state
        self._answer.object = part_html(state)
        stale = state.get("stale", "")
        summary = "" if stale else state.get("work_order", "")
        self._summary.object = summary
        self._copy.param.update(label="Copy the work order", disabled=not summary)
        self._report.disabled = not summary
        self._why_not.object = f"<p>{NOT_NOW}</p>" if stale else ""
        self._actions.visible = bool(state.get("work_order", ""))

    def outdate(self, why: str) -> None:
        """Mark the shown answer as out of date; the sentence `why` gives the reason."""
        if self.state.get("mood") in ("fault", "healthy", "unknown"):
            self.show({**self.state, "stale": why})


def _words(content: str) -> pn.pane.HTML:
    style = {"flex": "1 1 300px", "align-self": "center"}
    return pn.pane.HTML(content, stylesheets=[asset_text("part.css")], margin=0, styles=style)


def part_html(state: Mapping[str, Any]) -> str:
    """The answer as HTML: picture, headline, probability, plain words, work order, assumptions."""
    names = (
        "headline", "probability", "extent", "plain", "work_order", "color", "mood", "stale",
    )  # fmt: skip
    safe = {name: html.escape(str(state.get(name, ""))) for name in names}
    short = safe["probability"], safe["extent"]
    facts = [Fact(html.escape(name), value) for name, value in state.get("facts", ())]
    summary = (
        f'<div class="summary"><strong>Work order to copy</strong><p>{safe["work_order"]}</p></div>'
        if safe["work_order"] and not safe["stale"]
        else ""
    )
    assumptions = (
        f'<div class="rests"><h4>Assumptions</h4>{facts_html(facts)}</div>' if facts else ""
    )
    stale = ""
    if safe["stale"]:
        stale = f'<p class="stale" role="status"><strong>Out of date.</strong> {safe["stale"]}</p>'
    return (
        f'{stale}<section class="part{" old" if stale else ""}" '
        f'aria-label="Which part is damaged" data-mood="{safe["mood"]}" '
        f'style="--part: {safe["color"] or "var(--accent)"}">'
        f'<div class="place">{picture(state)}</div><div class="answer"><h3>{safe["headline"]}</h3>'
        f'<p class="probability">{" · ".join(filter(None, short))}</p>'
        f"<p>{safe['plain']}</p>{summary}</div>"
        f'<div class="rests">{assumptions}</div></section>'
    )


def picture(state: Mapping[str, Any]) -> str:
    """The bearing along the shaft as SVG, to scale, with the damaged part marked."""
    bearing, mood = state["bearing"], state["mood"]
    part = state.get("part", "") if mood == "fault" else ""
    ball, outer, inner = bearing["ball"], bearing["outer"], bearing["inner"]
    rim, bore = outer + 0.45 * ball, max(inner - 0.45 * ball, 0.3 * inner)
    scale = 96.0 / rim

    def ring(radius: float, hole: float, name: str) -> str:
        circles = " ".join(
            f"M{-r:.2f} 0A{r:.2f} {r:.2f} 0 1 1 {r:.2f} 0A{r:.2f} {r:.2f} 0 1 1 {-r:.2f} 0Z"
            for r in (scale * radius, scale * hole)
        )
        marked = " marked" if part == name else ""
        return f'<path class="steel{marked}" fill-rule="evenodd" d="{circles}"/>'

    balls = "".join(
        f'<circle class="ball{" marked" if part == "ball" and not i else ""}" '
        f'r="{0.5 * scale * ball:.2f}" cx="{0.5 * scale * bearing["pitch"] * math.cos(turn):.2f}" '
        f'cy="{0.5 * scale * bearing["pitch"] * math.sin(turn):.2f}"/>'
        for i in range(min(bearing["n_balls"], _MOST_BALLS))
        for turn in [2.0 * math.pi * i / bearing["n_balls"] + 0.5 * math.pi]
    )
    # the impact is at the bottom, where a load that points down presses
    places = {"outer race": outer, "inner race": inner, "ball": 0.5 * (bearing["pitch"] + ball)}
    mark = _impact(scale * places[part], max(0.22 * scale * ball, 4.5)) if part else ""
    if mood in ("unknown", "question"):
        mark = '<text class="question" text-anchor="middle" dominant-baseline="central">?</text>'
    words = f"Bearing, {part} marked" if part else _PICTURES.get(mood, "Bearing")
    return (
        f'<svg viewBox="-104 -104 208 208" role="img" aria-label="{words}" data-part="{part}">'
        f"{ring(rim, outer, 'outer race')}{ring(inner, bore, 'inner race')}{balls}{mark}</svg>"
    )


def _impact(y: float, size: float) -> str:
    """A spot with rays around it."""
    rays = ""
    for i in range(8):
        c, s = (function(math.pi * (i + 0.5) / 4.0) for function in (math.cos, math.sin))
        rays += f"M{size * c:.2f} {y + size * s:.2f}"
        rays += f"L{2.1 * size * c:.2f} {y + 2.1 * size * s:.2f}"
    return (
        f'<path class="rays" d="{rays}"/>'
        f'<circle class="spot" cx="0" cy="{y:.2f}" r="{0.55 * size:.2f}"/>'
    )
