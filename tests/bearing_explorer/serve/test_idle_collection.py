"""Garbage collections look at few objects, and wait where they can."""

from __future__ import annotations

import math
import subprocess
import sys

import panel.io.document as panel_document
from bearing_explorer.serve.idle_collection import (
    ALONE,
    DUE,
    LEFT,
    PRESSING,
    QUIET,
    TOO_MANY,
    IdleCollection,
)


class Clock:
    """What a collector sees of the world."""

    def __init__(self) -> None:
        self.now, self.quiet, self.new, self.left = 0.0, 0.0, 0, 0
        self.collected: list[str] = []
        self.collector = IdleCollection(
            lambda: self.quiet, lambda: self.new, lambda: self.left, self._collect, lambda: self.now
        )

    def _collect(self, among_all: bool) -> None:
        self.collected.append("all" if among_all else "new")

    def pass_by(self, seconds: float, quiet: float) -> list[str]:
        self.now += seconds
        self.quiet = quiet
        self.collected = []
        self.collector.look()
        return self.collected


def test_it_waits_for_a_quiet_moment() -> None:
    clock = Clock()
    assert clock.pass_by(1.0, quiet=100.0) == [], "nothing is due"
    clock.collector.ask()
    assert clock.pass_by(1.0, quiet=0.1) == [], "somebody drags"
    assert clock.pass_by(1.0, quiet=QUIET) == ["new"]
    assert clock.pass_by(1.0, quiet=QUIET) == [], "once is enough"
    clock.new = DUE
    assert clock.pass_by(1.0, quiet=0.1) == []
    assert clock.pass_by(1.0, quiet=QUIET) == ["new"], "without being asked for"


def test_it_does_not_wait_until_there_is_much_to_look_at() -> None:
    clock = Clock()
    clock.new = PRESSING - 1
    assert clock.pass_by(1.0, quiet=0.0) == []
    clock.new = PRESSING
    assert clock.pass_by(1.0, quiet=0.0) == ["new"]


def test_all_is_looked_at_once_nobody_is_there_and_much_is_left() -> None:
    clock = Clock()
    clock.left = LEFT + 1
    for _ in range(100):
        assert clock.pass_by(ALONE, quiet=60.0) == [], "somebody is there"
    assert clock.pass_by(0.25, quiet=math.inf) == []
    assert clock.pass_by(0.5 * ALONE, quiet=math.inf) == []
    assert clock.pass_by(0.5 * ALONE, quiet=math.inf) == ["all"]
    assert clock.pass_by(10.0 * ALONE, quiet=math.inf) == [], "once is enough"
    clock.left = LEFT
    clock.pass_by(0.25, quiet=60.0)
    clock.pass_by(0.25, quiet=math.inf)
    assert clock.pass_by(ALONE, quiet=math.inf) == [], "what is left is little"


def test_all_is_looked_at_before_it_takes_the_memory_of_the_machine() -> None:
    clock = Clock()
    clock.left = TOO_MANY
    assert clock.pass_by(1.0, quiet=QUIET) == []
    clock.left = TOO_MANY + 1
    assert clock.pass_by(1.0, quiet=0.0) == [], "somebody drags"
    assert clock.pass_by(1.0, quiet=QUIET) == ["all"]


_PROCESS = """
import asyncio, gc, weakref
from bearing_explorer.serve import idle_collection
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


_MANY = """
import asyncio, gc
from bearing_explorer.serve import idle_collection

class Session:
    def __init__(self):
        self.parts = [[self] for _ in range(50_000)]  # circles, as those of models

looked_at = []

def note(phase, told):
    if phase == "start" and told["generation"] == 2:
        looked_at.append(len(gc.get_objects()))

async def live():
    idle_collection._LOOK = 10.0
    idle_collection.begin(lambda: 0.0)  # somebody drags all the while
    gc.callbacks.append(note)
    sessions = []
    for _ in range(24):
        sessions.append(Session())
        await asyncio.sleep(2e-3 * idle_collection._LOOK)
    assert len(looked_at) > 3, "it does collect"
    bound = idle_collection.KEPT + idle_collection.PRESSING + 50_000  # of a session
    assert max(looked_at) < bound < 24 * 50_000 / 2, looked_at

asyncio.run(live())
"""


def test_a_collection_looks_at_what_is_new_however_many_sessions_there_are() -> None:
    subprocess.run([sys.executable, "-c", _MANY], check=True)


_FILLED = """
import gc, sys, threading
from bearing_explorer.serve import idle_collection

sys.setswitchinterval(1e-6)
filled, wrong = [], []

def fill():
    while len(filled) < 2000 and not wrong:
        try:
            filled.append(len(tuple([k] for k in range(300))))
        except SystemError as error:
            wrong.append(error)

thread = threading.Thread(target=fill)
thread.start()
objects = idle_collection._Objects()
while thread.is_alive():
    objects.collect(among_all=False)
assert not wrong, wrong
assert filled == [300] * 2000
"""


def test_a_collection_does_not_disturb_what_other_threads_are_making() -> None:
    subprocess.run([sys.executable, "-c", _FILLED], check=True)
