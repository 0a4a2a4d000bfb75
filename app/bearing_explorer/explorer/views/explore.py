"""Map of any output over two quantities: coarse at once, then refined.

The first, coarse level follows the sliders like any other view. When the sliders rest, a job
refines it level by level.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn

from bearing_explorer.explorer.results import explore
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.value_range import (
    SWEEPABLE,
    Sweep,
    focus_first,
    sweep,
    usual_range,
    value_of,
)
from bearing_explorer.explorer.views.scene_job_view import SceneJobView
from bearing_explorer.kit.compute.jobs import COMPUTATION, Jobs, JobState
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.heat_map import Side
from bearing_explorer.kit.sentences import sentence_of, with_unit
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.job_view import last_shown
from bearing_explorer.kit.widgets.form import FieldSpec, stack

if TYPE_CHECKING:
    from bearing_explorer.explorer.plots.plane import Field

_FIRST = {"x": "extent_deg", "y": "fy_n", "output": "k_yy_mean", "grid": "2"}
_GRIDS = [[str(stride), f"{n} × {m}"] for stride, (n, m) in explore.SIZES.items() if stride < 16]
_FADED = 0.35
SIDES = {"x": "Horizontal axis", "y": "Vertical axis"}
"""Sides of a map."""


@dataclass(frozen=True)
class MapRequest:
    """The map that the form describes; `given` are the texts of its fields."""

    x: Sweep
    y: Sweep
    output: explore.MapOutput
    stride: int
    given: Mapping[str, str] = field(default_factory=dict, compare=False)

    def of(self, results: Results) -> explore.Question:
        """The question of this map for a scene."""
        return explore.Question(
            focus_first(results.scene, results.focus), self.x, self.y, self.output
        )


class ExplorePlane(SceneJobView[explore.Plane]):
    """A map of one output over two quantities, with lines across it."""

    name = "explore"
    title = "Map of an output over two quantities"
    about = (
        "Any output over any two quantities. The sliders set everything else. Hatched: no answer. "
        "Ring: this scene. Point at the map to move the curves, click to go there."
    )
    start = "Compute the map"
    noun = "map"
    at_once = True
    longest = COMPUTATION.longest / 60.0
    bounds = f"Coarse at once, finer while you wait: at most {longest:.0f} minutes a map."

    _request: MapRequest | None = None
    _question: explore.Question | None = None
    _refining: tuple[explore.Question, int] | None = None

    def build(self, packed: PackedSource) -> Any:
        # HoloViews takes long to import: not when the page starts
        from bearing_explorer.explorer.plots.plane import PlaneFigures

        self._plane = PlaneFigures("explore", self._go)
        panes = [pn.pane.HoloViews(plot, margin=0) for plot in self._plane.plots]
        maps = stack(*panes, stylesheets=[style.SIDE_BY_SIDE])
        return [self.only_with_numbers(maps), self.job]

    @property
    def is_empty(self) -> bool:
        """True before the first map, and if no point of it has an answer."""
        return self.job_result is None or self.job_result.missing == self.job_result.values.size

    # The form

    def fields(self) -> list[FieldSpec]:
        outputs = [
            [output.name, output.label, output.group] for output in explore.MAP_OUTPUTS.values()
        ]
        quantities = [
            [q.key, f"{q.read_label} ({q.shown_unit})" if q.shown_unit else q.read_label, q.group]
            for q in SWEEPABLE.values()
        ]
        sides: list[FieldSpec] = []
        for side, words in SIDES.items():
            sides += [
                {"name": side, "label": words, "options": quantities},
                {"name": f"{side}_from", "label": "from"},
                {"name": f"{side}_to", "label": "to"},
            ]
        return [
            {"name": "output", "label": "What to draw", "options": outputs},
            *sides,
            {"name": "grid", "label": "Fineness", "options": _GRIDS},
        ]

    def form(self, editor: SceneEditor) -> tuple[dict[str, str], dict[str, Any]]:
        usual = {
            name: [f"{v:g}".replace("-", "−") for v in usual_range(name, editor.limits)]
            for name in SWEEPABLE
        }
        fills = {  # a side -> the quantity chosen there -> fields
            side: {
                name: {f"{side}_from": low, f"{side}_to": high}
                for name, (low, high) in usual.items()
            }
            for side in SIDES
        }
        values = {**_FIRST, **fills["x"][_FIRST["x"]], **fills["y"][_FIRST["y"]]}
        # loads that point down, as weights do, and not 0: without a load there is nothing to map
        values["y_from"] = f"{-0.05 * editor.limits['fy_n'].least:g}"
        if self._request is None:
            self._request = self.request_of(values, editor)
        return values, fills

    def request_of(self, given: Mapping[str, str], editor: SceneEditor) -> MapRequest:
        """The map that the form describes; ValueError with a sentence if it is impossible."""
        if given["output"] not in explore.MAP_OUTPUTS:
            raise ValueError("There is no such output.")
        if given["grid"] not in map(str, explore.SIZES):
            raise ValueError(f"A map has at most {_GRIDS[-1][1]} points.")
        if given["x"] == given["y"]:
            raise ValueError("Choose two different quantities.")
        x, y = (
            sweep(given[side], given[f"{side}_from"], given[f"{side}_to"], count, editor.limits)
            for side, count in zip(SIDES, explore.SIZES[1], strict=True)
        )
        output = explore.MAP_OUTPUTS[given["output"]]
        return MapRequest(x, y, output, int(given["grid"]), given)

    def start_job(self, given: Mapping[str, str]) -> None:
        """Take the map of the form; its job begins when the sliders rest."""
        try:
            self._request = self.request_of(given, self._editor)
        except ValueError as error:
            self.job.show(JobState("failed", 0.0, str(error)))
        else:
            self._refining = None
            self._draw()

    # Outside of the page

    def choices(self) -> dict[str, Any]:
        if self._request is None:
            return {}
        plane = self.job_result  # the grid of the exported numbers may be coarser than the form's
        stride = self._request.stride if plane is None else plane.stride
        return {**self._request.given, "grid": str(stride)}

    def choose(self, choices: Mapping[str, Any], results: Results) -> None:
        editor = results.editor
        self._request = request = self.request_of({**self.form(editor)[0], **choices}, editor)
        question = request.of(results)
        self.job_result = last_shown(lambda job: explore.refine(job, question, request.stride))

    # The picture

    def sentence(self, results: Results) -> str:
        plane = self._newest(results)[0]
        if plane is not None:
            return summary(plane)
        return self.words_of_nothing if self.is_empty else "Faint: an earlier map."

    def say(self, results: Results | None, sentence: str) -> None:
        if results is None or self._request is None:
            super().say(results, sentence)
            return
        self._question = question = self._request.of(results)
        plane, why = self._newest(results)
        self.job_result = plane or self.job_result
        super().say(results, sentence)
        if self.job_result is not None:
            scene = focus_first(results.scene, results.focus)
            x, y = (
                value_of(scene, sweep.field) for sweep in (self.job_result.x, self.job_result.y)
            )
            self._plane.show(field_of(self.job_result), (x, y), _FADED if plane is None else 1.0)
        if self._jobs is None or self._refining == (question, self._request.stride):
            return
        if self._refining is not None:
            self._jobs.cancel()  # its map is no longer wanted
        self._refining = None
        if why:
            self.job.show(JobState("failed", 0.0, why))
        elif not results.moving:
            self._refine(self._jobs, question, plane)

    def _go(self, x: float, y: float) -> None:
        """Set both quantities to their values at a place of the map, as if they were typed."""
        if self.job_result is None or self.parts is None:
            return
        fields = self.job_result.x.field, self.job_result.y.field
        typed = {
            field.key: float(f"{field.read_sign * value:.6g}")
            for field, value in zip(fields, (x, y), strict=True)
        }
        self.parts.change_scene({"typed": typed})

    def columns(self, plane: explore.Plane) -> dict[str, np.ndarray]:
        up, across = np.meshgrid(plane.y.field_values, plane.x.field_values, indexing="ij")
        return {
            plane.x.field.key: across.ravel(),
            plane.y.field.key: up.ravel(),
            plane.question.output.column: plane.values.ravel(),
            "no_answer_because": plane.reasons.ravel(),
            **{
                name: np.full(plane.values.size, value)
                for name, value in plane.question.output.fineness.items()
            },
        }

    def _newest(self, results: Results) -> tuple[explore.Plane | None, str]:
        """The finest map that is computed, or the reason why there is none."""
        if self._request is None:
            return None, ""
        question = self._request.of(results)
        if self.job_result is not None and self.job_result.question == question:
            return self.job_result, ""
        if not question.at_once:
            return None, ""
        try:
            return explore.coarse(question), ""
        except ValueError as error:
            return None, sentence_of(error)

    # Refining

    def _refine(self, jobs: Jobs, question: explore.Question, start: explore.Plane | None) -> None:
        """Start the job that refines a map."""
        assert self._request is not None
        stride = self._request.stride
        self._refining = question, stride
        jobs.start(
            lambda job: explore.refine(job, question, stride, start), self._take, self.report
        )

    def _take(self, plane: explore.Plane) -> None:
        if plane.question == self._question:
            self.job_result = plane
            self._draw()


def field_of(plane: explore.Plane) -> Field:
    """Convert a map for the figures."""
    from bearing_explorer.explorer.plots.plane import Field

    output = plane.question.output
    words = re.sub("^k ", "k_", output.label)  # the directions are a subscript
    words = words if words.startswith("k_") else words[0].upper() + words[1:]
    x, y = ((Side.of(sweep.field), sweep.values) for sweep in (plane.x, plane.y))
    return Field(x, y, words, output.unit, plane.values, plane.reasons)


def summary(plane: explore.Plane) -> str:
    """A sentence on a map: least and greatest value, their places, and missing points."""
    question, values = plane.question, plane.values
    words, size = field_of(plane).words, question.size_words(plane.stride)
    missing = ""
    if plane.missing:
        reasons = [str(why) for why in plane.reasons[np.isnan(values)]]
        common = max(set(reasons), key=reasons.count)
        points = "1 point has" if plane.missing == 1 else f"{plane.missing} points have"
        why = f"no answer, most often: {common.rstrip('.')}."
        if plane.missing == values.size:
            return f"{words}: {points} {why}"
        missing = f" {points} {why}"
    least, most = (
        np.unravel_index(int(place(values)), values.shape) for place in (np.nanargmin, np.nanargmax)
    )
    ends = f"least {_place(plane, least)}, greatest {_place(plane, most)}"
    return f"{words}: {ends}.{missing} Computed at {size}."


def _place(plane: explore.Plane, point: tuple[Any, ...]) -> str:
    """The number at a point (row, column) of a map, with its place, in words."""
    output = plane.question.output
    value, unit = float(plane.values[point]), output.unit
    prefixed = unit not in ("", "°")
    shown = style.with_prefix(value, unit) if prefixed else with_unit(value, unit, 3)
    where = [
        f"{sweep.field.read_label.lower()} {with_unit(sweep.values[k], sweep.field.shown_unit, 3)}"
        for sweep, k in ((plane.x, point[1]), (plane.y, point[0]))
    ]
    return f"{shown} at {' and '.join(where)}"
