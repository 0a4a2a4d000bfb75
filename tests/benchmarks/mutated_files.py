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
import contextlib
import io
import json
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from tests.benchmarks.machine import pace
from tests.browser.helpers import Server, free_port, serving
from tests.fuzz.inputs import bytes_like, text_like
from tests.fuzz.targets import csv_texts, matlab_files, unclear, wav_files
from tests.helpers.loops import run as run_coroutine
from tests.helpers.page_client import PageClient

LONGEST_TURN = 0.25
"""[s] of processor time of a turn of the event loop."""
PATIENCE = 90.0
"""[s] for an answer; reading itself gives up after 20."""
SESSIONS = 2
UNDER_WAY, REFUSED = "words busy", "words bad"
"""Classes of the form's sentence."""


def hdf5_files() -> list[bytes]:
    """Small files as measuring programs write them."""
    made = []
    signal = np.random.default_rng(3).normal(size=400)
    for options in ({}, {"compression": "gzip", "chunks": (100,)}):
        file = io.BytesIO()
        with h5py.File(file, "w") as writer:
            data = writer.create_dataset("bearing/acc_y", data=signal, **options)
            data.attrs["unit"], data.attrs["sample_rate"] = "g", 12_000.0
        made.append(file.getvalue())
    return made


def formats() -> dict[str, Callable[[random.Random], bytes]]:
    """A mutated file of each format, of random numbers."""
    texts, waves, matrices, trees = csv_texts(), wav_files(), matlab_files(), hdf5_files()
    return {
        "csv": lambda r: text_like(r, texts).encode("utf-8", "surrogatepass"),
        "wav": lambda r: bytes_like(r, waves),
        "mat": lambda r: bytes_like(r, matrices),
        "h5": lambda r: bytes_like(r, trees),
    }


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
    wanted: dict[str, Any] | None = None

    def _event(self, event: dict[str, Any], buffers: dict[str, bytes]) -> None:
        super()._event(event, buffers)
        if event["kind"] == "MessageSent" and "'of'" in str(event.get("msg_data")):
            self.wanted = event
        text = str(event.get("new")) if event.get("attr") == "text" else ""
        # a refusal, or the line that a file which is taken folds to
        if text and (REFUSED in text or self.name in text) and UNDER_WAY not in text:
            self.sentence = text

    async def upload(self, name: str, content: bytes) -> str:
        """Send a file; return the sentence about it, empty where none comes."""
        self.sentence, self.name, self.wanted = "", name, None
        await self.say("FileUpload", {"type": "begin", "name": name, "size": len(content)})
        end = time.perf_counter() + PATIENCE
        sent = False
        while time.perf_counter() < end and not self.closed:
            if self.wanted is not None and not sent:
                sent = True
                await self.send_piece(content, number_of(self.wanted))
            if self.sentence:
                return self.sentence
            await self.news(1.0)
        return ""

    async def send_piece(self, content: bytes, of: int) -> None:
        """The whole file in one piece: the page sends bytes as a buffer of the message."""
        data = {"type": "bytes", "data": {"id": "b1"}}
        entries = [["type", "piece"], ["content", data], ["of", of]]
        model = {"id": self.ids["FileUpload"]}
        values = [["model", model], ["data", {"type": "map", "entries": entries}]]
        event = {
            "type": "event",
            "name": "data_event",
            "values": {"type": "map", "entries": values},
        }
        head = {"msgid": "piece", "msgtype": "PATCH-DOC", "num_buffers": 1}
        patch = {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}
        frames = (json.dumps(head), "{}", json.dumps({"events": [patch]}))
        await self.send_frames(*frames, json.dumps({"id": "b1"}), content)


def number_of(event: dict[str, Any]) -> int:
    """The number of the upload in a message that asks for a piece."""
    found = json.dumps(event).replace('"of",', '"of":').split('"of":', 1)[1]
    return int("".join(c for c in found.strip()[:12] if c.isdigit()))


async def opened(url: str) -> Uploader:
    """A session on the tab of measurements."""
    client = Uploader(url)
    await client.open_page()
    await client.connect()
    await client.show("diagnosis", "FileUpload")
    return client


async def send_all(client: Uploader, numbers: Sequence[int], seed: int, tally: Tally) -> None:
    """Upload the files with these numbers, in one session."""
    kinds = formats()
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


def run(files: int, seed: int) -> tuple[Tally, list[dict[str, Any]], list[str], str]:
    """Upload so many: what came of it, longest turns, files left behind, and the log."""
    tally, port = Tally(), free_port()
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as other:
        report = Path(other) / "turns.json"
        command = [sys.executable, "-m", "tests.fuzz.watched_server", str(report)]
        options = ["--port", str(port), "--no-browser"]
        server = Server([*command, *options], port, environment={"TMPDIR": folder})
        with serving(server):

            async def everything() -> None:
                clients = [await opened(server.url) for _ in range(SESSIONS)]
                await asyncio.sleep(2.5)
                report.unlink()  # opening pages is not counted
                await asyncio.sleep(1.5)
                work = [
                    send_all(client, range(k, files, SESSIONS), seed, tally)
                    for k, client in enumerate(clients)
                ]
                await asyncio.gather(*work)

            run_coroutine(everything())  # browser tests keep a loop in the main thread
            time.sleep(1.5)  # the watch writes once a second
            left = [str(path.relative_to(folder)) for path in Path(folder).rglob("*")]
        turns: list[dict[str, Any]] = []
        with contextlib.suppress(FileNotFoundError):
            turns = json.loads(report.read_text(encoding="utf-8"))
        return tally, turns, left, server.log


def faults_of(files: int, tally: Tally, turns: list[dict[str, Any]], left: list[str]) -> list[str]:
    """What is not as it should be."""
    faults = list(tally.faults)
    if tally.answers.total() != files:
        faults.append(f"{files - tally.answers.total()} files without an answer")
    faults += [
        f"a turn of {1e3 * turn['worked']:.0f} ms: {turn['where'][:150]}"
        for turn in turns
        if turn["worked"] > LONGEST_TURN
    ]
    return faults + [f"left behind: {name}" for name in left]


def main() -> int:
    """Upload, print, and say with the exit code whether anything was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--files", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    chosen = parser.parse_args()
    began = time.perf_counter()
    tally, turns, left, log = run(chosen.files, chosen.seed)
    median, most = np.quantile(tally.seconds, [0.5, 1.0])
    print(f"{chosen.files} files in {time.perf_counter() - began:.0f} s, seed {chosen.seed}")
    print(f"answered: {dict(tally.answers)}, of them refused: {dict(tally.refused)}")
    print(f"after {median:.2f} s (median), {most:.2f} s (longest)")
    print(pace())
    for turn in turns[:3]:
        print(f"  {1e3 * turn['worked']:>6.0f} ms of work  {turn['where'][:150]}")
    faults = faults_of(chosen.files, tally, turns, left)
    if "Traceback" in log:
        faults.append(f"a traceback in the log: {log[log.find('Traceback') :][:2000]}")
    for words in faults:
        print(f"FOUND: {words}")
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
