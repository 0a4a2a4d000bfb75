"""Any output over the plane of any two quantities: coarse at once, refined while one waits.

The first, coarse level follows the sliders like any other view. When the sliders rest, a job
refines it level by level. The figures are HoloViews, and made when there is something to draw in
them: the library is imported then, too, off the event loop.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn
from bokeh.models import CustomJS, LayoutDOM, Plot, Spacer

from bearing_explorer.measurement.form import number_of
from bearing_explorer.plots import style
from bearing_explorer.plots.heat_map import Places, Side, goes_there, ring_at
from bearing_explorer.plots.style import AxisQuantity
from bearing_explorer.results.explore import (
    BUDGET,
    MAP_OUTPUTS,
    SIZES,
    Job,
    MapOutput,
    Plane,
    Question,
    coarse,
    refine,
)
from bearing_explorer.results.jobs import JobState, Work
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.scene_editor import SceneEditor
from bearing_explorer.state.sentences import sentence_of
from bearing_explorer.state.value_range import Sweep, focused, value_of
from bearing_explorer.views.base import Fill, Ranges, SessionParts, Sources
from bearing_explorer.views.job_view import JobView, last_shown
from bearing_explorer.views.still_figure import editor_of
from bearing_explorer.widgets.form import FieldSpec
from bearing_explorer.widgets.plane_form import plane_fields, plane_fills, plane_sweeps

if TYPE_CHECKING:
    from bearing_explorer.plots.plane import Field
    from bearing_explorer.results.results import Results

REST = 0.2
"""[s] that sliders must rest before a map is refined."""
PAUSE = 2.0
"""Between two drawings while sliders move, in drawing times: the event loop is everybody's."""

_FIRST = {"x": "extent_deg", "y": "fy_n", "output": "k_yy_mean", "grid": "2"}
_WITH_BAND = [output.name for output in MAP_OUTPUTS.values() if output.band is not None]
_FIRST_BAND = dict(
    zip(
        ("band_from", "band_to"),
        (f"{edge / 1e3:g}" for edge in MAP_OUTPUTS["mass_share"].band or ()),
        strict=True,
    )
)
_GRIDS = [[str(stride), f"{n} × {m}"] for stride, (n, m) in SIZES.items() if stride < 16]
_FADED = 0.65


@dataclass(frozen=True)
class MapRequest:
    """A map as the form has it."""

    x: Sweep
    y: Sweep
    output: MapOutput
    stride: int
    given: Mapping[str, str] = field(default_factory=dict, compare=False)

    def of(self, results: Results) -> Question:
        """The question for the scene shown."""
        return Question(focused(results.scene, results.focus), self.x, self.y, self.output)


class _CancelWhenStale:
    """A job that also ends when its map is no longer wanted."""

    def __init__(self, job: Work, wanted: Callable[[], bool]) -> None:
        self._job, self._wanted = job, wanted
        self.progress = job.progress
        self.show = job.show

    def cancelled(self) -> bool:
        return self._job.cancelled() or not self._wanted()


class ExplorePlane(JobView[Plane]):
    """A map of one output over two quantities, with lines across it and a histogram."""

    name = "explore"
    title = "Explore a plane"
    about = (
        "Any output over any two quantities. All else is as the sliders have it. Point at the "
        "map to move the curves, click to go there; select values in the histogram to find them "
        "on it. Hatched: no answer. Ring: this scene."
    )
    needs = frozenset()
    start = "Compute the map"
    at_once = True
    bounds = f"Coarse at once, finer while you wait: at most {BUDGET / 60.0:.0f} minutes a map."

    _request: MapRequest | None = None
    _question: Question | None = None
    _refining: tuple[Question, int] | None = None
    _timer: asyncio.TimerHandle | None = None
    _at: tuple[float, float] = (0.0, 0.0)
    _news: Any = None
    _next_show = 0.0
    _fill: Fill
    _filling: asyncio.Task[None] | None = None
    _drawn: Plane | None = None  # in the figures on the page
    _making: Plane | None = None  # in figures that are being made

    def build(self, packed: PackedSource) -> Any:
        self._mark = packed.source("explore_mark", "x", "y")
        self._old = packed.source("explore_old", "left", "right", "bottom", "top", "alpha")
        # the browser must know the sources before there is a figure that draws them
        anchor = Spacer(width=0, height=0, visible=False, tags=[self._mark, self._old])
        self._figures = pn.Column(min_height=460, sizing_mode="stretch_width", margin=0)
        return pn.Column(
            self.job,
            self._figures,
            pn.pane.Bokeh(anchor, margin=0),
            sizing_mode="stretch_width",
            margin=0,
        )

    # The form

    def fields(self) -> list[FieldSpec]:
        outputs = [[output.name, output.label, output.group] for output in MAP_OUTPUTS.values()]
        return [
            {"name": "output", "label": "Map of", "options": outputs},
            *plane_fields(headings=True),
            {"name": "grid", "label": "Points", "options": _GRIDS},
            {"name": "band_from", "label": "Band from (kHz)", "only": {"output": _WITH_BAND}},
            {"name": "band_to", "label": "to (kHz)", "only": {"output": _WITH_BAND}},
        ]

    def form(self, editor: SceneEditor) -> tuple[dict[str, str], dict[str, Any]]:
        fills = plane_fills(editor.limits)
        values = {**_FIRST, **fills["x"][_FIRST["x"]], **fills["y"][_FIRST["y"]], **_FIRST_BAND}
        # loads that point down, as weights do: without a load there is nothing to map
        values["y_to"] = f"{0.05 * editor.limits['fy_n'].least:g}".replace("-", "−")
        if self._request is None:
            self._request = self.request_of(values, editor)
        return values, fills

    def request_of(self, given: Mapping[str, str], editor: SceneEditor) -> MapRequest:
        """The map of the form; ValueError with a sentence where there can be none."""
        if given["output"] not in MAP_OUTPUTS:
            raise ValueError("There is no such output.")
        if given["grid"] not in [value for value, _ in _GRIDS]:
            raise ValueError(f"A map has at most {_GRIDS[-1][1]} points.")
        x, y = plane_sweeps(given, SIZES[1], editor.limits)
        output = MAP_OUTPUTS[given["output"]]
        if output.band is not None:
            output = output.in_band(
                *(
                    1e3
                    * number_of(given.get(name, ""), f"The {end} of the band", "kHz", 0.01, 100.0)
                    for name, end in (("band_from", "beginning"), ("band_to", "end"))
                )
            )
        return MapRequest(x, y, output, int(given["grid"]), given)

    def start_job(self, given: Mapping[str, str]) -> None:
        """Ask for the map of the form; the job begins when the sliders rest."""
        try:
            self._request = self.request_of(given, self._editor)
        except ValueError as error:
            self.job.show(JobState("failed", 0.0, str(error)))
        else:
            self._refining = None
            self._draw()

    def cancel_job(self) -> None:
        self._wait_no_more()
        super().cancel_job()

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self._fill = parts.fill

    # Outside of the page

    def choices(self) -> dict[str, Any]:
        return {} if self._request is None else dict(self._request.given)

    def choose(self, choices: Mapping[str, Any], results: Results) -> None:
        editor = editor_of(results)
        self._request = request = self.request_of({**self.form(editor)[0], **choices}, editor)
        question = request.of(results)
        self.found = last_shown(lambda job: refine(job, question, request.stride))

    def still_figures(self) -> Sequence[LayoutDOM]:
        import holoviews as hv

        from bearing_explorer.plots.plane import plane as linked_figures

        assert self.found is not None
        return [hv.render(linked_figures(field_of(self.found, self._at)), backend="bokeh")]

    def end(self) -> None:
        super().end()
        self._wait_no_more()

    # The picture

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        import bearing_explorer.plots.plane  # noqa: F401 - takes a second, once, and this is not the event loop

        none = np.zeros(0)
        sources: Sources = {
            "explore_mark": {"x": none, "y": none},
            "explore_old": dict.fromkeys(("left", "right", "bottom", "top", "alpha"), none),
        }
        if self._request is None:
            return sources, {}
        question = self._request.of(results)
        scene = focused(results.scene, results.focus)
        x, y = (value_of(scene, axis.field) for axis in (question.x, question.y))
        sources["explore_mark"] = {"x": np.array([x]), "y": np.array([y])}
        if self.found is not None and self._plane(question)[0] is None:
            ends = [float(v) for s in (self.found.question.x, self.found.question.y)
                    for v in (s.values[0], s.values[-1])]  # fmt: skip
            names = ("left", "right", "bottom", "top", "alpha")
            sources["explore_old"] = {
                name: np.array([value]) for name, value in zip(names, [*ends, _FADED], strict=True)
            }
        return sources, {}

    def sentence(self, results: Results) -> str:
        if self._request is None:
            return "There is no map yet."
        question = self._request.of(results)
        plane, why = self._plane(question)
        if plane is None:
            faint = "Faint: an earlier map. " if self.found is not None else ""
            return faint + (why or "This output takes a while: the map is being computed.")
        return summary(plane)

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is None or self._request is None:
            return
        self._question = question = self._request.of(results)
        scene = focused(results.scene, results.focus)
        x, y = (value_of(scene, axis.field) for axis in (question.x, question.y))
        self._at = x, y
        plane, why = self._plane(question)
        if plane is not None and time.perf_counter() > self._next_show:
            self._show(plane)
        if self._refining == (question, self._request.stride):
            return
        self._wait_no_more()
        self._refining = None
        if why:
            self.job.show(JobState("failed", 0.0, why))
        elif self._jobs is not None:
            loop = asyncio.get_running_loop()
            self._timer = loop.call_later(REST, self._refine, question, plane)

    def table(self, results: Results) -> dict[str, np.ndarray]:
        if self.found is None:
            return {}
        found = self.found
        y, x = np.meshgrid(found.y.values, found.x.values, indexing="ij")
        question = found.question
        return {
            question.x.field.key: x,
            question.y.field.key: y,
            question.output.column: found.values,
            "no_answer_because": found.reasons,
        }

    def _plane(self, question: Question) -> tuple[Plane | None, str]:
        """The map as far as it is computed, or the reason why there can be none."""
        if self.found is not None and self.found.question == question:
            return self.found, ""
        if not question.at_once:
            return None, ""
        try:
            return coarse(question), ""
        except ValueError as error:
            return None, sentence_of(error)

    def _show(self, plane: Plane) -> None:
        """Draw a map; its figures are made anew where it is one of something else."""
        if plane is self.found:
            return
        self.found = plane
        if self._filling is not None and not self._filling.done():
            return  # its turn comes when there are figures
        if self._drawn is None or self._drawn.question.figure != plane.question.figure:
            self._filling = self._fill(self._figures, self._linked_figures, self._filled)
            return
        started = time.perf_counter()
        self._drawn = plane
        self._news.send(field_of(plane, self._at))
        now = time.perf_counter()
        self._next_show = now + PAUSE * (now - started)

    def _linked_figures(self) -> pn.viewable.Viewable:
        """Figures of the newest map; Bokeh's come with their models.

        They change nothing that is on the page yet: callbacks of the place are attached later.
        """
        import holoviews as hv
        from holoviews.plotting.util import initialize_dynamic

        from bearing_explorer.plots.plane import plane as linked_figures

        assert self.found is not None
        self._making = plane = self.found
        field = field_of(plane, self._at)
        self._news = hv.streams.Pipe(data=field)
        sides = [Side.of(sweep.field) for sweep in (plane.x, plane.y)]
        self._plots: list[Plot] = []
        self._followers: list[CustomJS] = []
        layout = linked_figures(
            field,
            news=self._news,
            mark=self._mark,
            hooks=[_Marks(sides, self._mark, self._old)],
            listen=self._followers.append,
            each=lambda plot, _: self._plots.append(plot.handles["plot"]),
            responsive=True,
        )
        initialize_dynamic(layout)  # now, and not in the turn in which the models are made
        return pn.pane.HoloViews(layout, sizing_mode="stretch_width", margin=0)

    def _filled(self) -> None:
        """The figures are on the page; there may be a newer map than theirs."""
        self._mark.js_property_callbacks = {}  # those of figures that are gone
        self._mark.js_on_change("data", *self._followers)
        self._caption.figures = [plot.id for plot in self._plots]
        self._filling, self._drawn = None, self._making
        newest, self.found = self.found, self._drawn
        if newest is not None:
            self._show(newest)

    # Refining

    def _refine(self, question: Question, start: Plane | None) -> None:
        """Start the job, if this is still the map of the form."""
        self._timer = None
        if self._jobs is None or self._request is None or question != self._question:
            return
        stride = self._request.stride
        self._refining = wanted = (question, stride)

        def work(job: Work) -> str:
            going: Job = _CancelWhenStale(job, lambda: self._refining == wanted)
            if start is not None:
                job.show(start)  # it may have been passed over while the slider moved
            try:
                return refine(going, question, stride, start)
            except ValueError as error:
                raise ValueError(sentence_of(error)) from error

        self._jobs.start(work, self._take, self.job.show)

    def _take(self, found: Plane) -> None:
        if found.question == self._question:
            self._show(found)
            self._draw()

    def _wait_no_more(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


class _Marks:
    """A hook: the ring at this scene, the veil over a map of another, and the click to go there."""

    def __init__(self, sides: list[Side], mark: Any, old: Any) -> None:
        self._sides, self._mark, self._old = sides, mark, old

    def __call__(self, plot: Any, _: Any) -> None:
        if "marks" in plot.handles:
            return
        plot.handles["marks"] = True
        figure = plot.handles["plot"]
        figure.name = "explore_map"
        figure.stylesheets = [*figure.stylesheets, ":host { cursor: crosshair; }"]
        figure.quad(
            "left", "right", "top", "bottom", source=self._old, fill_color=style.PAPER,
            fill_alpha="alpha", line_color=None, level="overlay",
        )  # fmt: skip
        for ring in ring_at(""):
            ring.add(figure, self._mark).level = "overlay"
        goes_there(figure, Places(plot.handles["source"], self._sides))


def field_of(plane: Plane, at: tuple[float, float]) -> Field:
    """A map as the figures take it, with lines drawn across it at a place."""
    from bearing_explorer.plots.plane import Field

    question = plane.question
    sides = [Side.of(sweep.field) for sweep in (plane.x, plane.y)]
    output = question.output
    words = output.label[0].upper() + output.label[1:] if output.label[0] != "k" else output.label
    value = AxisQuantity(words, "", output.unit, prefixed=output.unit not in ("", "°"))
    return Field(
        (sides[0].name, sides[0].quantity, plane.x.values),
        (sides[1].name, sides[1].quantity, plane.y.values),
        (output.name.replace(":", "_"), value),
        plane.values,
        plane.reasons,
        at,
    )


def summary(plane: Plane) -> str:
    """A sentence on a map: least and greatest value, their places, and missing points."""
    question, values = plane.question, plane.values
    words = question.output.label
    missing = ""
    if plane.missing:
        reasons = [str(why) for why in plane.reasons[np.isnan(values)]]
        common = max(set(reasons), key=reasons.count)
        points = "1 point has" if plane.missing == 1 else f"{plane.missing} points have"
        missing = f" {points} no answer, most often: {common.rstrip('.')}."
    if plane.missing == values.size:
        return (
            f"{words[0].upper()}{words[1:]}: no point of {plane.shape_words} has an answer."
            + missing
        )
    least, most = (
        np.unravel_index(int(find(values)), values.shape) for find in (np.nanargmin, np.nanargmax)
    )
    ends = f"least {_place(plane, least)}, greatest {_place(plane, most)}"
    return f"{plane.shape_words}. {words}: {ends}.{missing}"


def _place(plane: Plane, at: tuple[Any, ...]) -> str:
    output = plane.question.output
    value = float(plane.values[at])
    shown = (
        style.with_prefix(value, output.unit)
        if output.unit not in ("", "°")
        else f"{style.number(value)}{output.unit}"
    )
    where = [
        f"{sweep.field.label.lower()} {style.number(float(sweep.values[k]))}"
        + (
            sweep.field.shown_unit
            if sweep.field.shown_unit == "°"
            else f" {sweep.field.shown_unit}"
        ).rstrip()
        for sweep, k in ((plane.x, at[1]), (plane.y, at[0]))
    ]
    return f"{shown} at {' and '.join(where)}"
