"""The explorer with a watch on its event loop: ``python -m tests.fuzz.watched_server REPORT ...``.

What follows the file's name is for the explorer. Each turn of the loop is timed where it happens,
by the clock and by the processor time of the loop's own thread; once a second the longest turns are
written to the file, as JSON.
"""

import asyncio
import json
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

from tests.browser.helpers import Server, free_port

LONGEST_HOLD = 1.0
"""Processor time of a turn of the event loop [s] that nothing from outside may cause."""
_KEPT = 6


def watch(report: Path) -> None:
    """Time all turns from now on."""
    act = asyncio.events.Handle._run
    longest: list[dict[str, Any]] = []

    def timed(handle: asyncio.events.Handle) -> None:
        began, worked = time.perf_counter(), time.thread_time()
        act(handle)
        took, worked = time.perf_counter() - began, time.thread_time() - worked
        if len(longest) < _KEPT or worked > longest[-1]["worked"]:
            longest.append({"seconds": took, "worked": worked, "where": repr(handle)[:300]})
            longest.sort(key=lambda turn: -turn["worked"])
            del longest[_KEPT:]

    def write() -> None:
        while True:
            time.sleep(1.0)
            partial = report.with_suffix(".new")
            partial.write_text(json.dumps(list(longest)), encoding="utf-8")
            partial.replace(report)

    asyncio.events.Handle._run = timed  # type: ignore[method-assign]
    threading.Thread(target=write, daemon=True).start()


class WatchedServer(Server):
    """The explorer in a process of its own, with a watch on its event loop."""

    def __init__(self, **environment: str) -> None:
        self._report = Path(tempfile.mkstemp(suffix=".json")[1])
        port = free_port()
        command = [sys.executable, "-m", "tests.fuzz.watched_server", str(self._report)]
        super().__init__([*command, "--port", str(port), "--no-browser"], port, "/", environment)

    def longest_turns(self) -> list[dict[str, Any]]:
        """The longest turns, as soon as they are written."""
        time.sleep(1.5)
        turns: list[dict[str, Any]] = json.loads(self._report.read_text(encoding="utf-8"))
        return turns


def faults_of(turns: list[dict[str, Any]], longest: float, log: str) -> list[str]:
    """Turns of more processor time than `longest` [s], and a traceback in the log."""
    at = log.find("Traceback")
    return [
        *(words_of(turn) for turn in turns if turn["worked"] > longest),
        *([f"a traceback in the log:\n{log[max(at - 300, 0) : at + 3000]}"] if at >= 0 else []),
    ]


def words_of(turn: dict[str, Any]) -> str:
    """A turn as a line."""
    return f"{1e3 * turn['worked']:>6.0f} ms of work  {turn['where'][:150]}"


if __name__ == "__main__":
    from bearing_explorer.__main__ import main

    watch(Path(sys.argv[1]))
    sys.exit(main(sys.argv[2:]))
