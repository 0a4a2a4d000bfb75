"""Where a picture is computed: light ones in turn on the event loop, all others in threads.

A thread that computes and the event loop take the interpreter from each other some forty times a
picture, which costs as much as a light picture itself. With a class on board that is what everybody
waits for. So what was light the last time, and is of the same kind now, is computed on the event
loop: one session after the other, and between two of them all that browsers have said is heard.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Hashable
from typing import TypeVar
from weakref import WeakKeyDictionary

from app.live import in_thread

Result = TypeVar("Result")

LIGHT = 0.006
"""[s] of one core that a light picture may cost."""
_MOST_KINDS = 64

_turns: WeakKeyDictionary[asyncio.AbstractEventLoop, asyncio.Lock] = WeakKeyDictionary()


class Turns:
    """Computes the pictures of one session, and remembers what kinds of them cost."""

    def __init__(self) -> None:
        self._cost: dict[Hashable, float] = {}
        #: how long its pictures have waited for those of others, since somebody set it to 0 [s]
        self.queued = 0.0

    def is_light(self, kind: Hashable) -> bool:
        """Whether the last picture of this kind was a light one."""
        return self._cost.get(kind, LIGHT) < LIGHT

    async def run(self, kind: Hashable, function: Callable[..., Result], *args: object) -> Result:
        """Run `function` where its kind belongs, and remember what it cost."""
        asked = time.perf_counter()

        def measured() -> Result:
            self.queued += time.perf_counter() - asked
            before = time.thread_time()
            try:
                return function(*args)
            finally:
                self._note(kind, time.thread_time() - before)

        if not self.is_light(kind):
            return await in_thread(measured)
        turn = _turns.setdefault(asyncio.get_running_loop(), asyncio.Lock())
        async with turn:
            await asyncio.sleep(0.0)  # what browsers have said meanwhile
            return measured()

    async def run_slow(self, function: Callable[..., Result], *args: object) -> Result:
        """Run what takes long, in the threads that are for it."""
        asked = time.perf_counter()

        def begun() -> Result:
            self.queued += time.perf_counter() - asked
            return function(*args)

        return await in_thread(begun, slow=True)

    def _note(self, kind: Hashable, seconds: float) -> None:
        if len(self._cost) >= _MOST_KINDS:
            self._cost.clear()
        self._cost[kind] = seconds
