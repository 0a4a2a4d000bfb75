"""Glyphs added to a figure as the models that they are.

`figure.line` and its like make three glyphs each: one for what is not selected and one for what is
muted come along. Nothing here is selected or muted, and models are most of what a session costs.
"""

from __future__ import annotations

from typing import Any

from bokeh import models
from bokeh.models import ColumnDataSource, GlyphRenderer, Plot

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
_OF_RENDERER = frozenset({"level", "x_range_name", "y_range_name"})


def add_glyph(
    plot: Plot,
    kind: type[models.Glyph],
    source: ColumnDataSource,
    *places: str | float,
    **look: Any,
) -> GlyphRenderer:
    """Add a glyph over a source, at columns or numbers; `look`: properties of it or its renderer.

    `color` is that of its lines and of its inside.
    """
    options = {name: look.pop(name) for name in _OF_RENDERER & look.keys()}
    if "color" in look:
        color = look.pop("color")
        look = {"line_color": color, "fill_color": color, **look}
    glyph = kind(**dict(zip(_PLACES[kind], places, strict=True)), **look)
    return plot.add_glyph(source, glyph, **options)
