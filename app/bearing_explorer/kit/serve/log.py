"""The log: warnings by default, a line for each update with ``--log-level info``.

2026-11-21 08:00:00 INFO update session=q7Zk2a1B scene=5f0c9e12 view=load ms=12.3
"""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Callable
from typing import Any

LEVELS = ("warning", "info")

log = logging.getLogger("bearing_explorer")


def begin(level: str) -> None:
    """Write to standard error from now on; `level` is one of LEVELS."""
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(levelname)s %(message)s")
    log.setLevel(level.upper())
    # Bokeh logs whole messages of browsers that it does not understand
    logging.getLogger("bokeh.protocol").setLevel(logging.CRITICAL)
    # Tornado logs each answer of 503, which a browser gets each second while kernels are compiled
    logging.getLogger("tornado.access").setLevel(logging.CRITICAL)


def session_name(document: Any) -> str:
    """Return the first letters of a session's name: enough to follow it, too few to enter it."""
    context = getattr(document, "session_context", None)
    return str(getattr(context, "id", "none"))[:8]


def short_digest(value: object) -> str:
    """Return eight digits that are the same for equal values."""
    return hashlib.blake2b(repr(value).encode(), digest_size=4).hexdigest()


def update(document: Any, name: Callable[[], str], view: str, seconds: float) -> None:
    """Log that a view drew the named content, and how long that took [s]."""
    if log.isEnabledFor(logging.INFO):
        place = (session_name(document), name(), view)
        log.info("update session=%s scene=%s view=%s ms=%.1f", *place, 1e3 * seconds)


def log_warning(event: str, document: Any = None, **more: object) -> None:
    """Log that something went wrong in a session, or with a message of a browser."""
    pairs = {"session": session_name(document), **more} if document is not None else more
    log.warning("%s %s", event, " ".join(f"{name}={value}" for name, value in pairs.items()))
