"""Where a picture is computed: light ones in turn on the event loop, all others in threads.

A thread that computes and the event loop take the interpreter from each other some forty times a
picture, which costs as much as a light picture itself. With a class on board that is what everybody
waits for. So what was light the last time, and is of the same kind now, is computed on the event
loop: one session after the other, and between two of them all that browsers have said is heard.

What a session plans while its hand rests would make the pictures of all others cost six times as
much if it ran in a thread. It has its turn too, where it is light, after all pictures that wait.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Hashable, Iterator
from concurrent.futures import Executor
from contextlib import contextmanager, suppress
from typing import TypeVar
from weakref import WeakKeyDictionary

from bearing_explorer.results import compiling
from bearing_explorer.results.executors import in_thread
from bearing_explorer.results.single_flight import WouldWait, never_waiting

Result = TypeVar("Result")

LIGHT = 0.006
"""[s] of one core that a light picture may cost."""
LIGHT_IDLE_WORK = 0.03
"""[s] of one core that light idle work may cost."""
PATIENCE = 2.0
"""[s] that light idle work lets pictures pass."""
_MOST_KINDS = 64


class _Line:
    """Who waits for a turn on one event loop."""

    def __init__(self) -> None:
        self.turn = asyncio.Lock()
        self.idle = asyncio.Lock()
        self.pictures = 0  # that wait


_lines: WeakKeyDictionary[asyncio.AbstractEventLoop, _Line] = WeakKeyDictionary()


class Scheduler:
    """Computes the pictures of one session, and remembers what kinds of them cost."""

    def __init__(self) -> None:
        self._cost: dict[Hashable, float] = {}
        #: how long its pictures took once they had their turn, since somebody set it to 0 [s]
        self.worked = 0.0

    def is_light(self, kind: Hashable, light: float = LIGHT) -> bool:
        """Whether pictures of this kind were light of late."""
        return self._cost.get(kind, light) < light

    async def run(self, kind: Hashable, function: Callable[..., Result], *args: object) -> Result:
        """Run `function` where its kind belongs, and remember what it cost."""

        def measured() -> Result:
            return self._measured(kind, function, *args)

        if not self.is_light(kind):
            return await in_thread(measured)
        line = _line()
        line.pictures += 1
        try:
            await line.turn.acquire()
        finally:
            line.pictures -= 1
        try:
            await asyncio.sleep(0.0)  # what browsers have said meanwhile
            with _on_the_loop():
                return measured()
        except WouldWait:
            pass  # for what a thread has at work: so a thread waits
        finally:
            line.turn.release()
        return await in_thread(measured)

    async def run_slow(self, function: Callable[..., Result], *args: object) -> Result:
        """Run what takes long, in the threads that are for it."""
        return await in_thread(self._measured, None, function, *args, slow=True)

    async def run_idle(
        self,
        threads: Executor,
        kind: Hashable | None,
        function: Callable[..., Result],
        *args: object,
    ) -> Result:
        """Run what nobody waits for: in `threads`, or where it is light after all pictures.

        What has no kind is never light. Cancelled before it had its turn it never begins.
        """
        kind = None if kind is None else ("idle", kind)

        async def in_threads() -> Result:
            return await asyncio.wrap_future(threads.submit(self._noted, kind, function, *args))

        if kind is None or not self.is_light(kind, LIGHT_IDLE_WORK):
            return await in_threads()
        line = _line()
        async with line.idle:
            end = time.monotonic() + PATIENCE
            while line.pictures and time.monotonic() < end:
                await asyncio.sleep(0.01)
            async with line.turn:
                with suppress(WouldWait), _on_the_loop():
                    return self._noted(kind, function, *args)
        return await in_threads()

    def _measured(
        self, kind: Hashable | None, function: Callable[..., Result], *args: object
    ) -> Result:
        began = time.perf_counter()
        result = self._noted(kind, function, *args)
        self.worked += time.perf_counter() - began
        return result

    def _noted(
        self, kind: Hashable | None, function: Callable[..., Result], *args: object
    ) -> Result:
        before = time.thread_time()
        result = function(*args)
        cost = time.thread_time() - before
        if kind is not None:
            if len(self._cost) >= _MOST_KINDS:
                self._cost.clear()
            # what was found among results that are known says little about the next
            self._cost[kind] = max(cost, 0.5 * self._cost.get(kind, 0.0))
        return result


@contextmanager
def _on_the_loop() -> Iterator[None]:
    """What is computed here waits for no thread: it raises `WouldWait` instead."""
    if compiling.here():
        raise WouldWait
    with never_waiting():
        yield


def _line() -> _Line:
    return _lines.setdefault(asyncio.get_running_loop(), _Line())
