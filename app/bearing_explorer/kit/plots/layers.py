"""Layers of a figure as declarations: curves, strips, shapes and words over the packed source.

A view lists what its figure shows, from the lowest layer to the highest; `draw` declares the
sources with the columns that the layers name, once each, and draws them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from bokeh import models
from bokeh.models import (
    CheckboxGroup,
    ColumnDataSource,
    CustomJS,
    GlyphRenderer,
    LinearColorMapper,
    RadioButtonGroup,
    Range1d,
)
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.glyphs import add_glyph
from bearing_explorer.kit.serve.packed_source import PackedSource


class Layer(Protocol):
    """One glyph of a figure, over one source."""

    @property
    def source(self) -> str:
        """Name of the source."""

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns that it reads."""

    def add(self, plot: figure, source: ColumnDataSource) -> GlyphRenderer:
        """Draw it."""


@dataclass(frozen=True)
class Glyph:
    """A glyph of Bokeh's of some kind.

    `places`: where it is, see `add_glyph`: columns or numbers. `reads`: columns that its `look`
    reads besides.
    """

    kind: type[models.Glyph]
    source: str
    places: tuple[str | float, ...]
    look: Mapping[str, Any] = field(default_factory=dict)
    reads: tuple[str, ...] = ()

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns that it reads."""
        return *(place for place in self.places if isinstance(place, str)), *self.reads

    def add(self, plot: figure, source: ColumnDataSource) -> GlyphRenderer:
        """Draw it."""
        return add_glyph(plot, self.kind, source, *self.places, **self.look)


def curve(
    source: str,
    x: str,
    y: str,
    color: str,
    width: float = 2.0,
    dash: Sequence[int] = (),
    alpha: float = 1.0,
) -> Glyph:
    """A curve; NaN is a gap."""
    look = {"line_color": color, "line_width": width, "line_alpha": alpha, "line_dash": list(dash)}
    return Glyph(models.Line, source, (x, y), look)


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
    """Balls at this cage angle: white dots that the frame does not cut."""
    look = {"fill_color": "white", "line_color": style.INK, "line_width": 1.6}
    return Glyph(models.Scatter, source, (x, y), {"size": 8, "level": "annotation", **look})


def uprights(
    source: str,
    x: str = "now",
    color: str = style.INK,
    width: float = 1.2,
    alpha: float = 0.75,
    **look: Any,
) -> Glyph:
    """Upright lines through the whole frame; as it is at the current cage angle."""
    line = {"line_color": color, "line_width": width, "line_alpha": alpha}
    return Glyph(models.VSpan, source, (x,), {**line, **look})


def filled(source: str, color: str, alpha: float = 1.0, **line: Any) -> Glyph:
    """Polygons with NaN between them; `line`: look of their edges, which have none otherwise."""
    look = {"fill_color": color, "fill_alpha": alpha, "line_color": None, **line}
    return Glyph(models.Patch, source, ("x", "y"), look)


def segments(source: str, color: Any, width: float, reads: tuple[str, ...] = ()) -> Glyph:
    """Straight lines from ``x0, y0`` to ``x1, y1``; `reads`: columns that the colour reads."""
    line = {"line_color": color, "line_width": width}
    return Glyph(models.Segment, source, ("x0", "y0", "x1", "y1"), line, reads)


@dataclass(frozen=True)
class Words:
    """Text made in the browser by `code`, see `style.words_of`.

    `reads`: columns that the code and the `look` read besides. A place along an axis is a column or
    a number; `x_share`, `y_share`: it is a share of the frame. `fitting`: the code knows whether
    the frame is `narrow`, below so many pixels; `in_view`: so it does, and words that the frame
    would cut off along that side are left out, `share` as `style.words_in_view` has it.
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
        if self.in_view:
            at = self.x if self.in_view == "x" else self.y
            text = style.words_in_view(plot, source, self.code, str(at), self.in_view, self.share)
        elif self.fitting:
            text = style.fitting_words(plot, source, self.code, below=self.fitting)
        else:
            text = style.words_of(source, self.code)
        look = {
            "text_font": {"value": style.FONT},
            "text_font_size": style.SMALL_TEXT_SIZE,
            "text_color": style.INK,
            "text_baseline": "middle",
            **self.look,
        }
        return add_glyph(plot, models.Text, source, self.x, self.y, text=text, **ranges, **look)


ON_PAPER = {"background_fill_color": "white", "background_fill_alpha": 0.85}
"""Look of words that lie on lines."""
CENTERED = {"text_align": "center"}
"""Look of words that lie to both sides of their place."""


def names_over(
    source: str,
    code: str,
    x: str,
    row: str | float,
    color: str,
    reads: tuple[str, ...] = (),
    **look: Any,
) -> Words:
    """Names over curves, by `code`, see `Words`; those that are zoomed out of view go.

    `row` is where, as a share of the frame's height. `x_offset` may be a column of pixels, for
    names on either side of their places.
    """
    share = {"center": 0.5}.get(look.get("text_align", ""), 1.0)
    if isinstance(shift := look.get("x_offset"), str):
        share, look["x_offset"], reads = 0.0, style.text_offset(shift), (*reads, shift)
    look = {"text_color": color, "level": "annotation", **ON_PAPER, **look}
    return Words(source, x, row, code, reads, y_share=True, in_view="x", share=share, look=look)


def sources_of(packed: PackedSource, layers: Iterable[Layer]) -> dict[str, ColumnDataSource]:
    """The sources that layers name, each declared once with all the columns that they read."""
    columns: dict[str, dict[str, None]] = {}
    for layer in layers:
        columns.setdefault(layer.source, {}).update(dict.fromkeys(layer.columns))
    return {name: packed.source(name, *own) for name, own in columns.items()}


def draw(plot: figure, packed: PackedSource, layers: Sequence[Layer]) -> list[GlyphRenderer]:
    """Draw layers whose sources no other figure has."""
    return add_all(plot, sources_of(packed, layers), layers)


def add_all(
    plot: figure, sources: Mapping[str, ColumnDataSource], layers: Sequence[Layer]
) -> list[GlyphRenderer]:
    """Draw layers over sources that several figures share."""
    return [layer.add(plot, sources[layer.source]) for layer in layers]


def by_number(column: str, colors: Sequence[str]) -> dict[str, Any]:
    """The colour of what a column numbers, from 0."""
    mapper = LinearColorMapper(palette=list(colors), low=-0.5, high=len(colors) - 0.5)
    return {"field": column, "transform": mapper}


def with_gaps(
    curves: Iterable[tuple[NDArray[np.float64], NDArray[np.float64]]], x: str, y: str
) -> dict[str, NDArray[np.float64]]:
    """Curves as one line with a gap between one and the next, as columns `x` and `y`."""
    none, gap = np.empty(0), np.array([np.nan])
    pieces = [(none, none)]
    for across, up in curves:
        pieces += [(across, up), (gap, gap)]
    parts = pieces[:-1] if len(pieces) > 1 else pieces
    return {x: np.concatenate([a for a, _ in parts]), y: np.concatenate([b for _, b in parts])}


def toggle(label: str, drawn: Sequence[GlyphRenderer], *, shown: bool) -> CheckboxGroup:
    """A box that shows and hides layers that are drawn, in the browser alone."""
    for one in drawn:
        one.update(visible=shown, syncable=False)
    # a group of one: its box and its words belong together for screen readers and fingers
    box = CheckboxGroup(
        labels=[label],
        active=[0] if shown else [],
        syncable=False,
        margin=(4, 5, 8, 5),
        stylesheets=[style.BUTTONS],
        css_classes=["look"],
    )
    code = "for (const one of drawn) one.visible = cb_obj.active.length > 0"
    box.js_on_change("active", CustomJS(args={"drawn": list(drawn)}, code=code))
    return box


_SWITCH = "plots.forEach((plot, which) => { plot.visible = which == cb_obj.active })"


def switch(labels: Sequence[str], plots: Sequence[figure], active: int = 0) -> RadioButtonGroup:
    """Buttons that show one of several figures, in the browser alone."""
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
