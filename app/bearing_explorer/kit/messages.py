"""Messages of the page's scripts: one class for each, checked when they arrive.

The scripts of the page send maps of plain values. `read` makes a message of a map, or refuses it;
the receivers see only messages that are whole. Each half has its own classes of messages.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any, TypeVar

import msgspec

log = logging.getLogger(__name__)

Kind = TypeVar("Kind")


def read(kind: type[Kind], data: Any) -> Kind | None:
    """Make a message of a kind from a browser's data; None, with a line in the log, if it fails."""
    try:
        return msgspec.convert(data, kind, builtin_types=(bytes,))
    except (msgspec.ValidationError, UnicodeError) as error:
        log.info("a message was ignored: %s", error)
        return None


def take(act: Callable[[dict[str, Any]], None], kind: type[msgspec.Struct], data: Any) -> None:
    """Call `act` with a message of a kind as a dictionary, where defaults may be absent."""
    message = read(kind, data)
    if message is not None:
        act(msgspec.to_builtins(message))


class TabChange(msgspec.Struct):
    """A tab is chosen by its name."""

    show: str
