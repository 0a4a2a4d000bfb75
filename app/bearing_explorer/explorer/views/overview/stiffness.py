"""The stiffness terms that matter in this scene, drawn large."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from bokeh.core.properties import value
from bokeh.models import Quad, Range1d, Scatter
from numpy.typing import NDArray

from bearing_explorer.explorer.plots import compared_curves, matrix_cells
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.plots.element_words import with_elements_of
from bearing_explorer.kit.plots.ranges import ROOM, StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore import STIFFNESS_TERMS, Equilibrium
from bearingcore.model.statics import TERM_UNITS

LEAST_VARIATION = 0.02
"""Share of a term's size by which it must vary, or differ from the healthy term, to matter."""
MOST_POINTS = 61
"""Most points of a trace: a cell is little more than a hundred pixels wide."""

WIDE, HIGH = 5.0, 3.0
"""Sides of the drawing, in its own units."""
HEAD = 0.55
"""Height above a frame for the symbol and the value, in the same units."""

_UNIT = np.array([matrix_cells.UNITS.index(unit) for unit in TERM_UNITS.values()])
_SUBSCRIPTS = [symbol[2:] for symbol in matrix_cells.SYMBOLS]
_VALUE_WORDS = f"""
const unit = {list(matrix_cells.UNITS)}[row.unit]
if (isNaN(row.now)) return narrow ? '' : 'no value'
let wide = Infinity
try {{ wide = plot.inner_width*(row.right - row.left)/{WIDE} }} catch {{}}
const most = (wide/larger - 20)/6.2 - {_SUBSCRIPTS}[row.term].length  // letters
return [3, 2].map(digits => si(row.now, unit, digits)).find(text => text.length < most) ?? ''
"""
_VALUE_LOOK = {"text_align": "right", "text_baseline": "bottom", "y_offset": -3}
_SYMBOL_LOOK = {
    "text_font": value(matrix_cells.SERIF),
    "text_color": style.INK,
    "text_baseline": "bottom",
}
_FRAME_LOOK = {"fill_color": "#FAFBFC", "line_color": style.GRID}
_NOW_LOOK = {"size": 6, "color": style.DEFECTIVE, "line_color": "white"}
LAYERS: tuple[layers.Layer, ...] = (
    layers.Glyph(Quad, "overview_terms", ("left", "right", "top", "bottom"), _FRAME_LOOK),
    layers.Words("overview_terms", "left", "top", "return 'k'", (),
          look={**_SYMBOL_LOOK, "y_offset": -3, "text_font_size": "13px"}),
    layers.Words("overview_terms", "left", "top", f"return {_SUBSCRIPTS}[row.term]", ("term",),
          look={**_SYMBOL_LOOK, "x_offset": 8, "y_offset": -1}),
    layers.Words("overview_terms", "right", "top", _VALUE_WORDS,
          ("now", "unit", "term", "left", "low", "high"), fitting=style.NARROW, look=_VALUE_LOOK),
    matrix_cells.crossing_layer("overview_crossings"),
    *compared_curves.curves("overview_stiffness", "x", "y", width=1.3),
    layers.curve("overview_healthy", "x", "y", style.HEALTHY, 1.3, cells="overview_terms"),
    layers.curve("overview_lively", "x", "y", style.DEFECTIVE, 1.8, cells="overview_terms"),
    layers.Glyph(Scatter, "overview_term_now", ("x", "y"), _NOW_LOOK),
)  # fmt: skip
"""Frames, symbols and curves of the cells, the lowest layer first."""


def cells_for(count: int) -> list[matrix_cells.Cell]:
    """Cells as large as possible: side by side, or in rows of three or five."""
    columns = count if count <= 3 else 3 if count <= 6 else 5
    rows = math.ceil(count / max(columns, 1))
    return [
        matrix_cells.Cell(
            WIDE * column / columns + 0.05,
            WIDE * (column + 1) / columns - 0.04,
            -HIGH * (row + 1) / rows + 0.03,
            -HIGH * row / rows - HEAD,
        )
        for row, column in (divmod(index, columns) for index in range(count))
    ]


class OverviewStiffness(ComparingView):
    """The terms that matter, over the cage angle; a click opens the tab of all terms."""

    name = "overview-stiffness"
    title = "Stiffness"
    about = (
        "The radial stiffness, and the other terms of the stiffness matrix that vary as the "
        "bearing turns or differ from the grey ones, with their value now. Blue: this scene. "
        "Grey: {grey}."
    )
    needs = frozenset({"equilibrium", "now", "ranges"})
    compact = True
    leads_to = "stiffness"
    lead = "all fifteen"

    def build(self, packed: PackedSource) -> Any:
        self._limits = [StickyRange(0.0, 1.0, room=ROOM) for _ in matrix_cells.SYMBOLS]
        plot = style.bare_figure(
            Range1d(0.0, WIDE, syncable=False), Range1d(-HIGH, 0.0, syncable=False), height=70
        )
        layers.draw(plot, packed, LAYERS)
        return self.only_with_numbers(plot, sizing_mode="stretch_both")

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        states, healthy, now = results.equilibrium, results.reference.equilibrium, results.now
        others = [results.against(other).equilibrium for other in results.compared]
        answers = [states, healthy, *others]
        first, last, _ = results.stretch
        sizes = [answer.cage_angles.size for answer in answers]
        picks = [np.linspace(0, n - 1, min(n, MOST_POINTS)).round().astype(int) for n in sizes]
        shares = [
            (answer.cage_angles[pick] - first) / (last - first)
            for answer, pick in zip(answers, picks, strict=True)
        ]
        share = (results.cage_angle - first) % (last - first) / (last - first)
        scales = matrix_cells.term_sizes(
            lambda term: np.concatenate([e.term(term) for e in answers])
        )
        # a cell for each term that matters, with a trace for each scene and a mark
        lively = lively_terms(results, answers, scales)
        cells = cells_for(len(lively))
        values, ends = np.empty(len(lively)), np.empty((2, len(lively)))
        traces: list[list[tuple[np.ndarray, np.ndarray]]] = [[] for _ in answers]
        marks = np.empty((2, len(lively)))
        for i, (cell, index) in enumerate(zip(cells, lively, strict=True)):
            term, scale = STIFFNESS_TERMS[index], scales[index]
            terms = [matrix_cells.clean_noise(answer.term(term), scale) for answer in answers]
            values[i] = matrix_cells.clean_noise(now.term(term), scale)[0]
            limits = ends[:, i] = matrix_cells.trace_limits(self._limits[index], scale, *terms)
            for trace, shares_of, pick, term_values in zip(
                traces, shares, picks, terms, strict=True
            ):
                trace.append((cell.x(shares_of), cell.y(term_values[pick], limits)))
            marks[:, i] = cell.x(np.array(share)), cell.y(np.array(values[i]), limits)
        drawn, reference, *compared = (layers.with_gaps(lines, "x", "y") for lines in traces)
        return {
            **compared_curves.sources(
                "overview_stiffness", ("x", "y"), compared, lambda line: line
            ),
            "overview_lively": drawn,
            "overview_healthy": reference,
            "overview_terms": {
                **matrix_cells.sides_of(cells),
                "term": np.array(lively, dtype=float),
                "now": values,
                "low": ends[0],
                "high": ends[1],
                "unit": _UNIT[lively],
            },
            "overview_crossings": matrix_cells.crossing_lines(results, cells),
            "overview_term_now": {"x": marks[0], "y": marks[1]},
        }, {}

    def sentence(self, results: Results) -> str:
        if not results.equilibrium.converged.any():
            return "There is no equilibrium here, so there is no stiffness to show."
        why = with_elements_of(results.scene.bearing, reasons.stiffness(results, briefly=True))
        return f"{why} {reasons.not_needed(results.scene, briefly=True)}".strip()

    def table(self, results: Results) -> dict[str, np.ndarray]:
        answer = results.equilibrium.table().in_units()
        return answer.only("cage_angle", *STIFFNESS_TERMS).named()


def free_terms(dofs: Sequence[str]) -> set[str]:
    """Names of the terms between these directions of the inner ring."""
    return {f"k_{a}{b}" for i, a in enumerate(dofs) for b in dofs[i:]}


def lively_terms(
    results: Results, answers: Sequence[Equilibrium], scales: Sequence[float]
) -> list[int]:
    """Indices of the terms that matter here: k_xx and k_yy; others if they vary or differ."""
    free = free_terms(results.equilibrium.dofs)
    terms = []
    for i, (term, scale) in enumerate(zip(STIFFNESS_TERMS, scales, strict=True)):
        values, *others = (matrix_cells.clean_noise(answer.term(term), scale) for answer in answers)
        if term in free and (
            term in reasons.RADIAL or any(is_lively(values, other, scale) for other in others)
        ):
            terms.append(i)
    return terms


def is_lively(values: NDArray[np.float64], healthy: NDArray[np.float64], scale: float) -> bool:
    """True if a term of this scale varies over the angles, or differs from the healthy one."""
    known, usual = values[np.isfinite(values)], healthy[np.isfinite(healthy)]
    if not known.size:
        return False
    ends = [known.min(), known.max(), *([usual.min(), usual.max()] if usual.size else [])]
    return bool(max(ends) - min(ends) > LEAST_VARIATION * scale)
