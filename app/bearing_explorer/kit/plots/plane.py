"""A map over two quantities, with a curve across it each way, as HoloViews.

`layout_of` returns the objects, for a notebook. `PlaneFigures` is the same on a page: HoloViews
makes its plots once and tells it where the pointer is; later maps go into the sources of these
plots, as elements that a stream makes anew take twice as long as all else until they are painted.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from bokeh.models import HoverTool, Range1d
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.color_scales import DIVERGING, SEQUENTIAL, hex_colors
from bearing_explorer.kit.plots.heat_map import BAR_LOOK, CLEAR, Side, ends
from bearing_explorer.kit.serve.live import one_message
from bearingcore.common import PREFIXES, number, prefix_power
from bearingcore.fields import FIELD_OF

if TYPE_CHECKING:
    import holoviews as hv
    from xarray import DataArray

_HATCHES = {"hatch_pattern": "/", "hatch_color": "white", "hatch_alpha": 0.6, "hatch_scale": 8}
"""Look of points without an answer; HoloViews has no option for it."""
_NO_PREFIX = ("", "°", "kg", "kg·m²")
_PALETTES = {True: hex_colors(DIVERGING), False: hex_colors(SEQUENTIAL)}

SIDE_BY_SIDE = """
:host { display: grid !important; gap: 8px 16px;
        min-height: auto !important;
        grid-template-columns: repeat(auto-fit, minmax(min(100%, max(380px, 40%)), 1fr)); }
"""
"""Style of a layout of the figures: two in a row where there is room."""


@dataclass(frozen=True, eq=False)
class Field:
    """Numbers over a plane.

    Attributes
    ----------
    x, y
        the quantities of the sides, and evenly spaced values in their units, (nx,) and (ny,).
    words, unit
        of the numbers.
    values : (ny, nx)
        NaN where there is no answer.
    reasons : (ny, nx)
        why there is none.
    """

    x: tuple[Side, NDArray[np.float64]]
    y: tuple[Side, NDArray[np.float64]]
    words: str
    unit: str
    values: NDArray[np.float64]
    reasons: NDArray[np.object_]

    @classmethod
    def of_sweep(cls, found: DataArray) -> Field:
        """One output of a sweep over two fields, angles in degrees.

        Raises
        ------
        ValueError
            for another number of fields.
        """
        if found.ndim != 2:
            raise ValueError(f"dimensions are {found.dims}; allowed: two, choose with .sel(...)")
        y, x = ((Side("", *of), at) for of, at in (_in_page_units(found[d]) for d in found.dims))
        (words, _, unit), values = _in_page_units(found)
        reasons = np.where(np.isfinite(values), "", "see the status of the sweep").astype(object)
        return cls(x, y, words, unit, values, reasons)

    @cached_property
    def scaled(self) -> tuple[NDArray[np.float64], str]:
        """The numbers with an SI prefix for the greatest of them, and their unit with it."""
        if self.unit in _NO_PREFIX:
            return self.values, self.unit
        power = prefix_power(float(np.nanmax(np.abs(self.values), initial=0.0)))
        return self.values / 10.0**power, PREFIXES[power] + self.unit

    @property
    def bounds(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Where the cells around its points begin and end, to the right and upwards."""
        return ends(self.x[1]), ends(self.y[1])

    @property
    def missing(self) -> dict[str, NDArray[Any]]:
        """The cells without an answer, with the reasons."""
        rows, columns = np.nonzero(np.isnan(self.values))
        (left, right), (bottom, top) = self.bounds
        width, height = (right - left) / self.x[1].size, (top - bottom) / self.y[1].size
        x, y = left + width * columns, bottom + height * rows
        reasons = self.reasons[rows, columns].astype(str)
        return {"x": x, "y": y, "x1": x + width, "y1": y + height, "reason": reasons}

    def cell_at(self, x: float, y: float) -> tuple[int, int] | None:
        """Row and column of the cell at a place; None beside the map."""
        cell = []
        for at, (first, last), side in zip((x, y), self.bounds, (self.x, self.y), strict=True):
            share = (at - first) / (last - first)
            if not 0.0 <= share <= 1.0:
                return None
            cell.append(min(int(share * side[1].size), side[1].size - 1))
        return cell[1], cell[0]

    def section(self, cell: tuple[int, int], up: bool) -> tuple[NDArray[Any], NDArray[Any], str]:
        """The numbers through a cell, upwards or to the right: places, values, and a title."""
        row, column = cell
        values = self.scaled[0]
        fixed, at = (self.x, column) if up else (self.y, row)
        unit = fixed[0].unit if fixed[0].unit in ("", "°") else f" {fixed[0].unit}"
        title = f"{self.words} at {fixed[0].words} {number(float(fixed[1][at]), 4)}{unit}"
        return (self.y[1], values[:, column], title) if up else (self.x[1], values[row], title)


def _in_page_units(given: DataArray) -> tuple[tuple[str, str, str], NDArray[np.float64]]:
    """Words, symbol and unit of numbers, and the numbers: SI, but angles in degrees."""
    unit = str(given.attrs.get("units", ""))
    name = str(given.name)
    words = FIELD_OF[name].label if name in FIELD_OF else name.replace("_", " ")
    words = words[0].upper() + words[1:]
    values = np.asarray(given, dtype=float)
    if unit == "rad":
        return (words, "", "°"), np.degrees(values)
    return (words, "", "" if unit == "1" else unit), values


def dimensions(field: Field) -> list[hv.Dimension]:
    """The sides and the numbers as HoloViews has them: `x`, `y` and `value`, with their labels."""
    import holoviews as hv
    import holoviews.plotting.bokeh  # what `opts` may say; hv.extension asks other computers

    hv.Store.set_current_backend("bokeh")
    (x, _), (y, _) = field.x, field.y
    said = {"x": (x.words, x.unit), "y": (y.words, y.unit), "value": (field.words, field.scaled[1])}
    return [
        hv.Dimension((name, words or name), unit=unit or None)
        for name, (words, unit) in said.items()
    ]


def map_of(field: Field, mark: tuple[float, float] | None = None) -> hv.Overlay:
    """The map, hatched where there is no answer, with a ring at the `mark`."""
    import holoviews as hv

    x, y, value = dimensions(field)
    limits = color_limits(field.scaled[0])
    image = hv.Image((field.x[1], field.y[1], field.scaled[0]), [x, y], value).opts(
        cmap=_PALETTES[limits[0] == -limits[1]], clim=limits, clipping_colors={"NaN": CLEAR},
        colorbar=True, colorbar_opts={**BAR_LOOK, "bar_line_color": style.STEEL_EDGE},
        default_tools=[], tools=[HoverTool(visible=False, point_policy="follow_mouse")],
    )  # fmt: skip
    missing = hv.Rectangles(field.missing, [x, y, "x1", "y1"], "reason").opts(
        default_tools=[], tools=[HoverTool(visible=False, tooltips="no answer: @reason")],
        fill_color="#B9BEC4", line_color=None, hooks=[_hatch],
    )  # fmt: skip
    rings = [  # dark on light, so that it shows on every colour
        hv.Points([] if mark is None else [mark], [x, y]).opts(
            size=15, fill_color=None, line_color=color, line_width=width, default_tools=[]
        )
        for color, width in ((style.LIGHT, 5.0), (style.SHADE, 2.0))
    ]
    return hv.Overlay([image, missing, *rings])


def _hatch(plot: Any, _: hv.Rectangles) -> None:
    plot.handles["glyph"].update(**_HATCHES)


def section_of(field: Field, cell: tuple[int, int], up: bool) -> hv.Curve:
    """The curve through a cell, upwards or to the right."""
    import holoviews as hv

    x, y, value = dimensions(field)
    places, values, title = field.section(cell, up)
    return hv.Curve((places, values), y if up else x, value).opts(
        color=style.DEFECTIVE, line_width=2.0, title=title, default_tools=[], framewise=True
    )


def layout_of(field: Field) -> hv.Layout:
    """The map and its sections, which follow the pointer; they begin in the middle."""
    import holoviews as hv

    plane = map_of(field)
    pointer = hv.streams.PointerXY(x=None, y=None, source=plane.Image.I)
    middle = (field.y[1].size // 2, field.x[1].size // 2)

    def section(x: float | None, y: float | None, up: bool) -> hv.Curve:
        cell = None if x is None or y is None else field.cell_at(x, y)
        return section_of(field, cell or middle, up)

    up, across = (
        hv.DynamicMap(partial(section, up=up), streams=[pointer]) for up in (True, False)
    )
    return hv.Layout([plane, up, across]).cols(2)


class PlaneFigures:
    """The map, and a curve across it each way, on a page.

    Parameters
    ----------
    name
        of the figures.
    go
        called with a place that is clicked at.

    Attributes
    ----------
    plots
        those of HoloViews, for its pane.
    """

    def __init__(self, name: str, go: Callable[[float, float], None]) -> None:
        import holoviews as hv

        self._field, self._mark, self._go = _BLANK, (0.0, 0.0), go
        self._cell: tuple[int, int] | None = None
        #: models of each element, by name: HoloViews calls a hook with them
        self._models: dict[str, dict[str, Any]] = {}
        plane = map_of(_BLANK)
        elements = {
            f"{name}_map": plane,
            **{f"{name}_{way}": section_of(_BLANK, (0, 0), way == "up") for way in _WAYS},
        }
        for part, key in zip(plane, ("image", "missing", "light", "dark"), strict=True):
            part.opts(hooks=[partial(self._keep, key), *([_hatch] if key == "missing" else [])])
        for way in _WAYS:
            elements[f"{name}_{way}"].opts(hooks=[partial(self._keep, way)])
        streams = hv.streams
        self._streams = [
            kind(source=plane.Image.I, subscribers=[act])
            for kind, act in (
                (streams.PointerXY, self._point),
                (streams.MouseLeave, lambda **_: self._send_sections(self._mark)),
                (streams.SingleTap, self._tap),
            )
        ]
        draw = hv.renderer("bokeh").get_plot
        self.plots = [draw(element) for element in elements.values()]
        self.map, self.up, self.across = (plot.state for plot in self.plots)
        for plot, name in zip((self.map, self.up, self.across), elements, strict=True):
            _house_style(plot, name)
        self.up.x_range, self.across.x_range = self.map.y_range, self.map.x_range
        self.across.y_range = self.up.y_range
        self.map.grid.visible = False
        self.map.toolbar_inner = False  # it would lie on the picture
        self.map.stylesheets = [":host { cursor: crosshair; }"]
        self.up.frame_align = False  # it needs no colour bar's room

    def _keep(self, key: str, plot: Any, _: Any) -> None:
        self._models[key] = plot.handles

    def show(self, field: Field, mark: tuple[float, float], alpha: float = 1.0) -> None:
        """Draw a field, and the curves across it at the `mark`. On the event loop only."""
        self._field, self._mark = field, mark
        values = field.scaled[0]
        (left, right), (bottom, top) = field.bounds
        image = self._models["image"]
        image["source"].data = {
            "image": [values.astype(np.float32)],
            "x": [left], "y": [bottom], "dw": [right - left], "dh": [top - bottom],
        }  # fmt: skip
        image["glyph"].global_alpha = alpha
        low, high = color_limits(values)
        image["color_mapper"].update(low=low, high=high, palette=_PALETTES[low == -high])
        cells = field.missing
        self._models["missing"]["source"].data = {
            "left": cells["x"], "bottom": cells["y"], "right": cells["x1"], "top": cells["y1"],
            "reason": cells["reason"],
        }  # fmt: skip
        for ring in ("light", "dark"):
            self._models[ring]["source"].data = {"x": [mark[0]], "y": [mark[1]]}
        known = values[np.isfinite(values)]
        least, most = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
        room = 0.06 * (most - least) or 0.06 * abs(most) or 1.0
        _move(self.map.x_range, left, right)
        _move(self.map.y_range, bottom, top)
        _move(self.up.y_range, least - room, most + room)
        self._write()
        self._draw_sections(mark)

    def _write(self) -> None:
        """Write labels and tooltips."""
        (x, _), (y, _), unit = self._field.x, self._field.y, self._field.scaled[1]
        in_unit = f" ({unit})" if unit else ""
        self._models["image"]["colorbar"].title = f"{self._field.words}{in_unit}"
        labels = [(x.label, y.label), (y.label, in_unit[1:]), (x.label, in_unit[1:])]
        for plot, (across, up) in zip((self.map, self.up, self.across), labels, strict=True):
            plot.xaxis[0].axis_label, plot.yaxis[0].axis_label = across, up
        tooltips = [
            (x.words, f"$x {x.unit}"), (y.words, f"$y {y.unit}"), (self._field.words, f"@image {unit}")
        ]  # fmt: skip
        hover = self._models["image"]["hover"]
        if hover.tooltips != tooltips:
            hover.tooltips = tooltips

    def _draw_sections(self, at: tuple[float, float]) -> None:
        """Draw the curves through a place; through the middle where that is beside the map."""
        field = self._field
        self._cell = field.cell_at(*at)
        cell = self._cell or (field.y[1].size // 2, field.x[1].size // 2)
        for way, plot in zip(_WAYS, (self.up, self.across), strict=True):
            places, values, title = field.section(cell, way == "up")
            side = "y" if way == "up" else "x"
            self._models[way]["source"].data = {side: places, "value": values}
            plot.title.text = title

    def _point(self, x: float | None, y: float | None) -> None:
        """Follow the pointer: most of its moves stay in a cell."""
        if x is None or y is None or self._field.cell_at(x, y) in (None, self._cell):
            return
        self._send_sections((x, y))

    def _send_sections(self, at: tuple[float, float]) -> None:
        """Draw the curves through a place: streams act outside of the document's lock."""
        change = one_message(self.map.document, partial(self._draw_sections, at))
        self._sent = asyncio.get_running_loop().create_task(change)

    def _tap(self, x: float | None, y: float | None) -> None:
        """Go to the middle of the cell that is clicked at."""
        if x is None or y is None or (cell := self._field.cell_at(x, y)) is None:
            return
        self._go(float(self._field.x[1][cell[1]]), float(self._field.y[1][cell[0]]))


_WAYS = ("up", "across")
_NO_SIDE = Side("", "", "", "")
_BLANK = Field(
    (_NO_SIDE, np.arange(2.0)), (_NO_SIDE, np.arange(2.0)), "", "", np.zeros((2, 2)),
    np.full((2, 2), "", dtype=object),
)  # fmt: skip


def _house_style(plot: figure, name: str) -> None:
    """Make a figure of HoloViews look as the others do."""
    style.style_figure(plot)
    for axis in plot.axis:
        style.style_axis(axis)
    plot.update(
        name=name, sizing_mode="stretch_both", width=None, height=None, min_width=280,
        min_height=200 if name.endswith("across") else 340, min_border_left=64,
        min_border_right=14, min_border_top=10, lod_threshold=None,
        output_backend="canvas",
    )  # fmt: skip
    plot.toolbar_location, plot.toolbar_inner = "right", True


def _move(shown: Range1d, start: float, end: float) -> None:
    """Move a range, and what a reset goes back to; where it is zoomed the latter alone."""
    home = {"reset_start": start, "reset_end": end}
    zoomed = (shown.start, shown.end) != (shown.reset_start, shown.reset_end)
    shown.update(**home, **({} if zoomed else {"start": start, "end": end}))


def color_limits(values: NDArray[np.float64]) -> tuple[float, float]:
    """Ends of the colour scale for numbers: the same on both sides of zero for both signs."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    if low < 0.0 < high:
        most = max(-low, high)
        return -most, most
    if not high > low:
        half = 0.5 * abs(low) or 0.5
        return low - half, high + half
    return low, high
