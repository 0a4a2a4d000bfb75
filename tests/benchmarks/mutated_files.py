"""Mutated files for the page: ``python -m tests.benchmarks.mutated_files --files 10000 --seed 1``.

A server is really started. Sessions upload files of every format that were good before a mutation
of `tests.fuzz.inputs`, in the messages that the page sends. Printed are how many were taken and
refused, how long answers took, the longest turn of the server's event loop, and what is left in
its folder for temporary files. The exit code says whether each file had an answer in a sentence,
no turn took more than LONGEST_TURN of processor time, and nothing is left.
"""

from __future__ import annotations

import argparse
import asyncio
import random
import re
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tests.benchmarks.machine import pace
from tests.browser.helpers import serving
from tests.fuzz.targets import broken_files, unclear
from tests.fuzz.watched_server import WatchedServer, faults_of, words_of
from tests.helpers.loops import run as run_coroutine
from tests.helpers.page_client import PageClient

LONGEST_TURN = 0.25
"""[s] of processor time of a turn of the event loop."""
PATIENCE = 90.0
"""[s] for an answer; reading itself gives up after 20."""
SESSIONS = 2
UNDER_WAY, REFUSED = "words busy", "words bad"
"""Classes of the form's sentence."""


@dataclass
class Tally:
    """What came of the files."""

    answers: Counter[str] = field(default_factory=Counter)
    refused: Counter[str] = field(default_factory=Counter)
    seconds: list[float] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


class Uploader(PageClient):
    """A session on the Diagnosis tab, whose form says what became of a file."""

    sentence = ""
    name = ""
    wanted: int | None = None
    """number of the upload of which the server has asked for a piece"""

    def _event(self, event: dict[str, Any], buffers: dict[str, bytes]) -> None:
        super()._event(event, buffers)
        if asked := re.search(r"'of'[:,] (\d+)", str(event.get("msg_data"))):
            self.wanted = int(asked[1])
        text = str(event.get("new")) if event.get("attr") == "text" else ""
        # a refusal, or the line that a file which is taken folds to
        if text and (REFUSED in text or self.name in text) and UNDER_WAY not in text:
            self.sentence = text

    async def upload(self, name: str, content: bytes) -> str:
        """Send a file in one piece; return the sentence about it, empty where none comes."""
        self.sentence, self.name, self.wanted = "", name, None
        await self.say("FileUpload", {"type": "begin", "name": name, "size": len(content)})
        end = time.perf_counter() + PATIENCE
        while time.perf_counter() < end and not self.closed and not self.sentence:
            if self.wanted is not None:
                block = {"type": "bytes", "data": {"id": "b1"}}
                piece = {"type": "piece", "content": block, "of": self.wanted}
                self.wanted = None
                await self.say("FileUpload", piece, b1=content)
            await self.news(1.0)
        return self.sentence


async def opened(url: str) -> Uploader:
    """A session on the tab of measurements."""
    client = Uploader(url)
    await client.open_page()
    await client.connect()
    await client.show("diagnosis", "FileUpload")
    return client


async def send_all(client: Uploader, numbers: Sequence[int], seed: int, tally: Tally) -> None:
    """Upload the files with these numbers, in one session."""
    kinds = broken_files()
    for number in numbers:
        kind = list(kinds)[number % len(kinds)]
        content = kinds[kind](random.Random(f"{seed} {number}")) or b" "
        began = time.perf_counter()
        sentence = await client.upload(f"file {number}.{kind}", content)
        tally.seconds.append(time.perf_counter() - began)
        tally.answers[kind] += bool(sentence)
        tally.refused[kind] += REFUSED in sentence
        wrong = "no answer" if not sentence else unclear(sentence[:600])
        if wrong:
            tally.faults.append(f"{kind} {number}: {wrong}: {sentence[:200]!r}")
        if client.closed:
            break
    await client.close()


def run(files: int, seed: int) -> tuple[Tally, list[dict[str, Any]], str]:
    """Upload so many: what came of it, the longest turns of the event loop, and the log."""
    tally = Tally()
    with tempfile.TemporaryDirectory() as folder, serving(WatchedServer(TMPDIR=folder)) as server:

        async def everything() -> None:
            clients = [await opened(server.url) for _ in range(SESSIONS)]
            await asyncio.sleep(2.5)
            server.forget_turns()  # opening pages is not counted
            await asyncio.sleep(1.5)
            work = [
                send_all(client, range(k, files, SESSIONS), seed, tally)
                for k, client in enumerate(clients)
            ]
            await asyncio.gather(*work)

        run_coroutine(everything())  # browser tests keep a loop in the main thread
        turns = server.longest_turns()
        left = [str(path.relative_to(folder)) for path in Path(folder).rglob("*")]
        tally.faults += [f"left behind: {name}" for name in left]
    if tally.answers.total() != files:
        tally.faults.append(f"{files - tally.answers.total()} files without an answer")
    return tally, turns, server.log


def main() -> int:
    """Upload, print, and say with the exit code whether anything was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--files", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    chosen = parser.parse_args()
    began = time.perf_counter()
    tally, turns, log = run(chosen.files, chosen.seed)
    median, most = np.quantile(tally.seconds, [0.5, 1.0])
    print(f"{chosen.files} files in {time.perf_counter() - began:.0f} s, seed {chosen.seed}")
    print(f"answered: {dict(tally.answers)}, of them refused: {dict(tally.refused)}")
    print(f"after {median:.2f} s (median), {most:.2f} s (longest)")
    print(pace())
    for turn in turns[:3]:
        print(words_of(turn))
    faults = [*tally.faults, *faults_of(turns, LONGEST_TURN, log)]
    for words in faults:
        print(f"FOUND: {words}")
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
