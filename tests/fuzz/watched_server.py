"""The explorer with a watch on its event loop: ``python -m tests.fuzz.watched_server REPORT ...``.

What follows the file's name is for the explorer. The processor time of each turn of the loop is
taken in the loop's own thread; once a second the longest turns are written to the file, as JSON.
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
GRACE = 2.0
"""For how long a session waits [s] for a page that lost its connection."""
_KEPT = 6


def watch(report: Path) -> None:
    """Time all turns from now on."""
    act = asyncio.events.Handle._run
    longest: list[dict[str, Any]] = []

    def timed(handle: asyncio.events.Handle) -> None:
        began = time.thread_time()
        act(handle)
        worked = time.thread_time() - began
        if len(longest) < _KEPT or worked > longest[-1]["worked"]:
            longest.append({"worked": worked, "where": repr(handle)[:150]})
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

    def slow_turns(self) -> list[str]:
        """Turns of too much processor time, in words."""
        time.sleep(1.5)  # by then the longest turns are written
        turns = json.loads(self._report.read_text(encoding="utf-8"))
        assert turns, "the loop was watched"
        return [
            f"{1e3 * turn['worked']:>6.0f} ms of work  {turn['where']}"
            for turn in turns
            if turn["worked"] > LONGEST_HOLD
        ]


if __name__ == "__main__":
    from bearing_explorer.__main__ import main
    from bearing_explorer.kit.serve import serving

    serving.SESSION_GRACE_SECONDS = GRACE
    watch(Path(sys.argv[1]))
    sys.exit(main(sys.argv[2:]))
