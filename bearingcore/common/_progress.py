"""Progress of long work, and the error that ends it."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float, str], object]
"""Called with the part that is done, 0 to 1, and the name of the current step."""


class CancelledError(RuntimeError):
    """Raised inside a `Progress` to end the work that calls it."""
