"""The drawing of the symmetric 5×5 stiffness matrix: a cell for each of its 15 terms.

All cells share one canvas: column j and row i of the matrix are the unit square at (j, -i). One
canvas paints several times faster than a figure for each term, and shows the place of each term in
the matrix. The matrix only repeats itself below the diagonal, so the number of loaded balls is
drawn there. The numbers of a cell are written beside it. When a cell is enlarged they are out of
sight; the drawing's own axes then show the numbers of the cells in view (cell_axes.js).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from bokeh import models
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import printed, style
from bearing_explorer.kit.plots.layers import Glyph, Words, segments
from bearing_explorer.kit.plots.ranges import StickyRange
from bearingcore import DOF_NAMES
from bearingcore.model.statics import TERM_SYMBOLS, crossings

UNITS = ("N/m", "N/rad", "N·m/rad")
"""Units of stiffness with no, one and two rotations."""
NEGLIGIBLE = 1e-6
"""A term below this share of the geometric mean of its two diagonal terms is rounding error."""
ZEROS = ("", "0 by symmetry", "0: not resisted")
"""Why a cell is empty; see `zero_kinds`."""

PLACES = [(i, j) for i in range(5) for j in range(i, 5)]
"""Row and column of each term."""
SYMBOLS = list(TERM_SYMBOLS.values())
"""Symbols of the terms; the part after the space is a subscript."""
NAMES = [*SYMBOLS, "Loaded balls"]
"""Names of the cells."""
SIDES = ("left", "right", "bottom", "top")
SERIF = "Georgia, 'Times New Roman', serif"
"""Font of the symbols."""


@dataclass(frozen=True)
class Cell:
    """A frame in the drawing, in matrix columns and rows."""

    left: float
    right: float
    bottom: float
    top: float

    def x(self, share: np.ndarray) -> np.ndarray:
        """Places along the frame for shares of 0 to 1."""
        return self.left + (self.right - self.left) * share

    def y(self, value: np.ndarray, limits: tuple[float, float]) -> np.ndarray:
        """Heights of values on an axis with these limits."""
        low, high = limits
        return self.bottom + (self.top - self.bottom) * (value - low) / (high - low)


def sides_of(cells: Sequence[Cell]) -> dict[str, NDArray[np.float64]]:
    """The sides of cells, as columns."""
    return {side: np.array([getattr(cell, side) for cell in cells]) for side in SIDES}


Named = tuple[str, float, float, float, float]


def named_cells(cells: Sequence[Cell]) -> list[Named]:
    """Name and sides of the cells, one for each of NAMES."""
    return [(name, c.left, c.right, c.bottom, c.top) for name, c in zip(NAMES, cells, strict=True)]


def enlarge_on_click(plot: figure) -> None:
    """Let a click on a cell enlarge it to the whole screen (enlarge.js)."""
    code = """
const detail = {figure: plot.id, x: cb_obj.x, y: cb_obj.y}
window.dispatchEvent(new CustomEvent("explorer-cell", {detail}))
"""
    plot.js_on_event("tap", models.CustomJS(args={"plot": plot}, code=code))


def matrix_figure(
    x: tuple[float, float],
    y: tuple[float, float],
    looks: str = "",
    **options: Any,
) -> figure:
    """Make a figure for cells, as wide as its card; `looks` are further styles."""
    plot = style.bare_figure(models.Range1d(*x), models.Range1d(*y), **options)
    plot.toolbar_location = "left"  # on the right it would lie on the last column
    plot.toolbar.styles = {"background-color": "transparent"}  # a curve is seen through it
    # Panel would give a `min_width` of the figure to the whole card, so a style sheet sets it
    plot.min_width = None
    plot.stylesheets = [looks]
    plot.tags = [printed.WIDE]
    return plot


def write(
    plot: figure,
    source: models.ColumnDataSource,
    code: str,
    x: Any = "x",
    y: Any = "y",
    fitting: Any = 0.0,
    **look: Any,
) -> None:
    """Write small words at x, y of a source; JavaScript `code` returns them (`layers.Words`)."""
    look = {"text_color": style.FAINT_INK, "text_baseline": "bottom", **look}
    Words("", x, y, code, fitting=fitting, look=look).add(plot, source)


def write_names(plot: figure, cells: Sequence[Cell]) -> None:
    """Write the symbols of the terms above their cells, and the name of the last cell."""
    *terms, balls = cells
    source = models.ColumnDataSource(
        {
            "x": [cell.left for cell in terms],
            "y": [cell.top for cell in terms],
            "below": [symbol[2:] for symbol in SYMBOLS],
        }
    )
    serif = {"text_font": {"value": SERIF}, "text_color": style.INK}
    write(plot, source, "return 'k'", y_offset=-6, text_font_size="15px", **serif)
    write(plot, source, "return row.below", x_offset=9, y_offset=-3, **serif)
    name = models.ColumnDataSource({"x": [balls.left], "y": [balls.top]})
    look = {"y_offset": -6, "text_font_size": style.TEXT_SIZE, "text_color": style.INK}
    write(plot, name, f"return {NAMES[-1]!r}", **look)


def crossing_layer(source: str) -> Glyph:
    """The layer of `crossing_lines`."""
    return segments(source, "#D5DAE0", 1.0, ("element",))


def crossing_lines(results: Results, cells: Sequence[Cell]) -> dict[str, NDArray[np.float64]]:
    """Vertical lines in cells at the cage angles at which an element passes an edge of a defect.

    `element` is its number, negative if every element in turn passes at the same place.
    """
    first, last, _ = results.stretch
    events = crossings(results.scene, first, last)
    share = np.array([(event.cage_angle - first) / (last - first) for event in events])
    number = np.array([event.ball + 1.0 for event in events])
    x = np.concatenate([cell.x(share) for cell in cells])
    low, high = (np.repeat([getattr(c, side) for c in cells], share.size) for side in SIDES[2:])
    element = np.tile(number if results.over_shaft else -number, len(cells))
    return {"x0": x, "y0": low, "x1": x, "y1": high, "element": element}


def term_sizes(term: Callable[[str], NDArray[np.float64]]) -> list[float]:
    """Return the scale of each term: the geometric mean of the tops of its two diagonal terms.

    `term` returns the shown numbers of a term by its name.
    """
    tops = []
    for dof in DOF_NAMES:
        values = np.abs(term(f"k_{dof}{dof}"))
        tops.append(float(np.max(values, where=np.isfinite(values), initial=0.0)))
    return [math.sqrt(tops[i] * tops[j]) or 1.0 for i, j in PLACES]


def clean_noise(values: np.ndarray, scale: float) -> np.ndarray:
    """Values of a term, with zeros for rounding errors of a term that vanishes by symmetry."""
    return np.where(np.abs(values) < NEGLIGIBLE * scale, 0.0, values)


def zero_kinds(flat: Sequence[bool]) -> list[int]:
    """Index into ZEROS of each term: 1 if it is `flat` (zero), 2 if a direction is not resisted."""
    idle = {i for (i, j), zero in zip(PLACES, flat, strict=True) if zero and i == j}
    return [zero + bool(zero and idle & {*place}) for place, zero in zip(PLACES, flat, strict=True)]


def trace_limits(sticky: StickyRange, scale: float, *traces: np.ndarray) -> tuple[float, float]:
    """Ends of the axis of a cell whose term has the size `scale`; NaN without finite values."""
    finite = np.concatenate(traces)
    finite = finite[np.isfinite(finite)]
    if not finite.size:
        return math.nan, math.nan
    if not finite.any():
        return -1.0, 1.0
    middle = 0.5 * (finite.min() + finite.max())
    return sticky.fit(*traces, np.array([middle - 0.005 * scale, middle + 0.005 * scale]))


_TICK_WORDS = "const k = shown.data.at.indexOf(tick)\nreturn k < 0 ? '' : shown.data.words[k]"


def axes_when_zoomed(
    plot: figure,
    cells: Sequence[Cell],
    scale_of: str,
    sources: Sequence[models.ColumnDataSource],
    **known: Any,
) -> None:
    """Show the axes of a bare figure while it is zoomed into.

    Parameters
    ----------
    cells
        one for each of NAMES.
    scale_of
        JavaScript body of a function of `k`, the number of a cell. It returns the quantities of its
        sides, ``{x: side, y: side}``, each ``{first, last, factor, unit, words}``. The axis writes
        places divided by `factor`; empty `words` stand for the name of the cell.
    sources
        sources whose new data may change these; the function finds them under this name.
    known
        further models of the function, by name.
    """
    axes = []
    for axis in (plot.xaxis[0], plot.yaxis[0]):
        shown = models.ColumnDataSource({"at": [], "words": []}, syncable=False)
        axis.ticker = models.FixedTicker(ticks=[], minor_ticks=[], syncable=False)
        axis.formatter = models.CustomJSTickFormatter(args={"shown": shown}, code=_TICK_WORDS)
        axis.syncable = False  # only the browser shows and hides it
        axes.append([axis, axis.ticker, shown])
    follow = models.CustomJS(
        args={
            "plot": plot,
            "axes": axes,
            "cells": [[cell.left, cell.right, cell.bottom, cell.top] for cell in cells],
            "cell_names": NAMES,
            "sources": list(sources),
            "home": [[shown.start, shown.end] for shown in (plot.x_range, plot.y_range)],
            **known,
        },
        code=f"{style.JS_PREFIX}const scale_of = (k) => {{{scale_of}}}\n"
        + asset_text("cell_axes.js"),
    )
    for end in ("start", "end"):
        plot.x_range.js_on_change(end, follow)
        plot.y_range.js_on_change(end, follow)
    for source in sources:
        source.js_on_change("data", follow)
