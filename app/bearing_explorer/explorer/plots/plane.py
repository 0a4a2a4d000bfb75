"""A map over two quantities, with a curve across it each way, as HoloViews.

`layout_of` returns the objects, for a notebook. `PlaneFigures` draws the same on a page: HoloViews
makes the plots once and reports where the pointer is. Later maps go straight into the sources of
these plots, because new elements from a stream take twice as long as all the rest of a change.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import holoviews as hv
import holoviews.plotting.bokeh  # registers the options of `opts`
import numpy as np
from bokeh.models import CustomJSHover, HoverTool, Range1d
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.color_scales import DIVERGING, SEQUENTIAL, hex_colors
from bearing_explorer.kit.plots.heat_map import BAR_LOOK, CLEAR, Side, ends
from bearing_explorer.kit.sentences import with_unit
from bearing_explorer.kit.serve.live import one_message, run_on_loop
from bearingcore.common import PREFIXES, prefix_power
from bearingcore.fields import FIELD_OF

if TYPE_CHECKING:
    from xarray import DataArray

hv.Store.set_current_backend("bokeh")  # hv.extension would make network requests
SECOND_CLICK = 0.32
"""Time [s] that a click on a zoomed map waits for a second click."""
WAYS = ("up", "across")
"""Names of the two sections of a map."""
_NO_PREFIX = ("", "°", "kg", "kg·m²")
_PALETTES = {True: hex_colors(DIVERGING), False: hex_colors(SEQUENTIAL)}

_ROUNDED = f"{style.JS_PREFIX}return isNaN(value) ? 'no answer' : rounded(value, 4)"
_TOOLTIP = f'<div style="{style.HTML_FONT}">{{}}</div>'


@dataclass(frozen=True, eq=False)
class Field:
    """Numbers over a plane of two quantities.

    Attributes
    ----------
    x, y
        the quantities of the sides, and evenly spaced values in their units, (nx,) and (ny,).
    words, unit
        words for the numbers, and their unit.
    values : (ny, nx)
        NaN where there is no answer.
    reasons : (ny, nx)
        why there is no answer.
    """

    x: tuple[Side, NDArray[np.float64]]
    y: tuple[Side, NDArray[np.float64]]
    words: str
    unit: str
    values: NDArray[np.float64]
    reasons: NDArray[np.object_]

    @classmethod
    def of_sweep(cls, output: DataArray) -> Field:
        """One output of a sweep over two fields, angles in degrees.

        ValueError for another number of fields, or values that are not evenly spaced.
        """
        if output.ndim != 2:
            raise ValueError(f"dimensions are {output.dims}; allowed: two, choose with .sel(...)")
        output = output.sortby(list(output.dims))
        y, x = ((Side("", *of), at) for of, at in (_page_numbers(output[d]) for d in output.dims))
        for side, at in (x, y):
            if np.ptp(np.diff(at)) > 1e-3 * (at[1] - at[0]):
                raise ValueError(f"{side.words} is {at}; allowed: evenly spaced values")
        (words, _, unit), values = _page_numbers(output)
        reasons = np.where(np.isfinite(values), "", "see the status of the sweep").astype(object)
        return cls(x, y, words, unit, values, reasons)

    @cached_property
    def scaled(self) -> tuple[NDArray[np.float64], str]:
        """The numbers in the unit with the SI prefix that suits the greatest one, and that unit."""
        if self.unit in _NO_PREFIX:
            return self.values, self.unit
        power = prefix_power(float(np.nanmax(np.abs(self.values), initial=0.0)))
        return self.values / 10.0**power, PREFIXES[power] + self.unit

    @property
    def label(self) -> str:
        """The words with the unit."""
        return style.AxisQuantity(self.words, "", self.scaled[1]).label()

    @property
    def bounds(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Ends of the cells around the points, to the right and upwards."""
        return ends(self.x[1]), ends(self.y[1])

    @property
    def missing(self) -> dict[str, NDArray[Any]]:
        """The cells without an answer, with the reasons."""
        rows, columns = np.nonzero(np.isnan(self.values))
        (left, right), (bottom, top) = self.bounds
        width, height = (right - left) / self.x[1].size, (top - bottom) / self.y[1].size
        x, y = left + width * columns, bottom + height * rows
        reasons = self.reasons[rows, columns].astype(str)
        ends_of_cells = {"left": x, "bottom": y, "right": x + width, "top": y + height}
        return {**ends_of_cells, "reason": reasons}

    def cell_at(self, x: float | None, y: float | None) -> tuple[int, int] | None:
        """Row and column of the cell at a place; None beside the map, or without a place."""
        if x is None or y is None:
            return None
        (left, right), (bottom, top) = self.bounds
        rows, columns = self.values.shape
        row, column = rows * (y - bottom) / (top - bottom), columns * (x - left) / (right - left)
        if not (0.0 <= row <= rows and 0.0 <= column <= columns):
            return None
        return min(int(row), rows - 1), min(int(column), columns - 1)

    def section(
        self, way: str, cell: tuple[int, int] | None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], str]:
        """Places, numbers and title of the section through a cell, or through the middle."""
        rows, columns = self.values.shape
        row, column = cell or (rows // 2, columns // 2)
        (side, at), (_, places) = (self.x, self.y) if way == "up" else (self.y, self.x)
        values = self.scaled[0][:, column] if way == "up" else self.scaled[0][row]
        fixed = with_unit(at[column if way == "up" else row], side.unit, 4)
        where = f"{side.words[:1].lower()}{side.words[1:]}"
        return places, values, f"{self.words} at {where} {fixed}"


def _page_numbers(output: DataArray) -> tuple[tuple[str, str, str], NDArray[np.float64]]:
    """Words, symbol and unit of numbers, and the numbers: SI, but angles in degrees."""
    unit = str(output.attrs.get("units", ""))
    name = str(output.name)
    words = FIELD_OF[name].label if name in FIELD_OF else name.replace("_", " ")
    words = words[0].upper() + words[1:]
    values = np.asarray(output, dtype=float)
    if unit == "rad":
        return (words, "", "°"), np.degrees(values)
    return (words, "", "" if unit == "1" else unit), values


def tooltip(field: Field) -> str:
    """The text at the pointer: coordinates and number, short, so that it covers no axis."""
    numbers = ("$x", field.x[0].unit), ("$y", field.y[0].unit), ("@image", field.scaled[1])
    x, y, value = (f"{n}{{custom}}{'' if u == '°' else ' '}{u}" for n, u in numbers)
    return _TOOLTIP.format(f"{x}, {y}<br><b>{value}</b>")


def dimensions(field: Field) -> list[hv.Dimension]:
    """The sides and the numbers for HoloViews: `x`, `y` and `value`, with their labels."""
    (x, _), (y, _) = field.x, field.y
    labels = ("x", x.words, x.unit), ("y", y.words, y.unit), ("value", field.words, field.scaled[1])
    return [hv.Dimension((name, words or name), unit=unit or None) for name, words, unit in labels]


def map_of(field: Field) -> hv.Overlay:
    """The map, hatched where there is no answer, with rings for a mark that has no place yet."""
    x, y, value = dimensions(field)
    low, high = color_limits(field.scaled[0])
    image = hv.Image((field.x[1], field.y[1], field.scaled[0]), [x, y], value).opts(
        cmap=_PALETTES[low == -high], clim=(low, high), clipping_colors={"NaN": CLEAR},
        colorbar=True, colorbar_opts={**BAR_LOOK, "bar_line_color": style.STEEL_EDGE},
        default_tools=[],
        tools=[
            HoverTool(
                visible=False, point_policy="follow_mouse", tooltips=tooltip(field),
                formatters=dict.fromkeys(("$x", "$y", "@image"), CustomJSHover(code=_ROUNDED)),
            )
        ],
    )  # fmt: skip
    missing = hv.Rectangles(tuple(field.missing.values()), [x, y, "x1", "y1"], "reason").opts(
        fill_color="#B9BEC4", line_color=None, hooks=[_hatch],
        default_tools=[], tools=[HoverTool(visible=False, tooltips=_TOOLTIP.format("@reason"))],
    )  # fmt: skip
    rings = [  # dark on light, so that it shows on every colour
        hv.Points([], [x, y]).opts(
            size=15, fill_color=None, line_color=color, line_width=width, default_tools=[]
        )
        for color, width in ((style.LIGHT, 5.0), (style.SHADE, 2.0))
    ]
    return hv.Overlay([image, missing, *rings])


def _hatch(plot: Any, _: hv.Rectangles) -> None:
    plot.handles["glyph"].update(
        hatch_pattern="/", hatch_color="white", hatch_alpha=0.6, hatch_scale=8
    )


def section_of(field: Field, way: str, x: float | None = None, y: float | None = None) -> hv.Curve:
    """The section "up" or "across" through a place; without a place, through the middle."""
    places, values, title = field.section(way, field.cell_at(x, y))
    side, value = dimensions(field)[way == "up"], dimensions(field)[2]
    return hv.Curve((places, values), side, value).opts(
        color=style.DEFECTIVE, line_width=2.0, title=title, default_tools=[], framewise=True
    )


def layout_of(field: Field) -> hv.Layout:
    """The map, and its sections, which follow the pointer."""
    plane = map_of(field)
    pointer = hv.streams.PointerXY(source=plane.Image.I)
    sections = [hv.DynamicMap(partial(section_of, field, way), streams=[pointer]) for way in WAYS]
    frames = {"frame_width": 420, "frame_height": 320}
    return (
        hv.Layout([plane, *sections]).cols(2).opts(hv.opts.Image(**frames), hv.opts.Curve(**frames))
    )


class PlaneFigures:
    """The map and its sections on a page; a click on the map calls `go` with the place.

    `plots` are the plots of HoloViews, for its pane.
    """

    def __init__(self, name: str, go: Callable[[float, float], None]) -> None:
        self._field, self._mark, self._go = _BLANK, (0.0, 0.0), go
        self._going: asyncio.TimerHandle | None = None
        plane, renderer = map_of(_BLANK), hv.renderer("bokeh")
        self._streams = [
            stream(source=plane.Image.I, subscribers=[subscriber])
            for stream, subscriber in (
                (hv.streams.PointerXY, self._point),
                (hv.streams.MouseLeave, lambda **_: self._send_sections(*self._mark)),
                (hv.streams.SingleTap, self._tap),
                (hv.streams.DoubleTap, lambda **_: self._going and self._going.cancel()),
            )
        ]
        elements = [plane, *(section_of(_BLANK, way) for way in WAYS)]
        self.plots = [renderer.get_plot(element) for element in elements]
        self._image, self._missing, *self._rings = (
            plot.handles for plot in self.plots[0].subplots.values()
        )
        self.map, self.up, self.across = figures = [plot.state for plot in self.plots]
        for plot, part in zip(figures, ("map", *WAYS), strict=True):
            _house_style(plot, f"{name}_{part}")
        self.up.x_range, self.across.x_range = self.map.y_range, self.map.x_range
        self.across.y_range = self.up.y_range
        self.map.grid.visible = False
        self.map.toolbar_inner = False  # inside it would cover the map
        self.map.stylesheets = [":host { cursor: crosshair; }"]
        self.up.frame_align = False  # it needs no room for a colour bar

    def show(self, field: Field, mark: tuple[float, float], alpha: float = 1.0) -> None:
        """Draw a field, and the sections at the `mark`. Call this on the event loop only."""
        self._field, self._mark = field, mark
        values, unit = field.scaled
        (left, right), (bottom, top) = field.bounds
        self._image["source"].data = {
            "image": [values.astype(np.float32)],
            "x": [left], "y": [bottom], "dw": [right - left], "dh": [top - bottom],
        }  # fmt: skip
        self._image["glyph"].global_alpha = self._missing["glyph"].fill_alpha = alpha
        for plot in self.plots[1:]:
            plot.handles["glyph"].line_alpha = alpha
        low, high = color_limits(values)
        self._image["color_mapper"].update(low=low, high=high, palette=_PALETTES[low == -high])
        self._missing["source"].data = field.missing
        for ring in self._rings:
            ring["source"].data = {"x": [mark[0]], "y": [mark[1]]}
        known = values[np.isfinite(values)]
        least, most = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
        room = 0.06 * (most - least) or 0.06 * abs(most) or 1.0
        _move(self.map.x_range, left, right)
        _move(self.map.y_range, bottom, top)
        _move(self.up.y_range, least - room, most + room)
        (x, _), (y, _), in_unit = field.x, field.y, f"({unit})" if unit else ""
        self._image["colorbar"].title = field.label
        self.map.xaxis[0].axis_label = self.across.xaxis[0].axis_label = x.label
        self.map.yaxis[0].axis_label = self.up.xaxis[0].axis_label = y.label
        self.up.yaxis[0].axis_label = self.across.yaxis[0].axis_label = in_unit
        self._image["hover"].tooltips = tooltip(field)
        self._draw_sections(*mark)

    def _draw_sections(self, x: float, y: float) -> None:
        self._cell = self._field.cell_at(x, y)
        for way, plot in zip(WAYS, self.plots[1:], strict=True):
            places, values, title = self._field.section(way, self._cell)
            side = "y" if way == "up" else "x"
            plot.handles["source"].data = {side: places, "value": values}
            plot.state.title.text = title

    def _send_sections(self, x: float, y: float) -> None:
        """Draw the sections as one message: streams of HoloViews do not lock the document."""
        change = one_message(self.map.document, partial(self._draw_sections, x, y))
        self._sent = asyncio.get_running_loop().create_task(change)

    def _point(self, x: float, y: float) -> None:
        if self._field.cell_at(x, y) not in (None, self._cell):  # most moves stay in a cell
            self._send_sections(x, y)

    def _tap(self, x: float | None, y: float | None) -> None:
        """Go to a cell. A zoomed map waits first: a second click shows the whole map instead."""
        if (cell := self._field.cell_at(x, y)) is not None:
            place = float(self._field.x[1][cell[1]]), float(self._field.y[1][cell[0]])
            wait = SECOND_CLICK * any(map(_is_zoomed, (self.map.x_range, self.map.y_range)))
            go, loop = partial(self._go, *place), asyncio.get_running_loop()
            self._going = loop.call_later(wait, run_on_loop, self.map.document, go)


_NO_SIDE = Side("", "", "", "")
_BLANK = Field(
    (_NO_SIDE, np.arange(2.0)), (_NO_SIDE, np.arange(2.0)), "", "", np.zeros((2, 2)),
    np.full((2, 2), "", dtype=object),
)  # fmt: skip


def _house_style(plot: figure, name: str) -> None:
    """Give a figure of HoloViews the style of the other figures."""
    style.style_figure(plot)
    for axis in plot.axis:
        style.style_axis(axis)
    plot.update(
        name=name, sizing_mode="stretch_both", width=None, height=None, min_width=280,
        min_height=200 if name.endswith("across") else 340, min_border_left=64,
        min_border_right=14, min_border_top=10, output_backend="canvas",
    )  # fmt: skip
    plot.toolbar_location, plot.toolbar_inner = "right", True


def _move(shown: Range1d, start: float, end: float) -> None:
    """Set the ends of a range and of its reset; of a zoomed range those of the reset alone."""
    home = {"reset_start": start, "reset_end": end}
    shown.update(**home, **({} if _is_zoomed(shown) else {"start": start, "end": end}))


def _is_zoomed(shown: Range1d) -> bool:
    return (shown.start, shown.end) != (shown.reset_start, shown.reset_end)


def color_limits(values: NDArray[np.float64]) -> tuple[float, float]:
    """Ends of the colour scale for numbers; symmetric about zero if they have both signs."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    if low < 0.0 < high:
        most = max(-low, high)
        return -most, most
    if not high > low:
        half = 0.5 * abs(low) or 0.5
        return low - half, high + half
    return low, high
