"""Progress of what takes a while, and the error that ends it."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float, str], object]
"""Called with the part done, 0 to 1, and what is being done."""


class CancelledError(RuntimeError):
    """Raised inside a `Progress` to end the work that calls it."""
