"""What the server writes down: nothing but trouble by default, a line an update when asked.

Lines are words and pairs of name and value, to be read and to be cut by programs:

    2026-11-21 08:00:00 INFO update session=q7Zk2a1B scene=5f0c9e12 view=load ms=12.3
"""

from __future__ import annotations

import hashlib
import logging
import sys
import time
from collections.abc import Callable
from typing import Any

LEVELS = ("warning", "info")
"""How much is written: trouble alone, or also who comes and goes and every update."""

log = logging.getLogger("bearing_explorer")


_LONGEST_LINE = 1000  # characters, but for what follows it of an error of our own


def begin(level: str) -> None:
    """Write to standard error from now on; `level` is one of LEVELS."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(OneLine("%(asctime)s %(levelname)s %(message)s"))
    handler.addFilter(meant_so)
    handler.addFilter(Seldom())
    logging.basicConfig(level=logging.WARNING, handlers=[handler])
    log.setLevel(level.upper())


def meant_so(record: logging.LogRecord) -> bool:
    """Whether a line is trouble: that somebody was asked to come back later (503) is none."""
    status = record.args[0] if isinstance(record.args, tuple) and record.args else None
    asked_back = record.name == "tornado.access" and status == 503
    return not asked_back or log.isEnabledFor(logging.INFO)


class OneLine(logging.Formatter):
    """Whatever strangers sent that stands in a line, it stays one line and moves no cursor."""

    def formatMessage(self, record: logging.LogRecord) -> str:  # noqa: N802 - logging's name
        """The line."""
        line = super().formatMessage(record)[:_LONGEST_LINE]
        return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in line)


class Seldom(logging.Filter):
    """Trouble of one kind is written once a second at most; the next line counts the others.

    A flood must not become one of lines. What is of one kind is known by the place in a program
    that writes it, and by the first word of our own lines.
    """

    def __init__(self, now: Callable[[], float] = time.monotonic, pause: float = 1.0) -> None:
        super().__init__()
        self._now = now
        self._pause = pause
        self._last: dict[tuple[object, ...], tuple[float, int]] = {}

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether a line is to be written."""
        if record.levelno < logging.WARNING:
            return True
        what = record.args[0] if record.name == log.name and record.args else None  # type: ignore[index]
        kind = (record.pathname, record.lineno, what)
        now = self._now()
        last, more = self._last.get(kind, (-self._pause, 0))
        if now - last < self._pause:
            self._last[kind] = (last, more + 1)
            return False
        self._last[kind] = (now, 0)
        if more:
            record.msg, record.args = f"{record.getMessage()} ({more} more like it)", ()
        return True


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
