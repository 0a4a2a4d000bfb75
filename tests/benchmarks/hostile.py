"""Hostile messages to a running server: ``python -m tests.benchmarks.hostile --messages 100000``.

A server is really started; several strangers open the page and its websocket and send what no
page sends (`tests.fuzz.hostile_messages`), connecting again whenever they are cut off. What they
send is waited for until the server has done with it or has cut the connection. Meanwhile somebody
moves a slider, and `/liveness` is asked over and over, each from a process of its own; and inside
the server each turn of its event loop is timed. Nothing from outside may hold that loop longer than
1 s. The exit code says whether the good session and `/liveness` were answered every time,
whether no turn took more processor time than that, and whether the log is without a traceback.
"""

from __future__ import annotations

import argparse
import asyncio
import math
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.benchmarks.machine import pace
from tests.browser.helpers import serving
from tests.fuzz.hostile_messages import SHAPES
from tests.fuzz.pulse import pulse
from tests.fuzz.slider import slider
from tests.fuzz.stranger import Stranger, Tally
from tests.fuzz.watched_server import LONGEST_HOLD
from tests.helpers.watched import watched_server

STRANGERS = 6
TELL_EVERY = 5_000  # messages


@dataclass
class Outcome:
    """All that was measured."""

    tally: Tally
    seconds: float
    memory: list[float]  # [MB] of the server: before, at most, after
    liveness: list[float]  # longest [s], unanswered
    slider: list[float]  # pictures, lost, median, 95 %, longest [s]
    loop: dict[str, Any]
    lines: int
    tracebacks: int
    trouble: str

    @property
    def longest_work(self) -> float:
        """Processor time [s] of the longest turn of the loop."""
        return max((turn["worked"] for turn in self.loop["longest"]), default=0.0)

    def faults(self) -> list[str]:
        """What must not be, in words."""
        _, unanswered = self.liveness
        pictures, lost, *_ = self.slider
        found = {
            f"{self.tracebacks} tracebacks in the log:\n{self.trouble}": self.tracebacks > 0,
            f"/liveness was not answered {unanswered:.0f} times": unanswered > 0,
            f"{lost:.0f} pictures of the good session were lost": lost > 0,
            "the good session had no picture": pictures == 0,
            f"{self.tally.unanswered} messages were never done with": self.tally.unanswered > 0,
            f"the server told strangers of errors: {self.tally.errors[:2]}": bool(
                self.tally.errors
            ),
            f"a turn of the loop worked for {self.longest_work:.2f} s": (
                self.longest_work > LONGEST_HOLD
            ),
        }
        return [words for words, wrong in found.items() if wrong]


def attack(
    messages: int, strangers: int = STRANGERS, first: int = 0, seconds: float = math.inf
) -> Outcome:
    """Send so many messages to a server of its own, or for so long."""
    server, told = watched_server()
    tally = Tally()
    url = server.url

    until = time.monotonic() + seconds

    async def send() -> list[float]:
        held = [resident(server.process.pid)]
        sending = asyncio.gather(
            *(Stranger(url, first + k, tally).send(messages, until) for k in range(strangers))
        )
        tell_at = TELL_EVERY
        while not sending.done():
            await asyncio.wait({sending}, timeout=1.0)
            held.append(resident(server.process.pid))
            if tally.messages >= tell_at:
                print(f"{tally.messages:>10,} messages {held[-1]:>8.0f} MB", flush=True)
                tell_at += TELL_EVERY
        await sending
        return held

    with serving(server), pulse(server.port) as heard, slider(url) as moved:
        begun = time.perf_counter()
        held = asyncio.run(send())
        seconds = time.perf_counter() - begun
        pictures, alive = moved(), heard()
        time.sleep(1.0)
        after = resident(server.process.pid)
        server.stop()
        log = server.log
    at = log.find("Traceback")
    return Outcome(
        tally, seconds, [held[0], max(held), after], alive, pictures, told(),
        len(log.splitlines()), log.count("Traceback"), log[max(at - 300, 0) : at + 9000],
    )  # fmt: skip


def resident(process: int) -> float:
    """What a process holds [MB]."""
    try:
        pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
    except OSError:
        return 0.0
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def tell(found: Outcome) -> None:
    """The table."""
    tally = found.tally
    print(f"{'shape':<12}{'messages':>10}{'cut off':>10}{'slowest until heard':>22}")
    for name in (*SHAPES, "all"):
        all_ = name == "all"
        sent = tally.messages if all_ else tally.sent[name]
        cut = tally.cut.total() if all_ else tally.cut[name]
        slowest = max(tally.slowest.values()) if all_ else tally.slowest.get(name, 0.0)
        print(f"{name:<12}{sent:>10,}{cut:>10,}{slowest:>20.2f} s")
    rate = tally.messages / found.seconds
    pages = f"{tally.pages} pages, {tally.late_pages} that came too late"
    print(f"{pages}; {found.seconds:.0f} s, {rate:.0f} messages a second")
    loop = found.loop
    print(
        f"event loop: {loop['turns']:,} turns; longest collection {1e3 * loop['collected']:.0f} ms"
    )
    for turn in loop["longest"][:6]:
        print(
            f"  {1e3 * turn['seconds']:>6.0f} ms, of which it worked {1e3 * turn['worked']:>5.0f}"
            f"  {turn['where'][:200]}"
        )
    longest, unanswered = found.liveness
    print(f"/liveness: longest {1e3 * longest:.0f} ms, {unanswered:.0f} without an answer")
    pictures, lost, *waits = found.slider
    median, most, longest = (1e3 * wait for wait in waits)
    print(
        f"a good session: {pictures:.0f} pictures, {lost:.0f} lost; median {median:.0f} ms, "
        f"95 % {most:.0f} ms, longest {longest:.0f} ms"
    )
    before, most, after = found.memory
    print(f"memory: {before:.0f} MB before, {most:.0f} MB at most, {after:.0f} MB after")
    print(f"log: {found.lines:,} lines, {found.tracebacks} tracebacks")
    print(pace())


def main() -> int:
    """Send, tell, and say with the exit code whether anything was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--messages", type=int, default=100_000)
    parser.add_argument("--strangers", type=int, default=STRANGERS)
    parser.add_argument("--minutes", type=float, default=math.inf, help="end after these")
    parser.add_argument("--first", type=int, default=0, help="number of the first stranger")
    chosen = parser.parse_args()
    found = attack(chosen.messages, chosen.strangers, chosen.first, 60.0 * chosen.minutes)
    tell(found)
    for words in found.faults():
        print(f"FOUND: {words}")
    return int(bool(found.faults()))


if __name__ == "__main__":
    sys.exit(main())
