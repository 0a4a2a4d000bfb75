"""Octave's text format: what `save` writes where no other is asked for.

Runs in the process of `child` alone. Each value has a head of lines such as "# type: matrix".
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from bearingcore.files.formats import Variables

DEEPEST = 8
"""Structs and cells inside one another."""


def walk_octave(content: bytes, found: Variables) -> None:
    """Add the path and value of each matrix, number and word, as in MATLAB.

    Raises
    ------
    ValueError, IndexError
        for a damaged text.
    """
    text = _Lines(content.decode("latin-1").splitlines())
    while text.skip_to("name"):
        _value(text, text.said("name"), found, 0)


class _Lines:
    """Lines that are read one after another."""

    def __init__(self, lines: list[str]) -> None:
        self._lines, self._place = lines, 0

    def skip_to(self, key: str) -> bool:
        """Whether there is another line with this key; it is the next one."""
        while self._place < len(self._lines):
            if self._lines[self._place].startswith(f"# {key}:"):
                return True
            self._place += 1
        return False

    def said(self, key: str) -> str:
        """The word of the next line with this key."""
        if not self.skip_to(key):
            raise ValueError(key)
        return self.take(1)[0].partition(":")[2].strip()

    def take(self, count: int) -> list[str]:
        """The next lines."""
        if count < 0 or self._place + count > len(self._lines):
            raise ValueError("the end of the text")
        self._place += count
        return self._lines[self._place - count : self._place]

    def numbers(self, count: int) -> np.ndarray:
        """The numbers of the next lines in a row."""
        return np.array(" ".join(self.take(count)).split(), dtype=float)

    def numbers_after(self, key: str) -> np.ndarray:
        """The numbers of the line after the one that begins so."""
        while not self.take(1)[0].startswith(f"# {key}"):
            pass
        return self.numbers(1)

    def holds(self, key: str) -> bool:
        """Whether the next line has this key."""
        return self._lines[self._place].startswith(f"# {key}:")


def _value(text: _Lines, path: str, found: Variables, depth: int) -> None:
    """A value of any type; those that are no numbers or words are passed over."""
    if depth > DEEPEST:
        raise ValueError("structs inside one another")
    kind = text.said("type")
    if "complex" in kind or "sparse" in kind:
        return
    if kind in ("scalar struct", "cell"):
        keys = ("length",) if kind == "scalar struct" else ("rows", "columns")
        inside = math.prod(int(text.said(key)) for key in keys)
        for index in range(inside):
            name = text.said("name")
            part = f"{path}{{{index + 1}}}" if kind == "cell" else f"{path}.{name}"
            _value(text, part, found, depth + 1)
    elif kind in ("string", "sq_string"):
        if int(text.said("elements")):
            found.add(path, np.array([text.take(2)[1]]))
    elif kind.endswith("scalar"):
        found.add(path, text.numbers(1))
    elif kind.endswith("range"):
        base, limit, step = text.numbers_after("base, limit, increment")
        found.add(path, base + step * np.arange(round((limit - base) / step) + 1))
    elif kind.endswith("matrix") and text.holds("rows"):
        shape = int(text.said("rows")), int(text.said("columns"))
        found.add(path, text.numbers(shape[0]).reshape(shape))
    elif kind.endswith("matrix") and text.holds("ndims"):  # of whole numbers, or of more dimensions
        text.said("ndims")
        sizes = text.numbers(1).astype(int).tolist()
        found.add(path, text.numbers(math.prod(sizes)).reshape(sizes, order="F"))
