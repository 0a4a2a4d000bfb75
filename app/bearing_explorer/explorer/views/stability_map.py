"""Stability of the steady orbit over two quantities of the scene, and its kinds of loss."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import panel as pn
from bokeh.models import FixedTicker, LinearColorMapper
from bokeh.palettes import Blues256
from numpy.typing import NDArray

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.value_range import (
    SWEEPABLE,
    Sweep,
    focused,
    table_of_places,
    value_of,
)
from bearing_explorer.explorer.views.swept_view import Swept, SweptView, compute_in_levels
from bearing_explorer.explorer.widgets.plane_form import plane_fields, plane_fills, plane_sweeps
from bearing_explorer.kit.compute.jobs import LONGEST, Work
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.heat_map import CLEAR, GridImage, Side, color_bar, ends, ring_at
from bearing_explorer.kit.plots.layers import draw, segments
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import FieldSpec
from bearingcore import Scene
from bearingcore.common import Progress
from bearingcore.dynamics import OUTCOMES, StabilityMap, regions, stability_map
from bearingcore.scene import MASSLESS

GRIDS = (13, 25, 49, 97)
"""Points along each side that can be chosen; each holds the points of those before."""

HEIGHT = 460

PERIOD_DOUBLING = (
    "<b>Period doubling</b>: the motion repeats after two ball passes, so the spectrum shows "
    "lines at half the ball-pass frequency and its odd multiples, between the usual ones. They "
    "look like a second fault or like looseness, but one defect at one shaft speed makes them, and "
    "they vanish when the speed changes."
)


@dataclass(frozen=True)
class Kind:
    """Outcome of a point of the map; `through`: the way a multiplier leaves the unit circle."""

    outcome: str
    through: str
    words: str
    color: str


KINDS = (
    Kind("stable orbit", "", "stable", CLEAR),
    Kind("unstable orbit", "-1", "period doubling (flip)", "#D55E00"),
    Kind("unstable orbit", "pair", "second frequency (Neimark–Sacker)", "#7B3294"),
    Kind("unstable orbit", "+1", "jump to another orbit (fold)", "#F0C419"),
    Kind("not converged", "", "no orbit found", "#30363D"),
    Kind("no common period", "", "no common period", "#8B929A"),
    Kind("no static state to start from", "", "no static state", "#B9BEC4"),
    Kind("refused", "", "no such scene", "#DDE0E3"),
    Kind("too many steps", "", "too many steps", "#5C636B"),
)
"""In the order of their codes in the picture."""

_SAY = """
const [size, kind] = cell
if (isNaN(kind)) return "not computed"
return kinds[kind] + (isNaN(size) ? "" : `, |μ| = ${rounded(size, 3)}`)
"""


LAYERS = [segments("stability_border", style.SHADE, 1.6), *ring_at("stability_mark")]
"""Over the map: |μ| = 1, and this scene."""


class OrbitStability(SweptView):
    """Largest Floquet multiplier over two quantities."""

    name = "stability-map"
    title = "Where the orbit is stable"
    about = (
        "Blue: the largest multiplier |μ| of a stable orbit. Other colours: kinds of instability; "
        "the dark line is |μ| = 1. Ring: this scene. Click to go there."
    )
    start = "Compute the map"
    bounds = (
        f"At most {GRIDS[-1]} × {GRIDS[-1]} points and {LONGEST / 60.0:.0f} minutes; coarse "
        "pictures come first."
    )

    def build(self, packed: PackedSource) -> Any:
        self._sides = {key: Side.of(field) for key, field in SWEEPABLE.items()}
        plot = style.make_figure(
            self._sides["shaft_speed_hz"].quantity,
            self._sides["extent_deg"].quantity,
            packed.range("stability_x", 0.0, 60.0),
            packed.range("stability_y", 0.0, 60.0),
            height=HEIGHT,
            name="stability_drawing",
        )
        plot.grid.visible = False
        plot.stylesheets = [":host { cursor: crosshair; }"]
        size = LinearColorMapper(
            palette=list(Blues256[::-1][12:215]), low=0.0, high=1.0, nan_color=CLEAR
        )
        kind = LinearColorMapper(
            palette=[k.color for k in KINDS[1:]],
            low=0.5,
            high=len(KINDS) - 0.5,
            low_color=CLEAR,
            nan_color=CLEAR,
        )
        said = "const kinds = [" + ", ".join(f'"{k.words}"' for k in KINDS) + "]\n" + _SAY
        self._image = GridImage(
            plot, packed, "stability_cells", [size, kind], list(self._sides.values()), said
        )
        draw(plot, packed, LAYERS)
        ticks = FixedTicker(ticks=[0.0, 0.25, 0.5, 0.75, 1.0])
        bar = color_bar(size, "|μ|, stable", ticker=ticks, bar_line_color=style.STEEL_EDGE)
        plot.add_layout(bar, "right")
        key = pn.pane.HTML(legend(), sizing_mode="stretch_width", margin=0)
        return [self.job, self.only_with_numbers(plot, key)]

    # The job

    def fields(self) -> list[FieldSpec]:
        grids = [[str(n), f"{n} × {n}"] for n in GRIDS]
        return [*plane_fields(), {"name": "grid", "label": "Fineness", "options": grids}]

    def form(self, editor: SceneEditor) -> tuple[dict[str, str], dict[str, Any]]:
        fills = plane_fills(editor.limits)
        x, y = "shaft_speed_hz", "extent_deg"
        return {"x": x, "y": y, **fills["x"][x], **fills["y"][y], "grid": "25"}, fills

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        if given["grid"] not in map(str, GRIDS):
            sizes = ", ".join(map(str, GRIDS[:-1]))
            raise ValueError(f"A map has {sizes} or at most {GRIDS[-1]} points along a side.")
        n = int(given["grid"])
        x, y = plane_sweeps(given, (n, n), editor.limits)
        scene = focused(editor.scene, editor.selected)
        return lambda job: compute(job, scene, x, y, n)

    # The picture

    def scene_of(self, results: Results) -> Scene:
        return super().scene_of(results).replace(balls=MASSLESS)

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        if (found := self.found) is None:
            return {}, {}
        x, y = found.sweeps
        right, up = ((self._sides[sweep.field.key], sweep.values) for sweep in (x, y))
        codes = codes_of(found.result)
        layers = [found.result.multiplier, codes]
        mark = (np.array([value_of(self.scene_of(results), sweep.field)]) for sweep in (x, y))
        sources: Sources = {
            "stability_cells": self._image.columns(right, up, layers, self.opacity(results, found)),
            "stability_border": border(x.values, y.values, codes),
            "stability_mark": dict(zip(("x", "y"), mark, strict=True)),
        }
        return sources, {"stability_x": ends(x.values), "stability_y": ends(y.values)}

    def words_of(self, results: Results, found: Swept) -> str:
        words = " ".join(regions(found.result))
        missing = found.result.count("not computed")
        own = self.opacity(results, found) == 1.0
        return f"{words} {missing} were not computed." if missing and own else words

    def columns(self, found: Swept) -> dict[str, np.ndarray]:
        names = ("largest_multiplier", "outcome", "through")
        return table_of_places(*found.sweeps) | found.result.table().only(*names).named()


def compute(job: Work, scene: Scene, x: Sweep, y: Sweep, n: int) -> str:
    """The map on coarse grids and then on finer ones, shown each time. Runs in a job's thread."""
    massless = scene.replace(balls=MASSLESS)  # only they have orbits that can be looked for

    def one_level(level: tuple[Sweep, ...], progress: Progress) -> StabilityMap:
        sides = [sweep.in_si for sweep in level]
        return stability_map(massless, *sides, progress=progress, cancelled=job.cancelled)

    strides = [(n - 1) // (grid - 1) for grid in GRIDS if grid <= n]
    levels = [(x.every(stride), y.every(stride)) for stride in strides]
    return compute_in_levels(job, levels, one_level, "points")


def codes_of(found: StabilityMap) -> NDArray[np.float64]:
    """Index into KINDS of each point; NaN where it was not computed."""
    codes = np.full(found.outcome.shape, np.nan)
    for code, kind in enumerate(KINDS):
        here = found.outcome == OUTCOMES.index(kind.outcome)
        if kind.through:
            here &= found.through == kind.through
        codes[here] = code
    return codes


def border(
    x: NDArray[np.float64], y: NDArray[np.float64], codes: NDArray[np.float64]
) -> dict[str, np.ndarray]:
    """Sides of cells between stable and other points, as columns x0, y0, x1, y1."""
    known, stable = np.isfinite(codes), codes == 0
    left, bottom = ends(x)[0], ends(y)[0]
    dx, dy = x[1] - x[0], y[1] - y[0]
    j, i = np.nonzero((stable[:, 1:] != stable[:, :-1]) & known[:, 1:] & known[:, :-1])
    upright = [left + (i + 1) * dx, bottom + j * dy, left + (i + 1) * dx, bottom + (j + 1) * dy]
    j, i = np.nonzero((stable[1:] != stable[:-1]) & known[1:] & known[:-1])
    level = [left + i * dx, bottom + (j + 1) * dy, left + (i + 1) * dx, bottom + (j + 1) * dy]
    return {
        name: np.concatenate([a, b])
        for name, a, b in zip(("x0", "y0", "x1", "y1"), upright, level, strict=True)
    }


def legend() -> str:
    """Meaning of the colours of unstable regions, and of period doubling."""
    items = style.legend((kind.color, "■", kind.words) for kind in KINDS[1:])
    return f'{items}<p style="{style.HTML_FONT};margin:6px 2px 0">{PERIOD_DOUBLING}</p>'
