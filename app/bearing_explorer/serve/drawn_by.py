"""What a library has drawn a figure by, found so that it can be let go of once the figure is gone.

HoloViews makes some eight thousand objects of a map, which refer to each other in circles. Its
elements, plots, streams and callbacks, and Bokeh's models, belong to one figure; what else they
hold may be shared, and reference counting frees it where it is not.
"""

from __future__ import annotations

import functools
import gc
import sys
from collections import OrderedDict, defaultdict, deque
from collections.abc import Iterator
from types import CellType, FunctionType, MethodType

from bokeh.model import Model
from bokeh.models.css import StyleSheet
from panel.viewable import Viewable

MOST = 60_000
"""Objects that are looked at for one figure. Beyond them it is left to a garbage collection."""

_LIBRARIES = frozenset({"bokeh", "holoviews", "panel", "param", "pandas"})
"""Whose objects are looked into."""
_OF_ALL = ("bokeh.document", "bokeh.io", "bokeh.server", "panel.config", "panel.io")
"""But not of these modules, which know all sessions."""
_PLAIN = frozenset(
    {dict, list, tuple, set, frozenset, defaultdict, deque, OrderedDict}
    | {functools.partial, CellType, FunctionType, MethodType}
)
_NOT_FOLLOWED = (type, Viewable, StyleSheet)
"""Panel keeps style sheets for the next figure of a session."""


class DrawnBy:
    """What a figure is drawn by: where to begin to look for its parts."""

    def __init__(self, *roots: object) -> None:
        self.roots = list(roots)


def parts_of_figure(drawn_by: DrawnBy, found: list[object], at_once: int) -> Iterator[None]:
    """Put the parts of a figure that is on no page any more into `found`.

    Yields after having looked at so many objects. `drawn_by` then holds nothing any more.
    """
    kinds = (Model, *_elements(), *_others())
    roots, drawn_by.roots = drawn_by.roots, []
    firsts = {id(one) for one in roots}
    seen: dict[int, object] = {}
    waiting = deque(roots)
    while waiting and len(seen) < MOST:
        one = waiting.popleft()
        if id(one) in seen or not (id(one) in firsts or _followed(one)):
            continue
        seen[id(one)] = one
        if isinstance(one, kinds):
            found.append(one)
        waiting += _held(one)
        if len(seen) % at_once == 0:
            yield


def forget_options(parts: list[object]) -> None:
    """Have HoloViews forget the options of its elements: it looks for them when these are gone."""
    elements = _elements()
    for part in parts:
        if isinstance(part, elements) and vars(part).get("_id") is not None:
            part.id = None  # type: ignore[attr-defined]


def _elements() -> tuple[type, ...]:
    return _kind("holoviews.core.dimension", "Dimensioned")


def _others() -> tuple[type, ...]:
    return (
        *_kind("holoviews.core.spaces", "Callable"),
        *_kind("holoviews.plotting.plot", "Plot"),
        *_kind("holoviews.streams", "Stream"),
    )


def _kind(module: str, name: str) -> tuple[type, ...]:
    """A class, where somebody has imported it: that takes a second."""
    return (getattr(sys.modules[module], name),) if module in sys.modules else ()


def _followed(one: object) -> bool:
    """Whether something is looked into: nothing that belongs to all, or is on a page."""
    kind = type(one)
    if kind in _PLAIN:
        return kind is not dict or "__builtins__" not in one  # type: ignore[operator]
    module = kind.__module__
    if not isinstance(module, str) or module.partition(".")[0] not in _LIBRARIES:
        return False
    if module.startswith(_OF_ALL):
        return False
    if isinstance(one, (*_NOT_FOLLOWED, *_kind("holoviews.plotting.renderer", "Renderer"))):
        return False
    return not (isinstance(one, Model) and one.document is not None)


def _held(one: object) -> list[object]:
    if type(one) is FunctionType:  # not the module that it was written in
        return [one.__closure__, one.__defaults__, one.__kwdefaults__, vars(one)]
    return gc.get_referents(one)
