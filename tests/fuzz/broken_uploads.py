"""Hostile messages and damaged files, sent to a server that is really started.

Several clients open the page and send what no page sends (`tests.fuzz.hostile_messages`),
connecting again whenever they are cut off; two sessions upload files of every format that were
good before a mutation of `tests.fuzz.inputs`. Meanwhile a good session moves a slider and
`/liveness` is asked over and over; and inside the server each turn of its event loop is timed.
"""

import asyncio
import math
import random
import re
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tornado.httpclient import AsyncHTTPClient

from tests.browser.helpers import serving
from tests.fuzz.attacker import PATIENCE, Tally, attack
from tests.fuzz.targets import broken_files, unclear
from tests.fuzz.watched_server import WatchedServer
from tests.helpers.loops import run as run_coroutine
from tests.helpers.page_client import PageClient

CLIENTS, SESSIONS = 4, 2
"""Hostile clients, and sessions that upload files."""
UNDER_WAY, REFUSED = "words busy", "words bad"
"""Classes of the form's sentence on a file."""


@dataclass
class Outcome:
    """The answers to messages and files, and what went wrong."""

    tally: Tally = field(default_factory=Tally)
    answered: int = 0
    refused: int = 0
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


async def upload_all(url: str, numbers: Sequence[int], outcome: Outcome) -> None:
    """Upload the damaged files with these numbers, in one session."""
    client = Uploader(url)
    await client.connect()
    await client.show("diagnosis", "FileUpload")
    kinds = broken_files()
    for number in numbers:
        kind = list(kinds)[number % len(kinds)]
        content = kinds[kind](random.Random(f"file {number}")) or b" "
        sentence = await client.upload(f"file {number}.{kind}", content)
        outcome.answered += bool(sentence)
        outcome.refused += REFUSED in sentence
        wrong = "no answer" if not sentence else unclear(sentence[:600])
        if wrong:
            outcome.faults.append(f"{kind} {number}: {wrong}: {sentence[:200]!r}")
        if client.closed:
            break
    await client.close()


async def use_meanwhile(url: str, others: asyncio.Future[Any], outcome: Outcome) -> None:
    """Move a slider in a good session and ask `/liveness`, until all others are done."""
    client = PageClient(url)
    await client.connect()
    drawn = alive = await client.until_drawn(seconds=PATIENCE)
    while drawn and alive and not others.done():
        await client.ask(set={"extent_deg": 20.0 + 10.0 * math.sin(0.1 * client.mark)})
        drawn = not client.closed and await client.until_drawn(seconds=PATIENCE)
        answer = await AsyncHTTPClient().fetch(
            url + "liveness", raise_error=False, request_timeout=PATIENCE
        )
        alive = answer.code == 200
        await asyncio.sleep(0.3)
    if not drawn or not alive:
        outcome.faults.append("the good session or /liveness was not answered every time")
    await client.close()


async def all_at_once(url: str, messages: int, files: int, first: int, outcome: Outcome) -> None:
    """Send messages and files beside the good session."""
    numbers = range(first, first + files)
    others = asyncio.gather(
        *(attack(url, first + k, messages, outcome.tally) for k in range(CLIENTS)),
        *(upload_all(url, numbers[k::SESSIONS], outcome) for k in range(SESSIONS)),
    )
    await use_meanwhile(url, others, outcome)
    await others


def run(messages: int, files: int, first: int) -> Outcome:
    """Start a server and send it so many; `first` is the number of the first client and file.

    Faults are: a good session, `/liveness` or a file without an answer or a sentence, a turn of
    more than a second of processor time, a traceback in the log, and what is left behind in the
    folder for temporary files.
    """
    outcome = Outcome()
    with tempfile.TemporaryDirectory() as folder, serving(WatchedServer(TMPDIR=folder)) as server:
        # browser tests keep a loop in the main thread
        run_coroutine(all_at_once(server.url, messages, files, first, outcome))
        outcome.faults += server.slow_turns()
        server.stop()
        _, traceback, after = server.log.partition("Traceback")
        outcome.faults += [after[:3000]] * bool(traceback)
        left = [str(path.relative_to(folder)) for path in Path(folder).rglob("*")]
    outcome.faults += [f"left behind: {name}" for name in left]
    errors, unanswered = outcome.tally.errors, outcome.tally.unanswered
    outcome.faults += [f"the server answered with errors: {error}" for error in errors[:2]]
    if unanswered:
        outcome.faults.append(f"{unanswered} messages were never taken")
    if missing := files - outcome.answered:
        outcome.faults.append(f"{missing} files without an answer")
    return outcome
