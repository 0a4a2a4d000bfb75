"""How many bytes the answers that are kept may hold, those of all caches of a process together.

A count of answers is no bound on memory: one is a kilobyte or twenty megabytes, as scenes are. With
caches that counted, a process held more than a gigabyte after some thousand random scenes.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Hashable, Mapping
from types import ModuleType
from typing import Any, Protocol

import numpy as np

MOST_BYTES = 256_000_000
_LONG = 256
"""Items from which a list counts as one of numbers, and is not looked through."""
_A_NUMBER = 32  # bytes of one in such a list, and of what points to it


class Holder(Protocol):
    """A cache."""

    def drop(self, key: Hashable) -> None:
        """Let go of an answer; the budget's lock is held."""


class Budget:
    """Answers by their caches and keys, the one that was used least of late first."""

    def __init__(self, most_bytes: int) -> None:
        self._most = most_bytes
        self._held: OrderedDict[tuple[Holder, Hashable], int] = OrderedDict()
        #: of all caches that share it
        self.lock = threading.RLock()
        self.total = 0

    def use(self, holder: Holder, key: Hashable) -> None:
        """An answer was asked for again; the lock is held."""
        if (holder, key) in self._held:
            self._held.move_to_end((holder, key))

    def add(self, holder: Holder, key: Hashable, answer: object) -> None:
        """An answer is kept; others may have to go, and the newest if it is too large alone."""
        size = held_bytes((key, answer))
        with self.lock:
            self.forget(holder, key)
            self._held[holder, key] = size
            self.total += size
            while self.total > self._most and self._held:
                (other, name), bytes_ = self._held.popitem(last=False)
                self.total -= bytes_
                other.drop(name)

    def forget(self, holder: Holder, key: Hashable) -> None:
        """An answer has left its cache; the lock is held."""
        self.total -= self._held.pop((holder, key), 0)


def held_bytes(answer: object) -> int:
    """Bytes of arrays and long lists that something keeps alive; of a view the whole array."""
    arrays: dict[int, int] = {}
    seen: set[int] = set()
    left: list[Any] = [answer]
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
                total += _A_NUMBER * len(item)
            else:
                left.extend(item)
        elif isinstance(item, Mapping):
            left.extend(item.values())
        else:
            left.extend(getattr(item, "__dict__", {}).values())
    return total + sum(arrays.values())


SHARED = Budget(MOST_BYTES)
"""Of the page's caches."""
