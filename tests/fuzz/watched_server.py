"""The explorer with a watch on its event loop: ``python -m tests.fuzz.watched_server REPORT ...``.

What follows the file's name is for the explorer. From outside, silence is that of the machine too;
so here each turn of the loop is timed where it happens, by the clock and by the processor time of
the loop's own thread. The longest turns and where they were at work are written to the file once a
second, as JSON, and when each turn began that worked for long.
"""

from __future__ import annotations

import asyncio
import gc
import json
import sys
import threading
import time
import traceback
from collections import deque
from pathlib import Path
from typing import Any

LONGEST_HOLD = 1.0  # [s] that nothing from outside may hold the event loop
LOOKED_AT = 0.08  # [s] after which a turn is asked where it is
KEPT = 12
LONG = 0.02  # [s] of work from which a turn is noted with its time


class Watch:
    """The longest turns of the event loop."""

    def __init__(self, report: Path) -> None:
        self._report = report
        self.turns = 0
        self.longest: list[dict[str, Any]] = []
        self.long: deque[dict[str, Any]] = deque(maxlen=3000)
        self.collected = 0.0  # [s] of processor time that the longest garbage collection took
        self._begun = 0.0  # of the turn that is going on; 0 between turns
        self._where: dict[float, str] = {}
        self._thread = threading.get_ident()
        self._collecting = 0.0

    def begin(self) -> None:
        """Watch from now on."""
        act = asyncio.events.Handle._run

        def timed(handle: asyncio.events.Handle) -> None:
            worked = time.thread_time()
            self._begun = begun = time.perf_counter()
            try:
                act(handle)
            finally:
                self._begun = 0.0
                self._note(begun, time.perf_counter() - begun, time.thread_time() - worked)

        asyncio.events.Handle._run = timed  # type: ignore[method-assign]
        gc.callbacks.append(self._collects)
        threading.Thread(target=self._look, daemon=True).start()

    def write(self) -> None:
        """Put what there is into the report, in one step."""
        found = {
            "turns": self.turns,
            "collected": self.collected,
            "longest": self.longest,
            "long": list(self.long),
        }
        beside = self._report.with_suffix(".new")
        beside.write_text(json.dumps(found), encoding="utf-8")
        beside.replace(self._report)

    def _note(self, begun: float, took: float, worked: float) -> None:
        self.turns += 1
        where = self._where.pop(begun, "")
        if worked >= LONG:
            self.long.append({"at": time.time() - took, "worked": worked, "where": where})
        if len(self.longest) < KEPT or took > self.longest[-1]["seconds"]:
            self.longest.append({"seconds": took, "worked": worked, "where": where})
            self.longest.sort(key=lambda turn: -turn["seconds"])
            del self.longest[KEPT:]

    def _collects(self, phase: str, told: dict[str, int]) -> None:
        if phase == "start":
            self._collecting = time.thread_time()
        else:
            self.collected = max(self.collected, time.thread_time() - self._collecting)

    def _look(self) -> None:
        written = 0.0
        while True:
            time.sleep(0.25 * LOOKED_AT)
            if time.monotonic() > written + 1.0:
                self.write()
                written = time.monotonic()
            begun = self._begun
            if begun and time.perf_counter() - begun > LOOKED_AT and begun not in self._where:
                stack = traceback.extract_stack(sys._current_frames().get(self._thread))
                ours = [one for one in stack[:-1] if "bearing" in one.filename]
                self._where[begun] = " < ".join(
                    f"{Path(one.filename).name}:{one.lineno} {one.name}"
                    for one in (stack[-1], *reversed(ours[-7:]))
                )
                for old in sorted(self._where)[:-100]:
                    del self._where[old]


def main() -> int:
    """Serve, and report once a second."""
    report, *arguments = sys.argv[1:]
    from bearing_explorer.__main__ import main as serve

    Watch(Path(report)).begin()
    return serve(arguments)


if __name__ == "__main__":
    sys.exit(main())
