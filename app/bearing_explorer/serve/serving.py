"""The server around the page: who may come in, how much they may ask for, and what it tells them.

Names of sessions are signed. What goes wrong is written to the log and answered with a sentence,
never with a traceback.
"""

from __future__ import annotations

import asyncio
import logging
import math
import os
import secrets
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import panel as pn
from bokeh.server import server as bokeh_server
from bokeh.server.urls import per_app_patterns
from bokeh.settings import settings
from tornado.ioloop import PeriodicCallback
from tornado.routing import Rule

from bearing_explorer.serve import limits, live, page_handler, places
from bearing_explorer.serve import log as write
from bearing_explorer.serve.bokeh_private import contexts_of, http_server_of
from bearing_explorer.serve.connections import BoundedServer
from bearing_explorer.serve.headers import Headers
from bearing_explorer.serve.limits import Limits
from bearing_explorer.serve.page_handler import PageHandler
from bearing_explorer.serve.small_pages import HasControls, Icon, Missing
from bearing_explorer.serve.websocket import LiveSocket, sockets

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
    not_yet: Callable[[], str] = str,
) -> Any:
    """The server, listening but not running yet. OSError where the port is taken.

    As long as `not_yet` has words to say, they stand in place of the page.
    """
    limits.use(bounds or limits.current())
    most = limits.current()
    places.reset()
    page_handler.begin(not_yet)
    sockets.clear()
    Headers.frame_ancestors = ("'self'", *frame_ancestors)
    per_app_patterns[:] = [(r"/ws", LiveSocket), (r"/?", PageHandler)]
    bokeh_server.HTTPServer = BoundedServer
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
        websocket_max_message_size=most.message,
        # what it is to leave to `places.drop_ended`
        unused_session_lifetime_milliseconds=int(4e3 * places.LINGERS),
        default_handler_class=Missing,
        extra_patterns=[(r"/favicon.ico", Icon)],
        http_server_kwargs={"max_header_size": longest_header, "max_body_size": 65536},
        **options,
    )
    server._tornado.add_transform(Headers)
    server._tornado.default_router.rules.insert(0, Rule(HasControls(), Missing))
    PeriodicCallback(lambda: _drop_ended(server), 1000.0).start()
    PeriodicCallback(_end_idle, min(5000.0, 250.0 * most.idle)).start()
    _fit(http_server_of(server).most)
    return server


async def _drop_ended(server: Any) -> None:
    for context in contexts_of(server):
        await places.drop_ended(context)


_FOR_REQUESTS = 24
"""Connections that are kept for all but websockets."""


def _fit(connections: int) -> None:
    """No more people than the system has connections for."""
    bounds = limits.current()
    fitting = max(connections - _FOR_REQUESTS, 1)
    if fitting < bounds.sessions:
        write.trouble("few-descriptors", connections=connections, sessions=fitting)
        limits.use(replace(bounds, sessions=fitting))


def quiet_for() -> float:
    """How long no browser has said anything [s]."""
    return time.monotonic() - max((socket._heard for socket in sockets), default=-math.inf)


def _end_idle() -> None:
    """Sessions that nobody uses are over, with a sentence on their page."""
    now, idle = time.monotonic(), limits.current().idle
    for socket in [one for one in sockets if now - one._heard > idle]:
        socket._heard = now  # said once
        asyncio.get_running_loop().create_task(_say_good_bye(socket))


async def _say_good_bye(socket: LiveSocket) -> None:
    document = socket.connection.session.document
    write.happened("idle", document)
    say = live.good_byes.get(document)
    if say is not None:
        await say(_IDLE_WORDS.format(limits.current().idle / 60.0))
    socket.close(1001, "The session was idle.")
