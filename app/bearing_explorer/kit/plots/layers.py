"""Layers of a figure as declarations: curves, strips, shapes and words over the packed source.

A view lists what its figure shows, from the lowest layer to the highest; `draw` declares the
sources with the columns that the layers name, once each, and draws them.

Glyphs are added as single models. `figure.line` and its like make three each, for glyphs that are
not selected and for muted ones. Nothing here is selected or muted, and models are most of the cost
of a session.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from bokeh import models
from bokeh.events import MouseLeave, MouseMove
from bokeh.models import (
    CheckboxGroup,
    ColumnDataSource,
    CustomJS,
    CustomJSExpr,
    GlyphRenderer,
    LinearColorMapper,
    RadioButtonGroup,
    Range1d,
)
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource

_PLACES: dict[type[models.Glyph], tuple[str, ...]] = {
    models.Circle: ("x", "y", "radius"),
    models.HSpan: ("y",),
    models.HStrip: ("y0", "y1"),
    models.Line: ("x", "y"),
    models.Patch: ("x", "y"),
    models.Quad: ("left", "right", "top", "bottom"),
    models.Scatter: ("x", "y"),
    models.Segment: ("x0", "y0", "x1", "y1"),
    models.Text: ("x", "y"),
    models.VSpan: ("x",),
    models.VStrip: ("x0", "x1"),
}
_OF_RENDERER = frozenset({"level", "tags", "x_range_name", "y_range_name"})


LIT = {"line_color": "#D55E00", "line_width": 3.5}
"""Look of the glyphs of a rolling element under the pointer."""


@dataclass(frozen=True)
class Glyph:
    """A Bokeh glyph of some kind.

    `places`: columns or numbers of its place. `look`: properties of the glyph or of its renderer;
    `color` is for its lines and its inside. `reads`: further columns, which its `look` reads. If
    "element" is among them (a number of a rolling element, from 1), an element under the pointer in
    any figure has the look `lit` (see `pointed.js`).
    """

    kind: type[models.Glyph]
    source: str
    places: tuple[str | float, ...]
    look: Mapping[str, Any] = field(default_factory=dict)
    reads: tuple[str, ...] = ()
    lit: Mapping[str, Any] = field(default_factory=dict)

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns that it reads."""
        return *(place for place in self.places if isinstance(place, str)), *self.reads

    def add(self, plot: figure, source: ColumnDataSource) -> GlyphRenderer:
        """Draw it."""
        look = dict(self.look)
        options = {name: look.pop(name) for name in _OF_RENDERER & look.keys()}
        if "color" in look:
            color = look.pop("color")
            look = {"line_color": color, "fill_color": color, **look}
        places = dict(zip(_PLACES[self.kind], self.places, strict=True))
        if "element" in self.reads:
            options["hover_glyph"] = self.kind(**places, **{**look, **self.lit})
            x, y = places.get("x", places.get("x0")), places.get("y")
            args = {"plot": plot, "source": source, "x": x, "y": y}
            point = CustomJS(args=args, code=asset_text("point.js"))
            plot.js_on_event(MouseMove, point)
            plot.js_on_event(MouseLeave, point)
        return plot.add_glyph(source, self.kind(**places, **look), **options)


def curve(
    source: str,
    x: str,
    y: str,
    color: str,
    width: float = 2.0,
    dash: Sequence[int] = (),
    alpha: float = 1.0,
    cells: str = "",
) -> Glyph:
    """A curve; NaN is a gap.

    `cells`: source of cells to draw it in; their sides and limits (low, high) are its axes.
    """
    look = {"line_color": color, "line_width": width, "line_alpha": alpha, "line_dash": list(dash)}
    return Glyph(models.Line, source, (x, y), look | ({"tags": [cells]} if cells else {}))


def strips(
    source: str,
    color: Any,
    alpha: float,
    *,
    low: str = "low",
    high: str = "high",
    level: bool = False,
    reads: tuple[str, ...] = (),
    **look: Any,
) -> Glyph:
    """Shaded stretches of the horizontal axis, or with `level` of the vertical one."""
    filled = {"fill_color": color, "fill_alpha": alpha, "line_color": None, **look}
    return Glyph(models.HStrip if level else models.VStrip, source, (low, high), filled, reads)


def ball_dots(source: str, x: str, y: str) -> Glyph:
    """Balls at the current cage angle: white dots that the frame does not cut."""
    look = {"fill_color": "white", "line_color": style.INK, "line_width": 1.6}
    look |= {"size": 8, "level": "annotation"}
    return Glyph(models.Scatter, source, (x, y), look, ("element",), {"size": 13, **LIT})


def uprights(
    source: str,
    x: str = "now",
    color: str = style.INK,
    width: float = 1.2,
    alpha: float = 0.75,
    **look: Any,
) -> Glyph:
    """Vertical lines through the whole frame, by default in the look of the current cage angle."""
    line = {"line_color": color, "line_width": width, "line_alpha": alpha}
    return Glyph(models.VSpan, source, (x,), {**line, **look})


def filled(source: str, color: str, alpha: float = 1.0, **line: Any) -> Glyph:
    """Polygons with NaN between them; without `line`, the look of their edges, they have none."""
    look = {"fill_color": color, "fill_alpha": alpha, "line_color": None, **line}
    return Glyph(models.Patch, source, ("x", "y"), look)


def segments(source: str, color: Any, width: float, reads: tuple[str, ...] = ()) -> Glyph:
    """Straight lines from ``x0, y0`` to ``x1, y1``; `reads`: columns that the colour reads."""
    line = {"line_color": color, "line_width": width}
    return Glyph(models.Segment, source, ("x0", "y0", "x1", "y1"), line, reads, LIT)


_WRITE = """
const data = source.data
const columns = Object.keys(data)
const count = columns.length ? data[columns[0]].length : 0
const texts = []
for (let i = 0; i < count; i++) {
  const row = {}
  for (const column of columns) row[column] = data[column][i]
  const text = String(write(row))
  texts.push(text && keep(row, text) ? text : null)  // an empty text is measured and painted too
}
return texts
"""
_ZOOMED = """
const {start, end, reset_start, reset_end} = shown
const zoomed = reset_start !== null && (start !== reset_start || end !== reset_end)
"""
_IN_VIEW = f"""{_ZOOMED}
if (!zoomed) return true
const at = row[column]
if (!(at >= start && at <= end)) return false
const room = (end - at)/(end - start)*plot.inner_width + margin
return room >= share*{0.55 * int(style.TEXT_SIZE[:-2]):.1f}*text.length
"""
_ZOOMS = f"""{_ZOOMED}
if (zoomed || was[0]) source.change.emit()
was[0] = zoomed
"""


@dataclass(frozen=True)
class Words:
    """Text made in the browser from numbers, as the packed source carries no words.

    Parameters
    ----------
    x, y
        a column or a number; with `x_share`, `y_share` it is a share of the frame.
    code
        JavaScript: body of ``(row) => ...``, which returns a string; `row` holds the columns by
        name, ``si(value, unit)`` writes a number with its prefix, ``rounded(value, digits)`` one
        without.
    reads
        further columns that the code and the `look` read.
    fitting
        width [px] of the frame, for type of the usual size, below which the code sees `narrow`.
    in_view
        "x" or "y": in a zoomed figure, words that the frame would cut off along that side are left
        out. The code then sees `narrow` below `style.NARROW`.
    share
        share of a text right of its place: a text that crosses the right edge is left out.
    """

    source: str
    x: str | float
    y: str | float
    code: str
    reads: tuple[str, ...] = ()
    x_share: bool = False
    y_share: bool = False
    fitting: float = 0.0
    in_view: str = ""
    share: float = 0.0
    look: dict[str, Any] = field(default_factory=dict)

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns that it reads."""
        return *(at for at in (self.x, self.y) if isinstance(at, str)), *self.reads

    def add(self, plot: figure, source: ColumnDataSource) -> GlyphRenderer:
        """Draw it."""
        ranges = {}
        for side, shares, extra in (
            ("x", self.x_share, plot.extra_x_ranges),
            ("y", self.y_share, plot.extra_y_ranges),
        ):
            if shares:
                extra.setdefault("shares", Range1d(0.0, 1.0, syncable=False))
                ranges[f"{side}_range_name"] = "shares"
        look = {
            "text_font": {"value": style.FONT},
            "text_font_size": style.SMALL_TEXT_SIZE,
            "text_color": style.INK,
            "text_baseline": "middle",
            **self.look,
        }
        look |= {"text": self._text(plot, source), **ranges}
        return Glyph(models.Text, self.source, (self.x, self.y), look).add(plot, source)

    def _text(self, plot: figure, source: ColumnDataSource) -> CustomJSExpr:
        below, keep, known = self.fitting, "return true", {}
        if self.in_view:
            below, keep = style.NARROW, _IN_VIEW
            at, shown = (self.x, plot.x_range) if self.in_view == "x" else (self.y, plot.y_range)
            known = {"column": at, "share": self.share, "margin": plot.min_border_right}
            known["shown"] = shown
            zoom = {"source": source, "shown": shown, "was": [False]}
            follow = CustomJS(args=zoom, code=_ZOOMS)
            shown.js_on_change("start", follow)
            shown.js_on_change("end", follow)
        if below:  # the width of the frame is known later than the numbers, and changes
            write = CustomJS(args={"source": source}, code="source.change.emit()")
            plot.js_on_change("inner_width", write)
        narrow = style.IS_NARROW if below else ""
        code = (
            f"{style.JS_PREFIX}const write = (row) => {{{narrow}{self.code}}}\n"
            f"const keep = (row, text) => {{{keep}}}\n{_WRITE}"
        )
        args = {"source": source, "plot": plot if below else None, "below": below, **known}
        return CustomJSExpr(args=args, code=code)


Layer = Glyph | Words
"""One glyph of a figure, over one source."""

ON_PAPER = {"background_fill_color": "white", "background_fill_alpha": 0.85}
"""Look of words that lie on lines."""
CENTERED = {"text_align": "center"}
"""Look of words that are centred on their place."""


def names_over(
    source: str,
    code: str,
    x: str,
    row: str | float,
    color: str,
    reads: tuple[str, ...] = (),
    **look: Any,
) -> Words:
    """Names over curves, written by `code`, see `Words`; zoomed out of view they are left out.

    `row` is their height, as a share of the frame's. `x_offset` may be a column of pixels, for
    names on either side of their places.
    """
    share = {"center": 0.5, "right": 0.0}.get(look.get("text_align", ""), 1.0)
    if isinstance(shift := look.get("x_offset"), str):
        share, look["x_offset"], reads = 0.0, style.text_offset(shift), (*reads, shift)
    look = {"text_color": color, "level": "annotation", **ON_PAPER, **look}
    return Words(source, x, row, code, reads, y_share=True, in_view="x", share=share, look=look)


def sources_of(packed: PackedSource, layers: Iterable[Layer]) -> dict[str, ColumnDataSource]:
    """Declare the sources that layers name, each once, with all the columns that they read."""
    columns: dict[str, dict[str, None]] = {}
    for layer in layers:
        columns.setdefault(layer.source, {}).update(dict.fromkeys(layer.columns))
    return {name: packed.source(name, *column) for name, column in columns.items()}


def draw(plot: figure, packed: PackedSource, layers: Sequence[Layer]) -> list[GlyphRenderer]:
    """Draw layers whose sources no other figure has."""
    return add_all(plot, sources_of(packed, layers), layers)


def add_all(
    plot: figure, sources: Mapping[str, ColumnDataSource], layers: Sequence[Layer]
) -> list[GlyphRenderer]:
    """Draw layers over sources that several figures share."""
    return [layer.add(plot, sources[layer.source]) for layer in layers]


def by_number(column: str, colors: Sequence[str]) -> dict[str, Any]:
    """Return colours by the numbers in a column, from 0."""
    mapper = LinearColorMapper(palette=list(colors), low=-0.5, high=len(colors) - 0.5)
    return {"field": column, "transform": mapper}


def with_gaps(
    curves: Iterable[tuple[NDArray[np.float64], NDArray[np.float64]]], x: str, y: str
) -> dict[str, NDArray[np.float64]]:
    """Join curves to one line with gaps between them, as columns `x` and `y`."""
    none, gap = np.empty(0), np.array([np.nan])
    pieces = [(none, none)]
    for across, up in curves:
        pieces += [(across, up), (gap, gap)]
    parts = pieces[:-1] if len(pieces) > 1 else pieces
    return {x: np.concatenate([a for a, _ in parts]), y: np.concatenate([b for _, b in parts])}


def least_and_greatest(
    values: NDArray[np.float64], parts: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Choose at most 2·`parts` numbers that draw the same line as the rows of `values` (n, k).

    The least and the greatest number of each of `parts` stretches are kept, in their order, so that
    no visible peak is lost. Returns their row numbers (the same for all columns) and the numbers.
    """
    n = len(values)
    if n <= 2 * parts:
        return np.arange(n), values
    size = math.ceil(n / parts)
    count = math.ceil(n / size)
    # repeat the last row, so that all stretches have the same size
    full = np.concatenate([values, np.repeat(values[-1:], count * size - n, axis=0)])
    blocks = full.reshape(count, size, -1)
    least, greatest = blocks.min(axis=1), blocks.max(axis=1)
    rising = blocks.argmin(axis=1) <= blocks.argmax(axis=1)
    kept = np.empty((count, 2, values.shape[1]))
    kept[:, 0] = np.where(rising, least, greatest)
    kept[:, 1] = np.where(rising, greatest, least)
    starts = np.arange(count) * size
    rows = np.stack([starts, np.minimum(starts + size, n) - 1], axis=1).ravel()
    length = 2 * count - int(rows[-1] == rows[-2])  # a last stretch of one row
    return rows[:length], kept.reshape(2 * count, -1)[:length]


def toggle(label: str, drawn: Sequence[GlyphRenderer], *, shown: bool) -> CheckboxGroup:
    """Return a box that shows and hides drawn layers, in the browser alone."""
    for renderer in drawn:
        renderer.update(visible=shown, syncable=False)
    # a group of one: its box and its words belong together for screen readers and fingers
    box = CheckboxGroup(
        labels=[label],
        active=[0] if shown else [],
        syncable=False,
        margin=(4, 5, 8, 5),
        stylesheets=[style.BUTTONS],
        css_classes=["look"],
    )
    code = "for (const layer of drawn) layer.visible = cb_obj.active.length > 0"
    box.js_on_change("active", CustomJS(args={"drawn": list(drawn)}, code=code))
    return box


_SWITCH = "plots.forEach((plot, which) => { plot.visible = which == cb_obj.active })"


def switch(labels: Sequence[str], plots: Sequence[figure], active: int = 0) -> RadioButtonGroup:
    """Return buttons that show one of several figures, in the browser alone."""
    for number, plot in enumerate(plots):
        plot.visible = number == active
    buttons = RadioButtonGroup(
        labels=list(labels),
        active=active,
        syncable=False,
        margin=(2, 5, 6, 5),
        stylesheets=[style.BUTTONS],
    )
    buttons.js_on_change("active", CustomJS(args={"plots": list(plots)}, code=_SWITCH))
    return buttons
