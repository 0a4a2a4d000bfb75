"""A cache in which whoever waits for an answer waits for the one that is being computed already."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from concurrent.futures import Future
from typing import Generic, TypeVar

Answer = TypeVar("Answer")


class SingleFlightCache(Generic[Answer]):
    """A bounded cache for threads: each key is computed once, the least used leaves first."""

    def __init__(self, compute: Callable[..., Answer], size: int) -> None:
        self._compute = compute
        self._size = size
        self._lock = threading.Lock()
        self._known: OrderedDict[Hashable, Future[Answer]] = OrderedDict()

    def __call__(self, *key: Hashable) -> Answer:
        with self._lock:
            future = self._known.get(key)
            mine = future is None
            if future is None:
                future = self._add(key)
            else:
                self._known.move_to_end(key)
        if mine:
            try:
                future.set_result(self._compute(*key))
            except BaseException as error:
                with self._lock:
                    self._known.pop(key, None)
                future.set_exception(error)
        return future.result()

    def keep(self, answer: Answer, *key: Hashable) -> None:
        """Keep what was computed elsewhere."""
        with self._lock:
            if key not in self._known:
                self._add(key).set_result(answer)

    def _add(self, key: tuple[Hashable, ...]) -> Future[Answer]:
        """A place for one more answer; the lock is held."""
        future = self._known[key] = Future[Answer]()
        while len(self._known) > self._size:
            self._known.popitem(last=False)
        return future

    def knows(self, *key: Hashable) -> bool:
        """Whether the answer is there already."""
        with self._lock:
            future = self._known.get(key)
        return future is not None and future.done()
