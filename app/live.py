"""Keeping a dragged page lively: newest inputs win, small frames leave at once.

The one place that touches private attributes of Bokeh and Panel; `tests/app/test_live.py`
and `tests/browser/test_wire.py` notice when an upgrade moves them.
"""

from __future__ import annotations

import asyncio
import logging
import os
from collections.abc import Awaitable, Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Generic, TypeVar

from bokeh.document import Document
from panel.io import unlocked
from panel.io.state import set_curdoc

log = logging.getLogger(__name__)

Inputs = TypeVar("Inputs")
Result = TypeVar("Result")

#: threads shared by all sessions; kernels release the interpreter lock, so they do run together
_THREADS = ThreadPoolExecutor(max_workers=os.cpu_count() or 2, thread_name_prefix="compute")


async def in_thread(function: Callable[..., Result], *args: object) -> Result:
    """Run `function` off the event loop, in the threads that all sessions share."""
    return await asyncio.get_running_loop().run_in_executor(_THREADS, function, *args)


class LatestWins(Generic[Inputs]):
    """One worker that always works on the newest inputs and drops what they overtook.

    Slider events come faster than scenes can be drawn. A queue would grow into a tail that
    moves on after the hand has stopped; here at most one set of inputs waits.
    """

    def __init__(
        self,
        work: Callable[[Inputs], Awaitable[None]],
        failed: Callable[[Exception], None] | None = None,
    ) -> None:
        self._work = work
        self._failed = failed
        self._newest: list[Inputs] = []
        self._task: asyncio.Task[None] | None = None
        self._stopped = False

    @property
    def waiting(self) -> bool:
        """Whether newer inputs wait than those at work."""
        return bool(self._newest)

    @property
    def idle(self) -> bool:
        """Whether all that was submitted has been worked on or overtaken."""
        return not self._newest and (self._task is None or self._task.done())

    def submit(self, inputs: Inputs) -> None:
        """Take these inputs as the newest. Call it on the event loop of the session."""
        if self._stopped:
            return
        self._newest = [inputs]
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._run())

    def stop(self) -> None:
        """Take no more inputs; the session is gone."""
        self._stopped = True
        self._newest = []
        if self._task is not None:
            self._task.cancel()

    async def _run(self) -> None:
        while self._newest:
            inputs = self._newest.pop()
            try:
                await self._work(inputs)
            except Exception as error:
                log.exception("drawing a scene failed")
                if self._failed is not None:
                    self._failed(error)


@contextmanager
def one_message(doc: Document | None) -> Iterator[None]:
    """Change models of `doc` from a task of the event loop: all changes leave at once.

    Outside a callback that holds the document's lock a plain assignment would be lost.
    """
    if doc is None:
        yield
        return
    with set_curdoc(doc), unlocked():
        yield


def send_at_once(doc: Document | None) -> int:
    """Set TCP_NODELAY on the websockets of `doc`; return how many there were.

    A Bokeh message is several small frames; without this the kernel holds them back until
    the browser acknowledges the one before (about 30 ms a drawing).
    """
    context = getattr(doc, "session_context", None)
    session = getattr(context, "session", None)
    count = 0
    for connection in getattr(session, "_subscribed_connections", ()):
        socket = getattr(connection, "_socket", None)
        if socket is not None and getattr(socket, "ws_connection", None) is not None:
            socket.set_nodelay(True)
            count += 1
    return count
