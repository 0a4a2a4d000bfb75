"""The house style for HoloViews: dimensions out of quantities, axes that choose their prefix."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import holoviews as hv
import numpy as np
from bokeh.models import ColorBar, Range1d
from numpy.typing import NDArray

from bearing_explorer.plots import style
from bearing_explorer.plots.color_scales import DIVERGING, SEQUENTIAL
from bearing_explorer.plots.style import AxisQuantity

WIDTH, HEIGHT = 560, 320
"""[px] of a figure in a notebook."""


def dimension(name: str, quantity: AxisQuantity, **more: Any) -> hv.Dimension:
    """A dimension called `name`, with the words and the unit of an axis of the page."""
    return hv.Dimension(name, label=quantity.words, unit=quantity.unit or None, **more)


class Axes:
    """A hook that gives a figure the page's look, and axes that write their own units.

    HoloViews calls hooks again whenever a figure is updated; what follows by itself is done once,
    as is what is to be done to `each` figure.
    """

    def __init__(
        self,
        x: AxisQuantity,
        y: AxisQuantity,
        color: AxisQuantity | None = None,
        each: Callable[[Any, Any], None] | None = None,
    ) -> None:
        self.x, self.y, self.color, self.each = x, y, color, each

    def __call__(self, plot: Any, element: Any) -> None:
        done = plot.handles.setdefault("house", set())
        handles = plot.handles
        for name, quantity in (("x", self.x), ("y", self.y)):
            axis = handles.get(f"{name}axis")
            if axis is None or name in done:
                continue
            done.add(name)
            style.style_axis(axis)
            style.write_units(axis, quantity, handles[f"{name}_range"])
        bar = handles.get("colorbar")
        if bar is not None and self.color is not None:
            self._write_bar(handles)
        if "figure" not in done:
            done.add("figure")
            if self.each is not None:
                self.each(plot, element)
            figure = handles["plot"]
            figure.output_backend = "canvas"
            figure.toolbar.autohide = True
            figure.toolbar.logo = None
            figure.outline_line_color = None
            figure.background_fill_color = figure.border_fill_color = style.PAPER
            figure.title.text_font = style.FONT
            figure.title.text_font_size = style.TEXT_SIZE
            figure.title.text_font_style = "normal"
            figure.title.text_color = style.FAINT_INK
            figure.grid.grid_line_color = style.GRID
            for legend in figure.legend:
                legend.label_text_font = style.FONT
                legend.label_text_font_size = style.SMALL_TEXT_SIZE
                legend.border_line_color = None
                legend.background_fill_alpha = 0.7

    def _write_bar(self, handles: dict[str, Any]) -> None:
        """Title and numbers of the colour bar, with the prefix that its ends ask for."""
        assert self.color is not None
        bar, mapper = handles["colorbar"], handles["color_mapper"]
        if "bar_range" not in handles:
            handles["bar_range"] = Range1d(mapper.low, mapper.high)
            _style_bar(bar)
            style.write_units(bar, self.color, handles["bar_range"])
        handles["bar_range"].update(start=mapper.low, end=mapper.high)


def _style_bar(bar: ColorBar) -> None:
    bar.width = 10
    bar.bar_line_color = style.STEEL_EDGE
    bar.major_tick_line_color = None
    bar.major_label_text_font = bar.title_text_font = style.FONT
    bar.title_text_font_style = "normal"
    bar.major_label_text_font_size = bar.title_text_font_size = style.SMALL_TEXT_SIZE
    bar.major_label_text_color = style.FAINT_INK
    bar.title_text_color = style.INK
    bar.background_fill_color = None


_PALETTES = {
    "sequential": ["#{:02x}{:02x}{:02x}".format(*rgb) for rgb in SEQUENTIAL],
    "diverging": ["#{:02x}{:02x}{:02x}".format(*rgb) for rgb in DIVERGING],
}


def color_scale(values: NDArray[np.float64]) -> tuple[list[str], tuple[float, float]]:
    """Palette and limits for numbers: light at zero where they have both signs."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    if low < 0.0 < high:
        most = max(-low, high)
        return _PALETTES["diverging"], (-most, most)
    if not high > low:
        half = 0.5 * abs(low) or 0.5
        low, high = low - half, high + half
    return _PALETTES["sequential"], (low, high)


def curve_options(axes: Axes, **more: Any) -> dict[str, Any]:
    """Options of a figure of curves."""
    return {
        "width": WIDTH,
        "height": HEIGHT,
        "show_grid": True,
        "hooks": [axes],
        "active_tools": [],
        "default_tools": ["save", "pan", "box_zoom", "reset"],
        **more,
    }
