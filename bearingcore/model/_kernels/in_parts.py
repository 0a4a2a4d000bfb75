"""Long work of compiled code in parts, so that it can be watched and stopped.

Python raises nothing, not even KeyboardInterrupt, while compiled code runs.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

from bearingcore.model._kernels.path import BLOCK

FIRST_WORK = 20_000_000
"""Numbers of a state times contacts times steps, of the first part of a motion: 20 ms of planar
motions, 140 ms of five directions with the tangent."""

PART_SECONDS = 0.1
"""Time [s] that a part should take."""

Watch = Callable[[float], object]
"""Called with the part done, 0 to 1, after each part; it ends the work by raising."""


def parts(first: int, last: int, size: int) -> Iterator[tuple[int, int]]:
    """Yield the ends (begin, end) of parts from first to last, the first one of a size.

    Parts grow until the work on one takes PART_SECONDS.
    """
    while first < last:
        end = min(first + size, last)
        begun = time.perf_counter()
        yield first, end
        if time.perf_counter() - begun < 0.5 * PART_SECONDS:
            size *= 2
        first = end


def march_in_parts(
    n_steps: int, size: int, march: Callable[[tuple[int, int]], int], watch: Watch | None
) -> int:
    """Call march(span) for all steps in parts; return the number after which all was finite.

    size: numbers of a state times contacts.
    """
    half, done = BLOCK // 2, 0
    for span in parts(0, n_steps + 1, max(FIRST_WORK // (size * half), 1) * half):
        done = march(span)
        if watch is not None:
            watch(min(span[1] / max(n_steps, 1), 1.0))
        if done < span[1]:  # the end, or a motion that is no longer finite
            break
    return done
