"""A map over two quantities, with the lines across it and a histogram, all linked.

The lines follow the pointer without asking Python, so they do in a saved page too. A part of the
histogram, selected with the mouse, stays bright on the map.
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import holoviews as hv

if "bokeh" not in hv.Store.loaded_backends():
    hv.extension("bokeh", logo=False, inline=True)  # exported notebooks need nothing from outside

import numpy as np
import panel as pn
import param
from bokeh.models import CustomJS, HoverTool, Range1d, UIElement
from holoviews.plotting.bokeh.links import LinkCallback
from holoviews.plotting.links import Link
from numpy.typing import NDArray
from panel.io.notebook import patch_inline_stylesheets

from bearing_explorer.plots import style
from bearing_explorer.plots.color_scales import DIVERGING, SEQUENTIAL
from bearing_explorer.plots.heat_map import BAR_LOOK, Places, Side, reading, sections
from bearing_explorer.plots.style import AxisQuantity
from bearing_explorer.serve.fast import before_showing

if TYPE_CHECKING:
    from xarray import DataArray

NO_ANSWER = "#B9BEC4"
BINS = 24
_SAY = """
if (isNaN(cell[0])) return "no answer"
return `${words}: ` + (prefixed ? si(cell[0], unit.trim(), 4) : rounded(cell[0], 4) + unit)
"""
_WHY = (
    f'<div style="font: 12px {style.FONT.replace(chr(34), "")}; max-width: 260px; '
    'white-space: normal">No answer: @reason</div>'
)


@dataclass(frozen=True, eq=False)
class Field:
    """Numbers over a plane.

    Attributes
    ----------
    x, y
        name of the dimension, its axis, and evenly spaced values, (nx,) and (ny,).
    value
        name of the dimension and its axis.
    values : (ny, nx)
        NaN where there is no answer.
    reasons : (ny, nx)
        why there is none.
    at
        place on x and y at which the lines across the map are drawn first.
    """

    x: tuple[str, AxisQuantity, NDArray[np.float64]]
    y: tuple[str, AxisQuantity, NDArray[np.float64]]
    value: tuple[str, AxisQuantity]
    values: NDArray[np.float64]
    reasons: NDArray[np.object_]
    at: tuple[float, float]

    @classmethod
    def of_sweep(cls, found: DataArray) -> Field:
        """One output of a sweep over two fields, in the units that it says."""
        if found.ndim != 2:
            raise ValueError(f"dimensions are {found.dims}; allowed: two, choose with .sel(...)")
        y, x = (_in_page_units(name, found[name]) for name in found.dims)
        name, axis, values = _in_page_units(found.name, found)
        reasons = np.where(np.isfinite(values), "", "see the status of the sweep").astype(object)
        middle = (float(x[2].mean()), float(y[2].mean()))
        return cls(x, y, (name, axis), values, reasons, middle)

    @property
    def dimensions(self) -> tuple[hv.Dimension, hv.Dimension, hv.Dimension]:
        """Of x, y and the value."""
        (x, x_axis, _), (y, y_axis, _), (value, axis) = self.x, self.y, self.value
        return dimension(x, x_axis), dimension(y, y_axis), dimension(value, axis)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, bottom, right, top of the cells around all places."""
        sides = []
        for _, _, places in (self.x, self.y):
            half = 0.5 * (places[1] - places[0])
            sides.append((float(places[0] - half), float(places[-1] + half)))
        return sides[0][0], sides[1][0], sides[0][1], sides[1][1]


def _in_page_units(name: Any, given: DataArray) -> tuple[str, AxisQuantity, NDArray[np.float64]]:
    """Name of a dimension, its axis and its values: SI units as they are, angles in degrees."""
    unit = str(given.attrs.get("units", ""))
    values = np.asarray(given, dtype=float)
    words = str(name).replace("_", " ")
    words = words[0].upper() + words[1:]
    if unit == "rad":
        return f"{name}_deg", AxisQuantity(words, "", "°"), np.degrees(values)
    prefixed = unit not in ("", "1", "kg", "kg·m²")
    return str(name), AxisQuantity(words, "", "" if unit == "1" else unit, prefixed), values


def dimension(name: str, quantity: AxisQuantity, **more: Any) -> hv.Dimension:
    """A dimension called `name`, with the words and the unit of an axis of the page."""
    return hv.Dimension(name, label=quantity.words, unit=quantity.unit or None, **more)


class Axes:
    """A hook that gives a figure the page's look, and axes that write their own units.

    HoloViews calls hooks again whenever a figure is updated; callbacks are attached once,
    and `each` is called once for each figure.
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
            style.style_figure(figure)

    def _write_bar(self, handles: dict[str, Any]) -> None:
        """Title and numbers of the colour bar, with the prefix that its ends ask for."""
        assert self.color is not None
        bar, mapper = handles["colorbar"], handles["color_mapper"]
        if "bar_range" not in handles:
            handles["bar_range"] = Range1d(mapper.low, mapper.high)
            bar.update(**BAR_LOOK, bar_line_color=style.STEEL_EDGE)
            style.write_units(bar, self.color, handles["bar_range"])
        handles["bar_range"].update(start=mapper.low, end=mapper.high)


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


class Section(Link):
    """Shows in a curve, the target, the line across a map, the source, at the pointer."""

    along = param.String(doc="dimension that the curve runs along")
    value = param.String(doc="dimension of its values")
    sideways = param.Boolean(doc="whether it runs to the right")
    words = param.String(doc="beginning of the curve's title, before the place")
    unit = param.String(doc="unit of the place in its title")
    mark = param.Parameter(
        doc="source with x and y of the place to draw when nothing is pointed at"
    )
    listen = param.Parameter(doc="takes what is to follow the mark, instead of the mark itself")

    _requires_target = True


class _SectionCallback(LinkCallback):
    source_model = "plot"
    source_handles: Sequence[str] = ("source",)
    target_model = "plot"
    target_handles: Sequence[str] = ("source",)
    on_source_events: Sequence[str] = ("mousemove", "mouseleave")

    def __init__(self, root_model: Any, link: Section, source_plot: Any, target_plot: Any) -> None:
        self.root_model, self.link = root_model, link
        self.source_plot, self.target_plot = source_plot, target_plot
        line, title = target_plot.handles["source"], target_plot.handles["plot"].title
        line.syncable = title.syncable = False  # or the server would hear of each movement
        names = ("along", "value", "sideways", "words", "unit", "mark")
        follow = sections(
            source_plot.handles["source"],
            line=line,
            title=title,
            **{name: getattr(link, name) for name in names},
        )
        for event in self.on_source_events:
            source_plot.handles["plot"].js_on_event(event, follow)
        if link.mark is not None:
            if link.listen is None:
                link.mark.js_on_change("data", follow)
            else:
                link.listen(follow)
            source_plot.handles["source"].js_on_change("data", follow)


Section.register_callback("bokeh", _SectionCallback)

Hook = Callable[[Any, Any], None]


def plane(
    found: Field | DataArray,
    *,
    news: hv.streams.Pipe | None = None,
    mark: Any = None,
    listen: Callable[[CustomJS], object] | None = None,
    hooks: Sequence[Hook] = (),
    each: Hook | None = None,
    responsive: bool = False,
) -> hv.Layout:
    """The map, a line across it each way, and a histogram in which values can be selected.

    Parameters
    ----------
    found
        numbers over two evenly spaced quantities: one output of `bearingcore.sweep.sweep` over two
        fields, or a `Field`.
    news
        brings further fields of the same names to be drawn in place of this one.
    mark
        Bokeh source with the x and y of a place at which the lines are drawn while nothing is
        pointed at.
    listen
        takes the callbacks that are to follow the data of `mark`, where that must not be changed
        before the figures are shown; by default they are given to it at once.
    hooks
        further HoloViews hooks for the map.
    each
        a hook that is called once for each of the four figures.
    responsive
        as wide as there is room, instead of as in a notebook.
    """
    first = found if isinstance(found, Field) else Field.of_sweep(found)
    news = news if news is not None else hv.streams.Pipe(data=first)
    news.update(data=first)
    (x_name, x_axis, x_places), (y_name, y_axis, y_places), (value_name, axis) = (
        first.x,
        first.y,
        first.value,
    )
    many = AxisQuantity("Points", "", "")
    stacked = _Stacked(each) if responsive else each
    unit = dataclasses.replace(axis, name="", symbol="")  # their titles say of what
    selection = hv.streams.BoundsX(boundsx=None)
    picture = hv.DynamicMap(_image, streams=[news])
    gaps = hv.DynamicMap(_gaps, streams=[news])
    veil = hv.DynamicMap(_veil, streams=[news, selection])
    across = hv.DynamicMap(_across, streams=[news])
    up = hv.DynamicMap(_up, streams=[news])
    histogram = hv.DynamicMap(_histogram, streams=[news])
    selection.source = histogram
    reset = hv.streams.PlotReset(source=histogram)
    reset.add_subscriber(lambda **_: selection.event(boundsx=None))
    for line, sideways, along, place in (
        (across, True, x_name, y_axis),
        (up, False, y_name, x_axis),
    ):
        Section(
            picture, line, along=along, value=value_name, sideways=sideways,
            words=f"{axis.words} at {place.words}", unit=_spaced(place.unit), mark=mark,
            listen=listen,
        )  # fmt: skip
    big, small = (
        ({"responsive": True, "height": 292}, {"responsive": True, "height": 160})
        if responsive
        else ({"width": 470, "height": 340}, {"width": 470, "height": 190})
    )
    narrow = {} if responsive else {"width": 330}
    shared = {"active_tools": [], "shared_axes": False, "framewise": True, "axiswise": True}
    x_lim = {"xlim": (float(x_places[0]), float(x_places[-1]))}
    y_lim = {"xlim": (float(y_places[0]), float(y_places[-1]))}
    line = {"color": style.DEFECTIVE, "line_width": 2, "show_grid": True, "default_tools": []}
    picture.opts(
        hv.opts.Image(
            colorbar=True,
            clipping_colors={"NaN": "#00000000"},
            default_tools=["save"],
            xlim=x_lim["xlim"],
            ylim=y_lim["xlim"],
            hooks=[Axes(x_axis, y_axis, axis, stacked), _Reading(x_axis, y_axis, axis), *hooks],
            **big,
            **shared,
        )
    )
    gaps.opts(
        hv.opts.Rectangles(
            fill_color=NO_ANSWER,
            line_color=NO_ANSWER,
            hooks=[_hatched],
            tools=[HoverTool(tooltips=_WHY, point_policy="follow_mouse", visible=False)],
            **shared,
        )
    )
    veil.opts(
        hv.opts.Image(
            cmap=["#00000000", f"{style.PAPER}D0"], clim=(0, 1), colorbar=False, tools=[], **shared
        )
    )
    across.opts(
        hv.opts.Curve(hooks=[Axes(x_axis, unit, each=stacked)], **line, **x_lim, **small, **shared)
    )
    up.opts(
        hv.opts.Curve(
            hooks=[Axes(y_axis, unit, each=stacked)], **line, **y_lim, **{**big, **narrow}, **shared
        )
    )
    histogram.opts(
        hv.opts.Histogram(
            fill_color=style.DEFECTIVE,
            line_color="white",
            tools=["xbox_select"],
            default_tools=["reset"],
            title="Select values here to find them on the map",
            hooks=[Axes(axis, many, each=stacked)],
            **{**small, **narrow},
            **{**shared, "active_tools": ["xbox_select"]},
        )
    )
    return (
        hv.Layout([picture * gaps * veil, up, across, histogram])
        .cols(2)
        .opts(merge_tools=False, toolbar=None)
    )


class _Stacked:
    """A hook: one figure below the other where two in a row would be too narrow."""

    STYLE = "@media (max-width: 820px) { :host { grid-area: auto / 1 / auto / -1 !important; } }"

    def __init__(self, also: Hook | None) -> None:
        self._also = also

    def __call__(self, plot: Any, element: Any) -> None:
        figure = plot.handles["plot"]
        figure.stylesheets = [*figure.stylesheets, self.STYLE]
        if self._also is not None:
            self._also(plot, element)


def _hatched(plot: Any, _: Any) -> None:
    plot.handles["glyph"].update(
        hatch_pattern="/", hatch_color="white", hatch_alpha=0.6, hatch_scale=8
    )


def _spaced(unit: str) -> str:
    return unit if unit in ("", "°") else f" {unit}"


class _Reading:
    """A hook: the value under the pointer, with the prefix of its magnitude."""

    def __init__(self, x: AxisQuantity, y: AxisQuantity, value: AxisQuantity) -> None:
        self._sides = [Side("", axis.name, axis.symbol, axis.unit) for axis in (x, y)]
        words = {"words": value.words, "unit": _spaced(value.unit), "prefixed": value.prefixed}
        self._say = f"const {{words, unit, prefixed}} = {json.dumps(words)}\n{_SAY}"

    def __call__(self, plot: Any, _: Any) -> None:
        if "reading" in plot.handles:
            return
        image = plot.handles["source"]
        tool = reading(
            Places(image, self._sides), [plot.handles["glyph_renderer"]], self._say, [image]
        )
        plot.handles["reading"] = tool
        plot.handles["plot"].add_tools(tool)


def first_drawing() -> None:
    """Draw a map off the page: for the first one HoloViews inspects its classes, which takes long.

    That takes three times as long as a map does, and the page draws maps on its event loop.
    """
    places = np.linspace(0.0, 1.0, 4)
    x, y, value = (AxisQuantity(name, "", "") for name in "xyz")
    values = np.add.outer(places, places)
    values[0, 0] = np.nan
    field = Field(
        ("x", x, places), ("y", y, places), ("z", value), values,
        np.where(np.isnan(values), "none", ""), (0.5, 0.5),
    )  # fmt: skip
    news = hv.streams.Pipe(data=field)
    hv.renderer("bokeh").get_plot(plane(field, news=news, responsive=True))
    news.send(field)


def _image(data: Field) -> hv.Image:
    x, y, value = data.dimensions
    palette, limits = color_scale(data.values)
    image = hv.Image(data.values[::-1], [x, y], value, bounds=data.bounds)
    return image.opts(cmap=palette, clim=limits)


def _gaps(data: Field) -> hv.Rectangles:
    """Cells without an answer, with the reason."""
    left, bottom, right, top = data.bounds
    rows, columns = data.values.shape
    width, height = (right - left) / columns, (top - bottom) / rows
    cells = [
        (left + i * width, bottom + j * height, left + (i + 1) * width, bottom + (j + 1) * height,
         str(data.reasons[j, i]))
        for j, i in zip(*np.nonzero(np.isnan(data.values)), strict=True)
    ]  # fmt: skip
    x, y = data.x[0], data.y[0]
    corners = [f"{x}_from", f"{y}_from", f"{x}_to", f"{y}_to"]
    return hv.Rectangles(cells, corners, "reason")


def _veil(data: Field, boundsx: tuple[float, float] | None) -> hv.Image:
    """White over the cells that are not selected."""
    x, y, _ = data.dimensions
    veil = np.zeros(data.values.shape)
    if boundsx is not None:
        low, high = boundsx
        veil[~((data.values >= low) & (data.values <= high))] = 1.0
    return hv.Image(veil[::-1], [x, y], hv.Dimension("not_selected"), bounds=data.bounds)


def _nearest(places: NDArray[np.float64], at: float) -> int:
    return int(np.abs(places - at).argmin())


def _title(data: Field, axis: AxisQuantity, at: float) -> str:
    return f"{data.value[1].words} at {axis.words} {style.number(at, 4)}{_spaced(axis.unit)}"


def _across(data: Field) -> hv.Curve:
    x, _, value = data.dimensions
    row = _nearest(data.y[2], data.at[1])
    title = _title(data, data.y[1], data.y[2][row])
    curve = hv.Curve((data.x[2], data.values[row]), x, value)
    return curve.opts(title=title, ylim=_span(data))


def _up(data: Field) -> hv.Curve:
    _, y, value = data.dimensions
    column = _nearest(data.x[2], data.at[0])
    title = _title(data, data.x[1], data.x[2][column])
    curve = hv.Curve((data.y[2], data.values[:, column]), y, value)
    return curve.opts(title=title, ylim=_span(data))


def _span(data: Field) -> tuple[float, float]:
    """From a little below the least value of the map to a little above the greatest."""
    known = data.values[np.isfinite(data.values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    room = 0.06 * (high - low) or 0.06 * abs(high) or 1.0
    return low - room, high + room


def _histogram(data: Field) -> hv.Histogram:
    _, _, value = data.dimensions
    known = data.values[np.isfinite(data.values)]
    counts, edges = np.histogram(known, bins=BINS) if known.size else (np.zeros(1), [0.0, 1.0])
    return hv.Histogram((np.asarray(edges), counts), kdims=value, vdims="points")


def _inlined(_: Any, root: Any) -> None:
    """Have figures outside of a page carry their style sheets: a server serves those of a page."""
    doc = pn.state.curdoc
    if doc is None or doc.session_context is None:
        for part in root.select({"type": UIElement}):
            patch_inline_stylesheets(part)


before_showing(_inlined)
