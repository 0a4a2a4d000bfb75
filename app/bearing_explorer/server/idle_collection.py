"""Full garbage collections wait for a quiet moment.

With a class on board a full collection looks at a million objects, and for a third of a second
nobody is drawn anything. Young garbage goes as ever; what only a full collection finds can wait
until all hands rest, but not for ever.
"""

from __future__ import annotations

import gc
import threading
import time
from collections.abc import Callable

from tornado.ioloop import PeriodicCallback

from bearing_explorer.server import heap
from bearing_explorer.server.bokeh_private import collect_elsewhere

QUIET = 0.6
"""[s] that nobody has sent anything for, before a full collection."""
LONGEST = 120.0
"""[s] that a full collection waits for at most."""
DUE = 10
"""Collections of the younger generation after which a full one is due, as Python has it."""

_NEVER = 2**30


class IdleCollection:
    """Collects in full when that is due and nobody is waiting.

    `quiet_for` says for how long [s] nobody has sent anything.
    """

    def __init__(
        self,
        quiet_for: Callable[[], float],
        collect: Callable[[], object] = gc.collect,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        self._quiet_for, self._collect, self._now = quiet_for, collect, now
        self._asked = False
        self._due_since: float | None = None

    def ask(self) -> None:
        """Much has become garbage, as when a session ends."""
        self._asked = True

    def look(self) -> None:
        """Collect where it is time to; to be called a few times a second."""
        if not self._asked and gc.get_count()[2] < DUE:
            return
        now = self._now()
        if self._due_since is None:
            self._due_since = now
        if self._quiet_for() >= QUIET or now - self._due_since >= LONGEST:
            self._collect()
            self._asked, self._due_since = False, None


def begin(quiet_for: Callable[[], float]) -> None:
    """From now on this process collects that way. Call it where its event loop is current."""
    gc.collect()
    gc.freeze()  # modules and kernels stay for as long as the process does
    young, middle, _ = gc.get_threshold()
    gc.set_threshold(young, middle, _NEVER)
    collector = IdleCollection(quiet_for, _collect)
    collect_elsewhere(collector.ask)
    PeriodicCallback(collector.look, 250).start()


def _collect() -> None:
    """In full; what is free then goes back to the system, beside the event loop."""
    gc.collect()
    threading.Thread(target=heap.give_back, name="give back", daemon=True).start()
