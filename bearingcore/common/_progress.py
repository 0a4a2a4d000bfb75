"""Progress and cancelling of what takes a while: two callables that long work takes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

T = TypeVar("T")

Progress = Callable[[float, str], object]
"""Called with the part done, 0 to 1, and what is being done."""
Cancelled = Callable[[], bool]
"""Asked between points; True ends the work with the results so far."""


class CancelledError(RuntimeError):
    """Work was cancelled before it had anything to show."""


def in_turn(
    tasks: Sequence[T],
    name: Callable[[T], str],
    progress: Progress | None,
    cancelled: Cancelled | None,
    *,
    begin: float = 0.0,
) -> Iterator[T]:
    """The tasks one after another, calling `progress` before each; ends early when cancelled.

    `begin` is the part of the work that was done before.
    """
    for i, task in enumerate(tasks):
        if cancelled is not None and cancelled():
            return
        if progress is not None:
            progress(begin + (1.0 - begin) * i / len(tasks), name(task))
        yield task
    if progress is not None:
        progress(1.0, "done")
