"""What opening a page and its tabs costs the server: ``python -m tests.benchmarks.tabs``.

A server is really started, with a watch on each turn of its event loop
(`tests.fuzz.watched_server`). One person after the other opens the page and then all of its tabs.
Of each is printed for how long the longest turn of the loop worked meanwhile, by the time of its
own thread, which is what all others wait for, and how long it took until the tab was drawn. No turn
may work for longer than 0.25 s.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
import time
from dataclasses import dataclass
from typing import Any

from tests.benchmarks.machine import pace
from tests.browser.helpers import serving
from tests.fuzz.watched_server import LONGEST_HOLD
from tests.helpers.page_client import PageClient
from tests.helpers.watched import watched_server

QUIET = 1.0  # [s] without a message after which a tab has no more to say
LONGEST_WAIT = 8.0  # [s] for that: a first job goes on for longer


@dataclass
class Opening:
    """A tab, or the page, that somebody opened: when, and how long until it was drawn [s]."""

    name: str
    began: float
    drawn: float
    over: float = 0.0

    def turns(self, long: list[dict[str, Any]]) -> list[dict[str, Any]]:
        """The long turns of the loop meanwhile."""
        return [turn for turn in long if self.began <= turn["at"] <= self.over]


async def open_all(url: str, tabs: list[str]) -> list[Opening]:
    """Open the page, on the first of the tabs, and then the others, one after the other."""
    packets = 0

    def count(mark: int, now: float) -> None:
        nonlocal packets
        packets += 1

    client = PageClient(url, count)
    openings = [Opening("the page", time.time(), 0.0)]
    if await client.open_page() != 200:
        raise RuntimeError("there is no page")
    openings[-1].drawn = openings[-1].over = time.time()
    openings.append(Opening(tabs[0], time.time(), 0.0))
    await client.connect()
    for tab in tabs:
        if tab != tabs[0]:
            openings.append(Opening(tab, time.time(), 0.0))
            await client.show(tab)
        while tab != tabs[0] and tab not in client.words.values() and not client.closed:
            await client.news(30.0)
        before = packets if tab != tabs[0] else 0
        while packets == before and not client.closed:
            await client.news(30.0)
        openings[-1].drawn = heard = time.time()
        while time.time() - heard < QUIET and time.time() - openings[-1].drawn < LONGEST_WAIT:
            size = client.bytes_received + len(client.messages)
            await client.news(QUIET)
            if client.bytes_received + len(client.messages) != size:
                heard = time.time()
        openings[-1].over = time.time()
    await client.close()
    return openings


def measure(people: int, tabs: list[str]) -> tuple[list[list[Opening]], dict[str, Any]]:
    """What each person opened, and what the watch on the server's loop has noted."""
    server, told = watched_server()
    with serving(server):
        came = [asyncio.run(open_all(server.url, tabs)) for _ in range(people)]
        time.sleep(1.2)  # the report is written once a second
    return came, told()


def main() -> int:
    """Measure, print, and say with the exit code whether a turn was too long."""
    from bearing_explorer.page import SECTIONS

    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--people", type=int, default=2, help="one after the other")
    parser.add_argument("--tabs", nargs="*", help="besides the first (all)")
    chosen = parser.parse_args()
    first, *others = (section.name for section in SECTIONS)
    quiet = pace()
    came, loop = measure(chosen.people, [first, *(others if chosen.tabs is None else chosen.tabs)])
    heads = "".join(f"{f'person {n + 1}':>36}" for n in range(chosen.people))
    print(f"{'':<12}{heads}")
    print(f"{'opened':<12}" + f"{'longest turn':>16}{'all':>10}{'drawn':>10}" * chosen.people)
    too_long = 0
    for row in zip(*came, strict=True):
        cells = ""
        for opening in row:
            worked = [turn["worked"] for turn in opening.turns(loop["long"])]
            longest = max(worked, default=0.0)
            too_long += longest > LONGEST_HOLD
            cells += (
                f"{1e3 * longest:>13.0f} ms{1e3 * sum(worked):>7.0f} ms"
                f"{1e3 * (opening.drawn - opening.began):>7.0f} ms"
            )
        print(f"{row[0].name:<12}{cells}")
    print("the longest turns, of the loop's own processor time:")
    for turn in sorted(loop["long"], key=lambda turn: -turn["worked"])[:12]:
        ratio = quiet.ratio(turn["worked"])
        print(f"  {1e3 * turn['worked']:>5.0f} ms {ratio:>8}  {turn['where'][:230]}")
    print(f"longest garbage collection {1e3 * loop['collected']:.0f} ms")
    print(f"before: {quiet}\nafter:  {pace()}")
    return int(too_long > 0)


if __name__ == "__main__":
    sys.exit(main())
