"""A cache of results that is bounded by their bytes.

`functools.lru_cache` counts results. If one may have a hundred bytes and another sixteen megabytes,
a count does not bound the memory.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import wraps
from threading import Lock
from typing import Any, ParamSpec, TypeVar

from cachetools import LRUCache, cached
from cachetools.keys import hashkey

P = ParamSpec("P")
Result = TypeVar("Result")

OVERHEAD = 4096
"""Bytes of the objects around a result, including those of its arguments."""


def lru_cache_by_bytes(
    most_bytes: int, size: Callable[..., int], key: Callable[..., Hashable] | None = None
) -> Callable[[Callable[P, Result]], Callable[P, Result]]:
    """Cache the results of a function by its arguments; the least recently used are dropped first.

    Parameters
    ----------
    most_bytes
        greatest size of all kept results. A larger result is not kept.
    size
        called with a result and the arguments; returns the bytes of the result's arrays and of
        all objects that the result keeps alive.
    key
        function that makes the key of a result from the arguments; None: the arguments are the key.
    """

    def key_of(*arguments: Any, **named: Any) -> Hashable:
        return hashkey(key(*arguments, **named)) if key else hashkey(*arguments, **named)

    def decorate(function: Callable[P, Result]) -> Callable[P, Result]:
        kept: LRUCache[Hashable, tuple[Result, int]] = LRUCache(most_bytes, lambda entry: entry[1])

        @cached(kept, key_of, Lock())
        def sized(*arguments: P.args, **named: P.kwargs) -> tuple[Result, int]:
            result = function(*arguments, **named)
            return result, OVERHEAD + size(result, *arguments, **named)

        @wraps(function)
        def cached_call(*arguments: P.args, **named: P.kwargs) -> Result:
            return sized(*arguments, **named)[0]

        return cached_call

    return decorate
