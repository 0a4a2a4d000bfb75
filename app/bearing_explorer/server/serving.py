"""The server around the page: who may come in, how much they may ask for, and what it tells them.

Bokeh trusts its browser: a message may put any model with any value into the document, push a
whole document, or name a session it wants. Here the page's own scripts decide what is needed: what
they send is let through, all else is dropped before it is read. Names of sessions are signed.
What goes wrong is written to the log and answered with a sentence, never with a traceback.
"""

from __future__ import annotations

import asyncio
import html
import json
import logging
import math
import os
import secrets
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar
from urllib.parse import unquote

import panel as pn
from bokeh.server.urls import per_app_patterns
from bokeh.settings import settings
from panel.io import server as panel_server
from tornado.httputil import HTTPHeaders, HTTPServerRequest
from tornado.ioloop import PeriodicCallback
from tornado.routing import Matcher, Rule
from tornado.web import OutputTransform, RequestHandler

from bearing_explorer.assets import asset_text
from bearing_explorer.server import live
from bearing_explorer.server import log as write

MEGABYTE = 2**20


@dataclass(frozen=True)
class Limits:
    """What a process gives at most.

    sessions: people at once
    message: of the browser, a file that is uploaded among them [bytes]
    idle: after which a session that says nothing is over [s]
    messages_a_second: of one browser; what comes faster waits
    """

    sessions: int = 100
    message: int = 16 * MEGABYTE
    idle: float = 3600.0
    messages_a_second: float = 200.0


limits = Limits()


# What a browser may say

_LONGEST_VALUE = 20_000  # characters of a changed property, written out
_PLAIN = (str, int, float, bool, type(None))
#: what says what a model does, and how the server finds it again
_NEVER = {"code", "args", "esm", "tags", "name", "js_property_callbacks", "js_event_callbacks"}
_EVENTS = {"document_ready", "data_event", "dom_event"}


def welcome(event: Any, known: Any = None) -> bool:
    """Whether an event of a browser's patch is one that the page's own scripts may send.

    Messages of the page's components and plain values of properties pass; new models, new roots,
    tables of data, titles, and code never do. `known` holds the models of the session by id.
    """
    if not isinstance(event, dict):
        return False
    if event.get("kind") == "MessageSent":
        data = event.get("msg_data")
        if event.get("msg_type") != "bokeh_event" or not isinstance(data, dict):
            return False
        return data.get("type") == "event" and _event_name(data) and _without_models(data)
    if event.get("kind") != "ModelChanged":
        return False
    model, attribute = event.get("model"), event.get("attr")
    if not (isinstance(model, dict) and set(model) == {"id"} and isinstance(attribute, str)):
        return False
    if attribute in _NEVER:
        return False
    if known is not None and not _may_change(known, model["id"], attribute):
        return False
    return _is_plain(event.get("new")) and len(json.dumps(event.get("new"))) <= _LONGEST_VALUE


def by_name(event: Any) -> Any:
    """An event whose component is called by its id alone.

    BokehJS writes a model out in full that it believes the server has not heard of yet, as after a
    tab has been added; but whatever it says of a model, the server's own is meant.
    """
    try:
        entries = event["msg_data"]["values"]["entries"]
        changed = [
            [key, {"id": value["id"]}]
            if key == "model" and value["type"] == "object"
            else [key, value]
            for key, value in entries
        ]
        values = {**event["msg_data"]["values"], "entries": changed}
    except (KeyError, TypeError, ValueError):
        return event
    return {**event, "msg_data": {**event["msg_data"], "values": values}}


def _event_name(data: Mapping[str, Any]) -> bool:
    name = data.get("name")
    return isinstance(name, str) and (name in _EVENTS or name in _POINTER_EVENTS)


#: what figures tell that somebody listens to
_POINTER_EVENTS = {
    "tap", "doubletap", "press", "pan", "panstart", "panend", "mousemove", "mouseenter",
    "mouseleave", "wheel", "reset", "selectiongeometry", "rangesupdate", "lodstart", "lodend",
    "button_click", "menu_item_click", "value_submit",
}  # fmt: skip


def _may_change(known: Any, name: Any, attribute: str) -> bool:
    model = known.get(name) if isinstance(name, str) else None
    if model is None or model.__class__.__name__ in ("CustomJS", "CustomJSHover"):
        return False
    return attribute in type(model).properties()


def _is_plain(value: Any) -> bool:
    """Numbers and words, and lists and maps of them; nothing that makes a model or an array."""
    if isinstance(value, _PLAIN):
        return True
    if isinstance(value, list):
        return len(value) <= 2000 and all(_is_plain(item) for item in value)
    if isinstance(value, dict) and value.get("type") == "number":
        return set(value) == {"type", "value"} and isinstance(value["value"], str)
    if isinstance(value, dict) and value.get("type") == "map":
        entries = value.get("entries", [])
        return isinstance(entries, list) and all(_is_plain(entry) for entry in entries)
    return False


#: what Bokeh's notation may hold in messages: plain values, maps, and the bytes of a file
_HARMLESS = {"map", "number", "event", "bytes", "ndarray"}


def _without_models(value: Any, depth: int = 0) -> bool:
    """Whether a message only refers to models, and makes none."""
    if depth > 30:
        return False
    if isinstance(value, list):
        return all(_without_models(item, depth + 1) for item in value)
    if isinstance(value, dict):
        if "type" in value and value["type"] not in _HARMLESS:
            return False
        return all(_without_models(item, depth + 1) for item in value.values())
    return isinstance(value, _PLAIN)


def _message_of(event: Mapping[str, Any]) -> tuple[str, Any] | None:
    """Id of the model and plain data of a component's message; None where it is no such thing."""
    data = event.get("msg_data")
    if not isinstance(data, dict) or data.get("name") != "data_event":
        return None
    try:
        values = _read(data.get("values"))
        return str(values["model"]["id"]), values["data"]
    except (ValueError, TypeError, KeyError):
        return None


def _read(value: Any) -> Any:
    """Plain data out of Bokeh's notation; ValueError where it holds more than that."""
    if isinstance(value, list):
        return [_read(item) for item in value]
    if not isinstance(value, dict):
        return value
    kind = value.get("type")
    if kind == "map":
        return {key: _read(item) for key, item in value.get("entries", [])}
    if kind == "number":
        return float(value["value"])
    if kind is None and set(value) == {"id"}:
        return value
    raise ValueError(f"{kind} is not plain")


class LiveSocket(panel_server.WSHandler):  # type: ignore[misc]
    """The websocket of one browser."""

    _heard = 0.0  # when the browser said something last
    _credit = 100.0  # messages it may send at once
    _size = 0  # of the message that is coming [bytes]

    async def _async_open(self, token: str) -> None:
        if full(self.application_context) and not self._knows(token):
            write.trouble("full", sessions=limits.sessions)
            self.close(1013, "All places are taken.")
            return
        self._heard = time.monotonic()
        try:
            await super()._async_open(token)
        except Exception as error:
            write.trouble("refused", why=type(error).__name__)
            self.close(1008, "The session is not known.")
            return
        sockets.add(self)
        write.happened("came", self._document, sessions=len(sockets))

    @property
    def _document(self) -> Any:
        return self.connection.session.document if self.connection is not None else None

    def _knows(self, token: str) -> bool:
        from bokeh.util.token import get_session_id

        names = {session.id for session in self.application_context.sessions}
        return get_session_id(token) in names

    async def open(self, *arguments: Any, **named: Any) -> None:
        try:
            super().open(*arguments, **named)
        except Exception as error:
            write.trouble("refused", why=type(error).__name__)
            self.close(1008, "The session is not known.")

    async def on_message(self, fragment: str | bytes) -> None:
        """Take a frame: drop what is not for the page, hold back what comes too fast."""
        self._size += len(fragment)
        if self.receiver is None or self.connection is None:
            self._refuse("before the session was ready")
            return
        if self._size > limits.message:
            self.close(1009, "A message is larger than is allowed.")
            return
        try:
            message = await self.receiver.consume(fragment)
        except Exception as error:
            self._refuse(type(error).__name__)
            return
        if message is None:
            return
        self._size = 0
        await self._wait_for_turn()
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
            told = [by_name(event) for event in (events if isinstance(events, list) else [])]
            kept = [event for event in told if welcome(event, _ById(known))]
            if len(kept) == 1 and (found := _message_of(kept[0])) is not None:
                model = known.get_by_id(found[0])
                if model is not None:
                    await live.hand_on(self.connection.session, model, found[1])
            elif kept:
                message.content["events"] = kept
                await self._patch(message)
        elif kind == "PULL-DOC-REQ":
            reply = await self.handler.handle(message, self.connection)
            if reply is not None:  # from 3.10 on Bokeh sends it itself
                await self.send_message(reply)
        else:
            self._refuse("it is of a kind that the page does not send")

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

    async def _wait_for_turn(self) -> None:
        now = time.monotonic()
        rate = limits.messages_a_second
        self._credit = min(self._credit + rate * (now - self._heard), rate)
        self._heard = now
        self._credit -= 1.0
        if self._credit < 0.0:
            await asyncio.sleep(-self._credit / rate)

    def _refuse(self, why: str) -> None:
        write.trouble("refused", self._document, why=repr(why))
        self.close(1008, "This message was not understood.")

    async def send_message(self, message: Any) -> None:
        """Send a message, all of its frames in one write."""
        with live.one_write(self):
            await super().send_message(message)

    def on_close(self) -> None:
        if self in sockets:
            sockets.discard(self)
            write.happened("left", self._document, sessions=len(sockets))
        super().on_close()


class _ById:
    """Models of a document by id, without an error where there is none."""

    def __init__(self, models: Any) -> None:
        self._models = models

    def get(self, name: str) -> Any:
        return self._models.get_by_id(name)


sockets: set[LiveSocket] = set()


# The page


def full(context: Any) -> bool:
    """Whether all places of this process are taken."""
    return sum(1 for _ in context.sessions) >= limits.sessions


class PageHandler(panel_server.DocHandler):  # type: ignore[misc]
    """The page, or a friendly one that asks to come back later."""

    async def get(self, *arguments: Any, **named: Any) -> None:
        if full(self.application_context):
            self.set_status(503)
            self.set_header("Retry-After", "60")
            self._tell("All places are taken", _FULL.format(limits.sessions))
            return
        for name in ("bokeh-token", "bokeh-session-id"):
            if name in self.request.arguments:
                self.set_status(400)
                self._tell("This address does not work", _NO_SESSION)
                return
        await super().get(*arguments, **named)

    def _tell(self, title: str, words: str) -> None:
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.set_header("Cache-Control", "no-store")
        self.write(message_page(title, words))

    def write_error(self, status_code: int, **named: Any) -> None:
        self._tell("This did not work", f"The server answers {status_code}. Try the page again.")

    def head(self, *arguments: Any, **named: Any) -> None:
        """For monitors: no session is made."""


_FULL = "This server has room for {} people at once. Try again in a minute."
_NO_SESSION = "A session cannot be named in an address. Leave the part after the question mark out."


def message_page(title: str, words: str) -> str:
    """A small page with a sentence."""
    return (
        asset_text("message.html")
        .replace("{title}", html.escape(title))
        .replace("{words}", html.escape(words))
    )


class Missing(RequestHandler):
    """Whatever else is asked for."""

    def prepare(self) -> None:
        self.set_status(404)
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.finish(message_page("There is no such page", "The explorer is one page up."))


class _HasControls(Matcher):
    """Signs in a path that no file's name has; some would end in an error of the system."""

    def match(self, request: HTTPServerRequest) -> dict[str, Any] | None:
        path = unquote(request.path or "")
        return {} if any(ord(sign) < 32 or ord(sign) == 127 for sign in path) else None


class Icon(RequestHandler):
    """The logo as the page's icon, also under a path in front of the page."""

    def get(self) -> None:
        self.set_header("Content-Type", "image/svg+xml")
        self.set_header("Cache-Control", "max-age=86400")
        self.write(asset_text("logo.svg"))


# Headers

PERMISSIONS = (
    "accelerometer=(), autoplay=(), camera=(), display-capture=(), geolocation=(), gyroscope=(), "
    "magnetometer=(), microphone=(), midi=(), payment=(), usb=(), xr-spatial-tracking=()"
)


class Headers(OutputTransform):
    """Headers on every answer.

    Bokeh makes functions out of text (CustomJS) and Panel its components, so scripts may use
    `eval` and inline parts of the page; no script, style, font or picture from another server is
    ever taken.
    """

    frame_ancestors: ClassVar[tuple[str, ...]] = ("'self'",)

    def transform_first_chunk(
        self, status_code: int, headers: HTTPHeaders, chunk: bytes, finishing: bool
    ) -> tuple[int, HTTPHeaders, bytes]:
        del finishing
        headers["Content-Security-Policy"] = policy(self.frame_ancestors)
        headers["X-Content-Type-Options"] = "nosniff"
        headers["Referrer-Policy"] = "same-origin"
        headers["Permissions-Policy"] = PERMISSIONS
        headers["Cross-Origin-Opener-Policy"] = "same-origin"
        headers["Cross-Origin-Resource-Policy"] = "same-origin"
        if len(self.frame_ancestors) == 1:  # it has no way to name others
            headers["X-Frame-Options"] = "SAMEORIGIN"
        for told in ("Server", "Access-Control-Allow-Origin"):
            if told in headers:
                del headers[told]
        return status_code, headers, chunk


def policy(frame_ancestors: Sequence[str]) -> str:
    """What the page may load and do, and who may show it in a frame."""
    return "; ".join(
        [
            "default-src 'self'",
            "script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:",
            "style-src 'self' 'unsafe-inline'",
            "img-src 'self' data: blob:",
            "font-src 'self' data:",
            "connect-src 'self' blob:",
            "worker-src 'self' blob:",
            "object-src 'none'",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors " + " ".join(frame_ancestors),
        ]
    )


# Putting it together

_IDLE_WORDS = (
    "Nothing was moved for {:.0f} minutes: this session is over. Reload the page to go on."
)


def make_server(
    *,
    port: int,
    address: str,
    origins: Sequence[str] = (),
    root_path: str = "",
    num_procs: int = 1,
    frame_ancestors: Sequence[str] = (),
    bounds: Limits | None = None,
    page: Callable[[], Any],
    longest_header: int = 65536,
) -> Any:
    """The server, listening but not running yet. OSError where the port is taken."""
    global limits
    limits = bounds or limits
    Headers.frame_ancestors = ("'self'", *frame_ancestors)
    per_app_patterns[:] = [(r"/ws", LiveSocket), (r"/?", PageHandler)]
    live.visit_quickly()
    # it writes down what it does not understand, however long that is
    logging.getLogger("bokeh.protocol").setLevel(logging.CRITICAL)
    settings.perform_document_validation = False  # the tests do it
    options: dict[str, Any] = {}
    if origins:
        options["websocket_origin"] = list(origins)
    if root_path:
        options["prefix"] = root_path
    server = pn.serve(
        {"/": page},
        port=port,
        address=address,
        title="Bearing explorer",
        show=False,
        start=False,
        liveness=True,
        verbose=False,
        num_procs=num_procs,
        use_index=False,
        sign_sessions=True,
        secret_key=os.environ.get("BOKEH_SECRET_KEY", secrets.token_urlsafe(32)).encode(),
        include_headers=[],
        include_cookies=[],
        websocket_max_message_size=limits.message,
        default_handler_class=Missing,
        extra_patterns=[(r"/favicon.ico", Icon)],
        http_server_kwargs={"max_header_size": longest_header, "max_body_size": 65536},
        **options,
    )
    server._tornado.add_transform(Headers)
    server._tornado.default_router.rules.insert(0, Rule(_HasControls(), Missing))
    PeriodicCallback(_end_idle, min(5000.0, 250.0 * limits.idle)).start()
    return server


def quiet_for() -> float:
    """How long no browser has said anything [s]."""
    return time.monotonic() - max((socket._heard for socket in sockets), default=-math.inf)


def _end_idle() -> None:
    """Sessions that nobody uses are over, with a sentence on their page."""
    now = time.monotonic()
    for socket in [one for one in sockets if now - one._heard > limits.idle]:
        asyncio.get_running_loop().create_task(_say_good_bye(socket))
        sockets.discard(socket)


async def _say_good_bye(socket: LiveSocket) -> None:
    document = socket.connection.session.document
    write.happened("idle", document)
    say = live.good_byes.get(document)
    if say is not None:
        await say(_IDLE_WORDS.format(limits.idle / 60.0))
    socket.close(1001, "The session was idle.")
