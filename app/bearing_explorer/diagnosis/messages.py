"""Messages of the browser about files; see `kit.messages`."""

from __future__ import annotations

import msgspec


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
