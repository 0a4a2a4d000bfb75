"""One at a time, and nobody's many before another's first.

Making a page holds the event loop for a tenth of a second. Where many are asked for at once they
are made one after the other, with a pause in which all else is served, and addresses take turns.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

PAUSE = 0.03
"""[s] after each turn, for everybody else."""


class Turns:
    """A line for each key; the lines take turns."""

    def __init__(self, pause: float = PAUSE) -> None:
        self._pause = pause
        self._busy = False
        self._lines: dict[str, deque[asyncio.Future[None]]] = {}

    @property
    def waiting(self) -> int:
        """How many wait."""
        return sum(len(line) for line in self._lines.values())

    @asynccontextmanager
    async def turn(self, key: str) -> AsyncIterator[None]:
        """Wait for a turn of `key`, and keep all others waiting for as long as the block lasts."""
        if self._busy:
            mine: asyncio.Future[None] = asyncio.get_running_loop().create_future()
            self._lines.setdefault(key, deque()).append(mine)
            try:
                await mine
            except asyncio.CancelledError:
                if not mine.cancelled():  # its turn had come: it goes to the next
                    self._next()
                raise
        self._busy = True
        try:
            yield
        finally:
            asyncio.get_running_loop().call_later(self._pause, self._next)

    def _next(self) -> None:
        while self._lines:
            key = next(iter(self._lines))
            line = self._lines.pop(key)
            while line and line[0].done():  # gave up waiting
                line.popleft()
            if not line:
                continue
            line.popleft().set_result(None)
            if line:
                self._lines[key] = line  # behind all other lines
            return
        self._busy = False
