"""The server around the page: Bokeh's own, with headers, a cap on sessions, and small pages."""

from __future__ import annotations

import asyncio
import ctypes
import gc
import itertools
import os
import secrets
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import panel as pn
from bokeh.server.urls import per_app_patterns
from bokeh.settings import settings
from tornado.ioloop import PeriodicCallback

from bearing_explorer.kit.serve.bokeh_internals import find_models_quickly, parts_of
from bearing_explorer.kit.serve.headers import Headers
from bearing_explorer.kit.serve.hosts import AllowedHosts
from bearing_explorer.kit.serve.pages import Icon, Missing, PageHandler
from bearing_explorer.kit.serve.tornado_internals import HTTP_OPTIONS, bound
from bearing_explorer.kit.serve.websocket import LiveSocket, close_idle

SESSION_GRACE_SECONDS = 15.0
"""Time [s] for which a session without a browser is kept: the browser may come, or come back."""

_SWITCH_INTERVAL = 0.0005
"""Longest time [s] that a thread keeps the interpreter while the event loop waits for it.
With Python's own 5 ms, a class of thirty students waits a sixth longer."""


@dataclass(frozen=True)
class Limits:
    """Limits of a server process.

    Attributes
    ----------
    sessions
        people at once; those who come later are asked to come back.
    message
        size of a browser's message with all its frames [bytes]. Uploads come in pieces of 1 MB.
    idle
        time [s] after which a browser that sends nothing is disconnected.
    """

    sessions: int = 100
    message: int = 4 * 2**20
    idle: float = 3600.0


def make_server(
    *,
    port: int,
    address: str,
    page: Callable[[], Any],
    origins: Sequence[str] = (),
    root_path: str = "",
    num_procs: int = 1,
    frame_ancestors: Sequence[str] = (),
    limits: Limits = Limits(),
) -> Any:
    """Make the server, which listens but does not run yet. OSError if the port is taken."""
    PageHandler.most_sessions = limits.sessions
    PageHandler.one_at_a_time = asyncio.Lock()
    LiveSocket.largest = limits.message
    Headers.frame_ancestors = ("'self'", *frame_ancestors)
    per_app_patterns[:] = [(r"/ws", LiveSocket), (r"/?", PageHandler)]
    find_models_quickly()
    settings.perform_document_validation = False  # the tests validate documents
    options: dict[str, Any] = {}
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
        http_server_kwargs=dict(HTTP_OPTIONS),
        transforms=[Headers],
        unused_session_lifetime_milliseconds=int(1e3 * SESSION_GRACE_SECONDS),
        check_unused_sessions_milliseconds=1000,
        default_handler_class=Missing,
        extra_patterns=[(r"/favicon.ico", Icon)],
        **options,
    )
    if parts := parts_of(server):
        bound(*parts)
    PageHandler.hosts = LiveSocket.hosts = AllowedHosts(server.port, address, origins)
    sys.setswitchinterval(_SWITCH_INTERVAL)
    PeriodicCallback(lambda: close_idle(limits.idle), min(5000.0, 250.0 * limits.idle)).start()
    return server


_YOUNG, _MIDDLE, _FULL = 2000, 10, 1000  # Python's own: 700, 10, 10


def freeze_startup_objects() -> None:
    """Exclude from garbage collections what lasts as long as the process: modules, kernels.

    Objects of a session refer to each other, so only collections free them. Panel starts one five
    seconds after the last session has ended. While thirty students are at work, a full collection
    frees nothing and holds the event loop for a second. So full collections are made a hundred
    times less often; where people always come and go, `collect_now_and_then` makes them.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(_YOUNG, _MIDDLE, _FULL)


_ENDED_SESSIONS = 20
"""Number of ended sessions, of 4 to 5 MB each, after which garbage is collected."""
_ended = itertools.count(1)


def collect_now_and_then() -> None:
    """Free the memory of ended sessions, a number of them at once; call it as a session ends."""
    if next(_ended) % _ENDED_SESSIONS == 0:
        gc.collect()
        with suppress(AttributeError, OSError):  # another C library than glibc
            ctypes.CDLL(None).malloc_trim(0)
