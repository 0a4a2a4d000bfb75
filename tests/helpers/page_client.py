"""A client that acts like the page, without a browser: for benchmarks, fuzzing and serving tests.

It opens the page, its websocket, takes the document, says that it is ready, and then speaks as the
scripts of the page do: a message carries a mark, and packets of the packed source come back with
the mark of the newest change that is drawn. Packets are cut into sources as the page does it.
"""

import asyncio
import json
import re
import time
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import WebSocketClientConnection, websocket_connect

_TOKEN = re.compile(rb'"token":"([^"]+)"')
# as in assets/rows.js
AHEAD, PATIENCE = 2, 0.4
CROWDED, HELD, LONGEST_HELD = 0.08, 0.6, 0.15
LARGEST = 200 * 2**20  # bytes of a message that a client takes


class PageClient:
    """One person at the page. `on_packet(mark, seconds)` is called for each packet."""

    def __init__(self, url: str, on_packet: Callable[[int, float], None] | None = None) -> None:
        self.url = url if url.endswith("/") else url + "/"
        self.on_packet = on_packet
        self.token = ""
        self.mark = 0
        self.drawn = 0
        self._network = float("inf")  # the least time a change has been on its way [s]
        self._held = 0.0  # how long the next is held back [s]
        self._arrived = 0.0
        self.sources: dict[str, dict[str, np.ndarray]] = {}
        self.errors: list[str] = []  # what the server said about messages it could not take
        self.words: dict[str, Any] = {}  # newest sentences, status line and states of jobs, by id
        self.ids: dict[str, str] = {}
        self._known_sources: dict[int, tuple[str, list[str]]] = {}
        self._names: dict[str, str] = {}
        self._on_way: dict[int, float] = {}  # when changes were asked for
        self._socket: WebSocketClientConnection | None = None
        self._task: asyncio.Task[None] | None = None
        self._replies: dict[str, asyncio.Future[Any]] = {}
        self._news = asyncio.Event()
        self._count = 0
        self._welcome = self._over = False

    # Coming and going

    async def open_page(self) -> int:
        """Ask for the page; return the status. The token for the websocket is kept."""
        request = HTTPRequest(self.url, request_timeout=120.0)
        response = await AsyncHTTPClient(max_clients=1000).fetch(request, raise_error=False)
        match = _TOKEN.search(response.body or b"")
        self.token = match.group(1).decode() if match else ""
        self.body = response.body or b""
        return int(response.code)

    async def connect(self) -> None:
        """Open the page, its websocket, take the document, say that the page is up."""
        if not self.token and (status := await self.open_page()) != 200:
            raise ConnectionError(f"the page answered {status}")
        await self.open_socket()
        reply = await self.request("PULL-DOC-REQ")
        self._learn(reply["doc"])
        await self.patch(message("document_ready"))

    async def open_socket(
        self, origin: str | None = None, headers: Mapping[str, str] = MappingProxyType({})
    ) -> None:
        """The websocket alone; also once more."""
        self._welcome = self._over = False
        address = re.sub("^http", "ws", self.url) + "ws"
        request = HTTPRequest(address, headers={"Origin": origin} if origin else dict(headers))
        self._socket = await websocket_connect(
            request, subprotocols=["bokeh", self.token], max_message_size=LARGEST
        )
        stream = getattr(self._socket.protocol, "stream", None)
        assert stream is not None
        stream.set_nodelay(True)  # as browsers do
        self._task = asyncio.get_running_loop().create_task(self._read())
        while not self._welcome and not self.closed:
            await self.news(60.0)

    async def close(self) -> None:
        """Leave, as a closed tab does."""
        if self._socket is not None:
            self._socket.close()
        if self._task is not None:
            await asyncio.wait({self._task}, timeout=5.0)
            self._task.cancel()

    @property
    def closed(self) -> bool:
        """Whether the connection is over."""
        return self._task is None or self._task.done()

    # Speaking

    async def send_frames(self, *frames: str | bytes) -> None:
        """Raw frames."""
        assert self._socket is not None
        for frame in frames:
            await self._socket.write_message(frame, binary=isinstance(frame, bytes))

    async def request(self, kind: str, content: Any = None, seconds: float = 60.0) -> Any:
        """Send a message and wait for its answer."""
        self._count += 1
        name = f"c{self._count}"
        future = self._replies[name] = asyncio.get_running_loop().create_future()
        header = {"msgid": name, "msgtype": kind}
        await self.send_frames(json.dumps(header), "{}", json.dumps(content or {}))
        return await asyncio.wait_for(future, seconds)

    async def patch(self, *events: dict[str, Any], **buffers: bytes) -> None:
        """Send events of the document, not waiting for an answer; and blocks of bytes by name."""
        self._count += 1
        header = {"msgid": f"c{self._count}", "msgtype": "PATCH-DOC", "num_buffers": len(buffers)}
        await self.send_frames(json.dumps(header), "{}", json.dumps({"events": list(events)}))
        for name, block in buffers.items():
            await self.send_frames(json.dumps({"id": name}), block)

    async def say(self, component: str, data: Any, **buffers: bytes) -> None:
        """A message of one of the page's components, as `model.send_msg` sends it.

        `component` is the name of its class.
        """
        model = {"id": self.ids[component]}
        await self.patch(message("data_event", model=model, data=data), **buffers)

    async def ask(self, component: str = "Controls", **message: Any) -> int:
        """Ask for a change; return its mark."""
        self.mark += 1
        self._on_way[self.mark] = time.perf_counter()
        await self.say(component, {"mark": self.mark, **message})
        return self.mark

    async def turn(self) -> None:
        """Wait until the page would send its next change."""
        sent = time.perf_counter()
        while self.mark - self.drawn >= (1 if self._held else AHEAD):
            left = PATIENCE - (time.perf_counter() - sent)
            if left <= 0.0 or self.closed:
                return
            await self.news(left)
        await asyncio.sleep(self._arrived + self._held - time.perf_counter())

    async def show(self, tab: str, component: str = "") -> None:
        """Open a tab, and wait for a component of it."""
        await self.say("Tabs", {"show": tab})
        while component and component not in self.ids and not self.closed:
            await self.news(10.0)

    async def until_drawn(self, mark: int | None = None, seconds: float = 120.0) -> bool:
        """Wait until `mark` is drawn, the newest by default; whether it was."""
        wanted = self.mark if mark is None else mark
        end = time.perf_counter() + seconds
        while self.drawn < wanted or not self.sources:
            left = end - time.perf_counter()
            if left <= 0 or self.closed:
                return False
            await self.news(left)
        return True

    async def news(self, seconds: float) -> None:
        """Wait until something comes, but not longer than this."""
        self._news.clear()
        try:
            await asyncio.wait_for(self._news.wait(), seconds)
        except TimeoutError:
            return

    # Listening

    async def _read(self) -> None:
        """Take messages until the connection is over, in the middle of one too."""
        try:
            while (text := await self._frame()) is not None:
                header = json.loads(text)
                frames = [await self._frame() for _ in range(2 + 2 * header.get("num_buffers", 0))]
                if None in frames:
                    break
                _, content, *rest = frames
                names, blocks = rest[::2], rest[1::2]
                buffers = {json.loads(n)["id"]: b for n, b in zip(names, blocks, strict=True)}
                self._take(header, json.loads(content or "{}"), buffers)
                self._news.set()
        finally:
            self._news.set()

    async def _frame(self) -> Any:
        """The next frame; None once the connection is over, however often it is asked for."""
        if self._over:
            return None
        assert self._socket is not None
        frame = await self._socket.read_message()
        self._over = frame is None
        return frame

    def _take(self, header: dict[str, Any], content: Any, buffers: dict[str, bytes]) -> None:
        kind = header["msgtype"]
        reply = self._replies.pop(header.get("reqid", ""), None)
        if reply is not None and not reply.done():
            reply.set_result(content)
        self._welcome |= kind == "ACK"
        if kind == "ERROR":
            self.errors.append(json.dumps(content))
        if kind == "PATCH-DOC":
            for event in content["events"]:
                self._event(event, buffers)

    def _event(self, event: dict[str, Any], buffers: dict[str, bytes]) -> None:
        kind, model = event["kind"], event.get("model", {}).get("id")
        if kind == "ModelChanged":
            self._look(event["new"])
            if model == self.ids["unpack"] and event["attr"] == "args":
                self._learn_packed_source(_plain(event["new"]))
            if event["attr"] in ("text", "line", "active", "state"):
                self.words[model] = _plain(event["new"])
        data = event.get("data" if kind == "ColumnDataChanged" else "new")
        if model == self.ids["packet"] and event.get("attr") == "data":
            array = dict(data["entries"])["packed"]["array"]
            raw = buffers[array["data"]["id"]]
            self._packet(np.frombuffer(raw, np.float32))

    def _packet(self, packed: np.ndarray) -> None:
        n_sources, n_ranges = int(packed[2]), int(packed[3])
        heads = packed[4 : 4 + 3 * (n_sources + n_ranges)].reshape(-1, 3)
        body = 4 + heads.size
        for source, columns, length in heads[:n_sources].astype(int):
            name, names = self._known_sources[source]
            assert len(names) == columns
            block = packed[body : body + columns * length].reshape(columns, length)
            self.sources[name] = dict(zip(names, block, strict=True))
            body += columns * length
        self.drawn, now = int(packed[0]), time.perf_counter()
        arrived = [m for m in self._on_way if m <= self.drawn]
        if arrived:
            self._arrived = now
            way = now - min(self._on_way.pop(m) for m in arrived)
            elsewhere = max(0.0, way - float(packed[1]))
            self._network = min(self._network, elsewhere)
            waited = self._held + elsewhere - self._network
            self._held = min(HELD * waited, LONGEST_HELD) if waited > CROWDED else 0.0
        if self.on_packet is not None:
            self.on_packet(self.drawn, now)

    # What is where in the document

    def _learn(self, doc: Any) -> None:
        self._look(doc)
        for made in _models(doc):
            attributes = made.get("attributes", {})
            if made["name"] == "ColumnDataSource" and "packed" in str(attributes.get("data"))[:200]:
                self.ids["packet"] = made["id"]
            if made["name"] == "CustomJS" and "__mark" in attributes.get("code", ""):
                self.ids["unpack"] = made["id"]
                self._learn_packed_source(_plain(attributes["args"]))

    def _look(self, value: Any) -> None:
        """Names of sources, which the callback of the packed source lists by id; and components."""
        for made in _models(value):
            attributes = made.get("attributes", {})
            if attributes.get("name"):
                self._names[made["id"]] = attributes["name"]
            if label := attributes.get("label") or attributes.get("title"):
                self.ids[str(label)] = made["id"]  # of a widget
            shown = attributes.get("data")
            if isinstance(shown, dict) and shown.get("type") == "object":
                self.ids[shown["name"].rstrip("0123456789")] = made["id"]

    def _learn_packed_source(self, args: dict[str, Any]) -> None:
        columns = args["columns"]
        for index, source in enumerate(args["sources"]):
            name = self._names.get(source["id"], source["id"])
            self._known_sources[index] = (name, columns[index])


def message(name: str, **values: Any) -> dict[str, Any]:
    """An event of the page, as Bokeh sends it."""
    event = {"type": "event", "name": name, "values": notation(values)}
    return {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}


def notation(value: Any) -> Any:
    """Plain data as the page's scripts write it: objects are maps, but for what Bokeh looks up."""
    if isinstance(value, dict) and set(value) != {"id"} and value.get("type") != "bytes":
        return {"type": "map", "entries": [[k, notation(v)] for k, v in value.items()]}
    if isinstance(value, list | tuple):
        return [notation(item) for item in value]
    return value.hex() if isinstance(value, bytes) else value


def _plain(value: Any) -> Any:
    """The other way round."""
    if isinstance(value, dict) and value.get("type") == "map":
        return {key: _plain(item) for key, item in value.get("entries", [])}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value


def _models(value: Any) -> list[dict[str, Any]]:
    """All models that are written out in a piece of a document."""
    models: list[dict[str, Any]] = []
    left = [value]
    while left:
        item = left.pop()
        if isinstance(item, dict):
            if item.get("type") == "object" and "id" in item:
                models.append(item)
            left.extend(item.values())
        elif isinstance(item, list):
            left.extend(item)
    return models
