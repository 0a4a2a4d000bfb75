"""Speed against accuracy: a chart for each reference, and where steps and orbits are unstable."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import panel as pn
from bokeh.models import Plot

from bearing_explorer.explorer.results import accuracy
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views import stability_charts, work_precision
from bearing_explorer.explorer.views.scene_job_view import SceneJobView
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import SessionParts, figures_in
from bearing_explorer.kit.widgets.form import Fields, choices, row, select, stack
from bearingcore import presets
from bearingcore.model import experiments
from bearingcore.model.scene import WITH_MASS, preset_labels

CHARTS = {"motion": ("",), "statics": ("", *experiments.HARD_CASES)}
"""References of each experiment, by which its errors are counted: a chart for each."""
ERRORS = {"motion": tuple(experiments.MOTION_ERRORS), "statics": tuple(experiments.STATIC_ERRORS)}
"""Errors that can be drawn, by experiment."""

_CONTROLS = """
:host { flex-wrap: wrap; gap: 6px 14px; }
:host > * { align-self: start !important; }
.job { flex: 1 1 330px !important; margin: 0 !important; padding-top: 20px; }
"""
COSTS = [["seconds", "time"], ["evaluations", "evaluations"]]


_GRID = """
:host { display: grid; gap: 14px 26px;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 360px), 1fr)); }
"""
"""Style of charts side by side."""


class Accuracy(SceneJobView[accuracy.SceneMeasurements]):
    """Charts of error against cost, of steps that are too long, and of unstable orbits."""

    name = "accuracy"
    title = "Speed against accuracy"
    about = (
        "Error against cost, so low is exact and left is cheap. Each point is a method at one "
        "setting, steps a second or a tolerance, compared with two independent solvers at 10⁻¹³. "
        "Ring: in use. “Twice as many steps” under “Simpler models of this scene” is the error "
        "that remains on the page. The grey line joins the points that no other beats in both "
        "error and cost. Crosses on the upper edge failed; point at one for the reason. RK4 is "
        "compiled as a whole; SciPy and CVODE call compiled right-hand sides from Python, so their "
        "evaluations say more about the method than time does."
    )
    start = "Measure on this machine"
    bounds = "Measures what is shown, without SciPy's DOP853, Radau and BDF, which are slow."
    computes = False
    sentence_looks = ("unseen",)

    @property
    def is_empty(self) -> bool:
        return False

    def build(self, packed: PackedSource) -> Any:
        self._chosen = Fields(lambda _: self._redraw())
        for name, label, options in (
            ("charts", "Charts of", accuracy.SUBJECTS.items()),
            ("error", "Error of", ((name, name) for name in ERRORS["motion"])),
            ("cost", "Cost as", COSTS),
        ):
            self._chosen.add(name, select(label, [list(option) for option in options]))
        self._origin, self._foot = work_precision.prose(), work_precision.prose()
        self._charts = {
            name: {case: work_precision.WorkPrecision(case) for case in cases}
            for name, cases in CHARTS.items()
        }
        self._orbits = stability_charts.StabilityPicture(
            "Periodic motion: growth of a disturbance with each ball pass",
            "Shaft speed",
            "Largest growth factor",
        )
        self._steps = stability_charts.StabilityPicture(
            "Fixed steps: amplitude of the vibration",
            "Steps per second",
            "Amplitude over the right one",
        )
        self._sections = {
            name: (cases[""].panel, side_by_side(c.panel for case, c in cases.items() if case))
            for name, cases in self._charts.items()
        }
        both = side_by_side((self._orbits.panel, self._steps.panel))
        self._sections[experiments.STABILITY] = both, stack()
        first, more = zip(*self._sections.values(), strict=True)
        self._first, self._more = stack(*first), stack(*more)
        controls = row(*self._chosen.widgets.values(), self.job, stylesheets=[_CONTROLS])
        return [self._first, controls, self._origin, self._more, self._foot]

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self._show_section(self._subject)

    @property
    def _subject(self) -> str:
        """Name of the experiment on screen."""
        return str(self._chosen.values["charts"])

    def still_figures(self) -> list[Plot]:
        parts = self._sections[self._subject]
        panes = [pane for part in parts for pane in part.select(pn.pane.Bokeh)]
        return [plot for pane in panes for plot in figures_in(pane.object)]

    def _show_section(self, subject: str) -> None:
        """Show one section only, because the browser would take long to build them all."""
        first, more = self._sections[subject]
        for name in ("error", "cost"):
            self._chosen.widgets[name].visible = subject in ERRORS
        if list(self._first) != [first]:
            self._first.objects, self._more.objects = [first], [more]
            self._caption.put(figures=[plot.id for plot in self.still_figures()])

    # The job

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        name, scene = given["experiment"], editor.scene
        return lambda job: accuracy.compute(job, scene, name)

    def begin(self, given: Mapping[str, str]) -> None:
        super().begin({"experiment": self._subject})

    # The picture

    def _shown(self, results: Results) -> Mapping[str, experiments.Experiment]:
        """The experiments on screen: from this machine, or else measured beforehand."""
        base = accuracy.shipped(accuracy.preset_like(results.scene))
        measured = {} if self.job_result is None else self.job_result.result.experiments
        return {**base.experiments, **measured}

    def sentence(self, results: Results) -> str:
        shown, scene = self.job_result, results.scene
        preset = accuracy.preset_like(scene)
        words = f"Measured beforehand, for {preset_labels[preset]}."
        if presets[preset] != scene:
            words = (
                f"The points were measured beforehand, for {preset_labels[preset]} as it comes; "
                "“Measure on this machine” takes this scene."
            )
        if shown is not None:
            words = f"Measured on this machine: {shown.result.count} points. {words}"
            if shown.scene != scene:
                words += " The scene has changed since it was measured."
        if scene.balls == WITH_MASS:
            words += " Balls are massless in all charts."
        return words

    def table(self, results: Results) -> dict[str, np.ndarray]:
        base = accuracy.shipped(accuracy.preset_like(results.scene))
        shown = base if self.job_result is None else self.job_result.result
        return shown.table().named()

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        self._origin.object = work_precision.paragraph(sentence)
        if self.parts is None and self.job_result is not None:  # outside of the page
            measured = self.job_result.result.experiments
            self._chosen.put({"charts": next(iter(measured), experiments.STABILITY)})
        self._redraw()

    def _redraw(self) -> None:
        errors = ERRORS.get(self._subject, ())
        if errors and self._chosen.values["error"] not in errors:
            self._chosen.values["error"] = errors[0]
            options = choices([[name, name] for name in errors])
            self._chosen.widgets["error"].param.update(**options, value=errors[0])
        if self.parts is not None:
            self._show_section(self._subject)
        if self._results is not None:
            self._draw_charts(self._results)

    def _draw_charts(self, results: Results) -> None:
        preset, subject = accuracy.preset_like(results.scene), self._subject
        base = accuracy.shipped(preset)
        known = [base] if self.job_result is None else [self.job_result.result, base]
        reasons = {
            **(base.refused if presets[preset] == results.scene else {}),
            **(known[0].refused if self.job_result is not None else {}),
        }
        error, cost = self._chosen.values["error"], self._chosen.values["cost"]
        steps = next((results.stability for results in known if results.stability), None)
        fails = ""
        if subject == "motion":
            fails = f"{stability_charts.steps_sentence(steps)} See Charts of: Stability."
        shown = self._shown(results)
        parts = shown[subject].per_reference() if subject in shown else {}
        for case, chart in self._charts.get(subject, {}).items():
            chart.draw(parts.get(case), error, cost, reasons.get(subject, ""), fails)
        if subject == experiments.STABILITY:
            orbits = next((results.orbits for results in known if results.orbits), ())
            points = shown["motion"].points if "motion" in shown else ()
            in_use = next((point.value for point in points if point.in_use), math.nan)
            self._orbits.show(*stability_charts.orbit_marks(orbits, results.scene.shaft_speed))
            self._steps.show(*stability_charts.step_marks(steps, in_use))
            self._caption.put(line="Crosses failed: point at one for the reason.")
        self._caption.put(title=self.title_of(results))
        words = "".join(
            work_precision.details(part, error) for part in parts.values() if part.points
        )
        self._foot.object = foot(words, known, shown)

    def title_of(self, results: Results) -> str:
        """The verdict on the chart on screen."""
        if self._subject == experiments.STABILITY:
            return "Where methods fail: unstable speeds, and steps that are too long"
        experiment = self._shown(results).get(self._subject)
        part = None if experiment is None else experiment.per_reference().get("")
        if part is None or not part.points:
            return self.title
        return work_precision.verdict(
            part, self._chosen.values["error"], self._chosen.values["cost"]
        )


def side_by_side(panels: Iterable[pn.Column]) -> pn.Column:
    """Arrange charts in as many columns as there is room for."""
    return stack(*panels, stylesheets=[_GRID])


def foot(
    words: str,
    known: Sequence[experiments.Measurements],
    shown: Mapping[str, experiments.Experiment],
) -> str:
    """HTML that opens on a click: words on the charts, methods left out, and machines."""
    left = "".join(
        f"<li>{html.escape(name.capitalize())}: {html.escape(experiment.left_out)}.</li>"
        for name, experiment in shown.items()
        if experiment.left_out
    )
    words += f"<p>Left out:</p><ul>{left}</ul>" if left else ""
    for kind, results in zip(("Measured beforehand", "This machine"), known[::-1], strict=False):
        words += f"<p>{kind}: {html.escape(results.machine.sentence)}</p>"
    return f"<details><summary>Orders, failures, references, machines</summary>{words}</details>"
