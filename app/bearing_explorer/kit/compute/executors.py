"""The threads that compute, shared by all sessions of a process.

Kernels release the interpreter lock, so threads do run at the same time. There are several pools,
so that long computations never delay the pictures that follow a slider; see `jobs` for their use.
"""

from __future__ import annotations

import asyncio
import ctypes
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor as Pool
from contextlib import suppress
from typing import TypeVar
from weakref import WeakKeyDictionary

Result = TypeVar("Result")

_CORES = os.cpu_count() or 2

POOL_SIZE = 2 * _CORES
PICTURES = Pool(POOL_SIZE, "compute")
"""Pictures that follow a slider. There are more threads than processors, so that a quick picture
need not wait for a motion."""
FINE = Pool(1, "fine")
"""Fine pictures of all sessions, one by one: several at once would slow down moving sliders."""
ANSWERS = Pool(2, "answer")
"""Short work that a message asks for: a search, a link, a report."""
JOBS = Pool(max(2, _CORES // 2), "job")
"""Long computations that a person has started: maps, sweeps and diagnoses."""


def return_large_arrays() -> None:
    """Make glibc return freed blocks of 4 MB and more to the system at once.

    After four files of 24 MB, a process then keeps 470 MB; otherwise it would keep 1040 MB.
    """
    with suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).mallopt(_MMAP_THRESHOLD, 4 * 2**20)


_MMAP_THRESHOLD = -3  # M_MMAP_THRESHOLD of malloc.h

FILES = Pool(2, "file", initializer=return_large_arrays)
"""Measured signals, read from a file or simulated. Each file is read by a process of its own, with
half a gigabyte at most: two at a time are what a small server can bear."""


async def run_in_thread(
    function: Callable[..., Result], *args: object, pool: Pool = PICTURES
) -> Result:
    """Run `function` off the event loop."""
    return await asyncio.get_running_loop().run_in_executor(pool, function, *args)


_TURNS = WeakKeyDictionary[asyncio.AbstractEventLoop, asyncio.Lock]()
"""A lock for each event loop: an asyncio lock belongs to one."""


async def run_in_turn(function: Callable[..., Result], *args: object) -> Result:
    """Run `function` on the event loop, one call after the other.

    Between two calls, the messages of browsers are read, so that of the positions of a slider only
    the newest is drawn. With 30 people, that draws half as many more of their changes a second.
    """
    async with _TURNS.setdefault(asyncio.get_running_loop(), asyncio.Lock()):
        await asyncio.sleep(0.0)
        return function(*args)
