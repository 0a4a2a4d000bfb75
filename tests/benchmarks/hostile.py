"""Hostile messages to a running server: ``python -m tests.benchmarks.hostile --messages 20000``.

A server is really started. From a process of their own several clients open the page and send what
no page sends (`tests.fuzz.hostile_messages`), connecting again whenever they are cut off.
Meanwhile a good session moves a slider and `/liveness` is asked over and over; and inside the
server each turn of its event loop is timed. The exit code says whether the good session and
`/liveness` were answered every time, whether no turn took more than a second of processor time, and
whether the log is without a traceback.
"""

from __future__ import annotations

import argparse
import asyncio
import math
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pandas as pd
from tornado.httpclient import AsyncHTTPClient

from tests.benchmarks.machine import pace
from tests.browser.helpers import serving
from tests.fuzz.attacker import PATIENCE, Tally, attack
from tests.fuzz.watched_server import LONGEST_HOLD, WatchedServer, faults_of, words_of
from tests.helpers.page_client import PageClient

CLIENTS = 6


def send(url: str, messages: int, first: int) -> Tally:
    """Send from this process; return what came of it."""
    tally = Tally()

    async def all_of_them() -> None:
        await asyncio.gather(*(attack(url, first + k, messages, tally) for k in range(CLIENTS)))

    asyncio.run(all_of_them())
    return tally


async def meanwhile(url: str, sending: asyncio.Future[Tally]) -> tuple[list[float], list[float]]:
    """Waits for pictures of a good session and for `/liveness` [s]; infinite where none came."""
    client, pictures, alive = PageClient(url), list[float](), list[float]()
    await client.open_page()
    await client.connect()
    await client.until_drawn(seconds=PATIENCE)
    while not sending.done() or not pictures:
        began = time.perf_counter()
        await client.ask(set={"extent_deg": 20.0 + 10.0 * math.sin(0.1 * len(pictures))})
        drawn = not client.closed and await client.until_drawn(seconds=PATIENCE)
        pictures.append(time.perf_counter() - began if drawn else math.inf)
        began = time.perf_counter()
        answer = await AsyncHTTPClient().fetch(
            url + "liveness", raise_error=False, request_timeout=PATIENCE
        )
        alive.append(time.perf_counter() - began if answer.code == 200 else math.inf)
        await asyncio.sleep(0.3)
    await client.close()
    return pictures, alive


async def run(url: str, messages: int, first: int) -> tuple[Tally, list[float], list[float]]:
    """Everything at once."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as elsewhere:
        loop = asyncio.get_running_loop()
        sending = loop.run_in_executor(elsewhere, send, url, messages, first)
        pictures, alive = await meanwhile(url, sending)
        return await sending, pictures, alive


def main() -> int:
    """Send, print a table, and say with the exit code whether anything was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--messages", type=int, default=20_000)
    parser.add_argument("--first", type=int, default=0, help="number of the first client")
    chosen = parser.parse_args()
    with serving(WatchedServer()) as server:
        began = time.perf_counter()
        tally, pictures, alive = asyncio.run(run(server.url, chosen.messages, chosen.first))
        took = time.perf_counter() - began
        turns = server.longest_turns()
        server.stop()
        log = server.log
    columns = {
        "messages": tally.sent,
        "cut off": tally.cut,
        "slowest until taken [s]": tally.slowest,
    }
    print(pd.DataFrame(columns).to_string())
    print(f"{tally.sent.total():,} messages in {took:.0f} s; the longest turns of the event loop:")
    for turn in turns:
        print(words_of(turn))
    for what, waits in (("pictures", pictures), ("/liveness", alive)):
        median, most, longest = np.quantile(waits, [0.5, 0.95, 1.0])
        print(
            f"{what}: {len(waits)}; median {median:.3f}, 95 % {most:.3f}, longest {longest:.2f} s"
        )
    print(f"log: {len(log.splitlines()):,} lines")
    print(pace())
    faults = faults_of(turns, LONGEST_HOLD, log)
    faults += [f"the server answered with errors: {error}" for error in tally.errors[:2]]
    if tally.unanswered:
        faults.append(f"{tally.unanswered} messages were never taken")
    for what, waits in (("pictures of the good session", pictures), ("/liveness", alive)):
        if math.isinf(max(waits)):
            faults.append(f"{what}: not every time")
    for words in faults:
        print(f"FOUND: {words}")
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
