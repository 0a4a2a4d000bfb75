"""Keeping a dragged page lively: newest inputs win, small frames leave at once.

The one place that touches private attributes of Bokeh and Panel; `tests/app/test_live.py`
and `tests/browser/test_wire.py` notice when an upgrade moves them.
"""

from __future__ import annotations

import asyncio
import logging
import os
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Generic, TypeVar

from bokeh.document import Document
from bokeh.document.events import DocumentPatchedEvent
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
        failed: Callable[[Exception], Awaitable[None]] | None = None,
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
                    await self._failed(error)


async def one_message(doc: Document | None, change: Callable[[], None]) -> None:
    """Run `change`, which changes models of `doc`, and send all its changes as one message.

    For tasks of the event loop, which hold no lock on the document. The lock is taken and held
    until the message is written, so messages arrive in the order of the changes. Panel's own
    ``unlocked`` does not promise that: where two of its writes meet, the second may lie about
    until a third comes, and the last position of a slider would not be drawn.
    """
    session = getattr(getattr(doc, "session_context", None), "session", None)
    if doc is None or session is None:
        change()
        return

    async def act(document: Document) -> None:
        callbacks = document.callbacks
        document.hold("combine")
        try:
            with set_curdoc(document):
                change()
        finally:
            held = list(callbacks._held_events)
            patches = [event for event in held if isinstance(event, DocumentPatchedEvent)]
            callbacks._held_events = [event for event in held if event not in patches]
            document.unhold()
        connections = tuple(session._subscribed_connections)
        if patches and connections:
            message = connections[0].protocol.create("PATCH-DOC", patches)
            for connection in connections:
                await connection._socket.send_message(message)

    await session.with_document_locked(act, doc)


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
