"""What a message would cost to parse, known from its bytes alone.

A parser makes fifty bytes of objects out of two bytes of text, and half a second of silence out of
a megabyte of brackets. Counting brackets, commas and quotes takes a hundredth of that, so it is
done first, and what goes beyond any message of the page is never parsed.
"""

from __future__ import annotations

import re

#: a string in JSON, whatever is in it; characters that are escaped are passed over in pairs
_STRING = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"', re.DOTALL)
_BRACKET = re.compile(r"[\[\]{}]")

BYTES_A_MESSAGE = 100_000
ITEMS_A_MESSAGE = 100
"""What a message may hold that counts as one; larger ones count as several."""


def too_much(text: str, items: int, depth: int) -> str | None:
    """Why `text` is not worth parsing, in a few words; None where it is.

    Linear in the length of the text, and most of it in the C library's search for a byte.
    """
    opening = text.count("[") + text.count("{")
    if opening + text.count(",") > items or opening > depth:
        # what people wrote may hold any number of commas and brackets: it stands in strings
        if text.count('"') > 4 * items:
            return "it holds too many texts"
        text = _STRING.sub('""', text)
        opening = text.count("[") + text.count("{")
    if opening + text.count(",") > items:
        return "it holds too many values"
    if opening > depth and _depth(text) > depth:
        return "its lists are too deep"
    return None


def _depth(text: str) -> int:
    """How deep brackets stand in brackets."""
    level = deepest = 0
    for found in _BRACKET.finditer(text):
        level += 1 if found[0] in "[{" else -1
        deepest = max(deepest, level)
    return deepest


def weight(size: int, text: str) -> float:
    """As how many messages one counts that is `size` bytes long, its content being `text`."""
    items = text.count(",") + text.count("[") + text.count("{") if size < BYTES_A_MESSAGE else 0
    return max(1.0, size / BYTES_A_MESSAGE, items / ITEMS_A_MESSAGE)
