"""Messages of the page's scripts: one class for each, checked when they arrive.

The scripts of the page send maps of plain values. `read` makes one of the classes here of a map, or
refuses it; the receivers see only messages that are whole.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any, TypeVar

import msgspec

log = logging.getLogger(__name__)

Kind = TypeVar("Kind")


def read(kind: type[Kind], data: Any) -> Kind | None:
    """A message of a kind out of what a browser sent; None, with a line of the log, if it fails."""
    try:
        return msgspec.convert(data, kind, builtin_types=(bytes,))
    except (msgspec.ValidationError, UnicodeError) as error:
        log.info("a message was ignored: %s", error)
        return None


def take(act: Callable[[dict[str, Any]], None], kind: type[msgspec.Struct], data: Any) -> None:
    """Call `act` with a message of a kind, as a dictionary of its fields without their defaults."""
    message = read(kind, data)
    if message is not None:
        act(msgspec.to_builtins(message))


class TextFile(msgspec.Struct):
    """A text file that was chosen, or a scene that was kept: its name and its text."""

    name: str
    text: str


class TabChange(msgspec.Struct):
    """A tab is chosen by its name."""

    show: str


class UploadBegins(msgspec.Struct, tag="begin"):
    """A file was chosen: its name and its size [bytes].

    It is the `number`th of `count` that come, from 1, out of so many that were `chosen`; or the
    `baseline` with which the file that is there is to be compared.
    """

    name: str
    size: int
    number: int = 1
    count: int = 1
    chosen: int = 1
    baseline: bool = False


class UploadPiece(msgspec.Struct, tag="piece"):
    """A piece of a file; `of` is the number of the upload, as the server gave it."""

    content: bytes
    of: int


class RoleOfColumn(msgspec.Struct):
    """The role of a column of a file, from 0, was chosen, or the unit or place of a signal."""

    column: int
    role: str
    unit: str = ""
    place: str = ""
