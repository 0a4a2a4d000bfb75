"""A session that is over is taken apart, so that nothing of it waits for a garbage collection.

Models, components and views of a session refer to each other in circles: tens of thousands of
objects that reference counting alone does not free. To find them a garbage collection has to look
at all objects of everybody, and nobody is served meanwhile. But it is known what belonged to a
session. Once nothing works with it any longer, each of its parts lets go of all that it holds, and
reference counting frees the rest.
"""

from __future__ import annotations

import asyncio
import functools
import gc
from collections import deque
from collections.abc import Coroutine, Iterable, Iterator
from types import CellType, FunctionType, MethodType
from typing import Any

from bokeh.document import Document
from bokeh.model import Model
from panel.template.base import BaseTemplate
from panel.viewable import Viewable

from bearing_explorer.serve import threads
from bearing_explorer.serve.bokeh_private import inside
from bearing_explorer.serve.drawn_by import DrawnBy, forget_options, parts_of_figure

SETTLES = 1.0
"""[s] after the end of a session until its cancelled tasks have come back: some look about them
every 0.12 s."""
LOOKS = 0.25
"""[s] between two looks at whether a thread has come back. Nobody waits for it."""

AT_ONCE = 500
"""Objects that are looked at, or parts that are taken apart, in one turn of the event loop: it
takes some milliseconds."""

_HELD: tuple[type, ...] = (Model, Viewable, BaseTemplate, DrawnBy)
"""What belongs to one session, wherever it is found: none of these can be shown in two."""
_PLAIN = (list, tuple, set, frozenset, deque)

_at_work: set[asyncio.Task[None]] = set()


def parts_of(roots: Iterable[object], kinds: tuple[type, ...] = ()) -> list[object]:
    """What belongs to the session of `roots`, found by following what they hold.

    Models, components, templates and what is of `kinds` is followed and given back; lists,
    mappings, methods and closures are followed alone. All else is left as it is, for it may be
    shared: scenes, results, modules.
    """
    found: list[object] = []
    for _ in _search(roots, kinds, found):
        pass
    return found


def _search(
    roots: Iterable[object], kinds: tuple[type, ...], found: list[object]
) -> Iterator[None]:
    """Put the parts into `found`; each step takes a few milliseconds."""
    wanted = (*_HELD, *kinds)
    seen: dict[int, object] = {}
    waiting = list(roots)
    while waiting:
        one = waiting.pop()
        if id(one) in seen:
            continue
        mine = isinstance(one, wanted)
        held = gc.get_referents(one) if mine else _followed(one)
        if held is None:
            continue
        seen[id(one)] = one
        if mine:
            found.append(one)
            waiting += gc.get_referents(inside(one))
        waiting += held
        if len(seen) % AT_ONCE == 0:
            yield


def _followed(one: object) -> Iterable[object] | None:
    """What something holds that is no part by itself; None where it is not looked into."""
    if isinstance(one, _PLAIN):
        return one
    if isinstance(one, dict):
        return one.values()
    if isinstance(one, MethodType):
        return (one.__self__, one.__func__)
    if isinstance(one, FunctionType):
        return one.__closure__ or ()
    if isinstance(one, CellType):
        try:
            return (one.cell_contents,)
        except ValueError:  # nothing is in it yet
            return ()
    if isinstance(one, functools.partial):
        return (one.func, *one.args, *one.keywords.values())
    return None


def models_at_end(document: Document | None) -> list[Model]:
    """A list that is empty until a document is destroyed; then its models are in it.

    Bokeh cuts them from each other on that occasion, so that they are not found any more.
    """
    found: list[Model] = []
    if document is not None:
        models: Any = document.models
        destroy = models.destroy

        def listed() -> None:
            found.extend(models)
            del models.destroy
            destroy()

        models.destroy = listed
    return found


def take_apart(roots: Iterable[object], kinds: tuple[type, ...] = ()) -> None:
    """Have the parts of `roots` let go of what they hold, once nothing works with them any longer.

    On the event loop, after all that works with them was told to end. See `parts_of`.
    """
    _begin(_take_apart(list(roots), kinds))


def take_figure_apart(drawn_by: DrawnBy) -> None:
    """Have the parts of a figure that is gone from the page let go, in a session that goes on.

    On the event loop.
    """
    _begin(_take_figure_apart([drawn_by]))


def _begin(work: Coroutine[Any, Any, None]) -> None:
    task = asyncio.get_running_loop().create_task(work)
    _at_work.add(task)
    task.add_done_callback(_at_work.discard)


def take_apart_now(roots: Iterable[object], kinds: tuple[type, ...] = ()) -> None:
    """Have the parts of `roots`, which nothing works with and nobody is shown, let go at once.

    For any thread. See `parts_of`.
    """
    for part in parts_of(roots, kinds):
        _let_go(part)


async def _take_apart(roots: list[object], kinds: tuple[type, ...]) -> None:
    await _settled()
    parts: list[object] = []
    for _ in _search(roots, kinds, parts):
        await asyncio.sleep(0.0)
    roots.clear()
    await _take_figures_apart([part for part in parts if isinstance(part, DrawnBy)])
    await _clear(parts)


async def _take_figure_apart(figures: list[DrawnBy]) -> None:
    await _settled()
    await _take_figures_apart(figures)


async def _take_figures_apart(figures: list[DrawnBy]) -> None:
    parts: list[object] = []
    while figures:
        for _ in parts_of_figure(figures.pop(), parts, AT_ONCE):
            await asyncio.sleep(0.0)
    forget_options(parts)
    await _clear(parts)


def _let_go(part: object) -> None:
    """Have a part let go of all that it holds.

    Name by name: Python 3.13.0 breaks what a cleared mapping of attributes is given later.
    """
    held = vars(part)
    for name in list(held):
        held.pop(name, None)


async def _clear(parts: list[object]) -> None:
    while parts:
        _let_go(parts.pop())
        if len(parts) % AT_ONCE == 0:
            await asyncio.sleep(0.0)


async def _settled() -> None:
    """Wait until nothing works any longer with what has come to its end."""
    await asyncio.sleep(SETTLES)
    # what begins later belongs to others: all of this session's is cancelled
    begun = threads.at_work()
    while not all(future.done() for future in begun):
        await asyncio.sleep(LOOKS)
