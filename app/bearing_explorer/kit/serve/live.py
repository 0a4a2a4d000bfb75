"""Changes of a session's document: made on the event loop, sent to the browser as one message."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from contextlib import nullcontext
from typing import Any

from bokeh.document import Document
from panel.io.state import set_curdoc
from panel.models.esm import DataEvent

from bearing_explorer.kit.serve.bokeh_internals import (
    dispatch_event,
    locked,
    send_changes,
    sockets_of,
)

_SHORT = 0.01
"""Longest work [s] on the event loop that is not followed by a pause for other sessions."""


def run_on_loop(doc: Document | None, act: Callable[[], None]) -> None:
    """Run `act` on the event loop of a session: now if this is that loop, otherwise soon.

    From 3.10 on, Bokeh passes messages of a browser on in threads, which have no loop.
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

    Bokeh would list all models of the document, and ask each whether the message is meant for it.
    Afterwards other sessions have their turn for as long as this took, because one session may send
    many messages.
    """
    began = time.perf_counter()

    async def act(document: Document) -> None:
        with set_curdoc(document):
            dispatch_event(model, DataEvent(model, data))

    await locked(session, act)
    took = time.perf_counter() - began
    await asyncio.sleep(took if took > _SHORT else 0.0)


async def one_message(doc: Document | None, change: Callable[[], None]) -> None:
    """Run `change`, which changes models of `doc`, and send all its changes as one message.

    For tasks of the event loop, which hold no lock on the document. The lock is taken and held
    until the message is written, so messages arrive in the order of the changes. Panel's own
    ``unlocked`` does not promise that: if two of its writes meet, the second may wait until a third
    comes, and the last position of a slider would not be drawn.
    """
    session = getattr(getattr(doc, "session_context", None), "session", None)
    if doc is None or session is None:
        change()
        return

    async def act(document: Document) -> None:
        def act_in_document() -> None:
            with set_curdoc(document):
                change()

        await send_changes(session, document, act_in_document)

    await locked(session, act)


def send_at_once(doc: Document | None) -> int:
    """Set TCP_NODELAY on the websockets of `doc`, and return their number.

    A Bokeh message is several small frames. Otherwise the kernel would hold them back until
    the browser acknowledges the previous one (about 30 ms a drawing).
    """
    context = getattr(doc, "session_context", None)
    count = 0
    for socket in sockets_of(getattr(context, "session", None)):
        if getattr(socket, "ws_connection", None) is not None:
            socket.set_nodelay(True)
            count += 1
    return count
