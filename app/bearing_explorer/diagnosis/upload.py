"""A file from a browser, in pieces, because a message may hold only a few MB.

Name, size and pieces are checked here, because any program can send them.
"""

from __future__ import annotations

from typing import Any

MOST_BYTES = 24 * 2**20
"""Size of the largest file that is accepted from a browser."""

PIECE = 2**20
"""Size [bytes] of the pieces that the browser sends; far below the limit of the websocket."""

FIRST_LINES, LONGEST_LINE = 5, 120
"""Lines of a refused text that are shown, and characters of each."""

LONGEST_NAME = 60
NAME_IN_LINE = 24
"""Longest name [characters] in a line with other facts."""


class Upload:
    """Gathers the pieces of one file.

    Parameters
    ----------
    name, size
        of the file, as the browser gives them; the size in bytes.

    Raises
    ------
    ValueError
        with a sentence, for a file that is empty or too large.
    """

    def __init__(self, name: Any, size: Any) -> None:
        self.name = shown_name(name)
        if not isinstance(size, int) or isinstance(size, bool) or size < 0:
            raise ValueError(f"{self.name} has no size.")
        if size == 0:
            raise ValueError(f"{self.name} is empty.")
        if size > MOST_BYTES:
            raise ValueError(
                f"{self.name} is {size / 2**20:.0f} MB long; at most {MOST_BYTES // 2**20} MB are "
                "taken. Export a shorter part: a few seconds are enough."
            )
        self.size = size
        #: the bytes received so far
        self.content = bytearray()

    @property
    def whole(self) -> bool:
        """True once the file is complete."""
        return len(self.content) == self.size

    def take(self, piece: Any) -> None:
        """Add a piece; ValueError with a sentence for one that cannot be a part of the file."""
        if not isinstance(piece, bytes | bytearray | memoryview):
            raise ValueError(f"{self.name} was not received in full.")
        data = bytes(piece)
        if not data or len(data) > PIECE or len(self.content) + len(data) > self.size:
            raise ValueError(f"{self.name} was not received in full.")
        self.content += data


def first_lines(content: bytes) -> str:
    """The first lines of a refused text, which may show the reason; empty for other files."""
    encoding = "utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8"
    text = content[:20_000].decode(encoding, "replace")
    lines = [line.expandtabs(4)[:LONGEST_LINE] for line in text.splitlines()[:FIRST_LINES]]
    return "\n".join(lines) if all(line.isprintable() for line in lines) else ""


def shown_name(name: Any) -> str:
    """The name of a file, short and printable."""
    text = "".join(c for c in str(name)[:400] if c.isprintable())
    text = " ".join(text.split())
    return without_middle(text, LONGEST_NAME) or "The file"


def without_middle(name: str, longest: int) -> str:
    """Shorten a name to `longest` characters by leaving out its middle.

    The end stays: its number and suffix distinguish the files of one set.
    """
    if len(name) <= longest:
        return name
    end = min(11, longest // 2)
    return f"{name[: longest - end - 1]}…{name[-end:]}"
