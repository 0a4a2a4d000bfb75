"""What a process gives at most, to one browser and to all of them."""

from __future__ import annotations

from dataclasses import dataclass

MEGABYTE = 2**20


@dataclass(frozen=True)
class Limits:
    """What a process gives at most.

    Attributes
    ----------
    sessions
        people at once: browsers that are connected.
    message
        of a browser, all of its frames [bytes]. Files are uploaded in pieces of 1 MB; the largest
        text is a scene with a measured floor.
    items
        values, keys and brackets of a message, counted before it is parsed.
    depth
        of lists in lists.
    buffers
        blocks of bytes that belong to a message.
    idle
        after which a session that says nothing is over [s].
    messages_a_second
        of one browser; what comes faster waits. Large messages count as several.
    unread
        of what was sent to a browser and not taken by it [bytes].
    unclaimed
        pages that one address was given and that have not connected; then the oldest is given up.
    """

    sessions: int = 100
    message: int = 4 * MEGABYTE
    items: int = 5_000
    depth: int = 32
    buffers: int = 4
    idle: float = 3600.0
    messages_a_second: float = 200.0
    unread: int = 64 * MEGABYTE
    unclaimed: int = 32


_current = Limits()


def current() -> Limits:
    """The limits of this process."""
    return _current


def use(bounds: Limits) -> None:
    """From now on these are the limits of this process."""
    global _current
    _current = bounds
