"""Somebody who sends what no page sends, and comes again when cut off."""

from __future__ import annotations

import asyncio
import math
import random
import struct
import time
from collections import Counter
from dataclasses import dataclass, field

import numpy as np
from bearing_explorer.page import SECTIONS
from tornado.httpclient import HTTPClientError
from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError

from tests.fuzz.hostile_messages import SHAPES, Frames, Raw, any_shape, made
from tests.helpers.page_client import PageClient

PATIENCE = 60.0  # [s] for an answer
CHEAP_TAB = "load"
"""Most strangers look at it: what is tried is what they send, not what they are shown."""
SAME_PAGE = 400
"""Messages after which a new page is asked for; until then the same one is connected to again."""


@dataclass
class Tally:
    """What became of the messages of each shape."""

    sent: Counter[str] = field(default_factory=Counter)
    cut: Counter[str] = field(default_factory=Counter)
    slowest: dict[str, float] = field(default_factory=dict)  # [s], until all was heard
    pages: int = 0
    late_pages: int = 0
    unanswered: int = 0
    errors: list[str] = field(default_factory=list)

    @property
    def messages(self) -> int:
        """How many were sent in all."""
        return self.sent.total()


class _Blind(PageClient):
    """A client that looks at no picture: who connects again has missed some."""

    def _packet(self, packed: np.ndarray) -> None:
        del packed


class Stranger:
    """One of them; several share a `tally` and send until it has `messages`."""

    def __init__(self, url: str, number: int, tally: Tally) -> None:
        self._url = url
        self._random = random.Random(f"stranger {number}")
        self._tally = tally
        self._client: PageClient | None = None
        self._since_page = 0
        self._pongs = 0
        self._first = list(SHAPES)  # each shape once, then at random

    async def send(self, messages: int, until: float = math.inf) -> None:
        """Send until there are so many of all, or until a time of `time.monotonic`."""
        while self._tally.messages < messages and time.monotonic() < until:
            client = await self._there()
            if client is not None:
                await self._try(client)
        if self._client is not None:
            await self._client.close()

    async def _there(self) -> PageClient | None:
        """A connection: the one there is, else another to the same page, else of a new page."""
        client = self._client
        if client is not None and not client.closed and self._since_page < SAME_PAGE:
            return client
        if client is not None:
            await client.close()
        try:
            if client is None or self._since_page >= SAME_PAGE:
                raise ConnectionError
            await self._listen(client)
        except (ConnectionError, OSError, HTTPClientError, StreamClosedError):
            client = await self._new_page()
        self._client = client
        return client

    async def _new_page(self) -> PageClient | None:
        client = _Blind(self._url)
        try:
            if await client.open_page() != 200:
                await asyncio.sleep(0.5)
                return None
            self._since_page = 0
            self._tally.pages += 1
            await client.connect()
        except (HTTPClientError, OSError, TimeoutError):
            self._tally.late_pages += 1  # so many of them ask at once
            return None
        self._hear_pongs(client)
        every = self._random.random() < 0.25
        await client.show(self._random.choice(SECTIONS).name if every else CHEAP_TAB)
        await self._all_is_heard(client)
        return client

    async def _listen(self, client: PageClient) -> None:
        """Connect to the same page again, as a stranger does who saves himself the asking."""
        await client.open_socket()
        self._hear_pongs(client)
        if client.closed:
            raise ConnectionError

    def _hear_pongs(self, client: PageClient) -> None:
        assert client._socket is not None

        def on_pong(data: bytes) -> None:
            self._pongs += 1
            client._news.set()

        client._socket.on_pong = on_pong  # type: ignore[method-assign]

    async def _try(self, client: PageClient) -> None:
        name = self._first.pop() if self._first else any_shape(self._random)
        messages = made(self._random, name, client.ids)
        begun = time.perf_counter()
        for frames in messages:
            self._tally.sent[name] += 1
            self._since_page += 1
            try:
                await _write(client, frames)
            except (StreamClosedError, WebSocketClosedError):
                break
        if not await self._all_is_heard(client):
            self._tally.unanswered += 1
            await client.close()
        took = time.perf_counter() - begun
        self._tally.slowest[name] = max(self._tally.slowest.get(name, 0.0), took)
        self._tally.cut[name] += client.closed
        if client.failed:
            self._tally.errors.append(f"what it answered could not be read: {client.failed!r}")
        self._tally.errors += client.errors[:1]
        client.errors.clear()
        client.messages.clear()

    async def _all_is_heard(self, client: PageClient) -> bool:
        """Wait until the server has done with all that was sent: it answers a ping after that."""
        before, end = self._pongs, time.perf_counter() + PATIENCE
        try:
            await _write(client, [Raw(9, b"")])
        except (StreamClosedError, WebSocketClosedError):
            return True
        while self._pongs == before and not client.closed:
            left = end - time.perf_counter()
            if left < 0.0:
                return False
            await client.news(left)
        return True


async def _write(client: PageClient, frames: Frames) -> None:
    assert client._socket is not None
    stream = getattr(client._socket.protocol, "stream", None)
    if stream is None or client.closed:
        raise StreamClosedError
    for frame in frames:
        one = frame if isinstance(frame, Raw) else _framed(frame)
        length = len(one.payload)
        head = struct.pack("B", 0x80 * one.whole | one.flags | one.opcode)
        if length < 126:
            head += struct.pack("B", 0x80 | length)
        elif length <= 0xFFFF:
            head += struct.pack("!BH", 0x80 | 126, length)
        else:
            head += struct.pack("!BQ", 0x80 | 127, length)
        await stream.write(head + bytes(4) + one.payload)  # masked with nothing


def _framed(frame: str | bytes) -> Raw:
    return Raw(2, frame) if isinstance(frame, bytes) else Raw(1, frame.encode())
