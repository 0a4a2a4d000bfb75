"""A client that sends what no page sends, and connects again when it is cut off."""

import math
import random
import time
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np
from tornado.httpclient import HTTPClientError
from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError

from tests.fuzz.hostile_messages import SHAPES, any_shape
from tests.helpers.page_client import PageClient

PATIENCE = 60.0
"""For an answer [s]."""
SAME_PAGE = 400
"""Messages after which a new page is asked for; until then the same one is connected to again."""
_GONE = (StreamClosedError, WebSocketClosedError)


@dataclass
class Tally:
    """The messages of each shape that were sent, and the connections that were cut."""

    sent: Counter[str] = field(default_factory=Counter)
    cut: int = 0
    unanswered: int = 0
    errors: list[str] = field(default_factory=list)


class _Client(PageClient):
    """Looks at no picture: after another connection some are missing."""

    pongs = 0

    def _packet(self, packed: np.ndarray) -> None:
        del packed

    async def open_socket(self, origin: str | None = None) -> None:
        await super().open_socket(origin)
        assert self._socket is not None

        def on_pong(_: bytes) -> None:
            self.pongs += 1
            self._news.set()

        self._socket.on_pong = on_pong  # type: ignore[method-assign]

    async def all_is_taken(self) -> bool:
        """Wait until the server has taken all that was sent: it answers a ping after that."""
        assert self._socket is not None
        before, end = self.pongs, time.perf_counter() + PATIENCE
        try:
            self._socket.ping()
        except _GONE:
            return True
        while self.pongs == before and not self.closed:
            if (left := end - time.perf_counter()) < 0.0:
                return False
            await self.news(left)
        return True


async def attack(url: str, number: int, messages: int, tally: Tally) -> None:
    """Send until `tally` has so many messages; several clients may share it."""
    random_ = random.Random(f"attacker {number}")
    client: _Client | None = None
    first, since_page = list(SHAPES), math.inf  # each shape once, then at random
    while tally.sent.total() < messages:
        try:
            if client is None or since_page >= SAME_PAGE:
                client, since_page = await _new_page(client, url), 0
            elif client.closed:  # a server may answer the ping first and cut then
                tally.cut += 1
                await client.close()
                await client.open_socket()
        except (HTTPClientError, OSError, TimeoutError, *_GONE):
            since_page = math.inf  # the session is over: a new page
            continue
        name = first.pop() if first else any_shape(random_)
        tally.sent[name] += 1
        since_page += 1
        with suppress(*_GONE):
            await client.send_frames(*SHAPES[name][0](random_, client.ids))
        if not await client.all_is_taken():
            tally.unanswered += 1
            since_page = math.inf
        tally.errors += client.errors[:1]
        client.errors.clear()
    if client is not None:
        await client.close()


async def _new_page(before: _Client | None, url: str) -> _Client:
    if before is not None:
        await before.close()
    client = _Client(url)
    await client.connect()
    await client.show("load")
    return client
