"""All 15 stiffness traces over cage angle in one drawing, and the number of loaded balls.

All traces of a scene are one line with gaps. The legend and the number of loaded balls are below
the diagonal.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from bokeh.models import ColumnDataSource
from bokeh.plotting import figure

from bearing_explorer.explorer.plots import compared_curves, matrix_cells
from bearing_explorer.explorer.plots.matrix_cells import PLACES, UNITS, Cell, clean_noise, write
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.plots.element_words import elements, with_elements_of
from bearing_explorer.kit.plots.ranges import ROOM, StickyRange
from bearing_explorer.kit.plots.style import with_prefix
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore import STIFFNESS_TERMS
from bearingcore.common import prefix_power, prefixed_span
from bearingcore.model.statics import TERM_UNITS

NARROWEST = 920
"""Least width [px] at which a cell has room for its symbol and its value."""
NARROWEST_WITH_UNITS = 740
"""Least width [px] at which a cell has room for its unit inside and its limits beside it."""
LEFT = 0.31
"""Room for the numbers left of a cell."""


def _cell(row: int, column: int) -> Cell:
    return Cell(column + LEFT, column + 0.97, -row - 0.86, -row - 0.27)


_CELLS = [_cell(i, j) for i, j in PLACES]
_BALLS = Cell(LEFT, 2.6, -4.86, -3.5)
_FRAMES = [*_CELLS, _BALLS]
_IS_FOOT = np.array([i == j for i, j in PLACES] + [True])  # lowest cell of its column
_PLACE_COLUMNS = {
    **matrix_cells.sides_of(_FRAMES),
    "unit": np.array([UNITS.index(unit) for unit in TERM_UNITS.values()] + [len(UNITS)]),
}
_CELL_COLUMNS = (*_PLACE_COLUMNS, "foot", "low", "high", "now", "zero", "flat", "power")


class Stiffness(ComparingView):
    """15 stiffness traces of the scene and of the reference, with the current cage angle."""

    name = "stiffness"
    title = "Stiffness of the bearing"
    about = (
        "The 15 stiffness terms as the cage turns. They are the independent ones of the symmetric "
        "5×5 stiffness matrix: displacements are the columns, loads the rows. Blue: this scene. "
        "Grey: {grey}. Click: enlarges a term and says why it varies. For an inner-race defect, "
        "curves show the current turn of the shaft."
    )
    needs = frozenset({"equilibrium", "now", "ranges"})
    cells = matrix_cells.named_cells(_FRAMES)

    def build(self, packed: PackedSource) -> Any:
        """One canvas for all traces."""
        self._limits = [StickyRange(0.0, 1.0, room=ROOM) for _ in _CELLS]
        self._ball_limits = StickyRange(0.0, 1.0, shrink_below=0.0)
        self._lesson_term, self._lesson_limits = "", StickyRange(0.0, 1.0)
        plot = matrix_cells.matrix_figure(
            (-0.12, 5.03), (-5.17, 0.11), height=350, name="stiffness_drawing"
        )
        self._legend = _static_parts(plot)
        cells = packed.source("stiffness_cells", *_CELL_COLUMNS)
        now = packed.source("stiffness_now", "x", "y", "low", "high")
        axis = packed.source("stiffness_axis", "shaft", *UNITS)
        _moving_parts(plot, cells, axis)
        plot.segment("x", "low", "x", "high", source=now, line_color=style.INK, line_alpha=0.45)
        looks = {"healthy": (style.HEALTHY, 1.6), "defective": (style.DEFECTIVE, 1.8)}
        healthy, defective = (
            layers.curve(f"stiffness_{name}", "x", "y", *look, cells="stiffness_cells")
            for name, look in looks.items()
        )
        curves = [
            matrix_cells.crossing_layer("stiffness_crossings"),
            healthy,
            *compared_curves.curves("stiffness", "x", "y"),
            defective,
        ]
        layers.draw(plot, packed, curves)
        plot.scatter("x", "y", source=now, size=6, color=style.DEFECTIVE, line_color="white")
        units = [*UNITS, ""]
        matrix_cells.axes_when_zoomed(plot, _FRAMES, _SCALE_OF, [cells, axis], units=units)
        matrix_cells.enlarge_on_click(plot)
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        """Traces of all scenes, scaled to their cells, with limits and current values."""
        states, now = results.equilibrium, results.now
        references = [results.reference, *(results.against(other) for other in results.compared)]
        answers = [states, *(other.equilibrium for other in references)]
        first, last, _ = results.stretch
        shares = [(e.cage_angles - first) / (last - first) for e in answers]
        now_share = (results.cage_angle - first) % (last - first) / (last - first)
        scales = matrix_cells.term_sizes(
            lambda term: np.concatenate([e.term(term) for e in answers])
        )
        lines: list[list[tuple[np.ndarray, np.ndarray]]] = [[] for _ in shares]
        marks: list[tuple[float, float, float, float]] = []
        cell_numbers: list[tuple[float, float, float, float]] = []
        flat: list[bool] = []

        def put(
            cell: Cell, limits: tuple[float, float], xs: list[np.ndarray], *ys: np.ndarray
        ) -> None:
            for line, x, y in zip(lines, xs, ys, strict=True):
                line.append((cell.x(x), cell.y(y, limits)))

        for cell, sticky, term, scale in zip(
            _CELLS, self._limits, STIFFNESS_TERMS, scales, strict=True
        ):
            terms = [clean_noise(e.term(term), scale) for e in answers]
            value = float(clean_noise(now.term(term), scale)[0])
            limits = matrix_cells.trace_limits(sticky, scale, *terms)
            if term == results.lesson_term:
                limits = self._limits_of_lesson(term).fit(*terms)
            put(cell, limits, shares, *terms)
            height = float(cell.y(np.array(value), limits))
            marks.append((float(cell.x(np.array(now_share))), height, cell.bottom, cell.top))
            # the line of zero, at the edge of the cell if zero is beyond it
            zero = float(np.clip(cell.y(np.array(0.0), limits), cell.bottom, cell.top))
            known = [term[np.isfinite(term)] for term in terms]
            flat.append(any(map(len, known)) and not np.concatenate(known).any())
            cell_numbers.append((*limits, value, zero))

        # the last cell: numbers of loaded balls, drawn as steps
        counts = [np.where(e.converged, e.loaded_balls, np.nan) for e in answers]
        low, high = self._ball_limits.fit(*counts)
        limits = (max(0.0, math.floor(low - 0.5)), math.ceil(high + 0.5))
        steps = [_stepped(share) for share in shares]
        put(_BALLS, limits, steps, *(np.repeat(count, 2) for count in counts))
        balls = float(now.loaded_balls[0]) if now.converged[0] else math.nan
        height = float(_BALLS.y(np.array(balls), limits))
        marks.append((float(_BALLS.x(np.array(now_share))), height, _BALLS.bottom, _BALLS.top))
        cell_numbers.append((*limits, balls, _BALLS.bottom))

        powers = _shared_powers(np.array(cell_numbers[:-1])[:, :2], np.array(flat))
        drawn, reference, *others = (layers.with_gaps(line, "x", "y") for line in lines)
        mark, numbers = np.array(marks).T, np.array(cell_numbers).T
        return {
            **compared_curves.sources("stiffness", ("x", "y"), others, lambda line: line),
            "stiffness_defective": drawn,
            "stiffness_healthy": reference,
            "stiffness_now": dict(zip(("x", "y", "low", "high"), mark, strict=True)),
            "stiffness_cells": {
                **_PLACE_COLUMNS,
                "foot": _IS_FOOT * float(results.along(last)),
                **dict(zip(("low", "high", "now", "zero"), numbers, strict=True)),
                "flat": np.array([*matrix_cells.zero_kinds(flat), 0]),
                "power": np.array([*(powers[unit] for unit in TERM_UNITS.values()), 0]),
            },
            "stiffness_crossings": matrix_cells.crossing_lines(results, _FRAMES),
            "stiffness_axis": {
                "shaft": np.array([float(results.over_shaft)]),
                **{unit: np.array([power]) for unit, power in powers.items()},
            },
        }, {}

    def _limits_of_lesson(self, term: str) -> StickyRange:
        """Limits from zero that only grow, because a lesson compares its scenes on one axis."""
        if term != self._lesson_term:
            self._lesson_term = term
            self._lesson_limits = StickyRange(0.0, 1e-9, anchor="zero", shrink_below=0.0, room=0.2)
        return self._lesson_limits

    def sentence(self, results: Results) -> str:
        """Explain the size of the radial stiffness; add its range and how many balls carry load."""
        ranges, healthy = results.ranges, results.reference.ranges
        states = ranges.state
        if not states.converged.any():
            return "There is no equilibrium here, so there is no stiffness to show."
        parts = []
        for name, term in (("Horizontal stiffness", "k_xx"), ("vertical stiffness", "k_yy")):
            least, most = ranges.least[term], ranges.greatest[term]
            span = prefixed_span(least, most, "N/m")
            line = f"{name} {term} {'varies from' if ' to ' in span else 'is'} {span}"
            if results.grey.label and healthy.state.converged.any():
                mean = healthy.mean(healthy.state.term(term))
                line += f" (healthy: {with_prefix(mean, 'N/m')} on average)"
            parts.append(line)
        balls = states.loaded_balls[states.converged]
        count = str(balls.min()) if balls.min() == balls.max() else f"{balls.min()}–{balls.max()}"
        turns = " Ranges are over all turns of the shaft, curves over the one shown."
        carry = f"{elements(states.scene.bearing)} carry load"
        why = with_elements_of(states.scene.bearing, reasons.stiffness(results))
        held = reasons.not_needed(results.scene)
        sentences = why, f"{'; '.join(parts)}; {count} {carry}.", held
        return " ".join(filter(None, sentences)) + (turns if results.over_shaft else "")

    def cell_lines(self, content: Results) -> list[str]:
        return [reasons.stiffness_term(content, term) for term in STIFFNESS_TERMS]

    def show(self, results: Results) -> None:
        """Write in the legend whether the scene has a defect."""
        defect = "with the defect" if results.scene.defects else "without a defect"
        words = [defect, "healthy bearing", _NOW_WORDS]  # blue, grey, and the vertical line
        if words != self._legend.data["text"]:
            self._legend.data = {**self._legend.data, "text": words}

    def table(self, results: Results) -> dict[str, np.ndarray]:
        """Every trace in SI, of the scene and of the reference."""
        states, healthy = results.equilibrium, results.reference.equilibrium
        columns: dict[str, np.ndarray] = {}
        for kind, answer in (("defective", states), ("healthy", healthy)):
            table = answer.table().in_units().prefixed(kind)
            columns |= table.only(f"{kind}_cage_angle").named()
            if results.over_shaft:
                columns[f"{kind}_shaft_angle_deg"] = results.along(answer.cage_angles)
            shown = (*STIFFNESS_TERMS, "loaded_balls")
            columns |= table.only(*(f"{kind}_{name}" for name in shown)).named()
        return columns


_SCALE_OF = """
const [{data: rows}, {data: axis}] = sources
const unit = units[rows.unit[k]], [low, high] = [rows.low[k], rows.high[k]]
const e = unit ? power(Math.max(Math.abs(low), Math.abs(high))) : 0
const words = axis.shaft[0] ? 'Shaft angle φs' : 'Cage angle φc'
return {
  x: {first: 0, last: Math.max(...rows.foot), factor: 1, unit: '°', words},
  y: {first: low, last: high, factor: 10**e, unit: unit ? names[e] + unit : '', words: ''},
}
"""
_NOW_WORDS = "cage angle now"
_AXIS_WORDS = "return row.shaft ? 'Shaft angle φs, one turn' : 'Cage angle φc'"


def _stepped(share: np.ndarray) -> np.ndarray:
    """Edges of steps halfway between the angles, two for each angle."""
    middles = 0.5 * (share[1:] + share[:-1])
    return np.concatenate([share[:1], np.repeat(middles, 2), share[-1:]])


def _shared_powers(limits: np.ndarray, flat: np.ndarray) -> dict[str, float]:
    """Power of ten of the prefix that all terms of a unit share; `limits` (terms, 2) in SI."""
    units = np.array([*TERM_UNITS.values()])
    tops = {unit: np.abs(limits[(units == unit) & ~flat]) for unit in UNITS}
    known = {unit: top[np.isfinite(top)].max(initial=0.0) for unit, top in tops.items()}
    return {unit: float(prefix_power(float(top))) for unit, top in known.items()}


def _static_parts(plot: figure) -> ColumnDataSource:
    """Draw frames, names and legend, which never change; return the source of the legend."""
    frames = ColumnDataSource(matrix_cells.sides_of(_FRAMES))
    sides = {side: side for side in matrix_cells.SIDES}
    plot.quad(**sides, source=frames, fill_color="#FAFBFC", line_color=style.GRID)
    matrix_cells.write_names(plot, _FRAMES)
    y = [-2.16, -2.42, -2.68]
    colors = [style.DEFECTIVE, style.HEALTHY]
    ends = {"x0": [LEFT] * 2, "x1": [LEFT + 0.15] * 2, "y0": y[:2], "y1": y[:2]}
    plot.segment(**ends, line_color=colors, line_width=[2.4, 2.0])
    upright = {"x0": [LEFT + 0.075], "x1": [LEFT + 0.075], "y0": [y[2] - 0.06], "y1": [y[2] + 0.06]}
    plot.segment(**upright, line_color=style.INK, line_alpha=0.45)
    plot.scatter([LEFT + 0.075], [y[2]], size=6, color=style.DEFECTIVE, line_color="white")
    legend = ColumnDataSource({"x": [LEFT + 0.195] * 3, "y": y, "text": ["", "", _NOW_WORDS]})
    look = {"text_font_size": style.TEXT_SIZE, "text_color": style.INK, "fitting": style.NARROW}
    words = "return narrow ? row.text.replace(/ bearing$|^cage /, '') : row.text"
    write(plot, legend, words, text_baseline="middle", **look)
    return legend


_UNIT = f"const unit = {[*UNITS, '']}[row.unit]\n"
_LIMIT = f"""{_UNIT}
const at_corners = narrow && !row.foot
if (isNaN(row.low) || row.flat || at_corners !== %s) return ''
const e = unit ? power(Math.max(Math.abs(row.low), Math.abs(row.high))) : 0
return minus(String(Number((row.%s/10**(narrow ? row.power : e)).toPrecision(narrow ? 3 : 4))))
"""
_SHARED_UNITS = f"""
if (!narrow) return ''
return 'In ' + {[*UNITS]}.map((unit) => names[row[unit]] + unit).join(', ')
"""
_NOW = f"""{_UNIT}
if (row.flat) return ''
const e = power(Math.max(Math.abs(row.low), Math.abs(row.high)))
if (narrow) {{  // the value would lie on the symbol
  let wide = false
  try {{ wide = plot.inner_width > {NARROWEST_WITH_UNITS}*larger }} catch {{}}
  return wide && unit ? names[e] + unit : ''
}}
if (isNaN(row.now)) return 'no value'
if (!unit) return rounded(row.now, 3)
return rounded(row.now/10**e, 4) + '\\u00a0' + names[e] + unit
"""
_FLAT = f"""
return row.flat && narrow ? '0' : {list(matrix_cells.ZEROS)}[row.flat]
"""
_FOOT = f"""{_UNIT}
return row.foot && !(narrow && unit) ? rounded(%s, narrow ? 3 : 4) + '°' : ''
"""


def _moving_parts(plot: figure, cells: ColumnDataSource, axis: ColumnDataSource) -> None:
    """Draw zero lines, limits and values of the cells, and the ends of their cage angles."""
    plot.segment("left", "zero", "right", "zero", source=cells, line_color=style.STEEL_EDGE)
    fitting = NARROWEST_WITH_UNITS
    left = {"x": "left", "x_offset": -3, "text_align": "right", "fitting": fitting}
    # beside a cell; on a narrow figure, where cells are close together, below and above the corners
    for at_corners, low, high in (("false", "bottom", "top"), ("true", "top", "bottom")):
        write(plot, cells, _LIMIT % (at_corners, "low"), y="bottom", text_baseline=low, **left)
        write(plot, cells, _LIMIT % (at_corners, "high"), y="top", text_baseline=high, **left)
    write(plot, axis, _SHARED_UNITS, x=LEFT, y=-3.1, fitting=fitting)
    above = {"x": "right", "y": "top", "y_offset": -6, "text_align": "right"}
    write(plot, cells, _NOW, fitting=NARROWEST, **above)
    # words for a zero term: below the zero line, which runs through the middle
    inside = {"x": "left", "y": "bottom", "x_offset": 3, "y_offset": -1}
    write(plot, cells, _FLAT, fitting=NARROWEST, **inside)
    below = {"y": "bottom", "y_offset": 4, "text_baseline": "top", "fitting": fitting}
    write(plot, cells, _FOOT % "0*row.foot", x="left", **below)
    write(plot, cells, _FOOT % "row.foot", x="right", text_align="right", **below)
    middle = {"x": 0.5 * (_BALLS.left + _BALLS.right), "text_align": "center"}
    write(plot, axis, _AXIS_WORDS, **{**below, **middle, "y": _BALLS.bottom})
