"""Run time against error for the current scene; a click takes over the steps of a point."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import panel as pn
from bokeh.events import Tap
from bokeh.models import (
    ColumnDataSource,
    CustomJSHover,
    CustomJSTickFormatter,
    HoverTool,
    Range1d,
    Scatter,
)
from bokeh.plotting import figure

from bearing_explorer.plots import style
from bearing_explorer.plots.layers import (
    Glyph,
    Layer,
    Words,
    add_all,
    curve,
    draw,
    nothing,
    sources_of,
    switch,
)
from bearing_explorer.results.accuracy import TRIALS, Found, compute
from bearing_explorer.results.jobs import Work
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.scene_editor import SceneEditor
from bearing_explorer.state.settings import Settings
from bearing_explorer.views.base import Ranges, Sentence, SessionParts, Sources
from bearing_explorer.views.job_view import JobView
from bearing_explorer.widgets.form import Fields, FieldSpec, button, choices, row, select
from bearingcore.common.numbers import scientific
from bearingcore.experiments import Experiment, Point, StabilityChart
from bearingcore.experiments.balls import BALL_METHODS, BANDS
from bearingcore.experiments.integrators import METHODS
from bearingcore.experiments.models import MODELS
from bearingcore.experiments.stability import FIXED_STEP, VERDICTS
from bearingcore.experiments.statics import PLACINGS, SOLVERS

HEIGHT = 430
COSTS = ("seconds", "evaluations")
_KINDS = (METHODS, SOLVERS, PLACINGS, MODELS, BALL_METHODS)
NAMES = tuple(dict.fromkeys(name for kind in _KINDS for name in kind))
"""Every name that a point can have: the packed source carries their numbers."""
MOST_METHODS = max(len(kind) for kind in _KINDS)

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#20262D")
"""Okabe and Ito's, which colour-blind people can distinguish."""
MARKERS = {"circle": "●", "square": "■", "triangle": "▲", "diamond": "◆", "inverted_triangle": "▼",
           "plus": "✚", "star": "★"}  # fmt: skip
VERDICT_LOOKS = dict(
    zip(
        VERDICTS,
        (("#0072B2", "square"), ("#56B4E9", "inverted_triangle"), ("#E69F00", "diamond"),
         ("#D55E00", "x")),
        strict=True,
    )
)  # fmt: skip

AXES = {
    "spectrum": "Error of the spectrum (dB)",
    "stiffness": "Error of the stiffness, over the term",
    "trace": "Error of the curves, over their swing",
    next(iter(BANDS)): f"Error of third octaves, {next(iter(BANDS))} (dB)",
}
"""The error that each experiment draws."""

NEAR = 0.04
"""Part of the figure within which a click means a point."""


_ERROR = "accuracy_error"
_COLUMNS = (*COSTS, "error", "method")
_KNOWN = f"const names = {json.dumps(NAMES, ensure_ascii=False)}\n"
_FAILED_WORDS = f"""{_KNOWN}
const why = row.named == 1 ? ' failed' : ': error beyond this axis'
return row.named ? names[row.method] + why : ''
"""
_TOOLTIPS = [
    ("method", "@method{custom}"),
    ("error", "@error{custom}"),
    ("time", "@seconds{custom}"),
    ("evaluations", "@evaluations{0}"),
]
_READERS = {
    "@method": f"{_KNOWN}return names[value]",
    "@error": f"{style.JS_PREFIX}return rounded(Number(value), 2)",
    "@seconds": f"{style.JS_PREFIX}return si(Number(value), 's')",
}
_STEPS = "Steps in a period of the highest natural frequency"


def look(slot: int) -> tuple[str, str]:
    """Colour and marker; after all colours the markers change, so that no two are alike."""
    markers = list(MARKERS)
    return COLORS[slot % len(COLORS)], markers[(slot + slot // len(COLORS)) % len(markers)]


def layers(cost: str) -> list[Layer]:
    """The points of each method over one kind of cost, and crosses for those that failed."""
    drawn: list[Layer] = []
    for slot in range(MOST_METHODS):
        source, (color, marker) = f"accuracy_{slot}", look(slot)
        point = {"marker": marker, "size": 8, "fill_color": color, "line_width": 0.6}
        drawn += [
            curve(source, cost, "error", color, 1.2),
            Glyph("scatter", source, (cost, "error"), {**point, "line_color": "white"}, _COLUMNS),
        ]
    cross = {"marker": "x", "size": 10, "line_color": style.INK, "line_width": 1.8}
    down = {"angle": -0.5 * math.pi, "x_offset": 3, "y_offset": 9}
    return [
        *drawn,
        Glyph("scatter", "accuracy_failed", (cost, "error"), cross, _COLUMNS),
        Words("accuracy_failed", cost, "error", _FAILED_WORDS, ("named", "method"), look=down),
    ]


VERDICTS_AND_LIMITS = [
    *(
        Glyph(
            "scatter",
            f"accuracy_verdict_{number}",
            ("steps", "row"),
            {"marker": sign, "size": 14, "fill_color": color, "line_color": color, "line_width": 2},
        )
        for number, (color, sign) in enumerate(VERDICT_LOOKS.values())
    ),
    Glyph(
        "segment",
        "accuracy_limits",
        ("steps", "below", "steps", "above"),
        {"line_color": style.INK, "line_width": 2.5},
    ),
]
"""Layers of the chart of stability."""
_EVERY_LAYER = [*layers(COSTS[0]), *VERDICTS_AND_LIMITS]


def _log_figure(label: str, ticks: Sequence[float], *ranges: Range1d, **options: Any) -> figure:
    """A figure over a logarithmic axis."""
    nameless = style.AxisQuantity("", "", "")
    plot = style.make_figure(nameless, nameless, *ranges, x_axis_type="log", **options)
    plot.xaxis.axis_label = label
    style.fixed_ticks(plot.xaxis[0], ticks)
    return plot


def _chart(
    packed: PackedSource, cost: str, error: Range1d, sources: Mapping[str, ColumnDataSource]
) -> figure:
    """Error over one kind of cost."""
    timed = cost == "seconds"
    plot = _log_figure(
        "Time" if timed else "Evaluations",
        [m * 10.0**e for e in range(-9, 13) for m in (1, 3)],
        packed.range(f"accuracy_{cost}", *((1e-4, 1.0) if timed else (1e2, 1e6))),
        error,
        height=HEIGHT,
        name=f"accuracy_drawing_{cost}",
        y_axis_type="log",
    )
    plot.stylesheets = [
        ":host { cursor: crosshair; }"
        ".bk-events.bk-events:focus { outline: none; }"  # it is clicked, not typed into
    ]
    plot.yaxis.axis_label = "Error"
    plot.xaxis.formatter = style.logarithmic_ticks("s" if timed else "", plot)
    plot.yaxis.formatter = style.logarithmic_ticks()
    drawn = add_all(plot, sources, layers(cost))
    plot.add_tools(
        HoverTool(
            renderers=[one for one in drawn if isinstance(one.glyph, Scatter)],
            visible=False,  # no button: it is always on
            tooltips=_TOOLTIPS,
            formatters={field: CustomJSHover(code=code) for field, code in _READERS.items()},
        )
    )
    return plot


def _verdicts(packed: PackedSource) -> figure:
    """Methods down, steps across."""
    plot = _log_figure(
        _STEPS,
        [1, 2, 5, 10, 20, 50],
        packed.range("accuracy_steps", 0.8, 80.0),
        Range1d(-0.6, len(FIXED_STEP) - 0.4),
        height=300,
        name="accuracy_drawing_stability",
    )
    plot.yaxis.axis_label = None
    plot.xaxis.formatter = style.logarithmic_ticks()
    style.fixed_ticks(plot.yaxis[0], range(len(FIXED_STEP)))
    names = json.dumps(FIXED_STEP, ensure_ascii=False)
    plot.yaxis.formatter = CustomJSTickFormatter(code=f"return {names}[tick] ?? ''")
    draw(plot, packed, VERDICTS_AND_LIMITS)
    return plot


class Accuracy(JobView[Found]):
    """Error against cost, and where steps are too long."""

    name = "accuracy"
    title = "Speed against accuracy"
    about = (
        "Run time against error for each method. Low is exact, left is cheap. Each is "
        "compared with a reference on this scene that two families of methods agree on. Crosses "
        "on the upper edge failed. Click a point of “RK4” to march the scene's motion with its "
        "steps."
    )
    needs = frozenset()
    start = "Measure"
    bounds = (
        "A short motion or few cage angles, usually done within half a minute. scipy's DOP853, "
        "Radau and BDF are left out here, as they take longer than all others together."
    )

    take_steps: Callable[[float | None], None] | None = None
    """Marches the scene's motions with a step rate [Hz], or None: with the program's own."""
    _note = ""

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self.take_steps = parts.take_steps
        for cost, plot in zip(COSTS, self._plots, strict=True):
            plot.on_event(Tap, partial(self._clicked, cost))

    def build(self, packed: PackedSource) -> Any:
        error = packed.range("accuracy_error", 1e-6, 10.0)
        sources = sources_of(packed, [layer for cost in COSTS for layer in layers(cost)])
        self._plots = [_chart(packed, cost, error, sources) for cost in COSTS]
        costs = switch(["Cost as time", "Cost as evaluations"], self._plots)
        whole = {"sizing_mode": "stretch_width", "margin": 0}
        self._work = pn.Column(costs, *self._plots, **whole)
        self._stability = pn.Column(_verdicts(packed), visible=False, **whole)
        self._legend = pn.pane.HTML("", **whole)
        steps = self._step_controls()
        return pn.Column(self.job, self._work, self._stability, self._legend, steps, **whole)

    # The job

    def fields(self) -> list[FieldSpec]:
        options = [[name, trial.label] for name, trial in TRIALS.items()]
        return [{"name": "experiment", "label": "What to measure", "options": options}]

    def form(self, editor: SceneEditor) -> tuple[dict[str, str], dict[str, Any]]:
        return {"experiment": next(iter(TRIALS))}, {}

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        name, scene = given["experiment"], editor.scene
        if name not in TRIALS:
            raise ValueError("There is no such experiment.")
        return lambda job: compute(job, scene, name)

    def _take(self, found: Found) -> None:
        self._note = ""
        super()._take(found)

    # Steps taken over. What comes from the browser is not to be trusted.

    def offered(self) -> dict[str, float]:
        """Step rates [Hz] that were measured and can be used, by their text."""
        if self.found is None or not isinstance(self.found.result, Experiment):
            return {}
        usable = [p for p in self.found.result.points if _usable(p)]
        return {f"{p.value:.0f}": p.value for p in sorted(usable, key=lambda p: p.value)}

    def _step_controls(self) -> pn.Row:
        self._steps = Fields(self._step_chosen)
        self._steps.add("steps", select("Steps of the scene's motion", [["", "automatic"]]))
        self._reset = button("Reset", lambda: self._use(None), disabled=True)
        self._step_words = Sentence(margin=0, sizing_mode="stretch_width")
        return row(self._steps.widgets["steps"], self._reset, self._step_words)

    def _step_chosen(self, _: str) -> None:
        self._use(self.offered().get(self._steps.values["steps"]))

    def _clicked(self, cost: str, event: Any) -> None:
        self._tapped(cost, event.x, event.y)

    def _tapped(self, cost: str, x: Any, y: Any) -> None:
        point = self.nearest(cost, x, y)
        if point is None:
            return
        if _usable(point):
            self._use(point.value)
        else:
            self._note = (
                f"{point.method}, {point.setting}, is for comparison only: the scene's motion is "
                "marched with RK4, so click one of its points."
            )
            self._step_words.text = self._note

    def nearest(self, cost: str, x: Any, y: Any) -> Point | None:
        """The drawn point that a click at x, y means, if there is one near."""
        if not all(isinstance(v, int | float) and math.isfinite(v) and v > 0.0 for v in (x, y)):
            return None
        if self.found is None or not isinstance(result := self.found.result, Experiment):
            return None
        shown = chart_ranges(result)
        wide, high = (math.log(b / a) for a, b in (shown[f"accuracy_{cost}"], shown[_ERROR]))

        def distance(point: Point) -> float:
            """Share of the figure between the click and a point."""
            at = getattr(point, cost), drawn_error(result, point)
            if not all(v > 0.0 and math.isfinite(v) for v in at):
                return math.inf
            return math.hypot(math.log(at[0] / x) / wide, math.log(at[1] / y) / high)

        nearest = min(result.points, key=distance)
        return nearest if distance(nearest) < NEAR else None

    def _use(self, step_rate: float | None) -> None:
        self._note = ""
        if self.take_steps is not None:
            self.take_steps(step_rate)

    # The picture

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        sources = nothing(_EVERY_LAYER)
        if self.found is None:
            return sources, {}
        result = self.found.result
        if isinstance(result, StabilityChart):
            return sources | _stability_sources(result), {
                "accuracy_steps": _around([t.step_rate / result.highest_frequency
                                           for t in result.trials], 1.25)
            }  # fmt: skip
        ranges = chart_ranges(result)
        bottom, top = ranges[_ERROR]
        good = [p for p in result.points if math.isfinite(drawn_error(result, p))]
        for slot, method in enumerate(result.methods):
            own = [p for p in good if p.method == method]
            errors = [max(drawn_error(result, p), bottom) for p in own]
            sources[f"accuracy_{slot}"] = _columns(own, errors)
        lost = [p for p in result.points if p not in good]
        at_right = {cost: ranges[f"accuracy_{cost}"][1] / 1.2 for cost in COSTS}
        columns = _columns(lost, [top / 1.5] * len(lost))
        for cost in COSTS:
            known = np.isfinite(columns[cost]) & (columns[cost] > 0.0)
            columns[cost] = np.where(known, columns[cost], at_right[cost])
        _, first = np.unique(columns["method"], return_index=True)
        columns["named"] = np.zeros(len(lost))
        columns["named"][first] = [1.0 if lost[k].failed else 2.0 for k in first]
        sources["accuracy_failed"] = columns
        return sources, ranges

    def sentence(self, results: Results) -> str:
        if self.found is None:
            return "Nothing is measured yet."
        result = self.found.result
        words = _chart_words(result) if isinstance(result, StabilityChart) else _work_words(result)
        if not result.completed:
            words += " Cancelled before its end."
        if results.scene != self.found.scene:
            words = f"The scene has changed since this was measured. Then: {words}"
        return words

    def columns(self, found: Found) -> dict[str, np.ndarray]:
        return found.result.table().named()

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        result = None if self.found is None else self.found.result
        charted = isinstance(result, StabilityChart)
        if self._stability.visible != charted:
            self._stability.visible, self._work.visible = charted, not charted
        if isinstance(result, Experiment):
            label = AXES[_drawn(result)]
            for plot in self._plots:
                plot.yaxis.axis_label = label
            self._plots[1].xaxis.axis_label = result.evaluations.capitalize()
        self._legend.object = legend(result)
        settings = Settings() if results is None else results.settings
        self._show_steps(settings.step_rate)

    def _show_steps(self, step_rate: float | None) -> None:
        chosen = "" if step_rate is None else f"{step_rate:.0f}"
        rates = list(dict.fromkeys([*self.offered(), *([chosen] if chosen else [])]))
        options = [["", "automatic"], *([text, f"RK4, {text} Hz"] for text in rates)]
        self._steps.values["steps"] = chosen
        self._steps.widgets["steps"].param.update(**choices(options), value=chosen)
        self._reset.disabled = not chosen
        note = "The program chooses the steps of the scene's motion."
        if step_rate is not None:
            note = f"Chosen steps: {step_rate:.0f} Hz."
        self._step_words.text = self._note or note


def _usable(point: Point) -> bool:
    """True where the scene's motion can be computed with the steps of a point."""
    return point.method == "RK4" and "step_rate" in point.settings and not point.failed


def _said(name: str) -> str:
    """An error's name in a sentence."""
    return f"power in third octaves of {name}" if name in BANDS else name


def _drawn(result: Experiment) -> str:
    """The name of the error that is drawn."""
    return next(iter(result.errors))


def drawn_error(result: Experiment, point: Point) -> float:
    """The error at which a point is drawn; NaN at the edge of the figure."""
    error = point.errors.get(_drawn(result), math.nan)
    return error if not point.failed and math.isfinite(error) else math.nan


def _around(values: list[float], room: float) -> tuple[float, float]:
    known = [v for v in values if v > 0.0 and math.isfinite(v)] or [1.0]
    return min(known) / room, max(known) * room


def chart_ranges(result: Experiment) -> Ranges:
    """Ranges that hold every point, with an edge above for those that failed."""
    low, high = _around([drawn_error(result, p) for p in result.points], 2.0)
    ranges: Ranges = {_ERROR: (low, high * 8.0)}
    for cost in COSTS:
        ranges[f"accuracy_{cost}"] = _around([getattr(p, cost) for p in result.points], 1.6)
    return ranges


def _columns(points: list[Point], errors: list[float]) -> dict[str, np.ndarray]:
    return {
        "seconds": np.array([p.seconds for p in points], dtype=float),
        "evaluations": np.array([p.evaluations for p in points], dtype=float),
        "error": np.array(errors, dtype=float),
        "method": np.array([NAMES.index(p.method) for p in points], dtype=float),
    }


def _stability_sources(chart: StabilityChart) -> Sources:
    sources: Sources = {}
    for number, verdict in enumerate(VERDICTS):
        found = [t for t in chart.trials if t.verdict == verdict]
        sources[f"accuracy_verdict_{number}"] = {
            "steps": np.array([t.step_rate / chart.highest_frequency for t in found], dtype=float),
            "row": np.array([FIXED_STEP.index(t.method) for t in found], dtype=float),
        }
    limits = {row: chart.linear_limit[name] for row, name in enumerate(FIXED_STEP)}
    rows = np.array([r for r, limit in limits.items() if 0.0 < limit < math.inf], dtype=float)
    steps = np.array([limits[int(r)] / chart.highest_frequency for r in rows], dtype=float)
    sources["accuracy_limits"] = {"steps": steps, "below": rows - 0.42, "above": rows + 0.42}
    return sources


def _agreement(result: Experiment | StabilityChart) -> str:
    """The references, and their worst disagreement."""
    name = _drawn(result) if isinstance(result, Experiment) else "spectrum"
    references = (
        list(result.references.values()) if isinstance(result, Experiment) else [result.reference]
    )
    worst = max(references, key=lambda r: (not r.trusted, r.agreement[name]))
    unit = _unit(result, name)
    apart = f"{scientific(worst.agreement[name])}{unit} in {_said(name)}"
    families = ", ".join(worst.families)
    words = f"Two independent references ({families}) differ by {apart}"
    words += "." if worst.trusted else ", so smaller errors mean little."
    return f"{words} {worst.note}." if worst.note else words


def _unit(result: Experiment | StabilityChart, error: str) -> str:
    """The unit of an error behind its number; charts of stability compare spectra."""
    unit = result.unit(error) if isinstance(result, Experiment) else "dB"
    return " dB" if unit == "dB" else ""


def _short(error: float) -> str:
    """An error for a sentence: in powers of ten where it is small."""
    return style.number(error, 2) if 0.01 <= error < 1000.0 else scientific(error)


def _work_words(result: Experiment) -> str:
    words = f"{result.title}. "
    if frontier := result.frontier():
        first, last = frontier[0], frontier[-1]
        unit = _unit(result, _drawn(result))
        words += ". ".join(
            f"{kind}: {p.method} with {p.setting} "
            f"({style.with_prefix(p.seconds, 's')}, error {_short(drawn_error(result, p))}"
            f"{unit})"
            for kind, p in (("Fastest", first), ("Most accurate", last))
        )
        words += ". "
    failed = {p.method: p.status for p in result.points if p.failed}
    if failed:
        words += "; ".join(f"{name} {status}" for name, status in failed.items()) + ". "
    return words + _agreement(result)


def _chart_words(chart: StabilityChart) -> str:
    words = []
    for name in dict.fromkeys(t.method for t in chart.trials):
        found, limit = (v / chart.highest_frequency
                        for v in (chart.found_limit(name), chart.linear_limit[name]))  # fmt: skip
        expected = "never" if limit == 0.0 else f"below {style.number(limit, 2)}"
        first = min(t.step_rate for t in chart.trials if t.method == name)
        met = "at any tried" if not math.isfinite(found) else (
            "never" if found * chart.highest_frequency <= first * 1.000001
            else f"below {style.number(found, 2)}"
        )  # fmt: skip
        words.append(f"{name} {met} (expected: {expected})")
    frequency = style.with_prefix(chart.highest_frequency, "Hz")
    return (
        f"In steps a period of {frequency}, the motion diverges with {', '.join(words)}. "
        + _agreement(chart)
    )


def legend(result: Experiment | StabilityChart | None) -> str:
    """The legend as HTML; methods that failed with their reason."""
    items: list[tuple[str, str, str]] = []
    if isinstance(result, StabilityChart):
        signs = {"square": "■", "inverted_triangle": "▼", "diamond": "◆", "x": "✕"}
        items = [(c, signs[marker], verdict) for verdict, (c, marker) in VERDICT_LOOKS.items()]
        items.append((style.INK, "┃", "linear limit: stable to the right"))
    elif result is not None:
        for slot, method in enumerate(result.methods):
            color, marker = look(slot)
            why = next((p.status for p in result.of(method) if p.failed), "")
            items.append((color, MARKERS[marker], f"{method}: {why}" if why else method))
    return style.legend(items)
