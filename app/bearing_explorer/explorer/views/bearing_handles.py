"""Handles of the drawing of the bearing: the ends and middles of defects, the tip of the arrow.

Without a load that tip is in the middle of the shaft.

Each is dragged, or moved by arrow keys once it has the focus, and the sliders follow.
"""

from __future__ import annotations

import numpy as np
from bokeh.models import CustomJS, Scatter
from bokeh.plotting import figure

from bearing_explorer.explorer.results.defect_shape import Span
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots.layers import Glyph, add_all, sources_of
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearingcore import Scene

COLUMNS = ("x", "y", "x0", "kind", "defect", "value", "angle", "bore", "newtons")
START, END, MIDDLE, LOAD = range(4)
"""Kinds of handles, as `grab.js` numbers them."""


def dots(source: str) -> Glyph:
    """The handles of defects; that of the arrow is its tip."""
    look = {"fill_color": "white", "line_color": "#B87A00", "line_width": 1.6, "size": "size"}
    return Glyph(Scatter, source, ("x", "y"), look, (*COLUMNS[2:], "size"))


def handles(
    scene: Scene,
    spans: list[Span],
    row: int,
    race: dict[str, float],
    tip: float,
    bore: float,
    newtons: float,
) -> dict[str, np.ndarray]:
    """Columns of the handles of a row, about its middle at 0.

    `value` is the extent of the defect [deg], or the load [N], `angle` [deg] where the handle is.

    Parameters
    ----------
    spans
        where the defects of the row are now.
    race
        radius of each raceway.
    tip
        distance of the tip of the arrow from the middle.
    bore, newtons
        radius of the bore, and load [N] of an arrow of length 1.
    """
    met = [k for k, one in enumerate(scene.defects) if one.row in (None, row)]
    places: list[tuple[float, float, int, int, float]] = []
    for number, span in zip(met, spans, strict=True):
        if span.extent > 0.0:
            turns = ((START, 0.0), (END, span.extent), (MIDDLE, 0.5 * span.extent))
            long = float(np.degrees(span.extent))
            places += [
                (race[span.race], span.start + turn, kind, number, long) for kind, turn in turns
            ]
    size = float(np.hypot(scene.load.fx, scene.load.fy))
    direction = float(np.arctan2(scene.load.fy, scene.load.fx)) if size > 0.0 else -0.5 * np.pi
    places.append((tip, direction, LOAD, 0, size))
    radius, angle, kind, defect, value = np.array(places, dtype=float).reshape(-1, 5).T
    return {
        "x": radius * np.cos(angle),
        "y": radius * np.sin(angle),
        "x0": np.zeros(angle.size),
        "kind": kind,
        "defect": defect,
        "value": value,
        "angle": np.degrees(angle) % 360.0,
        "bore": np.full(angle.size, bore),
        "newtons": np.full(angle.size, newtons),
        "size": np.where(kind <= END, 9.0, 0.0),
    }


def let_grab(plot: figure, packed: PackedSource, name: str) -> None:
    """Draw the handles of this source, and let them be moved."""
    glyph = dots(name)
    sources = sources_of(packed, [glyph])
    add_all(plot, sources, [glyph])
    grab = CustomJS(args={"plot": plot, "source": sources[name]}, code=asset_text("grab.js"))
    sources[name].js_on_change("data", grab)
    plot.js_on_change("inner_width", grab)
    plot.x_range.js_on_change("end", grab)
