"""The threads of the page, all in one place: who computes what, and how many at a time.

Kernels release the interpreter lock, so threads do run together. The pools are shared by all
sessions of a process. They are kept apart so that what takes long never stands before what a hand
waits for.
"""

from __future__ import annotations

import asyncio
import os
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Result = TypeVar("Result")

_CORES = os.cpu_count() or 2
_HALF = max(1, _CORES // 2)

PICTURES = ThreadPoolExecutor(_CORES, "compute")
"""Pictures that are not light, and what a message asks for."""
SLOW_PICTURES = ThreadPoolExecutor(_HALF, "compute-slow")
"""Pictures of motions: or a few sessions that simulate would keep all others from dragging."""
BESIDE = ThreadPoolExecutor(_HALF, "beside")
"""What goes on beside a picture that needs it later."""
PLANS = ThreadPoolExecutor(_HALF, "plan")
"""Plans of all sessions: half of the machine stays with what moves."""
JOBS = ThreadPoolExecutor(_HALF, "job")
"""Long computations that somebody started: half of the machine, drawing has the other half."""
DIAGNOSES = ThreadPoolExecutor(_HALF, "diagnose")
"""Which part is damaged, of all sessions: half of the machine, drawing has the other half."""
READERS = ThreadPoolExecutor(2, "read")
"""Files that are read: two at a time, whoever brings them, as reading takes memory."""

_POOLS = {
    "compute": PICTURES,
    "compute-slow": SLOW_PICTURES,
    "beside": BESIDE,
    "plan": PLANS,
    "job": JOBS,
    "diagnose": DIAGNOSES,
    "read": READERS,
}
_GRACE = 0.2  # [s] for threads that do nothing to end


def still_at_work() -> bool:
    """Begin nothing more; whether a thread still computes what nobody will see.

    Python itself would wait for all of them before a process ends, for minutes with long jobs.
    """
    for pool in _POOLS.values():
        pool.shutdown(wait=False, cancel_futures=True)
    end = time.monotonic() + _GRACE
    begins = tuple(f"{name}_" for name in _POOLS)
    ours = [thread for thread in threading.enumerate() if thread.name.startswith(begins)]
    for thread in ours:
        thread.join(max(end - time.monotonic(), 0.0))
    return any(thread.is_alive() for thread in ours)


async def in_thread(function: Callable[..., Result], *args: object, slow: bool = False) -> Result:
    """Run `function` off the event loop, with the pictures or with the `slow` ones."""
    threads = SLOW_PICTURES if slow else PICTURES
    return await asyncio.get_running_loop().run_in_executor(threads, function, *args)
