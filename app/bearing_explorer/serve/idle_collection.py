"""Garbage collections that look at few objects, however many people are there.

A full collection looks at all objects that there are, and nobody is served meanwhile: with tens of
sessions a second long. So what has survived is not looked at again: it is frozen, which means put
aside. Reference counting still frees it, and `taking_apart` sees to it that reference counting
suffices for a session. A collection then looks at what has come since the last one.

What is frozen and becomes garbage all the same, in circles that nothing takes apart, stays. It is
looked for when nobody is connected; with people there only before it takes a machine's memory.
"""

from __future__ import annotations

import gc
import math
import sys
import time
from collections.abc import Callable

from tornado.ioloop import PeriodicCallback

from bearing_explorer.serve import heap
from bearing_explorer.serve.bokeh_private import collect_elsewhere

QUIET = 0.6
"""[s] that nobody has sent anything for, before a collection that can wait."""
DUE = 40_000
"""New objects for which a collection is due, in a quiet moment: about what opening one session
makes."""
PRESSING = 2 * DUE
"""New objects for which it waits no longer."""
KEPT = 40_000
"""Objects that may be left by a collection without being frozen. What is frozen too early, such as
figures that are made anew each time, is found by no collection once it has become garbage.

So a collection looks at `KEPT` and `PRESSING` and what comes in the quarter of a second between two
looks: at 150,000 objects. That takes half a microsecond each, 0.08 s, and up to three times as long
on a machine whose memory is in demand."""
LEFT = 400_000
"""Blocks of memory beyond those of the start for which all are looked at once nobody is there: some
50 MB, of 200,000 objects. All are then half a million, which takes a quarter of a second."""
TOO_MANY = 8_000_000
"""Blocks beyond those of the start for which all are looked at in a quiet moment, whoever is there:
they are a gigabyte. That keeps everybody waiting for some seconds, and is meant for what nobody has
foreseen: ninety people with three tabs each have as many."""
ALONE = 20.0
"""[s] without anybody connected after which all may be looked at: pages that come back have come,
and sessions that have ended are taken apart."""

_LOOK = 250.0  # [ms]
_GIVE_BACK = 20_000.0  # [ms]; what is free is used anew first
_NEVER = 2**30


class IdleCollection:
    """Collects when that is due, and keeps each collection short.

    Parameters
    ----------
    quiet_for
        how long [s] nobody has sent anything; infinite while nobody is connected.
    new
        how many objects may have come since the last collection.
    left
        how many blocks of memory there are beyond those of the start, or of the last look at all.
    collect
        collects among the new objects, or, where its argument says so, among all.
    """

    def __init__(
        self,
        quiet_for: Callable[[], float],
        new: Callable[[], int],
        left: Callable[[], int],
        collect: Callable[[bool], object],
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        self._quiet_for, self._new = quiet_for, new
        self._left, self._collect, self._now = left, collect, now
        self._asked = False
        self._alone_since: float | None = None
        self._looked_at_all = True

    def ask(self) -> None:
        """Much has become garbage, as when a session ends."""
        self._asked = True

    def look(self) -> None:
        """Collect where it is time to; to be called a few times a second."""
        quiet = self._quiet_for()
        new = self._new()
        if new >= PRESSING or (quiet >= QUIET and (self._asked or new >= DUE)):
            self._asked = False
            self._collect(False)
        if quiet < math.inf:
            self._alone_since, self._looked_at_all = None, False
            if quiet >= QUIET and self._left() > TOO_MANY:
                self._collect(True)
            return
        now = self._now()
        if self._alone_since is None:
            self._alone_since = now
        if not self._looked_at_all and now - self._alone_since >= ALONE:
            self._looked_at_all = True
            if self._left() > LEFT:
                self._collect(True)


def put_aside() -> None:
    """Modules and kernels stay for as long as the process does: look at them a last time.

    That takes a quarter of a second: to be called before anybody is served, and once more, for what
    has come since.
    """
    gc.collect()
    gc.freeze()


def _old() -> int:
    """How many objects have survived and are not frozen.

    Counted in one step of the interpreter: a tuple that another thread is filling is among them,
    and Python takes it for an error ("bad argument to internal function") where that thread finds
    it in a list of somebody else's.
    """
    return next(map(len, map(gc.get_objects, (2,))))


class _Objects:
    """The objects of this process that a garbage collection looks at."""

    def __init__(self) -> None:
        put_aside()
        self._kept = sys.getallocatedblocks()
        self._young, self._middle, _ = gc.get_threshold()
        gc.set_threshold(self._young, self._middle, _NEVER)
        self._collected = False

    def new(self) -> int:
        """How many may have come since the last collection, less those that are gone again."""
        young, middle, old = gc.get_count()
        return young + self._young * (middle + self._middle * old)

    def left(self) -> int:
        """How many blocks there are beyond those that stay: frozen objects are not counted, for
        which Python would walk along all of them.
        """
        return sys.getallocatedblocks() - self._kept

    def collect(self, among_all: bool) -> None:
        """Collect among the new ones, or among all."""
        if among_all:
            gc.unfreeze()
        gc.collect()
        if among_all:
            gc.freeze()
            self._kept = sys.getallocatedblocks()
        elif _old() > KEPT:
            gc.freeze()
        self._collected = True

    def give_back(self) -> None:
        """What is free after a collection goes back to the system, beside the event loop."""
        if self._collected:
            self._collected = False
            heap.give_back_beside()


def begin(quiet_for: Callable[[], float]) -> None:
    """From now on this process collects that way. Call it where its event loop is current."""
    objects = _Objects()
    collector = IdleCollection(quiet_for, objects.new, objects.left, objects.collect)
    collect_elsewhere(collector.ask)
    PeriodicCallback(collector.look, _LOOK).start()
    PeriodicCallback(objects.give_back, _GIVE_BACK).start()
