"""Candidates for the extent of a defect: a table with bars, one to show, one to take."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import panel as pn

from bearing_explorer.diagnosis.measurement_state import Sized
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.widgets.form import Fields, button, choices, row, select
from bearingcore import Candidate, Scene
from bearingcore.common import probability


class CandidateList(pn.Column):
    """Candidates as a table with bars of probability, one of them shown, and a button to take it.

    Parameters
    ----------
    look
        called with the number of the candidate to show.
    take
        called with the extent [deg] of the candidate that goes into the scene.
    """

    def __init__(self, look: Callable[[int], None], take: Callable[[float], None]) -> None:
        self._rows: list[dict[str, Any]] = []
        self._looked = 0
        self._table = pn.pane.HTML(
            "", stylesheets=[asset_text("sizing.css")], sizing_mode="stretch_width", margin=0
        )
        self._fields = Fields(lambda name: look(int(self._fields.values[name])))
        chosen = self._fields.add(
            "candidate", select("Curves shown", [["0", ""]], css_classes=["beside"])
        )
        self._take = button(
            "", lambda: take(self._rows[self._looked]["extent_deg"]), css_classes=["take"]
        )
        super().__init__(
            self._table, row(chosen, self._take), sizing_mode="stretch_width", margin=(2, 0, 8, 0)
        )

    def show(self, rows: list[dict[str, Any]], looked: int, *, takes: bool = True) -> None:
        """Show candidates, as `rows` makes them, and which of them the figures show.

        `takes`: whether there is a scene on the page that can take one.
        """
        self._rows, self._looked = rows, looked
        self._table.object = table_html(rows, looked)
        options = [[str(index), row["extent"]] for index, row in enumerate(rows)]
        self._fields.values["candidate"] = str(looked)
        self._fields.widgets["candidate"].param.update(**choices(options), value=str(looked))
        label = f"Take {rows[looked]['extent']} into the scene"
        self._take.param.update(label=label, visible=takes)


def table_html(rows: list[dict[str, Any]], looked: int) -> str:
    """The candidates as an HTML table."""
    lines = []
    for index, one in enumerate(rows):
        truth = f'<span class="truth">true {one["truth"]}</span>' if one["truth"] else ""
        width = max(100.0 * one["probability"], 0.4) if one["percent"] else 0.0
        lines.append(
            f'<tr class="{"looked" if index == looked else ""}"><th scope="row">{one["extent"]}'
            f"<small>{one['length']}</small></th><td>{one['made_of']}</td>"
            f'<td class="bar"><i style="width: {width:.1f}%"></i></td>'
            f'<td class="percent">{one["percent"]}{truth}</td>'
            f"<td>{one['explains']}</td></tr>"
        )
    return (
        '<table><caption class="unseen">Candidates for the extent of the defect</caption>'
        f"<tbody>{''.join(lines)}</tbody></table>"
    )


def rows(sized: Sized) -> list[dict[str, Any]]:
    """The candidates as the browser lists them.

    Without a clear size they show no probability: it would look like a verdict.
    """
    candidates = sized.sizing.candidates
    spacing = sized.scene.bearing.ball_spacing
    truth = sized.measured.true_extent
    nearest = None
    if truth is not None:
        nearest = min(range(len(candidates)), key=lambda i: abs(candidates[i].extent - truth))
    return [
        {
            "extent": in_degrees(candidate.extent),
            "length": along_race(candidate.extent, sized.scene),
            "extent_deg": round(math.degrees(candidate.extent), 2),
            "made_of": made_of(candidate, spacing),
            "probability": candidate.probability,
            "percent": probability(candidate.probability) if sized.sizing.conclusive else "",
            "explains": "explains "
            f"{100.0 * max(1.0 - float(candidate.waveform_misfit.mean()), 0.0):.0f} % of the mean "
            "ball pass",
            "truth": in_degrees(truth) if index == nearest and truth is not None else "",
        }
        for index, candidate in enumerate(candidates)
    ]


def made_of(candidate: Candidate, spacing: float) -> str:
    """An extent as whole ball spacings [rad] and a rest."""
    rest = candidate.extent - candidate.turns * spacing
    return f"{candidate.turns} × {in_degrees(spacing)} + {in_degrees(rest)}"


def along_race(extent: float, scene: Scene) -> str:
    """The length of an extent [rad] on the outer race, with its unit."""
    return style.with_prefix(extent * scene.bearing.outer_raceway_radius, "m")


def in_degrees(angle: float) -> str:
    """An extent [rad] in degrees; unlike a place it may be more than a turn."""
    return f"{math.degrees(angle):.1f}°"
