"""Attributes that are computed on first use, in any thread, without a lock of the class.

Before Python 3.12 `functools.cached_property` holds one lock for all objects of a class while it
computes. A thread then waits, maybe for seconds, until another thread has computed the attribute of
another object. Without the lock two threads may both compute the same attribute.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

__all__ = ["cached_property"]

if TYPE_CHECKING or sys.version_info >= (3, 12):
    from functools import cached_property
else:

    class cached_property:  # noqa: N801  # as in functools
        """Copy of `functools.cached_property` without the lock."""

        def __init__(self, func: Any) -> None:
            self.func, self.__doc__, self._name = func, func.__doc__, func.__name__

        def __set_name__(self, owner: type, name: str) -> None:
            self._name = name

        def __get__(self, instance: Any, owner: type | None = None) -> Any:
            if instance is None:
                return self
            # Python looks into vars first, so this code runs once
            value = vars(instance)[self._name] = self.func(instance)
            return value
