"""The threads that compute, all in one place: who computes what, and how many at a time.

Kernels release the interpreter lock, so threads do run together. The pools are shared by all
sessions of a process. They are kept apart so that what takes long never stands before what a hand
waits for.
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor as Pool
from typing import TypeVar

Result = TypeVar("Result")

_CORES = os.cpu_count() or 2
_HALF = max(1, _CORES // 2)

PICTURES = Pool(_CORES, "compute")
"""Pictures that are not light, and what a message asks for."""
SLOW_PICTURES = Pool(_HALF, "compute-slow")
"""Pictures of motions: or a few sessions that simulate would keep all others from dragging."""
BESIDE = Pool(_HALF, "beside")
"""What goes on beside a picture that needs it later."""
PLANS = Pool(_HALF, "plan")
"""Plans of all sessions: half of the machine stays with what moves."""
JOBS = Pool(_HALF, "job")
"""Long computations that somebody started: half of the machine, drawing has the other half."""
DIAGNOSES = Pool(_HALF, "diagnose")
"""Which part is damaged, of all sessions: half of the machine, drawing has the other half."""
READERS = Pool(2, "read")
"""Files that are read: two at a time, whoever brings them, as reading takes memory."""


async def in_thread(function: Callable[..., Result], *args: object, slow: bool = False) -> Result:
    """Run `function` off the event loop, with the pictures or with the `slow` ones."""
    threads = SLOW_PICTURES if slow else PICTURES
    return await asyncio.get_running_loop().run_in_executor(threads, function, *args)
