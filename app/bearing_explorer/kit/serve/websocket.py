"""The websocket of a browser: it takes messages of the page's own scripts and nothing else."""

from __future__ import annotations

import time
from typing import Any, ClassVar

from bokeh.util.token import check_token_signature, get_session_id, get_token_payload
from panel.io import server as panel_server

from bearing_explorer.kit.serve import live
from bearing_explorer.kit.serve.allowed_messages import (
    MOST_EVENTS,
    component_message,
    is_allowed,
    is_costly,
    name_model_by_id,
)
from bearing_explorer.kit.serve.bokeh_internals import apply_patch
from bearing_explorer.kit.serve.hosts import AllowedHosts
from bearing_explorer.kit.serve.log import log_warning
from bearing_explorer.kit.serve.pages import SERVER_IS_FULL, PageHandler

MOST_SOCKETS = 4
"""Most sockets of one session: a page has one, and for a moment two while it reconnects."""


class LiveSocket(panel_server.WSHandler):  # type: ignore[misc]
    """The websocket of one browser."""

    connected: ClassVar[set[LiveSocket]] = set()
    hosts: ClassVar[AllowedHosts]
    largest: ClassVar[int] = 4 * 2**20
    """Largest message [bytes] with all its frames; `websocket_max_message_size` bounds a frame."""
    last_message_at = 0.0
    """Time [s of `time.monotonic`] of the browser's last message."""
    session_name = _named_token = ""
    _size = 0
    connection: Any
    receiver: Any

    async def prepare(self) -> None:
        """Refuse a foreign page before anything else is done for it."""
        if self.hosts.allow_socket(self.request):
            await super().prepare()
            return
        headers = self.request.headers
        names = {name: repr(headers.get(name))[:200] for name in ("Host", "Origin")}
        log_warning("refused a websocket", **names, allow="--allow-websocket-origin")
        self.set_status(403)
        self.finish()

    def check_origin(self, origin: str) -> bool:
        """Return True if a page of this origin may connect; not every Tornado calls this."""
        return self.hosts.allow_origin(origin)

    def select_subprotocol(self, subprotocols: list[str]) -> str | None:
        """Keep the token, which comes as the name of a second protocol."""
        self._named_token = subprotocols[-1] if subprotocols else ""
        chosen: str | None = super().select_subprotocol(subprotocols)
        return chosen

    async def open(self, *arguments: Any, **named: Any) -> None:
        """Connect to the session that the token names."""
        self.last_message_at = time.monotonic()
        try:
            if not self._is_signed() or await self._has_place():
                super().open(*arguments, **named)
        except Exception as error:
            self._refuse(error)

    def _is_signed(self) -> bool:
        """Return True if the token is of this server and valid; Bokeh refuses all others."""
        app, token = self.application, self._named_token
        signed = check_token_signature(token, signed=app.sign_sessions, secret_key=app.secret_key)
        return signed and get_token_payload(token).get("session_expiry", 0.0) > time.time()

    async def _has_place(self) -> bool:
        """Return True if server and session have room for this socket; otherwise close it."""
        token, context = self._named_token, self.application_context
        name = get_session_id(token)
        if await PageHandler.make_session(context, name, self.request, token) is None:
            self.close(1013, SERVER_IS_FULL.format(PageHandler.most_sessions))
            return False
        if sum(name == other.session_name for other in self.connected) >= MOST_SOCKETS:
            self.close(1008, "This page is connected too often.")
            return False
        self.session_name = name
        self.connected.add(self)
        return True

    async def on_message(self, fragment: str | bytes) -> None:
        """Take a frame; disconnect a sender of anything that the page does not send."""
        self.last_message_at = time.monotonic()
        self._size += len(fragment)
        if self._size > self.largest:
            self.close(1009, "A message is larger than is allowed.")
            return
        try:
            if isinstance(fragment, str) and is_costly(fragment):
                raise ValueError("it holds too much")
            message = await self.receiver.consume(fragment)
            if message is not None:
                self._size = 0
                await self._take(message)
        except Exception as error:
            self._refuse(error)

    async def _take(self, message: Any) -> None:
        """Answer a request for the document, or pass on the allowed events of a message."""
        if message.msgtype == "PULL-DOC-REQ":
            answer = await self.handler.handle(message, self.connection)
            if answer is not None:  # newer versions of Bokeh send it themselves
                await self.send_message(answer)
            return
        events = message.content["events"]
        if message.msgtype != "PATCH-DOC" or len(events) > MOST_EVENTS:
            raise ValueError("the page does not send such a message")
        session = self.connection.session
        buffers = {buffer.id: buffer.to_bytes() for buffer in message.buffers}
        others = []
        for event in events:
            if (component := component_message(event, buffers)) is None:
                others.append(name_model_by_id(event))
            elif (model := session.document.models.get_by_id(component[0])) is not None:
                await live.hand_on(session, model, component[1])
        message.content["events"] = [e for e in others if is_allowed(e, session.document.models)]
        if message.content["events"]:
            await apply_patch(message, self.connection)

    def _refuse(self, error: Exception) -> None:
        log_warning("refused", why=type(error).__name__)
        self.close(1008, "This message was not understood.")

    def on_close(self) -> None:
        """Leave the session: the browser is gone."""
        self.connected.discard(self)
        connection, self.connection = self.connection, None
        if connection is not None:  # Bokeh's own method fails after a failed ping
            self.application.client_lost(connection)


def close_idle(seconds: float) -> None:
    """Disconnect browsers that sent nothing for these `seconds`; their pages show the reason."""
    now = time.monotonic()
    for socket in [peer for peer in LiveSocket.connected if now - peer.last_message_at > seconds]:
        socket.close(1001, f"The page was not used for {seconds / 60.0:.0f} min.")
