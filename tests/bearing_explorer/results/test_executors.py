"""Work off the event loop."""

import subprocess
import sys
import threading

import pytest
from bearing_explorer.results.executors import in_thread

from tests.helpers.loops import run


def test_work_in_a_thread_leaves_the_event_loop_free() -> None:

    async def where() -> tuple[str, str]:
        return threading.current_thread().name, await in_thread(
            lambda: threading.current_thread().name
        )

    here, there = run(where())
    assert here != there
    assert there.startswith("compute")


_PROCESS = """
import os, threading
from bearing_explorer.results.executors import JOBS, PICTURES
from bearing_explorer.serve.threads import still_at_work

PICTURES.submit(int).result()
if {busy}:
    begun = threading.Event()
    JOBS.submit(lambda: (begun.set(), threading.Event().wait()))
    waiting = [JOBS.submit(int) for _ in range(50)]
    begun.wait()
assert still_at_work() is {busy}
if {busy}:
    assert waiting[-1].cancelled(), "nothing more is begun"
    os._exit(0)
"""


@pytest.mark.parametrize("busy", [True, False])
def test_a_process_can_end_while_a_thread_computes(busy: bool) -> None:
    code = _PROCESS.format(busy=busy)
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60.0)
