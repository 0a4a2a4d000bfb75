"""Somebody who moves a slider all the while: ``python -m tests.fuzz.slider URL``.

In a process of its own, or waiting would be for the strangers' work too. A new position is sent
half a second after the one before is drawn. Prints how many there were, how many were never drawn,
and the seconds from asking to the picture: median, 95 %, longest; when its input ends.
"""

from __future__ import annotations

import asyncio
import math
import sys
import threading
import time

import numpy as np

from tests.fuzz.pulse import READY, Told, asking
from tests.helpers.page_client import PageClient

PATIENCE = 60.0  # [s]
PAUSE = 0.5  # [s] between a picture and the next position


def slider(url: str) -> Told:
    """Move it for as long as the block lasts; see `tests.fuzz.pulse.asking`."""
    return asking("tests.fuzz.slider", url)


async def move(url: str, over: threading.Event) -> None:
    """Ask until the input ends."""
    client = PageClient(url)
    await client.open_page()
    await client.connect()
    await client.until_drawn(seconds=5.0 * PATIENCE)
    print(READY, flush=True)
    waits, lost, number = [], 0, 0
    while not over.is_set() and not client.closed:
        number += 1
        asked = time.perf_counter()
        await client.ask(set={"extent_deg": 20.0 + 10.0 * math.sin(0.1 * number)})
        if await client.until_drawn(seconds=PATIENCE):
            waits.append(time.perf_counter() - asked)
        else:
            lost += 1
        await asyncio.sleep(PAUSE)
    lost += client.closed
    await client.close()
    found = np.quantile(waits, [0.5, 0.95, 1.0]) if waits else [math.inf] * 3
    print(len(waits), lost, *found)


def main(url: str) -> None:
    """Begin, and listen for the end."""
    over = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), over.set()), daemon=True).start()
    asyncio.run(move(url, over))


if __name__ == "__main__":
    main(sys.argv[1])
