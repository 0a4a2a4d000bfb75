"""Results that are kept for when they are asked for again, but no more bytes of them than agreed.

`functools.lru_cache` counts results. Where one may be a hundred bytes and another sixteen
megabytes, a count is no bound on memory.
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
"""Bytes of objects around a result, those of its arguments among them."""


def lru_cache_by_bytes(
    most_bytes: int, size: Callable[..., int], key: Callable[..., Hashable] | None = None
) -> Callable[[Callable[P, Result]], Callable[P, Result]]:
    """Keep what a function returns, by its arguments, the least recently used going first.

    Parameters
    ----------
    most_bytes
        size of all kept results. A result that is larger is not kept at all.
    size
        bytes of the arrays of a result and of what it keeps alive: called with the result, then
        the arguments.
    key
        function that makes a result's key of the arguments; None: the arguments are the key.
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
