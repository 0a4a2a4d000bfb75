"""The websocket of a browser: who may speak, how much, and how fast.

What a frame would cost is known before it is parsed, what comes too fast waits, and who sends what
no page sends is cut off.
"""

from __future__ import annotations

import asyncio
import time
from typing import Any
from urllib.parse import urlsplit

from bokeh.protocol.receiver import Receiver
from bokeh.server.protocol_handler import ProtocolHandler
from bokeh.util.token import get_session_id
from panel.io import server as panel_server

from bearing_explorer.serve import limits, live, message_cost, places
from bearing_explorer.serve import log as write
from bearing_explorer.serve.allowed_messages import ById, by_name, message_of, welcome
from bearing_explorer.serve.small_pages import tell, tell_error
from bearing_explorer.serve.taking_apart import take_apart

_PULL = 50.0
"""Messages that count as much as one that asks for the whole document."""


class LiveSocket(panel_server.WSHandler):  # type: ignore[misc]
    """The websocket of one browser."""

    _heard = 0.0  # when the browser said something last
    _credit = 100.0  # messages it may send at once
    _size = 0  # of the message that is coming [bytes]
    _frames = 0  # of it that have come
    _weight = 0.0  # as how many messages it counts
    _cut = False  # whether the browser is listened to no longer
    _document: Any = None  # of the session that it is connected to
    connection: Any  # to the session
    receiver: Any
    handler: Any
    session_name = ""
    """Of the session that this is connected to; empty before."""

    async def prepare(self) -> None:
        """Answer with a sentence where no connection can come of it."""
        made = super().prepare()
        if made is not None:
            await made
        try:
            urlsplit(self.request.headers.get("Origin", ""))
        except ValueError:
            write.trouble("refused", why="'its Origin is no address'")
            self.set_status(403)
            tell(self, "This did not work", "The page must be opened from this server.")
            self.finish()

    def write_error(self, status_code: int, **named: Any) -> None:
        """A page with a sentence."""
        tell_error(self, status_code)

    async def _async_open(self, token: str) -> None:
        name = str(get_session_id(token))
        if not places.may_connect(name):
            write.trouble("full", sessions=limits.current().sessions)
            self.end_with(1013, "All places are taken.")
            return
        self._heard = time.monotonic()
        try:
            await super()._async_open(token)
        except Exception as error:
            write.trouble("refused", why=type(error).__name__)
            self.end_with(1008, "The session is not known.")
            return
        if self._cut:  # it is gone meanwhile, and nobody would take it out again
            self._let_go()
            return
        for other in [one for one in sockets if one.session_name == name]:
            other.end_with(1008, "The session was connected to again.")
        self.session_name, self._document = name, self.connection.session.document
        sockets.add(self)
        places.came(name)
        write.happened("came", self._document, sessions=len(sockets))

    async def open(self, *arguments: Any, **named: Any) -> None:
        """Let in who knows the name of a session."""
        try:
            super().open(*arguments, **named)
        except Exception as error:
            write.trouble("refused", why=type(error).__name__)
            self.end_with(1008, "The session is not known.")

    async def on_message(self, fragment: str | bytes) -> None:
        """Take a frame: drop what is not for the page, hold back what comes too fast."""
        if self._cut:
            return
        if self.receiver is None or self.connection is None:
            self._refuse("before the session was ready")
            return
        bounds = limits.current()
        self._size += len(fragment)
        self._frames += 1
        if self._size > bounds.message or self._frames > 3 + 2 * bounds.buffers:
            self.end_with(1009, "A message is larger than is allowed.")
            return
        if isinstance(fragment, str):
            why = message_cost.too_much(fragment, bounds.items, bounds.depth)
            if why is not None:
                self._refuse(why)
                return
            self._weight = max(self._weight, message_cost.weight(self._size, fragment))
        try:
            message = await self.receiver.consume(fragment)
        except Exception as error:
            self._refuse(type(error).__name__)
            return
        if message is None:
            return
        weight = max(self._weight, message_cost.weight(self._size, ""))
        self._size, self._frames, self._weight = 0, 0, 0.0
        await self._wait_for_turn(_PULL if message.msgtype == "PULL-DOC-REQ" else weight)
        if self._cut:
            return
        try:
            await self._act(message)
        except Exception as error:
            write.trouble("not-taken", self._document, why=type(error).__name__)
            write.log.debug("a message was not taken", exc_info=True)
            self._refuse("it could not be read")

    async def _act(self, message: Any) -> None:
        kind = message.msgtype
        if kind == "PATCH-DOC":
            events = message.content.get("events")
            known = self.connection.session.document.models
            heard = [by_name(event) for event in (events if isinstance(events, list) else [])]
            kept = [event for event in heard if welcome(event, ById(known))]
            if len(kept) == 1 and (found := message_of(kept[0])) is not None:
                model = known.get_by_id(found[0])
                if model is not None:
                    await live.hand_on(self.connection.session, model, found[1])
            elif kept:
                message.content["events"] = kept
                await self._patch(message)
        elif kind == "PULL-DOC-REQ":
            await self._send_document(message.header["msgid"])
        else:
            self._refuse("it is of a kind that the page does not send")

    async def _send_document(self, asked: str) -> None:
        """Send the whole document: written in a thread, which takes a second with all tabs in it.

        Nobody changes it meanwhile, and nothing that is changed later is sent before it.
        """
        connection = self.connection

        async def send(document: Any) -> None:
            def written() -> Any:
                reply = connection.protocol.create("PULL-DOC-REPLY", asked, document)
                _ = reply.content_json  # the text of it, which is kept
                return reply

            await self.send_message(await live.in_writer(written))

        await live.locked(connection.session, send)

    async def _patch(self, message: Any) -> None:
        """Apply a patch on the event loop: from 3.10 on Bokeh does it in a thread.

        Answered by nothing: the page's scripts do not wait for it.
        """
        session = self.connection.session

        async def apply(document: Any) -> None:
            session._current_patch_connection = self.connection
            try:
                message.apply_to_document(document, session)
            finally:
                session._current_patch_connection = None

        await live.locked(session, apply)

    async def _wait_for_turn(self, weight: float) -> None:
        now = time.monotonic()
        rate = limits.current().messages_a_second
        self._credit = min(self._credit + rate * (now - self._heard), rate)
        self._heard = now
        self._credit -= weight
        if self._credit < 0.0:
            await asyncio.sleep(-self._credit / rate)

    def _refuse(self, why: str) -> None:
        write.trouble("refused", self._document, why=repr(why))
        self.end_with(1008, "This message was not understood.")

    def end_with(self, code: int, words: str) -> None:
        """Close, and hear nothing more of what is on its way."""
        self._cut = True
        self.close(code, words)

    async def send_message(self, message: Any) -> None:
        """Send a message, all of its frames in one write."""
        stream = getattr(self.ws_connection, "stream", None)
        waiting = len(getattr(stream, "_write_buffer", None) or b"")
        if waiting > limits.current().unread:
            write.trouble("refused", self._document, why="'it takes nothing of what it is sent'")
            self._cut = True
            stream.close()  # type: ignore[union-attr]
            return
        with live.one_write(self):
            await super().send_message(message)

    def on_close(self) -> None:
        """The browser is gone.

        Bokeh would tell the document, where nobody listens, and fail if a ping found out before.
        """
        self._cut = True
        if self in sockets:
            sockets.discard(self)
            places.left(self.session_name)
            write.happened("left", self._document, sessions=len(sockets))
        self._document = None
        self._let_go()

    def _let_go(self) -> None:
        """The session may end, and nothing of this connection waits for a garbage collection."""
        if self.connection is not None:
            self.application.client_lost(self.connection)
        if self.receiver is not None:
            take_apart((self.receiver, self.handler), (Receiver, ProtocolHandler))
        self.connection = self.receiver = self.handler = None


sockets: set[LiveSocket] = set()
"""Those that are connected."""
