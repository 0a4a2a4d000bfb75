"""A cache in which whoever waits for an answer waits for the one that is being computed already."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Generic, TypeVar

from bearing_explorer.results.budget import SHARED, Budget

Answer = TypeVar("Answer")


class WouldWait(BaseException):
    """An answer is being computed by another thread, and here nobody may wait for one.

    Not an `Exception`: nothing has failed, and who takes failures for answers must not take this.
    """


class _Here(threading.local):
    may_wait = True


_here = _Here()


@contextmanager
def never_waiting() -> Iterator[None]:
    """Have what this thread asks for raise `WouldWait` where it would wait for another thread.

    For the event loop, which is everybody's.
    """
    before, _here.may_wait = _here.may_wait, False
    try:
        yield
    finally:
        _here.may_wait = before


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
        while True:
            future, mine = self._asked(key)
            if mine:
                self._answer(key, future)
            elif not (_here.may_wait or future.done()):
                raise WouldWait
            try:
                return future.result()
            except WouldWait:
                if mine:
                    raise
                # who was at it must not wait for a third: it is begun anew here

    def _asked(self, key: tuple[Hashable, ...]) -> tuple[Future[Answer], bool]:
        """The answer to come, and whether it is for the caller to find it."""
        with self._lock:
            future = self._known.get(key)
            if future is None:
                return self._add(key), True
            self._known.move_to_end(key)
            self._budget.use(self, key)
            return future, False

    def _answer(self, key: tuple[Hashable, ...], future: Future[Answer]) -> None:
        try:
            answer = self._compute(*key)
        except BaseException as error:
            with self._lock:
                self._known.pop(key, None)
            future.set_exception(error)
        else:
            future.set_result(answer)
            self._budget.add(self, key, answer)

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
