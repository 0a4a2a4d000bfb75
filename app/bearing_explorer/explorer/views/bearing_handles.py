"""Handles in the drawing of the bearing: ends and middles of defects, tip of the load's arrow.

Without a load the tip is in the middle of the shaft. A handle is dragged with the pointer, or moved
with the arrow keys when it has the focus; the sliders follow.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from bokeh.models import CustomJS, Scatter
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.explorer.results.defect_shape import Span
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots.layers import Glyph, add_all, sources_of
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearingcore import Scene

COLUMNS = ("x", "y", "x0", "kind", "defect", "value", "angle", "bore", "newtons")
START, END, MIDDLE, LOAD = range(4)
"""Kinds of handles, as `grab.js` numbers them."""


def points(radius: Any, angle: NDArray[np.float64], end: str = "") -> dict[str, np.ndarray]:
    """Cartesian columns of points at a radius and angles: `x0` and `y0` for the `end` "0"."""
    return {f"x{end}": radius * np.cos(angle), f"y{end}": radius * np.sin(angle)}


def dots(source: str) -> Glyph:
    """Dots at the handles of defects; the tip of the arrow needs no dot."""
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
    """Columns of the handles of a row of balls, from the middle of the shaft.

    `value` is the extent of the defect [deg] or the load [N]; `angle` [deg] is the handle's place.

    Parameters
    ----------
    spans
        places of the row's defects at this cage angle.
    race
        radius of each raceway.
    tip
        distance of the tip of the arrow from the middle.
    bore, newtons
        radius of the bore, and load [N] of an arrow of length 1.
    """
    numbers = [k for k, defect in enumerate(scene.defects) if defect.row in (None, row)]
    places: list[tuple[float, float, int, int, float]] = []
    for number, span in zip(numbers, spans, strict=True):
        if span.extent > 0.0:
            turns = ((START, 0.0), (END, span.extent), (MIDDLE, 0.5 * span.extent))
            degrees = float(np.degrees(span.extent))
            places += [
                (race[span.race], span.start + turn, kind, number, degrees) for kind, turn in turns
            ]
    size = float(np.hypot(scene.load.fx, scene.load.fy))
    direction = float(np.arctan2(scene.load.fy, scene.load.fx)) if size > 0.0 else -0.5 * np.pi
    places.append((tip, direction, LOAD, 0, size))
    radius, angle, kind, defect, value = np.array(places, dtype=float).reshape(-1, 5).T
    return {
        **points(radius, angle),
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
    """Draw the handles of a source and let the hand move them."""
    glyph = dots(name)
    sources = sources_of(packed, [glyph])
    add_all(plot, sources, [glyph])
    grab = CustomJS(args={"plot": plot, "source": sources[name]}, code=asset_text("grab.js"))
    sources[name].js_on_change("data", grab)
    plot.js_on_change("inner_width", grab)
    plot.js_on_change("inner_height", grab)
    plot.x_range.js_on_change("end", grab)
