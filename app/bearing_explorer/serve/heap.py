"""The heap of the C library: what nobody uses goes back to the system.

glibc gives each thread that asks for memory a heap of its own, and keeps what is freed inside of
them for later. Motions are some megabytes each and come from a dozen threads: after a while a
process holds several times what it uses.
"""

from __future__ import annotations

import ctypes
import sys
from functools import cache
from typing import Any

from bearing_explorer.serve.threads import Pool

ARENAS = 2
"""Heaps of a process, whatever its threads: they seldom ask at the same time."""
LARGE = 4 * 2**20
"""[bytes] from which an array has pages of its own, which go back as soon as it is gone."""

_BESIDE = Pool(1, "give back")

_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD, _M_ARENA_MAX = -1, -3, -8  # as malloc.h has them


@cache
def _library() -> Any:
    """The C library, where it is glibc; else None."""
    if not sys.platform.startswith("linux"):
        return None
    try:
        library = ctypes.CDLL(None)
        known = hasattr(library, "malloc_trim") and hasattr(library, "mallopt")
    except OSError:
        return None
    return library if known else None


def keep_small() -> bool:
    """Few heaps, and large arrays beside them; whether the C library does so.

    To be called before there are threads.
    """
    library = _library()
    if library is None:
        return False
    done = [
        library.mallopt(_M_ARENA_MAX, ARENAS),
        library.mallopt(_M_MMAP_THRESHOLD, LARGE),
        library.mallopt(_M_TRIM_THRESHOLD, 2 * LARGE),
    ]
    return all(done)


def give_back() -> None:
    """Give back what nobody uses. It takes some milliseconds, in which other threads go on."""
    library = _library()
    if library is not None:
        library.malloc_trim(0)


def give_back_beside() -> None:
    """Have it given back in a thread."""
    _BESIDE.submit(give_back)
