"""Inputs made of good ones by breaking them, each repeatable by its number."""

import random
import re
from collections.abc import Sequence
from typing import Any

NUMBERS = (
    *("0", "-0", "1", "-1", "nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "1e400", "0x10"),
    *("9" * 30, "9" * 400, "1_000", "١٢", "1,5", "0.1", "65536", "2147483648", "1e5", "-7", "14"),
)
TOKENS = (
    *"\x00\ufeff\u202e\ud800\n\r\t\"'[]{}=#;,./&?%+é😀",
    *("..", "../../etc/passwd", "%00", "%s%n", "${7*7}", "{{7*7}}", "<script>", "__class__"),
    *("__import__('os')", "!!python/object", "true", "null", " " * 300, "a" * 3000, "[" * 300),
    *("defect", "bearing", "extent"),
)


def text_like(random_: random.Random, seeds: Sequence[str]) -> str:
    """A good text with something wrong, or sometimes nothing but noise."""
    text = random_.choice(seeds)
    for _ in range(random_.choice((1, 1, 1, 2, 3, 6))):
        text = _break_text(random_, text, seeds)
    return text[:200_000]


def _break_text(random_: random.Random, text: str, seeds: Sequence[str]) -> str:
    at = random_.randrange(len(text) + 1)
    end = min(len(text), at + random_.choice((1, 2, 5, 20, 100)))
    way = random_.randrange(9)
    if way == 0:
        return text[:at] + text[end:]
    if way == 1:
        return text[:at] + random_.choice(TOKENS) + text[at:]
    if way == 2:
        return text[:at] + text[at:end] * random_.choice((2, 3, 10)) + text[end:]
    if way == 3:
        return text[:at]
    if way == 4:
        other = random_.choice(seeds)
        return text[:at] + other[random_.randrange(len(other) + 1) :]
    if way == 5:
        noise = "".join(chr(random_.choice((*range(32, 127), *range(0x3F0)))) for _ in range(8))
        return text[:at] + noise + text[end:]
    if way == 6:
        lines = text.split("\n")
        i, j = random_.randrange(len(lines)), random_.randrange(len(lines))
        lines[i], lines[j] = lines[j], lines[i]
        return "\n".join(lines)
    numbers = list(re.finditer(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?", text))
    if not numbers:
        return text + random_.choice(NUMBERS)
    number = random_.choice(numbers)
    return text[: number.start()] + random_.choice(NUMBERS) + text[number.end() :]


def bytes_like(random_: random.Random, seeds: Sequence[bytes]) -> bytes:
    """The same of a file; its head is hit more often than its middle."""
    content = bytearray(random_.choice(seeds))
    for _ in range(random_.choice((1, 1, 2, 4, 10))):
        reach = min(len(content), random_.choice((64, 256, len(content) + 1)))
        at = random_.randrange(reach + 1)
        way = random_.randrange(6)
        if way == 0 and content:
            content[min(at, len(content) - 1)] = random_.randrange(256)
        elif way == 1:
            word = random_.choice((0, 1, 2**31 - 1, 2**31, 2**32 - 1, 3, 14, 15, 9))
            content[at : at + 4] = word.to_bytes(4, random_.choice(("little", "big")))
        elif way == 2:
            del content[at:]
        elif way == 3:
            del content[at : at + random_.choice((1, 3, 40))]
        elif way == 4:
            content[at:at] = random_.randbytes(random_.choice((1, 4, 30)))
        else:
            content += random_.randbytes(random_.choice((1, 100)))
    return bytes(content)


def plain_value(random_: random.Random, depth: int = 0) -> Any:
    """Anything that a message in JSON, or with the bytes of a file, can hold."""
    way = random_.randrange(12 if depth < 3 else 9)
    if way == 0:
        return random_.choice((None, True, False))
    if way == 1:
        return random_.choice((0, -1, 1, 7, 2**24, 2**63, -(2**70), 10**400))
    if way == 2:
        return random_.choice((0.0, -0.0, 1.5, float("nan"), float("inf"), -1e308, 5e-324, 33.3))
    if way in (3, 4):
        return random_.choice((*NUMBERS, *TOKENS))
    if way == 5:
        return random_.uniform(-400.0, 400.0)
    if way == 6:
        return random_.randbytes(random_.choice((0, 3, 50)))
    if way in (7, 8):
        return str(random_.uniform(-400.0, 400.0))
    if way == 9:
        return [plain_value(random_, depth + 1) for _ in range(random_.randrange(4))]
    return {
        random_.choice((*TOKENS[:20], "set", "mark", "name", "x")): plain_value(random_, depth + 1)
        for _ in range(random_.randrange(4))
    }
