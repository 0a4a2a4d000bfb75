"""Full garbage collections wait until nobody is waiting."""

import gc
import subprocess
import sys

import panel.io.document as panel_document
from bearing_explorer.server.idle_collection import LONGEST, QUIET, IdleCollection


class Clock:
    """What a collector sees of the world."""

    def __init__(self) -> None:
        self.now, self.quiet, self.collected = 0.0, 0.0, 0
        self.collector = IdleCollection(lambda: self.quiet, self._collect, lambda: self.now)

    def _collect(self) -> None:
        self.collected += 1

    def pass_by(self, seconds: float, quiet: float) -> int:
        self.now += seconds
        self.quiet = quiet
        self.collector.look()
        return self.collected


def test_it_waits_for_a_quiet_moment() -> None:
    gc.collect()
    clock = Clock()
    assert clock.pass_by(1.0, quiet=100.0) == 0, "nothing is due"
    clock.collector.ask()
    assert clock.pass_by(1.0, quiet=0.1) == 0, "somebody drags"
    assert clock.pass_by(1.0, quiet=QUIET) == 1
    assert clock.pass_by(1.0, quiet=QUIET) == 1, "once is enough"


def test_it_does_not_wait_for_ever() -> None:
    clock = Clock()
    clock.collector.ask()
    for _ in range(10):
        assert clock.pass_by(LONGEST / 10.0, quiet=0.0) == 0
    assert clock.pass_by(LONGEST / 10.0, quiet=0.0) == 1


def test_garbage_of_many_young_collections_is_due_without_being_asked_for() -> None:
    gc.collect()
    clock = Clock()
    was = gc.get_threshold()
    gc.set_threshold(was[0], was[1], 2**30)
    try:
        for _ in range(12):
            gc.collect(1)
        assert clock.pass_by(1.0, quiet=QUIET) == 1
    finally:
        gc.set_threshold(*was)


_PROCESS = """
import asyncio, gc, weakref
from bearing_explorer.server import idle_collection
import panel.io.document as panel_document

class Session:
    pass

async def live():
    idle_collection.begin(lambda: 60.0)
    session = Session()
    session.itself = session
    gone = weakref.ref(session)
    del session
    panel_document._garbage_collect()  # as Panel does it when a session ends
    assert gone() is not None, "not on the spot"
    for _ in range(200):
        await asyncio.sleep(0.05)
        if gone() is None:
            return
    raise AssertionError("garbage stays")

asyncio.run(live())
"""


def test_a_process_collects_what_a_session_leaves() -> None:
    assert callable(panel_document._garbage_collect)
    subprocess.run([sys.executable, "-c", _PROCESS], check=True)
