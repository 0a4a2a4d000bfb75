"""Every view of the page as a function, for scripts and notebooks.

``from bearing_explorer import figures`` and call the function named like a view, with a scene:

    drawn = figures.stiffness(presets["fan-rig"], cage_angle=0.1)
    drawn.show()      # in the browser; in a notebook the figure shows by itself
    drawn.table()     # the numbers, as in the view's CSV file

They draw what the page draws, by the same code. `names` lists them; `figure_of` of each half lists
their parameters, and `kit.views.still_figure.Figure` is their result. `of_sweep` gives a sweep
over two fields as HoloViews.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from bearing_explorer.kit.plots.color_scales import DIVERGING, SEQUENTIAL, hex_colors
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.views.still_figure import Figure
from bearing_explorer.page import SECTIONS, figure_of

if TYPE_CHECKING:
    import holoviews as hv
    from xarray import DataArray

_VIEWS: dict[str, type[View]] = {
    view.name.replace("-", "_"): view for section in SECTIONS for view in section.views
}

names = tuple(_VIEWS)
"""The functions that there are."""


def of_sweep(found: DataArray) -> hv.AdjointLayout:
    """One output of a sweep over two fields as HoloViews: a map and its histogram.

    Angles are in degrees; HoloViews and hvPlot go on from there: slices, overlays, selections.

    Raises
    ------
    ValueError
        for another number of fields.
    """
    import holoviews as hv
    import holoviews.plotting.bokeh  # what `opts` may say; hv.extension asks other computers

    from bearing_explorer.explorer.plots.plane import Field, color_limits

    hv.Store.set_current_backend("bokeh")
    field = Field.of_sweep(found)
    values, unit = field.scaled
    sides = [hv.Dimension(side.words, unit=side.unit or None) for side, _ in (field.x, field.y)]
    number = hv.Dimension(field.words, unit=unit or None)
    image = hv.Image((field.x[1], field.y[1], values), sides, number)
    limits = color_limits(values)
    image = image.opts(
        hv.opts.Image(
            cmap=hex_colors(DIVERGING if limits[0] == -limits[1] else SEQUENTIAL),
            clim=limits,
            colorbar=True,
            tools=["hover"],
            frame_width=420,
            frame_height=320,
        )
    )
    return image.hist()


def __getattr__(name: str) -> Callable[..., Figure]:
    if name not in _VIEWS:
        raise AttributeError(f"there is no figure {name!r}; there are: {', '.join(names)}")
    return partial(figure_of, _VIEWS[name])


def __dir__() -> list[str]:
    return [*globals(), *names]
