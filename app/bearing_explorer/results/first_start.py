"""Kernels are compiled in a thread while the server answers already, in words, that it is at it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from bearingcore import warm_up

WORDS = (
    "What it computes with is being compiled for this processor. That is done once and takes about "
    "half a minute; {:.0f} s have passed. The explorer opens here by itself."
)


class FirstStart:
    """Compiles what is not compiled yet; `say` is told of each part.

    `load` is called too, before there is a page: what takes long to import, and must not be
    imported by two threads at once.
    """

    def __init__(
        self, say: Callable[[str], object], load: Callable[[], object] = lambda: None
    ) -> None:
        self._say = say
        self._load = load
        self._begun = time.monotonic()
        #: whether it has begun and not ended
        self.at_work = False
        #: what went wrong, if anything did
        self.failed: Exception | None = None

    def begin(self, done: Callable[[], object]) -> None:
        """Begin, and call `done` from the thread at the end, however it ended."""
        self._begun, self.at_work = time.monotonic(), True
        threading.Thread(target=self._work, args=(done,), daemon=True).start()

    def words(self) -> str:
        """What to say to whoever wants to see something; empty once all is compiled."""
        return WORDS.format(time.monotonic() - self._begun) if self.at_work else ""

    def give_up(self) -> None:
        """The process is about to end: so does the one that compiles beside it."""
        warm_up.give_up()

    def _work(self, done: Callable[[], object]) -> None:
        try:
            warm_up.warm(self._say)
            self._load()
        except Exception as error:
            self.failed = error
        finally:
            self.at_work = False
            done()
