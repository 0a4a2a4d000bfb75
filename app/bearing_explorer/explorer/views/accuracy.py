"""Speed against accuracy: a chart for each reference."""

from __future__ import annotations

import html
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
import panel as pn

from bearing_explorer.explorer.results.accuracy import preset_like, shipped
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.work_precision import (
    REST,
    WorkPrecision,
    paragraph,
    prose,
)
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import SessionParts, View, figures_in
from bearing_explorer.kit.widgets.form import Fields, row, select, stack
from bearingcore import presets
from bearingcore.experiments import (
    HARD_CASES,
    MOTION_ERRORS,
    STATIC_ERRORS,
    Experiment,
    Measurements,
)
from bearingcore.scene import WITH_MASS, preset_labels


class Chart(NamedTuple):
    """A chart: its experiment, its reference in that, and its heading."""

    experiment: str
    reference: str
    title: str
    wide: bool = False


CHARTS = {
    "Motion": (Chart("motion", "", "Steps and methods, against two families at 10⁻¹³", wide=True),),
    "Statics": (
        Chart("statics", "", "Solvers, against energy minima in 80-bit numbers", wide=True),
        *(Chart("statics", case, f"The same, {case}") for case in HARD_CASES),
    ),
}
"""The charts by what they are of: each has one reference."""
ERRORS = {
    "motion": MOTION_ERRORS,
    "statics": STATIC_ERRORS,
}
"""Errors that can be drawn, by experiment."""

COSTS = [["seconds", "time"], ["evaluations", "evaluations"]]


def _grid(least: int) -> str:
    """Style of charts side by side, each at least that many pixels wide."""
    columns = f"repeat(auto-fit, minmax(min(100%, {least}px), 1fr))"
    return f":host {{ display: grid; grid-template-columns: {columns}; gap: 14px 26px; }}"


class Accuracy(View[Results]):
    """Error against cost; of its sections the page shows one."""

    name = "accuracy"
    title = "Speed against accuracy"
    about = (
        "Run time against error, one reference to a chart. Low is exact, left is cheap. Grey line: "
        "points that no other beats in both. Dashed: an error of 0.1 dB or 1 %. Ring: in use. "
        "Crosses on the upper edge failed; point at one for the reason. Dotted: the order of "
        "convergence that theory gives. Letters at the points: steps a second, or tolerance."
    )
    sentence_looks = ("unseen",)

    def build(self, packed: PackedSource) -> Any:
        self._chosen = Fields(lambda _: self._redraw())
        self._chosen.add("charts", select("Charts of", [[name, name] for name in CHARTS]))
        self._chosen.add("cost", select("Cost as", COSTS))
        self._origin, self._foot = prose("", REST), prose()
        self._charts = {
            heading: [
                (one, WorkPrecision(one.title, ERRORS[one.experiment], self._redraw, one.wide))
                for one in charts
            ]
            for heading, charts in CHARTS.items()
        }
        self._sections = {
            heading: stack(*(chart.panel for _, chart in made), stylesheets=[_grid(360)])
            for heading, made in self._charts.items()
        }
        self._place = stack(*self._sections.values(), margin=(14, 0, 0, 0))
        return [
            row(*self._chosen.widgets.values(), self._origin),
            self._place,
            self._foot,
        ]

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self._turn_to(self._chosen.values["charts"])

    def _turn_to(self, heading: str) -> None:
        """Leave the browser one section alone: it takes long to build them all."""
        section = self._sections[heading]
        if list(self._place) != [section]:
            self._place.objects = [section]
            panes = section.select(pn.pane.Bokeh)
            self._caption.put(
                figures=[plot.id for pane in panes for plot in figures_in(pane.object)]
            )

    def sentence(self, results: Results) -> str:
        scene = results.scene
        preset = preset_like(scene)
        words = f"Measured: {preset_labels[preset]}."
        if presets[preset] != scene:
            words = (
                f"This scene is not measured: the points are those of {preset_labels[preset]} as "
                "it comes. In Python `bearingcore.experiments.measure(scene)` measures any scene."
            )
        if scene.balls == WITH_MASS:
            words += " Balls are massless in all charts."
        return words

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return shipped(preset_like(results.scene)).table().named()

    def _redraw(self) -> None:
        if self.parts is not None:
            self._turn_to(self._chosen.values["charts"])
        if self._results is not None:
            self.show(self._results)

    def show(self, results: Results) -> None:
        preset = preset_like(results.scene)
        found = shipped(preset)
        refused = found.refused if presets[preset] == results.scene else {}
        cost = self._chosen.values["cost"]
        for one, chart in chain.from_iterable(self._charts.values()):
            why = refused.get(one.experiment, "")
            chart.draw(_part(found, one), cost, why)
        self._origin.object = paragraph(self.sentence(results))
        self._foot.object = foot(found)


def _part(found: Measurements, chart: Chart) -> Experiment | None:
    """The part of measurements that a chart shows."""
    one = found.experiments.get(chart.experiment)
    part = None if one is None else one.per_reference().get(chart.reference)
    return part if part is not None and part.points else None


def foot(found: Measurements) -> str:
    """Methods left out and the reasons; versions and machine."""
    left = "".join(
        f"<li>{html.escape(name.capitalize())}: {html.escape(one.left_out)}.</li>"
        for name, one in found.experiments.items()
        if one.left_out
    )
    words = f"<h4>What was left out, and why</h4><ul>{left}</ul>" if left else ""
    return f"{words}<p>{html.escape(found.machine.sentence)}</p>"
