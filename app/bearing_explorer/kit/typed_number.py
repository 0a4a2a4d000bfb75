"""Numbers as a person types them."""

from __future__ import annotations

import math
import re

from bearingcore.common import number, span


def number_of(text: str, words: str, unit: str, least: float, most: float) -> float:
    """The number that a person typed; ValueError with a sentence."""
    bare = re.sub(r"(?<=\d)[\s'](?=\d{3}\b)", "", text.strip()).replace("−", "-")
    bare = re.sub(rf"\s*{re.escape(unit)}$", "", bare, flags=re.IGNORECASE) if unit else bare
    if not bare:
        raise ValueError(f"{words} is missing: type it in{f' ({unit})' if unit else ''}.")
    try:
        value = float(bare.replace(",", "."))
    except ValueError:
        raise ValueError(f"{words} must be a number, not “{text[:20]}”.") from None
    if not math.isfinite(value) or not least <= value <= most:
        allowed = (
            span(least, most, unit, 6).rstrip()
            if math.isfinite(most)
            else f"at least {number(least, 6)} {unit}".rstrip()
        )
        raise ValueError(f"{words} is {number(value, 6)}; possible: {allowed}.")
    return value
