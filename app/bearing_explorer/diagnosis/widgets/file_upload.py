"""Files of the browser, sent in pieces that the server requests.

Panel's FileInput sends a file as one message: a large one would hold up all others or end the
connection, and neither shows how much has arrived.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import msgspec
import param
from panel.custom import JSComponent

from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.messages import read


class UploadBegins(msgspec.Struct, tag="begin"):
    """A file was chosen: its name and its size [bytes].

    It is the `number`th (from 1) of `count` files that are sent, out of `chosen` files.
    """

    name: str
    size: int
    number: int = 1
    count: int = 1
    chosen: int = 1


class UploadPiece(msgspec.Struct, tag="piece"):
    """A piece of a file; `of` is the number of the upload, as the server gave it."""

    content: bytes
    of: int


class FileUpload(JSComponent):
    """Buttons to choose files or a folder, a place to drop files, and a bar.

    Parameters
    ----------
    received
        called with each message of the browser, on the event loop.
    """

    largest = param.Integer(doc="Size of a file that is sent [bytes].")
    piece = param.Integer(doc="Size of a piece [bytes].")
    most = param.Integer(doc="Largest number of files; of more, so many are taken.")
    note = param.String()

    _esm = scripts("element.js", "file_upload.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("file_upload.css")]

    def __init__(
        self, received: Callable[[UploadBegins | UploadPiece], None], **params: Any
    ) -> None:
        super().__init__(margin=0, sizing_mode="stretch_width", **params)
        self._received = received
        self.on_msg(lambda event: self._take(event.data))

    def want(self, first: int, of: int) -> None:
        """Ask for the piece that begins at a byte, of the upload with a number."""
        self._send_msg({"first": first, "of": of})

    def more(self) -> None:
        """Ask for the next file."""
        self._send_msg({"more": True})

    def _take(self, data: Any) -> None:
        message = read(UploadBegins | UploadPiece, data)  # type: ignore[arg-type]
        if message is not None:
            self._received(message)
