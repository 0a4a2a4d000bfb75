"""The threads of a process: who begins some makes a pool here, so that a stop knows of all."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, TypeVar

Result = TypeVar("Result")

_GRACE = 0.2  # [s] for threads that do nothing to end


class Pool(ThreadPoolExecutor):
    """Some threads with a name; what they are at can be asked for."""

    def __init__(self, most: int, name: str) -> None:
        super().__init__(most, name)
        self._unfinished: set[Future[Any]] = set()
        _pools.append(self)

    def submit(
        self, function: Callable[..., Result], /, *arguments: Any, **named: Any
    ) -> Future[Result]:
        """Have it called in one of the threads."""
        future = super().submit(function, *arguments, **named)
        self._unfinished.add(future)
        future.add_done_callback(self._unfinished.discard)
        return future

    @property
    def at_work(self) -> list[Future[Any]]:
        """What its threads compute at this moment; not what waits for its turn."""
        return [future for future in self._unfinished.copy() if future.running()]

    def ended(self, by: float) -> bool:
        """Whether all of its threads end until a time of `time.monotonic` [s]."""
        for thread in list(self._threads):
            thread.join(max(by - time.monotonic(), 0.0))
        return not any(thread.is_alive() for thread in self._threads)


_pools: list[Pool] = []


def at_work() -> list[Future[Any]]:
    """What all threads compute at this moment."""
    return [future for pool in _pools for future in pool.at_work]


def still_at_work() -> bool:
    """Begin nothing more; whether a thread still computes what nobody will see.

    Python itself would wait for all of them before a process ends, for minutes with long jobs.
    """
    for pool in _pools:
        pool.shutdown(wait=False, cancel_futures=True)
    by = time.monotonic() + _GRACE
    return not all(pool.ended(by) for pool in _pools)
