"""Every view of the page as a function, for scripts and notebooks.

``from bearing_explorer import figures`` and call the function named like a view, with a scene:

    drawn = figures.stiffness(presets["fan-rig"], cage_angle=0.1)
    drawn.show()      # in the browser; in a notebook the figure shows by itself
    drawn.table()     # the numbers, as in the view's CSV file

They draw what the page draws, by the same code; `of_sweep` draws a sweep over two fields as the tab
Explore does. `names` lists them; `views.still_figure.figure_of`
lists their parameters, and `views.still_figure.Figure` is their result.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from bearing_explorer.page import SECTIONS
from bearing_explorer.plots.plane import Field, PlaneFigures
from bearing_explorer.views.base import View
from bearing_explorer.views.still_figure import Figure, FilledSources, StillFigures, figure_of

if TYPE_CHECKING:
    from xarray import DataArray

_VIEWS: dict[str, type[View]] = {
    view.name.replace("-", "_"): view for section in SECTIONS for view in section.views
}

names = tuple(_VIEWS)
"""The functions that there are."""


def of_sweep(found: DataArray) -> StillFigures:
    """One output of a sweep over two fields: a map, lines across it, and a histogram.

    Raises
    ------
    ValueError
        for another number of fields.
    """
    field, sources = Field.of_sweep(found), FilledSources()
    drawn = PlaneFigures(sources, "sweep", [field.x[0], field.y[0]])
    drawn.write(field)
    follow = sources.fill(*drawn.data(field))
    return StillFigures("sweep", field.words, "", drawn.plots, follow)


def __getattr__(name: str) -> Callable[..., Figure]:
    if name not in _VIEWS:
        raise AttributeError(f"there is no figure {name!r}; there are: {', '.join(names)}")
    return partial(figure_of, _VIEWS[name])


def __dir__() -> list[str]:
    return [*globals(), *names]
