"""A cache in which whoever waits for an answer waits for the one that is being computed already."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from concurrent.futures import Future
from typing import Generic, TypeVar

from bearing_explorer.compute.budget import SHARED, Budget

Answer = TypeVar("Answer")


class SingleFlightCache(Generic[Answer]):
    """A bounded cache for threads: each key is computed once, the least used leaves first.

    At most `size` answers are kept, and no more bytes of them than `budget` allows.
    """

    def __init__(self, compute: Callable[..., Answer], size: int, budget: Budget = SHARED) -> None:
        self._compute = compute
        self._size = size
        self._budget = budget
        self._lock = budget.lock
        self._known: OrderedDict[Hashable, Future[Answer]] = OrderedDict()

    def __call__(self, *key: Hashable) -> Answer:
        with self._lock:
            future = self._known.get(key)
            mine = future is None
            if future is None:
                future = self._add(key)
            else:
                self._known.move_to_end(key)
                self._budget.use(self, key)
        if mine:
            try:
                answer = self._compute(*key)
            except BaseException as error:
                with self._lock:
                    self._known.pop(key, None)
                future.set_exception(error)
            else:
                future.set_result(answer)
                self._budget.add(self, key, answer)
        return future.result()

    def keep(self, answer: Answer, *key: Hashable) -> None:
        """Keep what was computed elsewhere."""
        with self._lock:
            if key not in self._known:
                self._add(key).set_result(answer)
                self._budget.add(self, key, answer)

    def drop(self, key: Hashable) -> None:
        """Let go of an answer; the lock is held."""
        self._known.pop(key, None)  # type: ignore[arg-type]

    def _add(self, key: tuple[Hashable, ...]) -> Future[Answer]:
        """A place for one more answer; the lock is held."""
        future = self._known[key] = Future[Answer]()
        while len(self._known) > self._size:
            gone, _ = self._known.popitem(last=False)
            self._budget.forget(self, gone)
        return future

    def knows(self, *key: Hashable) -> bool:
        """Whether the answer is there already."""
        with self._lock:
            future = self._known.get(key)
        return future is not None and future.done()
