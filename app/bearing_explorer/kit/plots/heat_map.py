"""Heat maps: numbers on a grid as a picture, read under the pointer, clicked to go there.

Every heat map of the page is read and clicked by the same scripts, see `let_point`; what draws it
is a `GridImage`, or a canvas of sixteen maps.

The packed source carries columns of floats, so a picture travels as one column: a head that says
where the grid lies and which quantities its sides are, then the values of each layer, row by row
from below.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from bokeh.events import DoubleTap, Tap
from bokeh.models import (
    ColorBar,
    ColorMapper,
    ColumnDataSource,
    CustomJS,
    CustomJSHover,
    GlyphRenderer,
    HoverTool,
    LinearColorMapper,
    Plot,
    Range1d,
)
from bokeh.palettes import Viridis256
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearingcore.fields import Field

_NO_SIDES: dict[str, list[float]] = {"across": [], "up": []}
"""Sides of a grid before the first numbers."""

CLEAR = "#00000000"
"""Transparent."""

_HEAD = 9
_PLACE = asset_text("heat_map_place.js")
TOOLTIP = (
    f'<div style="font: 12px {style.FONT.replace(chr(34), "")}; line-height: 1.45">'
    "$x{custom}<br>$y{custom}<br><b>$sx{custom}</b></div>"
)
"""Text under the pointer: both places and the value."""
VALUE_FIELDS = {"$x": "x", "$y": "y", "$sx": "value"}
"""Meaning of the fields of TOOLTIP. The value is none of Bokeh's own, which writes NaN itself."""


@dataclass(frozen=True)
class Side:
    """Quantity along a side of a grid.

    `name`: of the quantity that a click sets, `sign` times what is read; empty where it sets none.
    """

    name: str
    words: str
    symbol: str
    unit: str
    sign: float = 1.0

    @classmethod
    def of(cls, field: Field) -> Side:
        """The side for a field of the scene."""
        minus = "−" if field.read_sign < 0.0 else ""
        symbol = minus + field.symbol.replace("_", "")
        return cls(field.key, field.read_label, symbol, field.shown_unit, field.read_sign)

    @property
    def quantity(self) -> style.AxisQuantity:
        """The side for an axis."""
        return style.AxisQuantity(self.words, self.symbol, self.unit)

    @property
    def label(self) -> str:
        """Text of an axis."""
        return self.quantity.label()

    def for_browser(self) -> dict[str, str | float]:
        """The side for the scripts."""
        unit = self.unit if self.unit in ("", "°") else f" {self.unit}"
        return {"name": self.name, "words": self.words, "unit": unit, "sign": self.sign}


def scale_by(shown: Range1d, mapper: LinearColorMapper) -> None:
    """Have the ends of a range be those of a colour scale."""
    mapper.update(low=shown.start, high=shown.end, syncable=False)
    code = "mapper.setv({low: shown.start, high: shown.end})"
    follow = CustomJS(args={"mapper": mapper, "shown": shown}, code=code)
    shown.js_on_change("start", follow)
    shown.js_on_change("end", follow)


def let_point(
    plot: Plot,
    image: ColumnDataSource,
    sides: Sequence[Side],
    renderers: Sequence[GlyphRenderer],
    say: str,
    layers: Sequence[Any] = (),
    *,
    stands: ColumnDataSource | None = None,
    count: int = 1,
    digits: int | None = None,
    tooltip: str = TOOLTIP,
    fields: Mapping[str, str] = VALUE_FIELDS,
    **args: Any,
) -> None:
    """Show the value under the pointer, without the server, and have a click go there.

    A click sets the quantities of both sides to those of the place clicked at. Two clicks do not:
    they bring a figure that is zoomed back, see heat_map_click.js.

    Parameters
    ----------
    image
        Bokeh's source of the pictures: image, x, y, dw, dh.
    sides
        all quantities that a side may have; the first to the right and the second upwards where
        no source says which (``across``, ``up``).
    renderers
        that are pointed at.
    say
        JavaScript: body of a function of `cell`, the numbers of all `layers` there, and `at`, the
        place; it returns their meaning as text.
    stands
        the source that says so, and the values at the ends (``x_first``, ``x_last``, ``y_first``,
        ``y_last``) where these are not the ends of the picture.
    count
        how many pictures of the source are maps.
    digits
        places are those of the middles of cells, or with this the very ones, rounded to as many
        digits behind the point.
    fields
        content of the fields of the tooltip: "x", "y" or "value".
    args
        models and numbers that `say` knows besides.
    """
    places = {
        "image": image,
        "stands": stands,
        "count": count,
        "digits": digits,
        "sides": [side.for_browser() for side in sides],
    }
    click = CustomJS(args=places, code=_PLACE + asset_text("heat_map_click.js"))
    plot.js_on_event(Tap, click)
    plot.js_on_event(DoubleTap, click)
    code = f"{style.JS_PREFIX}{_PLACE}const say = (cell, at) => {{{say}}}\n" + asset_text(
        "heat_map_read.js"
    )
    known = {**places, "layers": list(layers), **args}
    plot.add_tools(
        HoverTool(
            renderers=list(renderers),
            visible=False,  # no button: it is always on
            point_policy="follow_mouse",
            tooltips=tooltip,
            formatters={
                field: CustomJSHover(args={**known, "wanted": wanted}, code=code)
                for field, wanted in fields.items()
            },
        )
    )


BAR_LOOK: dict[str, Any] = {
    "width": 10,
    "major_tick_line_color": None,
    "major_label_text_font": style.FONT,
    "major_label_text_font_size": style.SMALL_TEXT_SIZE,
    "major_label_text_color": style.FAINT_INK,
    "title_text_font": style.FONT,
    "title_text_font_style": "normal",
    "title_text_font_size": style.SMALL_TEXT_SIZE,
    "title_text_color": style.INK,
    "background_fill_color": None,
}
"""Look of colour bars."""


def color_bar(mapper: ColorMapper, title: str = "", **options: Any) -> ColorBar:
    """The colour scale of a map."""
    return ColorBar(color_mapper=mapper, title=title, **{**BAR_LOOK, **options})


def bright_image(
    plot: figure,
    packed: PackedSource,
    name: str,
    shown: Range1d,
    sides: Sequence[Side],
    say: str,
    title: str,
) -> GridImage:
    """Numbers on a grid from dark to bright, with their scale, whose ends are those of `shown`.

    `name`, `sides` and `say` are those of `GridImage`; `title` is that of the scale.
    """
    plot.grid.visible = False
    mapper = LinearColorMapper(palette=list(Viridis256), nan_color=CLEAR)
    scale_by(shown, mapper)
    plot.add_layout(color_bar(mapper, title, bar_line_color=None), "right")
    return GridImage(plot, packed, name, [mapper], sides, say)


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
        all quantities that a side of the grid may have.
    say
        JavaScript: body of a function of `cell`, the numbers of all layers under the pointer,
        which returns their meaning as text.
    """

    def __init__(
        self,
        plot: figure,
        packed: PackedSource,
        name: str,
        mappers: Sequence[ColorMapper],
        sides: Sequence[Side],
        say: str,
    ) -> None:
        self.name = name
        self._sides = list(sides)
        self._n_layers = len(mappers)
        cells = packed.source(name, "packed")
        blank = {"x": [0.0], "y": [0.0], "dw": [1.0], "dh": [1.0], "alpha": [0.0]}
        layers = [
            ColumnDataSource({"image": [np.zeros((1, 1), np.float32)], **blank}, syncable=False)
            for _ in mappers
        ]
        drawn = [
            plot.image(
                "image", "x", "y", "dw", "dh", source=layer, color_mapper=mapper,
                global_alpha="alpha", level="image",
            )
            for layer, mapper in zip(layers, mappers, strict=True)
        ]  # fmt: skip
        plot.toolbar_inner = False  # it would lie on the picture
        axes = {"x_axis": plot.xaxis[0], "y_axis": plot.yaxis[0]}
        for axis in axes.values():
            axis.syncable = False  # or the server would hear of each change of its label
        stands = ColumnDataSource(_NO_SIDES, syncable=False)
        args = {**axes, "layers": layers, "stands": stands, "head": _HEAD}
        labels = [side.label for side in self._sides]
        cells.js_on_change(
            "data", CustomJS(args={**args, "labels": labels}, code=asset_text("heat_map.js"))
        )
        let_point(plot, layers[0], self._sides, drawn[:1], say, layers, stands=stands)

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


def ends(values: NDArray[np.float64]) -> tuple[float, float]:
    """Where cells around evenly spaced values begin and end."""
    half = 0.5 * float(values[1] - values[0])
    return float(values[0]) - half, float(values[-1]) + half
