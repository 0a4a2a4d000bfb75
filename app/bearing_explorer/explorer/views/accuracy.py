"""Speed against accuracy: a chart for each reference, and where steps and orbits are unstable."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Mapping
from typing import Any

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
from bearing_explorer.explorer.views.stability_charts import (
    StabilityPicture,
    orbit_marks,
    step_marks,
)
from bearing_explorer.explorer.views.work_precision import (
    WorkPrecision,
    details,
    paragraph,
    prose,
    verdict,
)
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import SessionParts, figures_in
from bearing_explorer.kit.widgets.form import Fields, FieldSpec, choices, row, select, stack
from bearingcore import presets
from bearingcore.experiments import (
    HARD_CASES,
    MOTION_ERRORS,
    STATIC_ERRORS,
    Experiment,
    Measurements,
)
from bearingcore.scene import WITH_MASS, preset_labels

MOTION, STATICS, STABILITY_CHARTS = "Motion", "Statics", "Stability"
CHARTS = {MOTION: ("motion", ("",)), STATICS: ("statics", ("", *HARD_CASES))}
"""The experiment of each subject, and the references in it: a chart for each."""
SECTIONS = (*CHARTS, STABILITY_CHARTS)
"""Subjects to choose from, of which the page shows one."""
ERRORS = {MOTION: tuple(MOTION_ERRORS), STATICS: tuple(STATIC_ERRORS)}
"""Errors that can be drawn, by subject."""

_CONTROLS = """
:host { flex-wrap: wrap; gap: 6px 14px; }
:host > * { align-self: start !important; }
.job { flex: 1 1 330px !important; margin: 0 !important; }
"""
COSTS = [["seconds", "time"], ["evaluations", "evaluations"]]


_GRID = """
:host { display: grid; gap: 14px 26px;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 360px), 1fr)); }
"""
"""Style of charts side by side."""


class Accuracy(SceneJobView[Found]):
    """Error against cost, where steps are too long, and where the orbit is unstable."""

    name = "accuracy"
    title = "Speed against accuracy"
    about = (
        "Error against cost: low is exact, left is cheap. Each point is a method at one "
        "setting, steps a second or a tolerance, compared with two independent solvers at 10⁻¹³. "
        "The ring is in use. The grey line joins points that no other beats in both, the dotted "
        "ones have the order of convergence that theory gives. Crosses on the upper edge failed; "
        "point at one for the reason. RK4 is compiled as a whole; SciPy and CVODE call compiled "
        "right-hand sides from Python, so their evaluations say more about the method than time "
        "does."
    )
    start = "Measure on this machine"
    bounds = "Points come one by one; SciPy's DOP853, Radau and BDF take too long here."
    computes = False
    sentence_looks = ("unseen",)

    @property
    def is_empty(self) -> bool:
        return False

    def build(self, packed: PackedSource) -> Any:
        self._chosen = Fields(lambda _: self._redraw())
        for name, label, options in (
            ("charts", "Charts of", [[name, name] for name in SECTIONS]),
            ("error", "Error of", [[name, name] for name in ERRORS[MOTION]]),
            ("cost", "Cost as", COSTS),
        ):
            self._chosen.add(name, select(label, options))
        self._origin, self._foot = prose(), prose()
        self._charts = {
            heading: [(case, WorkPrecision(case)) for case in cases]
            for heading, (_, cases) in CHARTS.items()
        }
        self._orbits = StabilityPicture(
            "Periodic motion: growth of a disturbance with each ball pass",
            "Shaft speed",
            "Largest growth factor",
        )
        self._steps = StabilityPicture(
            "Fixed steps: amplitude of the vibration",
            "Steps per second",
            "Amplitude over the right one",
        )
        panels = {
            heading: [chart.panel for _, chart in made] for heading, made in self._charts.items()
        }
        both = stack(self._orbits.panel, self._steps.panel, stylesheets=[_GRID])
        self._sections = {
            STABILITY_CHARTS: (both, stack()),
            **{
                name: (first, stack(*more, stylesheets=[_GRID]))
                for name, (first, *more) in panels.items()
            },
        }
        first, more = zip(*self._sections.values(), strict=True)
        self._first, self._more = stack(*first), stack(*more)
        controls = row(*self._chosen.widgets.values(), self.job, stylesheets=[_CONTROLS])
        return [self._first, controls, self._origin, self._more, self._foot]

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self._turn_to(self._chosen.values["charts"])

    def _turn_to(self, heading: str) -> None:
        """Leave the browser one section alone: it takes long to build them all."""
        first, more = self._sections[heading]
        if heading in ERRORS and self._chosen.values["error"] not in ERRORS[heading]:
            options = choices([[name, name] for name in ERRORS[heading]])
            self._chosen.values["error"] = error = ERRORS[heading][0]
            self._chosen.widgets["error"].param.update(**options, value=error)
        for name in ("error", "cost"):
            self._chosen.widgets[name].visible = heading in ERRORS
        if list(self._first) != [first]:
            self._first.objects, self._more.objects = [first], [more]
            panes = [pane for part in (first, more) for pane in part.select(pn.pane.Bokeh)]
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
        drawn = (heading for heading, (name, _) in CHARTS.items() if name == measured)
        if measured != EVERYTHING:
            self._chosen.put({"charts": next(drawn, STABILITY_CHARTS)})
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
        words = f"Measured beforehand, for {preset_labels[preset]}."
        if presets[preset] != scene:
            words = (
                f"The points were measured beforehand, for {preset_labels[preset]} as it comes; "
                "“Measure on this machine” takes this scene."
            )
        if found is not None:
            words = f"Measured on this machine: {found.result.count} points. {words}"
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
        cost, error = self._chosen.values["cost"], self._chosen.values["error"]
        heading = self._chosen.values["charts"]
        shown = self._shown(results)
        name, _ = CHARTS.get(heading, ("", ()))
        parts = shown[name].per_reference() if name in shown else {}
        for case, chart in self._charts.get(heading, ()):
            part = parts.get(case)
            has_points = part is not None and part.points
            chart.draw(part if has_points else None, error, cost, reasons.get(name, ""))
        if heading == STABILITY_CHARTS:
            known = [found for found in (own, base) if found is not None]
            steps = next((found.stability for found in known if found.stability is not None), None)
            orbits = next((found.orbits for found in known if found.orbits), ())
            points = shown["motion"].points if "motion" in shown else ()
            in_use = next((point.value for point in points if point.in_use), math.nan)
            self._orbits.show(orbit_marks(orbits, results.scene.shaft_speed))
            self._steps.show(step_marks(steps, in_use))
            self._caption.put(line="Crosses failed: point at one for the reason.")
        self._caption.put(title=self.title_of(results))
        words = "".join(details(part, error) for part in parts.values() if part.points)
        self._foot.object = foot(words, own, base, shown)

    def title_of(self, results: Results) -> str:
        """The verdict on the chart that is shown."""
        chosen = self._chosen.values
        if chosen["charts"] not in CHARTS:
            return "Where methods fail: unstable speeds, and steps that are too long"
        name, (case, *_) = CHARTS[chosen["charts"]]
        one = self._shown(results).get(name)
        part = None if one is None else one.per_reference().get(case)
        if part is None or not part.points:
            return self.title
        return verdict(part, chosen["error"], chosen["cost"])


def foot(
    words: str, own: Measurements | None, base: Measurements, shown: Mapping[str, Experiment]
) -> str:
    """The words on the charts, methods left out and machines, as HTML that opens on a click."""
    left = "".join(
        f"<li>{html.escape(name.capitalize())}: {html.escape(one.left_out)}.</li>"
        for name, one in shown.items()
        if one.left_out
    )
    words += f"<p>Left out:</p><ul>{left}</ul>" if left else ""
    for kind, found in (("Measured beforehand", base), ("This machine", own)):
        if found is not None:
            words += f"<p>{kind}: {html.escape(found.machine.sentence)}</p>"
    return f"<details><summary>Orders, failures, references, machines</summary>{words}</details>"
