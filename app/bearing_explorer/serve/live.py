"""What a browser says and is sent: heard on the event loop, sent as one message, at once."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from typing import Any, TypeVar

from bokeh.document import Document
from panel.io.state import set_curdoc
from panel.models.esm import DataEvent
from panel.viewable import Viewable
from tornado.iostream import StreamClosedError

from bearing_explorer.serve.bokeh_private import (
    hear,
    locked,
    make_models,
    send_changes,
    sockets_of,
    visit_quickly,
)
from bearing_explorer.serve.threads import Pool

__all__ = [
    "counted_once",
    "good_byes",
    "hand_on",
    "in_writer",
    "locked",
    "make_models",
    "models_made",
    "on_loop",
    "one_message",
    "one_write",
    "send_at_once",
    "visit_quickly",
]

Made = TypeVar("Made")

_WRITER = Pool(1, "document")
"""Where models are made and large messages are written, one after the other, for all sessions."""

#: how to say a last word on the page of a document whose session ends
good_byes: dict[Any, Callable[[str], Awaitable[None]]] = {}


def on_loop(doc: Document | None, act: Callable[[], None]) -> None:
    """Have `act` happen on the event loop of a session: now where this is it, else soon.

    From 3.10 on Bokeh hands over in threads, which have no loop, what a browser says.
    """
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        assert doc is not None

        async def soon() -> None:
            with set_curdoc(doc):
                act()

        doc.add_next_tick_callback(soon)
    else:
        with set_curdoc(doc) if doc is not None else nullcontext():
            act()


async def hand_on(session: Any, model: Any, data: Any) -> None:
    """Give a message of the browser to the component that `model` shows.

    Bokeh would list all models of the document to read it, and ask each whether it is meant.
    """

    async def act(document: Document) -> None:
        with set_curdoc(document):
            hear(model, DataEvent(model, data))

    await locked(session, act)


async def in_writer(make: Callable[[], Made]) -> Made:
    """Have something of a document made in the one thread for that, and everybody else served."""
    return await asyncio.get_running_loop().run_in_executor(_WRITER, make)


async def models_made(doc: Document | None, layout: Viewable, child: Viewable) -> None:
    """Make the models of `child`, which is about to come into `layout`, off the event loop.

    Nothing else changes in the session meanwhile: it would miss the models that are half made.
    """
    session = getattr(getattr(doc, "session_context", None), "session", None)
    if session is None:
        return

    async def act(document: Document) -> None:
        await in_writer(lambda: make_models(layout, child, document))

    await locked(session, act)


async def one_message(
    doc: Document | None, change: Callable[[], None], new_models: bool = False
) -> None:
    """Run `change`, which changes models of `doc`, and send all its changes as one message.

    For tasks of the event loop, which hold no lock on the document. The lock is taken and held
    until the message is written, so messages arrive in the order of the changes. Panel's own
    ``unlocked`` does not promise that: where two of its writes meet, the second may lie about
    until a third comes, and the last position of a slider would not be drawn.

    With `new_models` Bokeh counts the models of the document once, after all of the change, and the
    message, which may be long, is written in a thread.
    """
    session = getattr(getattr(doc, "session_context", None), "session", None)
    if doc is None or session is None:
        change()
        return

    async def act(document: Document) -> None:
        def in_document() -> None:
            with set_curdoc(document), document.models.freeze() if new_models else nullcontext():
                change()

        await send_changes(session, document, in_document, in_writer if new_models else None)

    await locked(session, act)


def send_at_once(doc: Document | None) -> int:
    """Set TCP_NODELAY on the websockets of `doc`; return how many there were.

    A Bokeh message is several small frames; without this the kernel holds them back until
    the browser acknowledges the one before (about 30 ms a drawing).
    """
    context = getattr(doc, "session_context", None)
    count = 0
    for socket in sockets_of(getattr(context, "session", None)):
        if getattr(socket, "ws_connection", None) is not None:
            socket.set_nodelay(True)
            count += 1
    return count


@contextmanager
def counted_once(doc: Document | None) -> Iterator[None]:
    """Have Bokeh count the models of `doc` once, after the block, and only where some came or went.

    HoloViews has them counted after each figure that it draws anew, in which there are none new.
    """
    if doc is None:
        yield
        return
    models: Any = doc.models
    changes: list[None] = []
    models.invalidate, models.recompute = lambda: changes.append(None), lambda: None
    try:
        yield
    finally:
        del models.invalidate, models.recompute
        if changes:
            models.recompute()


@contextmanager
def one_write(handler: Any) -> Iterator[None]:
    """Gather what a websocket writes and hand it to the system at once.

    A message of Bokeh is five frames or more; each would be a call of the system of its own, which
    is most of what a small message costs.
    """
    connection: Any = getattr(handler, "ws_connection", None)
    stream = getattr(connection, "stream", None)
    if stream is None or isinstance(stream, _Gathered):
        yield
        return
    gathered = connection.stream = _Gathered(stream)
    try:
        yield
    finally:
        connection.stream = stream
        gathered.write_all()


class _Gathered:
    """Stands for a stream; what is written waits."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream
        self._parts: list[bytes] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, data: bytes) -> asyncio.Future[None]:
        self._parts.append(bytes(data))
        done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        done.set_result(None)
        return done

    def write_all(self) -> None:
        if self._parts:
            with suppress(StreamClosedError):
                self._stream.write(b"".join(self._parts))
