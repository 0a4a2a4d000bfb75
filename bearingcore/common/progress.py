"""Progress and cancelling of what takes a while: two callables that long work takes."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float, str], object]
"""Called with the part done, 0 to 1, and what is being done."""
Cancelled = Callable[[], bool]
"""Asked between points; True ends the work with what was found so far."""
