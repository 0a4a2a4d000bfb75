"""What the server writes down: nothing but trouble by default, a line an update when asked.

Lines are words and pairs of name and value, to be read and to be cut by programs:

    2026-11-21 08:00:00 INFO update session=q7Zk2a1B scene=5f0c9e12 view=load ms=12.3
"""

from __future__ import annotations

import hashlib
import logging
import sys
from typing import Any

LEVELS = ("warning", "info")
"""How much is written: trouble alone, or also who comes and goes and every update."""

log = logging.getLogger("bearing_explorer")


def begin(level: str) -> None:
    """Write to standard error from now on; `level` is one of LEVELS."""
    logging.basicConfig(
        stream=sys.stderr, level=logging.WARNING, format="%(asctime)s %(levelname)s %(message)s"
    )
    log.setLevel(level.upper())


def session_name(document: Any) -> str:
    """The first letters of a session's name: enough to follow it, too few to enter it."""
    context = getattr(document, "session_context", None)
    return str(getattr(context, "id", "none"))[:8]


def scene_name(scene: object) -> str:
    """Eight digits that equal scenes share."""
    return hashlib.blake2b(repr(scene).encode(), digest_size=4).hexdigest()


def update(document: Any, scene: object, view: str, seconds: float) -> None:
    """That a change was drawn, and how long that took [s]."""
    if log.isEnabledFor(logging.INFO):
        log.info(
            "update session=%s scene=%s view=%s ms=%.1f",
            session_name(document),
            scene_name(scene),
            view,
            1e3 * seconds,
        )


def happened(what: str, document: Any = None, **more: object) -> None:
    """That something happened to a session."""
    if log.isEnabledFor(logging.INFO):
        pairs = {"session": session_name(document), **more} if document is not None else more
        log.info("%s %s", what, " ".join(f"{name}={value}" for name, value in pairs.items()))


def trouble(what: str, document: Any = None, **more: object) -> None:
    """The same at the level that is always written."""
    pairs = {"session": session_name(document), **more} if document is not None else more
    log.warning("%s %s", what, " ".join(f"{name}={value}" for name, value in pairs.items()))
