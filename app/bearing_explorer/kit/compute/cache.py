"""Results that all sessions share: each is computed once.

Thirty people who look at one scene cost as much as one. A thread that needs a result that another
thread is computing waits for it.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Hashable, Mapping
from concurrent.futures import Future
from contextlib import suppress
from types import ModuleType
from typing import Any, Generic, TypeVar

import numpy as np
from cachetools import LRUCache

Result = TypeVar("Result")

MOST_BYTES = 64_000_000
"""Largest size of all kept results. A largest count would not bound memory: a result has a kilobyte
or 20 MB, and with counts a process held more than a gigabyte after some thousand scenes."""

_OVERHEAD = 4096  # bytes of objects around the arrays
_LONG = 256  # items; a longer list is taken to hold numbers, and is not searched
_NUMBER_SIZE = 32  # bytes of a number in such a list, with its pointer


_results: LRUCache[tuple[Any, ...], tuple[Any, int]] = LRUCache(
    MOST_BYTES, getsizeof=lambda kept: kept[1]
)
_under_way: dict[Hashable, Future[Any]] = {}
_lock = threading.Lock()
_functions: dict[str, Cached[Any]] = {}


class Cached(Generic[Result]):
    """A function whose results are kept by its arguments, for all threads. See `cached`."""

    def __init__(self, compute: Callable[..., Result]) -> None:
        self._compute = compute
        functools.update_wrapper(self, compute)
        self.name = f"{compute.__module__}.{compute.__qualname__}"
        _functions[self.name] = self

    def __call__(self, *key: Hashable) -> Result:
        """Return the result for these arguments."""
        full_key = (self, *key)
        with _lock:
            if full_key in _results:
                result: Result = _results[full_key][0]
                return result
            future = _under_way.get(full_key)
            mine = future is None
            if future is None:
                future = _under_way[full_key] = Future()
        if mine:
            return self._fulfil(full_key, future)
        return future.result()  # type: ignore[no-any-return]

    def knows(self, *key: Hashable) -> bool:
        """Return True if the result is kept already."""
        with _lock:
            return (self, *key) in _results

    def _fulfil(self, full_key: tuple[Hashable, ...], future: Future[Result]) -> Result:
        """Compute a result, keep it, and hand it to the threads that wait for it."""
        try:
            result = self._compute(*full_key[1:])
        except BaseException as error:
            with _lock:
                del _under_way[full_key]
            future.set_exception(error)
            raise
        _keep(full_key, result)
        with _lock:
            del _under_way[full_key]
        future.set_result(result)
        return result


def _keep(full_key: tuple[Hashable, ...], result: Any) -> None:
    size = nbytes((full_key[1:], result)) + _OVERHEAD
    with _lock, suppress(ValueError):  # too large to be kept
        _results[full_key] = result, size


def cached(compute: Callable[..., Result]) -> Cached[Result]:
    """Keep the results of a function by its arguments; the least recently used go first.

    Each result is computed once, even if several threads need it at the same time. All functions
    together keep at most `MOST_BYTES`. Exceptions are not kept.
    """
    return Cached(compute)


def kept_results() -> dict[tuple[Hashable, ...], tuple[Any, int]]:
    """Return all kept results with their bytes, by the function's name and its arguments."""
    with _lock:
        return {(key[0].name, *key[1:]): value for key, value in _results.items()}


def keep_results(results: Mapping[tuple[Any, ...], Any]) -> None:
    """Keep results by the function's name and its arguments, as if they had been computed."""
    for (name, *key), result in results.items():
        if name in _functions:
            _keep((_functions[name], *key), result)


def clear() -> None:
    """Forget all results."""
    with _lock:
        _results.clear()


def nbytes(value: object) -> int:
    """Count the bytes of arrays and long lists that a value keeps alive, with arrays of views."""
    arrays: dict[int, int] = {}
    seen: set[int] = set()
    left: list[Any] = [value]
    total = 0
    while left:
        item = left.pop()
        if isinstance(item, str | bytes | float | int | type | ModuleType | None):
            continue
        if id(item) in seen:
            continue
        seen.add(id(item))
        if isinstance(item, np.ndarray):
            while isinstance(item.base, np.ndarray):
                item = item.base
            arrays[id(item)] = item.nbytes
        elif isinstance(item, list | tuple | set | frozenset):
            if len(item) > _LONG:
                total += _NUMBER_SIZE * len(item)
            else:
                left.extend(item)
        elif isinstance(item, Mapping):
            left.extend(item.values())
        else:
            left.extend(getattr(item, "__dict__", {}).values())
    return total + sum(arrays.values())
