"""Messages of the browser's scripts, as data: one class for each, checked when they arrive.

The scripts of the page send maps of plain values. `read` makes one of the classes here of a map, or
refuses it; the receivers see only messages that are whole.
"""

from __future__ import annotations

from typing import Annotated, Any, TypeVar

import msgspec

Kind = TypeVar("Kind")

Name = Annotated[str, msgspec.Meta(max_length=400)]


def read(kind: type[Kind], data: Any) -> Kind | None:
    """A message of a kind out of what a browser sent; None where it is no such message."""
    try:
        return msgspec.convert(data, kind, builtin_types=(bytes,))
    except msgspec.ValidationError:
        return None


class UploadBegins(msgspec.Struct, tag="begin"):
    """A file was chosen: its name and its size [bytes]."""

    name: str
    size: int


class UploadPiece(msgspec.Struct, tag="piece"):
    """A piece of a file; `of` is the number of the upload, as the server gave it."""

    content: bytes
    of: int
