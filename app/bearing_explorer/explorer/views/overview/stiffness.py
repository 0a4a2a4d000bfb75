"""The 15 stiffness terms, small: a curve where something happens, a reason where nothing does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from bokeh.core.properties import value
from bokeh.models import ColumnDataSource, Quad, Range1d, Scatter
from numpy.typing import NDArray

from bearing_explorer.explorer.plots.matrix_cells import (
    PLACES,
    SERIF,
    SYMBOLS,
    UNITS,
    Cell,
    cleaned,
    sides_of,
    term_sizes,
    trace_limits,
    write,
)
from bearing_explorer.kit.plots import compared_curves, style
from bearing_explorer.kit.plots.glyphs import add_glyph
from bearing_explorer.kit.plots.layers import Glyph, Layer, Words, curve, draw, with_gaps
from bearing_explorer.kit.plots.ranges import ROOM, StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearingcore import DOF_NAMES, STIFFNESS_TERMS
from bearingcore.scene.scene import DOF_SYMBOLS
from bearingcore.statics.equilibrium import TERM_SYMBOLS, TERM_UNITS

if TYPE_CHECKING:
    from bearing_explorer.explorer.results.results import Results

COLUMNS = 5
LIVELY = 0.02
"""Of the size of a term: it matters where it swings or is off the healthy one by more."""
MOST_POINTS = 61
"""Of a trace: a cell is little more than a hundred pixels wide."""

_CELLS = [
    Cell(column + 0.05, column + 0.96, -row - 0.97, -row - 0.38)
    for row, column in (divmod(index, COLUMNS) for index in range(len(SYMBOLS)))
]
_ROWS = math.ceil(len(_CELLS) / COLUMNS)
_SIDES = sides_of(_CELLS)
_UNIT = np.array([UNITS.index(unit) for unit in TERM_UNITS.values()])
_LETTERS = np.array([len(symbol[2:]) for symbol in SYMBOLS], dtype=float)
_DIRECTIONS = np.array(PLACES)
_WHY_WORDS = f"""
const names = {[DOF_SYMBOLS[dof] for dof in DOF_NAMES]}
if (row.lively) return ''
return row.held < 0 ? 'constant' : names[row.held] + (narrow ? '' : ' fixed')
"""
_VALUE_WORDS = f"""
const unit = {list(UNITS)}[row.unit]
if (!row.lively) return ''
if (isNaN(row.now)) return narrow ? '' : 'no value'
let wide = Infinity
try {{ wide = plot.inner_width*(row.right - row.left)/{COLUMNS} }} catch {{}}
const most = (wide/larger - 20)/6.2 - row.letters  // letters right of the symbol
return [3, 2].map(digits => si(row.now, unit, digits)).find(text => text.length < most) ?? ''
"""

_VALUE_LOOK = {"text_align": "right", "text_baseline": "bottom", "y_offset": -3}
_WHY_LOOK = {"text_align": "center", "text_color": style.FAINT_INK}
_NOW_LOOK = {"size": 6, "color": style.DEFECTIVE, "line_color": "white"}
LAYERS: tuple[Layer, ...] = (
    Words("overview_terms", "right", "top", _VALUE_WORDS,
          ("now", "unit", "lively", "left", "letters"), fitting=style.NARROW, look=_VALUE_LOOK),
    Words("overview_terms", "middle", "center", _WHY_WORDS, ("lively", "held"),
          fitting=style.NARROW, look=_WHY_LOOK),
    *compared_curves.curves("overview_stiffness", "x", "y", width=1.3),
    curve("overview_healthy", "x", "y", style.HEALTHY, 1.3),
    curve("overview_lively", "x", "y", style.DEFECTIVE, 1.8),
    Glyph(Scatter, "overview_term_now", ("x", "y"), _NOW_LOOK),
)  # fmt: skip
"""Over the frames and symbols of the cells, from the lowest to the highest."""


class OverviewStiffness(View):
    """All terms over the cage angle; a cell has a value only where its term matters."""

    name = "overview-stiffness"
    title = "Stiffness of the bearing"
    about = (
        "The 15 terms of the stiffness matrix as the bearing turns. Blue, with their value now: "
        "those that vary, or differ from the grey ones. Grey: {grey}. “Fixed”: the ring does not "
        "move along this direction in this scene."
    )
    needs = frozenset({"equilibrium", "now", "ranges"})
    compact = True
    sentence_looks = ("unseen",)
    leads_to = "stiffness"
    in_report = False

    def build(self, packed: PackedSource) -> Any:
        self._limits = [StickyRange(0.0, 1.0, room=ROOM) for _ in _CELLS]
        plot = style.bare_figure(
            Range1d(0.0, COLUMNS, syncable=False), Range1d(-_ROWS, 0.0, syncable=False), height=110
        )
        frames = ColumnDataSource({**_SIDES, "below": [symbol[2:] for symbol in SYMBOLS]})
        frame = {"fill_color": "#FAFBFC", "line_color": style.GRID}
        add_glyph(plot, Quad, frames, "left", "right", "top", "bottom", **frame)
        look = {"x": "left", "y": "top", "text_font": value(SERIF), "text_color": style.INK}
        write(plot, frames, value("k"), y_offset=-3, text_font_size="13px", **look)
        write(plot, frames, "below", x_offset=8, y_offset=-1, **look)
        draw(plot, packed, LAYERS)
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        found, healthy, now = results.equilibrium, results.reference.equilibrium, results.now
        answers = [found, healthy, *(results.against(one).equilibrium for one in results.compared)]
        first, last, _ = results.stretch
        pick = [_some(answer.cage_angles.size) for answer in answers]
        shares = [
            (answer.cage_angles[some] - first) / (last - first)
            for answer, some in zip(answers, pick, strict=True)
        ]
        share = (results.cage_angle - first) % (last - first) / (last - first)
        scales = term_sizes(lambda term: np.concatenate([e.term(term) for e in answers]))
        free = free_terms(found.dofs)
        is_held = np.array([dof not in found.dofs for dof in DOF_NAMES])[_DIRECTIONS]
        held = np.where(is_held[:, 0], _DIRECTIONS[:, 0], _DIRECTIONS[:, 1])
        lively = np.zeros(len(_CELLS))
        values = np.empty(len(_CELLS))
        traces: list[list[tuple[np.ndarray, np.ndarray]]] = [[] for _ in answers]
        marks = np.full((2, len(_CELLS)), np.nan)
        for i, (cell, term, scale) in enumerate(zip(_CELLS, STIFFNESS_TERMS, scales, strict=True)):
            terms = [cleaned(answer.term(term), scale) for answer in answers]
            values[i] = cleaned(now.term(term), scale)[0]
            lively[i] = term in free and any(is_lively(terms[0], b, scale) for b in terms[1:])
            if lively[i]:
                limits = trace_limits(self._limits[i], scale, *terms)
                for trace, share_of, some, values_of in zip(
                    traces, shares, pick, terms, strict=True
                ):
                    trace.append((cell.x(share_of), cell.y(values_of[some], limits)))
                marks[:, i] = cell.x(np.array(share)), cell.y(np.array(values[i]), limits)
        drawn, reference, *compared = (with_gaps(lines, "x", "y") for lines in traces)
        return {
            **compared_curves.sources(
                "overview_stiffness", ("x", "y"), compared, lambda line: line
            ),
            "overview_lively": drawn,
            "overview_healthy": reference,
            "overview_terms": {
                "left": _SIDES["left"],
                "right": _SIDES["right"],
                "letters": _LETTERS,
                "top": _SIDES["top"],
                "now": values,
                "unit": _UNIT,
                "lively": lively,
                "held": np.where(is_held.any(axis=1), held, -1),
                "middle": 0.5 * (_SIDES["left"] + _SIDES["right"]),
                "center": 0.5 * (_SIDES["top"] + _SIDES["bottom"]),
            },
            "overview_term_now": {"x": marks[0], "y": marks[1]},
        }, {}

    def sentence(self, results: Results) -> str:
        found, healthy, ranges = results.equilibrium, results.reference.equilibrium, results.ranges
        if not found.converged.any():
            return "There is no equilibrium here, so there is no stiffness to show."
        scales = term_sizes(lambda term: np.concatenate([found.term(term), healthy.term(term)]))
        named = [
            f"k_{TERM_SYMBOLS[term][2:]} from "
            f"{style.with_prefix(ranges.least[term], TERM_UNITS[term])} to "
            f"{style.with_prefix(ranges.greatest[term], TERM_UNITS[term])}"
            for term, scale in zip(STIFFNESS_TERMS, scales, strict=True)
            if term in free_terms(found.dofs)
            and is_lively(found.term(term), healthy.term(term), scale)
        ]
        return f"As the bearing turns these vary: {style.list_words(named) or 'none'}."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        answer = results.equilibrium.table().in_units()
        return answer.only("cage_angle", *STIFFNESS_TERMS).named()


def free_terms(dofs: Sequence[str]) -> set[str]:
    """Terms that matter where the inner ring can move in these directions only."""
    return {f"k_{a}{b}" for i, a in enumerate(dofs) for b in dofs[i:]}


def is_lively(values: NDArray[np.float64], healthy: NDArray[np.float64], scale: float) -> bool:
    """Whether a term of this size varies over the angles, or differs from the healthy one."""
    known, usual = values[np.isfinite(values)], healthy[np.isfinite(healthy)]
    if not known.size:
        return False
    ends = [known.min(), known.max(), *([usual.min(), usual.max()] if usual.size else [])]
    return bool(max(ends) - min(ends) > LIVELY * scale)


def _some(size: int) -> NDArray[np.int64]:
    """At most MOST_POINTS of this many points, both ends among them."""
    return np.unique(np.linspace(0, size - 1, min(size, MOST_POINTS)).round().astype(np.int64))
