"""Numbers on a grid as a picture: sent through the wire, read under the pointer, clicked to go.

The wire carries columns of floats, so a picture travels as one column: a head that says where the
grid lies and which quantities its sides are, then the values of each layer, row by row from below.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from bokeh.events import Tap
from bokeh.models import ColorMapper, ColumnDataSource, CustomJS, CustomJSHover, HoverTool
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.assets import asset_text
from bearing_explorer.server.packed_source import Wire
from bearing_explorer.state.quantity_list import Quantity

CLEAR = "#00000000"
"""No colour at all: what lies below is seen."""

_HEAD = 9
_TOOLTIP = (
    '<div style="font: 12px system-ui, sans-serif; line-height: 1.45">'
    "$x{custom}<br>$y{custom}<br><b>@image{custom}</b></div>"
)


@dataclass(frozen=True)
class Side:
    """What a side of a grid stands for.

    `name`: of the quantity that a click sets; empty where it sets none.
    """

    name: str
    words: str
    symbol: str
    unit: str

    @classmethod
    def of(cls, quantity: Quantity) -> Side:
        """The side for a quantity of the page."""
        symbol = re.sub(r"<[^>]*>", "", quantity.symbol)
        return cls(quantity.name, quantity.label, symbol, quantity.unit)

    @property
    def label(self) -> str:
        """Text of an axis."""
        words = f"{self.words} {self.symbol}".strip()
        return f"{words} ({self.unit})" if self.unit else words

    def for_browser(self) -> dict[str, str]:
        """What the scripts need to know."""
        unit = self.unit if self.unit in ("", "°") else f" {self.unit}"
        return {"name": self.name, "words": self.words, "unit": unit, "label": self.label}


class GridImage:
    """Layers of one grid in a figure, drawn one over the other.

    Parameters
    ----------
    plot
        the figure they are drawn in.
    name
        of the source, one per session.
    mappers
        colour of each layer's numbers; NaN should be transparent.
    sides
        everything that a side of the grid may stand for.
    say
        JavaScript: body of a function of `cell`, the numbers of all layers under the pointer,
        which returns what they mean.
    """

    def __init__(
        self,
        plot: figure,
        wire: Wire,
        name: str,
        mappers: Sequence[ColorMapper],
        sides: Sequence[Side],
        say: str,
    ) -> None:
        self.name = name
        self._sides = list(sides)
        self._n_layers = len(mappers)
        cells = wire.source(name, "packed")
        blank = {"x": [0.0], "y": [0.0], "dw": [1.0], "dh": [1.0], "alpha": [0.0]}
        layers = [
            ColumnDataSource({"image": [np.zeros((1, 1), np.float32)], **blank}, syncable=False)
            for _ in mappers
        ]
        self.renderers = [
            plot.image(
                "image", "x", "y", "dw", "dh", source=layer, color_mapper=mapper,
                global_alpha="alpha", level="image",
            )
            for layer, mapper in zip(layers, mappers, strict=True)
        ]  # fmt: skip
        plot.toolbar_inner = False  # it would lie on the picture
        known = [side.for_browser() for side in self._sides]
        shared = {"quantities": known, "head": _HEAD}
        axes = {"x_axis": plot.xaxis[0], "y_axis": plot.yaxis[0]}
        for axis in axes.values():
            axis.syncable = False  # or each change of its label would be told to the server
        cells.js_on_change(
            "data",
            CustomJS(args={**shared, **axes, "layers": layers}, code=asset_text("heat_map.js")),
        )
        plot.js_on_event(
            Tap, CustomJS(args={**shared, "cells": cells}, code=asset_text("grid_click.js"))
        )
        code = f"const say = (cell) => {{{say}}}\n" + asset_text("grid_read.js")
        args = {**shared, "cells": cells, "n_layers": self._n_layers}
        readers = {
            field: CustomJSHover(args={**args, "wanted": wanted}, code=code)
            for field, wanted in (("$x", "x"), ("$y", "y"), ("@image", "value"))
        }
        plot.add_tools(
            HoverTool(
                renderers=self.renderers[:1],
                visible=False,  # no button: it is always on
                point_policy="follow_mouse",
                tooltips=_TOOLTIP,
                formatters=readers,
            )
        )

    def columns(
        self,
        x: tuple[Side, NDArray[np.float64]],
        y: tuple[Side, NDArray[np.float64]],
        layers: Sequence[NDArray[np.float64]],
        alpha: float = 1.0,
    ) -> dict[str, np.ndarray]:
        """The source's columns: values (ny, nx) of each layer at evenly spaced places x, y.

        The places are in the units of their sides.
        """
        (x_side, x_values), (y_side, y_values) = x, y
        left, right = ends(x_values)
        bottom, top = ends(y_values)
        head = [
            x_values.size, y_values.size, left, right - left, bottom, top - bottom, alpha,
            self._sides.index(x_side), self._sides.index(y_side),
        ]  # fmt: skip
        assert len(layers) == self._n_layers
        return {"packed": np.concatenate([head, *(np.ravel(layer) for layer in layers)])}

    def nothing(self) -> dict[str, np.ndarray]:
        """The source's columns while there is nothing to draw."""
        return {"packed": np.zeros(0)}


def ends(values: NDArray[np.float64]) -> tuple[float, float]:
    """Where cells around evenly spaced values begin and end."""
    half = 0.5 * float(values[1] - values[0])
    return float(values[0]) - half, float(values[-1]) + half
