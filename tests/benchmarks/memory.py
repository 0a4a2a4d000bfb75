"""Memory over classes that come and go: ``python -m tests.benchmarks.memory``.

A server is really started. Class after class opens the page and three tabs, drags, and leaves.
Printed is what the process holds with each class there and after it has left, and how long the
first pictures of a class that comes at once took. From the second class on, once caches are full,
what is left must be flat within 15 %.
"""

import asyncio
import sys
import time

import numpy as np

from tests.benchmarks.machine import pace, resident
from tests.browser.helpers import explorer_server, serving
from tests.helpers.page_client import PageClient

CLASSES, PEOPLE = 10, 20
TABS = ("load", "stiffness", "vibration")
SETTLES = 30.0
"""After which sessions are dropped and a collection has been [s]."""
MAY_GROW = 1.15


async def person(url: str, number: int) -> float:
    """Come, drag on each tab, and leave; return the time until the first picture [s]."""
    client, began = PageClient(url), time.perf_counter()
    await client.connect()
    await client.until_drawn(seconds=120.0)
    first = time.perf_counter() - began
    for tab in TABS:
        await client.show(tab)
        for step in range(3):
            await client.ask(set={"extent_deg": 10.0 + number + 0.3 * step})
            await client.until_drawn(seconds=120.0)
    await client.close()
    return first


async def one_class(url: str, process: int, number: int) -> tuple[list[float], float, float]:
    """First pictures [s], and the memory at most and after all have left [MB]."""
    held: list[float] = []
    people = asyncio.gather(*(person(url, PEOPLE * number + k) for k in range(PEOPLE)))
    while not people.done():
        await asyncio.wait({people}, timeout=0.5)
        held.append(resident(process))
    await asyncio.sleep(SETTLES)
    return await people, max(held), resident(process)


def main() -> int:
    """Print a table, and say with the exit code whether memory was flat."""
    left: list[float] = []
    with serving(explorer_server()) as server:
        process = server.process.pid
        print(f"{resident(process):.0f} MB before; then for each class of {PEOPLE}:")
        for number in range(CLASSES):
            firsts, most, after = asyncio.run(one_class(server.url, process, number))
            median, last = np.median(firsts), max(firsts)
            left.append(after)
            print(
                f"{most:>6.0f} MB at most, {after:>5.0f} MB after it; "
                f"first pictures {median:.1f} s (median), {last:.1f} s (last)",
                flush=True,
            )
    ratio = left[-1] / left[min(1, len(left) - 1)]
    print(f"from the second class to the last: {ratio:.2f}; {pace()}")
    return int(ratio > MAY_GROW)


if __name__ == "__main__":
    sys.exit(main())
