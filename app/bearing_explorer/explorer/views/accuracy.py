"""Speed against accuracy: a chart for each reference, and where steps and orbits are unstable."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Mapping
from itertools import chain, pairwise
from typing import Any, NamedTuple

import numpy as np
import panel as pn

from bearing_explorer.explorer.results.accuracy import (
    EVERYTHING,
    TRIALS,
    Found,
    compute,
    preset_like,
    shipped,
)
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views.scene_job_view import SceneJobView
from bearing_explorer.explorer.views.work_precision import (
    REST,
    WorkPrecision,
    paragraph,
    prose,
)
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import SessionParts, figures_in
from bearing_explorer.kit.widgets.form import Fields, FieldSpec, row, select, stack
from bearingcore import presets
from bearingcore.experiments import (
    HARD_CASES,
    MOTION_ERRORS,
    STATIC_ERRORS,
    Experiment,
    Measurements,
    OrbitAtSpeed,
    StabilityChart,
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
STEPS_AND_ORBITS = "Stability"
SECTIONS = (*CHARTS, STEPS_AND_ORBITS)
"""Subjects to choose from, of which the page shows one."""
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


class Accuracy(SceneJobView[Found]):
    """Error against cost, where steps are too long, and where the orbit is unstable."""

    name = "accuracy"
    title = "Speed against accuracy"
    about = (
        "Run time against error, one reference to a chart. Low is exact, left is cheap. Grey line: "
        "points that no other beats in both. Dashed: an error of 0.1 dB or 1 %. Ring: in use. "
        "Crosses on the upper edge failed; point at one for the reason. Dotted: the order of "
        "convergence that theory gives. Letters at the points: steps a second, or tolerance."
    )
    start = "Measure on this machine"
    bounds = (
        "Points come one by one. SciPy's DOP853, Radau and BDF are shown as shipped only: they "
        "take longer than all others together."
    )
    computes = False
    sentence_looks = ("unseen",)

    @property
    def is_empty(self) -> bool:
        return False

    def build(self, packed: PackedSource) -> Any:
        self._chosen = Fields(lambda _: self._redraw())
        self._chosen.add("charts", select("Charts of", [[name, name] for name in SECTIONS]))
        self._chosen.add("cost", select("Cost as", COSTS))
        self._origin, self._foot = prose("", REST), prose()
        self._charts = {
            heading: [
                (one, WorkPrecision(one.title, ERRORS[one.experiment], self._redraw, one.wide))
                for one in charts
            ]
            for heading, charts in CHARTS.items()
        }
        self._stability = prose()
        self._sections = {
            heading: stack(*(chart.panel for _, chart in made), stylesheets=[_grid(360)])
            for heading, made in self._charts.items()
        }
        self._sections[STEPS_AND_ORBITS] = stack(self._stability)
        self._place = stack(*self._sections.values(), margin=(14, 0, 0, 0))
        return [
            self.job,
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

    # The job

    def fields(self) -> list[FieldSpec]:
        options = [[name, words] for name, words in TRIALS.items()]
        return [{"name": "experiment", "label": "What to measure", "options": options}]

    def form(self, editor: SceneEditor) -> tuple[dict[str, str], dict[str, Any]]:
        return {"experiment": next(iter(TRIALS))}, {}

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        name, scene = given["experiment"], editor.scene
        if name not in TRIALS:
            raise ValueError("There is no such experiment.")
        return lambda job: compute(job, scene, name)

    def begin(self, given: Mapping[str, str]) -> None:
        super().begin(given)
        measured = given["experiment"]
        drawn = (
            name for name, charts in CHARTS.items() for c in charts if c.experiment == measured
        )
        if measured != EVERYTHING:
            self._chosen.put({"charts": next(drawn, STEPS_AND_ORBITS)})
            self._redraw()

    # The picture

    def _shown(self, results: Results) -> Mapping[str, Experiment]:
        """The experiments shown: of this machine, and shipped where there are none of it."""
        base = shipped(preset_like(results.scene))
        own = {} if self.found is None else self.found.result.experiments
        return {**base.experiments, **own}

    def sentence(self, results: Results) -> str:
        found, scene = self.found, results.scene
        preset = preset_like(scene)
        words = f"Shipped: {preset_labels[preset]}."
        if presets[preset] != scene:
            words = (
                f"Nothing is shipped for this scene. Shipped points are those of "
                f"{preset_labels[preset]} as it comes; “Measure on this machine” takes this scene."
            )
        if found is not None:
            words = f"Measured on this machine: {found.result.count} points. {words}"
            if self._same:
                words += " Pale: shipped."
            if found.scene != scene:
                words += " The scene has changed since it was measured."
        if scene.balls == WITH_MASS:
            words += " Balls are massless in all charts."
        return words

    def table(self, results: Results) -> dict[str, np.ndarray]:
        base = shipped(preset_like(results.scene))
        shown = base if self.found is None else self.found.result
        return shown.table().named()

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        self._origin.object = paragraph(sentence)
        if self._results is not None:
            self._show(self._results)

    @property
    def _same(self) -> bool:
        """Whether the scene that was measured here is a preset as it comes."""
        scene = None if self.found is None else self.found.scene
        return scene is not None and presets.get(preset_like(scene)) == scene

    def _redraw(self) -> None:
        if self.parts is not None:
            self._turn_to(self._chosen.values["charts"])
        if self._results is not None:
            self._show(self._results)

    def _show(self, results: Results) -> None:
        preset = preset_like(results.scene)
        base = shipped(preset)
        own = None if self.found is None else self.found.result
        reasons = {
            **(base.refused if presets[preset] == results.scene else {}),
            **(own.refused if own is not None else {}),
        }
        cost = self._chosen.values["cost"]
        for one, chart in chain.from_iterable(self._charts.values()):
            part, pale = _part(own, one), _part(base, one)
            if part is not None and not self._same:
                pale = None  # of another scene
            chart.draw(part, pale, cost, reasons.get(one.experiment, ""))
        known = [found for found in (own, base) if found is not None]
        steps = next((found.stability for found in known if found.stability is not None), None)
        orbits = next((found.orbits for found in known if found.orbits), ())
        self._stability.object = paragraph(steps_sentence(steps)) + paragraph(
            orbits_sentence(orbits)
        )
        self._foot.object = foot(own, base, self._shown(results))


def _part(found: Measurements | None, chart: Chart) -> Experiment | None:
    """The part of measurements that a chart shows."""
    one = None if found is None else found.experiments.get(chart.experiment)
    part = None if one is None else one.per_reference().get(chart.reference)
    return part if part is not None and part.points else None


def foot(own: Measurements | None, base: Measurements, shown: Mapping[str, Experiment]) -> str:
    """Methods left out and the reasons; versions and machines."""
    left = "".join(
        f"<li>{html.escape(name.capitalize())}: {html.escape(one.left_out)}.</li>"
        for name, one in shown.items()
        if one.left_out
    )
    words = f"<h4>What was left out, and why</h4><ul>{left}</ul>" if left else ""
    for kind, found in (("Shipped", base), ("This machine", own)):
        if found is not None:
            words += f"<p>{kind}: {html.escape(found.machine.sentence)}</p>"
    return words


def steps_sentence(chart: StabilityChart | None) -> str:
    """Step rates at which each method diverges, found and expected."""
    if chart is None:
        return "Stability of the steps is not measured yet."
    words = []
    for name in dict.fromkeys(t.method for t in chart.trials):
        found, limit = chart.stability_limit(name), chart.linear_limit[name]
        found, limit = found / chart.highest_frequency, limit / chart.highest_frequency
        met = style.number(found, 2) if math.isfinite(found) else "at every step tried"
        expected = style.number(limit, 2) if limit else "none"
        words.append(f"{name} {met} (linear theory: {expected})")
    frequency = style.with_prefix(chart.highest_frequency, "Hz")
    return (
        f"Steps per period of the highest frequency, {frequency}, below which the motion diverges: "
        f"{', '.join(words)}."
    )


def orbits_sentence(orbits: tuple[OrbitAtSpeed, ...]) -> str:
    """Where the periodic motion loses its stability, and how."""
    found = [one for one in orbits if one.multipliers]
    if not found:
        why = orbits[0].status if orbits else "not measured yet"
        return f"No periodic motion over the shaft speed: {why}."

    def at(one: OrbitAtSpeed) -> str:
        return f"{style.number(one.shaft_speed / (2.0 * math.pi), 3)} Hz"

    changed = [b for a, b in pairwise(found) if a.loss != b.loss]
    changes = [f"{one.loss or 'stable again'} from {at(one)}" for one in changed]
    first = f"{'Unstable' if found[0].loss else 'Stable'} at {at(found[0])}"
    words = ", ".join([first, *(changes or [f"and so to {at(found[-1])}"])])
    named = dict.fromkeys([found[0], *changed, found[-1]])
    sizes = ", ".join(f"{style.number(one.size, 2)} at {at(one)}" for one in named)
    missing = len(orbits) - len(found)
    rest = f" No orbit was found at {missing} of {len(orbits)} speeds." if missing else ""
    return (
        f"{words}. The factor by which a ball pass changes a small disturbance, 1 and more where "
        f"the orbit is unstable: {sizes}.{rest}"
    )
