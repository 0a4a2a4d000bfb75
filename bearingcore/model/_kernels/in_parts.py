"""Long work of compiled code in parts, so that progress can be shown and the work be stopped.

While compiled code runs, Python raises no exceptions, not even KeyboardInterrupt.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

from bearingcore.model._kernels.path import BLOCK

FIRST_WORK = 20_000_000
"""Work of the first part of a motion: numbers in a state times contacts times steps. It takes 20 ms
of planar motions, 140 ms of motions in five directions with their tangent."""

PART_SECONDS = 0.1
"""Time [s] that a part should take."""

Watch = Callable[[float], object]
"""Function called after each part with the share that is done, 0 to 1; it stops work by raising."""


def parts(first: int, last: int, size: int) -> Iterator[tuple[int, int]]:
    """Yield parts (begin, end) of the range from first to last; `size` is the length of the first.

    The length is doubled until a part takes more than half of PART_SECONDS.
    """
    while first < last:
        end = min(first + size, last)
        start = time.perf_counter()
        yield first, end
        if time.perf_counter() - start < 0.5 * PART_SECONDS:
            size *= 2
        first = end


def march_in_parts(
    n_steps: int, size: int, march: Callable[[tuple[int, int]], int], watch: Watch | None
) -> int:
    """Call march(span) for all steps in parts; return the number of steps with finite results.

    size: numbers in a state times contacts.
    """
    half, done = BLOCK // 2, 0
    for span in parts(0, n_steps + 1, max(FIRST_WORK // (size * half), 1) * half):
        done = march(span)
        if watch is not None:
            watch(min(span[1] / max(n_steps, 1), 1.0))
        if done < span[1]:  # after the last step, or if the motion is no longer finite
            break
    return done
