"""Heat maps: a grid of numbers as a picture. The pointer reads a value; a click goes to its place.

The same scripts do that for all heat maps of the page, see `let_point`. A heat map is drawn by a
`GridImage`, or by a canvas of sixteen maps.

The packed source carries columns of floats, so a picture travels as one column: a head that says
where the grid lies, then the values, row by row from below.
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

CLEAR = "#00000000"
"""Transparent."""

_PLACE = asset_text("heat_map_place.js")
TOOLTIP = (
    f'<div style="font: 12px {style.FONT.replace(chr(34), "")}; line-height: 1.45">'
    "$x{custom}<br>$y{custom}<br><b>$sx{custom}</b></div>"
)
"""Text under the pointer: both places and the value."""
VALUE_FIELDS = {"$x": "x", "$y": "y", "$sx": "value"}
"""Meaning of the fields of TOOLTIP. A value has no field of Bokeh's own: that would write "NaN"."""


@dataclass(frozen=True)
class Side:
    """Quantity along a side of a grid.

    A click sets the quantity `name` to `sign` times the value read; an empty `name`: nothing.
    """

    name: str
    words: str
    symbol: str
    unit: str
    sign: float = 1.0

    @classmethod
    def of(cls, field: Field) -> Side:
        """Return the side for a field of the scene."""
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

    def browser_data(self) -> dict[str, str | float]:
        """The side for the scripts."""
        unit = self.unit if self.unit in ("", "°") else f" {self.unit}"
        return {"name": self.name, "words": self.words, "unit": unit, "sign": self.sign}


def let_point(
    plot: Plot,
    image: ColumnDataSource,
    sides: Sequence[Side],
    renderers: Sequence[GlyphRenderer],
    say: str,
    *,
    stands: ColumnDataSource | None = None,
    count: int = 1,
    digits: int | None = None,
    tooltip: str = TOOLTIP,
    fields: Mapping[str, str] = VALUE_FIELDS,
    **args: Any,
) -> None:
    """Show the value under the pointer, without the server, and have a click go there.

    A click sets the quantities of both sides to their values at that place. A double click only
    resets the zoom of the figure, see heat_map_click.js.

    Parameters
    ----------
    image
        Bokeh's source of the pictures: image, x, y, dw, dh.
    sides
        all quantities that a side may have; without `stands`, the first lies to the right and the
        second upwards.
    renderers
        pictures from which the pointer reads values.
    say
        JavaScript: body of a function of `cell`, the number there, and `at`, the place; it returns
        its meaning as text.
    stands
        source of the sides (``across``, ``up``), and of the values at the ends (``x_first``,
        ``x_last``, ``y_first``, ``y_last``) if these are not the ends of the picture.
    count
        number of pictures of the source that are maps.
    digits
        number of decimals of a place; without it, a place is the middle of a cell.
    fields
        content of the fields of the tooltip: "x", "y" or "value".
    args
        further models and numbers that `say` uses.
    """
    places = {
        "image": image,
        "stands": stands,
        "count": count,
        "digits": digits,
        "sides": [side.browser_data() for side in sides],
    }
    click = CustomJS(args=places, code=_PLACE + asset_text("heat_map_click.js"))
    plot.js_on_event(Tap, click)
    plot.js_on_event(DoubleTap, click)
    code = f"{style.JS_PREFIX}{_PLACE}const say = (cell, at) => {{{say}}}\n" + asset_text(
        "heat_map_read.js"
    )
    plot.add_tools(
        HoverTool(
            renderers=list(renderers),
            visible=False,  # no button: it is always on
            point_policy="follow_mouse",
            tooltips=tooltip,
            formatters={
                field: CustomJSHover(args={**places, **args, "wanted": wanted}, code=code)
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
    """Return the colour scale of a map."""
    return ColorBar(color_mapper=mapper, title=title, **{**BAR_LOOK, **options})


class GridImage:
    """A grid of numbers from dark to bright, with a colour scale between the ends of `shown`.

    Parameters
    ----------
    plot
        the figure in which it is drawn.
    name
        of the source, one per session.
    sides
        the quantities to the right and upwards.
    say
        JavaScript: body of a function of `cell`, the number under the pointer, which returns its
        meaning as text.
    title
        of the scale.
    """

    def __init__(
        self,
        plot: figure,
        packed: PackedSource,
        name: str,
        shown: Range1d,
        sides: Sequence[Side],
        say: str,
        title: str,
    ) -> None:
        plot.grid.visible = False
        plot.toolbar_inner = False  # it would cover the picture
        mapper = LinearColorMapper(palette=list(Viridis256), nan_color=CLEAR)
        mapper.update(low=shown.start, high=shown.end, syncable=False)
        scale = "mapper.setv({low: shown.start, high: shown.end})"
        follow = CustomJS(args={"mapper": mapper, "shown": shown}, code=scale)
        for end in ("start", "end"):
            shown.js_on_change(end, follow)
        plot.add_layout(color_bar(mapper, title, bar_line_color=None), "right")
        cells = packed.source(name, "packed")
        blank = {"x": [0.0], "y": [0.0], "dw": [1.0], "dh": [1.0], "alpha": [0.0]}
        image = ColumnDataSource({"image": [np.zeros((1, 1), np.float32)], **blank}, syncable=False)
        drawn = plot.image(
            "image", "x", "y", "dw", "dh", source=image, color_mapper=mapper,
            global_alpha="alpha", level="image",
        )  # fmt: skip
        cells.js_on_change("data", CustomJS(args={"image": image}, code=asset_text("heat_map.js")))
        let_point(plot, image, sides, [drawn], say)

    def columns(
        self,
        x: NDArray[np.float64],
        y: NDArray[np.float64],
        values: NDArray[np.float64],
        alpha: float = 1.0,
    ) -> dict[str, np.ndarray]:
        """Return the source's columns for values (ny, nx) at evenly spaced places x, y."""
        (left, right), (bottom, top) = ends(x), ends(y)
        head = [x.size, y.size, left, right - left, bottom, top - bottom, alpha]
        return {"packed": np.concatenate([head, np.ravel(values)])}


def ends(values: NDArray[np.float64]) -> tuple[float, float]:
    """Return the outer ends of the cells around evenly spaced values."""
    half = 0.5 * float(values[1] - values[0])
    return float(values[0]) - half, float(values[-1]) + half
