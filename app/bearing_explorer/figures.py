"""Every view of the page as a function, for scripts and notebooks.

``from bearing_explorer import figures`` and call the function named like a view, with a scene:

    drawn = figures.stiffness(presets["fan-rig"], cage_angle=0.1)
    drawn.show()      # in the browser; in a notebook the figure shows by itself
    drawn.table()     # the numbers, as in the view's CSV file
    drawn.save("st.pdf")  # or .svg, .png, .html

They draw what the page draws, by the same code. `names` lists them; `figure_of` of each half lists
their parameters, and `kit.views.still_figure.Figure` is their result. `of_sweep` gives a sweep
over two fields as HoloViews.
"""

from __future__ import annotations

from collections.abc import Callable
from inspect import Signature, signature
from typing import TYPE_CHECKING, Any

from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.views.still_figure import Figure
from bearing_explorer.page import SECTIONS, half_of
from bearingcore import Scene
from bearingcore.errors import FieldError

if TYPE_CHECKING:
    import holoviews as hv
    from xarray import DataArray, Dataset

_VIEWS: dict[str, type[View]] = {
    view.name.replace("-", "_"): view for section in SECTIONS for view in section.views
}

names = tuple(_VIEWS)
"""Names of the functions."""


def of_sweep(swept: DataArray | Dataset) -> hv.Layout:
    """Return an output of a sweep over two fields as HoloViews: a map, and curves across it.

    Explore shows the same figures. On a server (`panel.panel(...).show()`) and in a live
    notebook the curves follow the pointer. Angles are in degrees.

    Raises
    ------
    ValueError
        for another number of fields or of outputs, and for values that are not evenly spaced.
    """
    from bearing_explorer.explorer.plots.plane import (  # HoloViews: not at the start
        Field,
        layout_of,
    )

    outputs = getattr(swept, "data_vars", {"": swept})
    names = [name for name in outputs if name != "status"]
    if len(names) != 1:
        raise ValueError(f"outputs are {names}; allowed: one, choose with [name]")
    return layout_of(Field.of_sweep(outputs[names[0]]))


def __getattr__(name: str) -> Callable[..., Figure]:
    if name not in _VIEWS:
        raise AttributeError(f"there is no figure {name!r}; there are: {', '.join(names)}")
    view, figure_of = _VIEWS[name], half_of(_VIEWS[name]).figure_of

    def draw(scene: Scene, **options: Any) -> Figure:
        if not isinstance(scene, Scene):
            kind = type(scene).__name__
            raise FieldError("scene", kind, "a Scene; a signal is the keyword recording")
        figure: Figure = figure_of(view, scene, **options)
        return figure

    draw.__name__ = draw.__qualname__ = name  # for help(figures.stiffness)
    draw.__doc__ = f"{view.title}.\n\n{figure_of.__doc__}"
    _, *parameters = signature(figure_of).parameters.values()
    draw.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    return draw


def __dir__() -> list[str]:
    return [*globals(), *names]
