"""Axes of a drawing of many cells, each of which has axes of its own.

The numbers of a cell are next to it, out of sight while the cell fills the frame: then the
drawing's own axes show, with the numbers of the cells in view, see cell_axes.js.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bokeh.models import ColumnDataSource, CustomJS, CustomJSTickFormatter, FixedTicker
from bokeh.plotting import figure

from bearing_explorer.assets import asset_text
from bearing_explorer.plots import style
from bearing_explorer.plots.matrix_cells import Cell

_WORDS = "const k = shown.data.at.indexOf(tick)\nreturn k < 0 ? '' : shown.data.words[k]"


def axes_when_zoomed(
    plot: figure,
    cells: Sequence[Cell],
    names: Sequence[str],
    scale_of: str,
    sources: Sequence[ColumnDataSource],
    **known: Any,
) -> None:
    """Show the axes of a bare figure while it is zoomed into.

    Parameters
    ----------
    names
        of the cells.
    scale_of
        JavaScript: body of a function of `k`, a cell, which returns the quantities of its sides:
        ``{x: side, y: side}``, each ``{first, last, factor, unit, words}``. What is written is a
        place over `factor`; empty `words` stand for the name of the cell.
    sources
        sources whose news change that; the function knows them as `sources`.
    known
        further models that it knows.
    """
    axes = []
    for axis in (plot.xaxis[0], plot.yaxis[0]):
        shown = ColumnDataSource({"at": [], "words": []}, syncable=False)
        axis.ticker = FixedTicker(ticks=[], minor_ticks=[], syncable=False)
        axis.formatter = CustomJSTickFormatter(args={"shown": shown}, code=_WORDS)
        axis.syncable = False  # it is the browser that shows and hides it
        axes.append([axis, axis.ticker, shown])
    follow = CustomJS(
        args={
            "plot": plot,
            "axes": axes,
            "cells": [[cell.left, cell.right, cell.bottom, cell.top] for cell in cells],
            "cell_names": list(names),
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
