"""Figures of the paper, drawn anew in its layout, with printed values and where it slips."""

from __future__ import annotations

import html
import re
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import bokeh.plotting
import numpy as np
from bokeh.models import LayoutDOM, LinearColorMapper, Range1d

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.paper_figures import FIGURES, Panel, PaperFigure
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.color_scales import DIVERGING, SEQUENTIAL, hex_colors
from bearing_explorer.kit.plots.heat_map import color_bar
from bearing_explorer.kit.plots.plane import color_limits
from bearing_explorer.kit.plots.zoom import zoomable
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearing_explorer.kit.widgets.facts import facts_pane, html_table
from bearing_explorer.kit.widgets.form import button, row, stack
from bearingcore import Scene

_OF_COMPARED = tuple(zip(("Green", "Pink"), compared_curves.COLORS, strict=False))
_GRID = """
:host {{
  display: grid;
  min-height: auto !important;
  grid-template-columns: repeat(auto-fit, minmax(max(270px, calc(100% / {columns} - 1px)), 1fr));
}}
.scroll-button {{ display: none; }}
"""
"""As many columns as in the paper, fewer where a panel would be too narrow."""


class PaperFigures(View):
    """One figure of the paper at a time; a button for each."""

    name = "paper"
    title = "Figures of the paper"
    about = "Figures 3 to 10 of the paper, computed anew. Petersen, Howard and Prime (2014)."
    in_report = False
    computes = True

    def build(self, packed: PackedSource) -> Any:
        self._figure, self._drawn = FIGURES[0], 0
        self._made: tuple[PaperFigure, list[bokeh.plotting.figure], str] | None = None
        self._buttons = {
            one.number: button(f"Figure {one.number}", partial(self._show, one)) for one in FIGURES
        }
        self._live = button("Open it live", self._open_live, css_classes=["main"])
        self._panels = stack(sizing_mode="stretch_both")
        self._numbers = facts_pane(sizing_mode="stretch_width")
        return [row(*self._buttons.values(), self._live), self._panels, self._numbers]

    def _show(self, figure: PaperFigure) -> None:
        """Draw a figure, and set the sliders to its scene."""
        self._figure = figure
        self._open(figure, self.name, compared=False)

    def _open_live(self) -> None:
        """The tab of the figure, with its other scenes as compared ones."""
        self._open(self._figure, self._figure.tab, compared=True)

    def _open(self, figure: PaperFigure, tab: str, compared: bool) -> None:
        if self.parts is not None:
            self.parts.open_link(f"Figure {figure.number}", figure.link(tab, compared))

    def choices(self) -> dict[str, Any]:
        return {"figure": self._figure.number}

    def choose(self, choices: Mapping[str, Any], results: Results) -> None:
        numbers = {figure.number: figure for figure in FIGURES}
        number = choices.get("figure", FIGURES[0].number)
        if number not in numbers:
            raise ValueError(f"figure is {number!r}; it can be {', '.join(map(str, numbers))}")
        self._figure = numbers[number]

    def scene_drawn(self, results: Results) -> Scene:
        return self._figure.scenes[-1]

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        figure = self._figure
        if self._made is None or self._made[0] is not figure:
            plots = [_plot(panel, figure) for panel in figure.panels]
            self._made = figure, plots, _numbers(figure)
        return {}, {}

    def sentence(self, results: Results) -> str:
        figure = self._figure
        bearing = "Liew and Lim's bearing" if figure.preset == "liew-lim" else "the fan rig"
        return f"Figure {figure.number} is of {bearing}, independent of the sliders."

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if self._made is None:
            return
        figure, plots, numbers = self._made
        line = f"Figure {figure.number}: {figure.title}. {_key(figure)}"
        self._caption.put(figures=[plot.id for plot in plots], line=line)
        if figure.number == self._drawn:
            return
        self._drawn = figure.number
        self._panels.stylesheets = [_GRID.format(columns=figure.columns)]
        self._panels.objects = plots
        self._numbers.object = numbers
        self._live.label = f"Open it on the tab {figure.tab.capitalize()}"
        for number, one in self._buttons.items():
            one.css_classes = ["main"] if number == figure.number else []
        self.figures = plots

    def still_figures(self) -> Sequence[LayoutDOM]:
        return [] if self._made is None else self._made[1]

    def table(self, results: Results) -> dict[str, np.ndarray]:
        columns: dict[str, np.ndarray] = {}
        for panel in self._figure.panels:
            for extent, scene in zip(self._figure.extents_deg, self._figure.scenes, strict=True):
                if panel.extents_deg is None or extent in panel.extents_deg:
                    for number, line in enumerate(panel.curves(scene)):
                        name = f"{panel.title} {extent:g}° {number or ''}".strip()
                        columns |= {f"{name} x": line.x, f"{name} y": line.y}
        return columns


def _looks(figure: PaperFigure) -> dict[float, tuple[str, str]]:
    """Name and colour of the curves of each extent; the last is that of the sliders, blue."""
    own = [extent for extent in figure.extents_deg if extent]
    looks = [*_OF_COMPARED[: len(own) - 1], ("Blue", style.DEFECTIVE)]
    return {0.0: ("Grey", style.HEALTHY), **dict(zip(own, looks, strict=True))}


def _key(figure: PaperFigure) -> str:
    """Which curve is which, in words."""
    if len(figure.extents_deg) == 1:
        return ""
    looks = _looks(figure)
    words = {extent: f"{extent:g}°" if extent else "without defect" for extent in looks}
    return " ".join(f"{looks[e][0]}: {words[e]}." for e in figure.extents_deg)


def _numbers(figure: PaperFigure) -> str:
    """Printed values and ours as a table, and the errors of the paper."""
    rows = (
        [_symbols(one.name), html.escape(one.paper), html.escape(one.ours(figure.scenes))]
        for one in figure.printed
    )
    slip = f"<p><b>Errors in the paper.</b> {_symbols(figure.slip)}</p>" if figure.slip else ""
    return html_table(("", "Paper", "Here"), rows, named=True) + slip


def _symbols(words: str) -> str:
    """Words as HTML, with what is behind "_" below the letter before it."""
    return re.sub(r"_(\w+)", r"<sub>\1</sub>", html.escape(words))


def _plot(panel: Panel, figure: PaperFigure) -> bokeh.plotting.figure:
    """A panel with the curves of its scenes."""
    x0, x1, y0, y1 = panel.shown
    ranges = Range1d(x0, x1), Range1d(y0, y1)
    if not panel.title:
        plot = style.bare_figure(*ranges, height=280, sizing_mode="fixed", width=330)
    else:
        plot = style.make_figure(
            panel.x, panel.y, *ranges, height=230, title=panel.title, min_width=200
        )
    if panel.grid is not None:
        quantity, values = panel.grid
        _draw_map(plot, panel.shown, quantity, values(figure.scenes[-1]))
    looks = _looks(figure)
    for extent, scene in zip(figure.extents_deg, figure.scenes, strict=True):
        if panel.extents_deg is not None and extent not in panel.extents_deg:
            continue
        color = looks[extent][1]
        for low, high in panel.shaded(scene):
            plot.vstrip(low, high, fill_color=color, fill_alpha=0.15, line_color=None)
        for line in panel.curves(scene):
            plot.line(line.x, line.y, line_color=color, line_width=line.width)
    zoomable(plot, equal_aspect=not panel.title)
    return plot


def _draw_map(
    plot: bokeh.plotting.figure,
    shown: Sequence[float],
    quantity: style.AxisQuantity,
    values: np.ndarray,
) -> None:
    x0, x1, y0, y1 = shown
    low, high = color_limits(values)
    palette = hex_colors(DIVERGING if low == -high else SEQUENTIAL)
    mapper = LinearColorMapper(palette=palette, low=low, high=high)
    plot.image([values], x=x0, y=y0, dw=x1 - x0, dh=y1 - y0, color_mapper=mapper)
    bar = color_bar(mapper, width=10)
    style.write_units(bar, quantity, Range1d(low, high))
    plot.add_layout(bar, "right")
