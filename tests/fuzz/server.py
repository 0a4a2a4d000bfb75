"""Strangers at the running server: paths, queries, frames of the websocket, patches."""

from __future__ import annotations

import asyncio
import json
import random
import time
from contextlib import suppress
from typing import Any
from urllib.parse import quote, urlparse

from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError

from tests.browser.helpers import explorer_server, serving
from tests.fuzz.inputs import TOKENS, plain_value, text_like
from tests.fuzz.pulse import pulse
from tests.fuzz.targets import _addresses
from tests.helpers.page_client import PageClient

_PATHS = (
    *("", "ws", "liveness", "static/js/bokeh.min.js", "favicon.ico", "metadata", "autoload.js"),
    *("static/../../etc/passwd", "static/..%2f..%2f..%2fetc/passwd", "static//etc/passwd"),
    *("static/extensions/panel/../../../../pyproject.toml", "static/extensions/none/x.js"),
    *("rest/session_info", "admin", "index", "%00", "static/%00", "component_resources/x/y.js"),
)
_KINDS = ("PATCH-DOC", "PULL-DOC-REQ", "PUSH-DOC", "SERVER-INFO-REQ", "OK", "ERROR", "", "patch")
_EVENTS = ("ModelChanged", "MessageSent", "RootAdded", "TitleChanged", "ColumnDataChanged", "x")
_TELLTALES = (b"Traceback", b"root:", b"/site-packages/", b"[project]", b" object at 0x")


async def attack(inputs: int, first: int = 0) -> list[str]:
    """Try `inputs` inputs on a server of its own; return what should not have happened."""
    found: list[str] = []
    began = time.perf_counter()
    asked = explorer_server("--max-sessions", "1000")
    with serving(asked) as server, pulse(asked.port) as heard:
        share = inputs // 4
        quiet = PageClient(server.url)
        await quiet.open_page()
        await quiet.connect()
        for number in range(first, first + share):
            found += await _ask(server.url, random.Random(f"http {number}"), f"http {number}")
        for number in range(first, first + share // 4):
            found += await _raw(server.url, random.Random(f"raw {number}"), f"raw {number}")
        talker = _Talker(server.url)
        for number in range(first, first + share):
            await talker.frames(random.Random(f"frames {number}"))
        for number in range(first, first + share // 4):
            await talker.shape(random.Random(f"shape {number}"))
        for number in range(first, first + inputs - 2 * share - 2 * (share // 4)):
            await talker.patch(random.Random(f"patch {number}"))
        found += talker.found
        await talker.close()
        # somebody who was there all the while has lost nothing
        await quiet.ask(set={"extent_deg": 31.0})
        if not await quiet.until_drawn(seconds=60.0):
            found.append("server: another session no longer draws")
        await quiet.close()
        longest, unanswered = heard()
        log = server.log
    print(f"{'':<10}longest silence {1e3 * longest:.0f} ms, {unanswered:.0f} without an answer")
    if unanswered:
        found.append(f"server: {unanswered:.0f} times it did not say that it lives")
    if "Traceback" in log:
        at = log.index("Traceback")
        found.append("server: its log has a traceback:\n" + log[max(at - 500, 0) : at + 2500])
    took = time.perf_counter() - began
    print(f"{'server':<10}{inputs:>9}{'':>29}{len(found):>7}{took:>6.0f} s", flush=True)
    return found


async def _ask(url: str, random_: random.Random, name: str) -> list[str]:
    path = random_.choice(_PATHS)
    if random_.random() < 0.4:
        path += quote(random_.choice(TOKENS).encode("utf-8", "surrogatepass"), safe="./%&?=")
    query = random_.choice(("", "?", *_addresses_once())).lstrip("?")
    if random_.random() < 0.5:
        query = text_like(random_, _addresses_once())[:4000]
    asked = quote(query.encode("utf-8", "surrogatepass"), safe="=&+%.;/")
    if random_.random() < 0.2:
        asked += "&" + random_.choice(("bokeh-session-id=x", "bokeh-token=x", "bokeh-token=x.y"))
    method = random_.choice(("GET", "GET", "GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS"))
    body = "x" * random_.choice((0, 10, 5000)) if method in ("POST", "PUT") else None
    request = HTTPRequest(
        f"{url}{path}?{asked}", method=method, body=body, request_timeout=60.0,
        follow_redirects=False, allow_nonstandard_methods=True,
    )  # fmt: skip
    answer = await AsyncHTTPClient().fetch(request, raise_error=False)
    return _judge(name, f"{method} {path}?{asked[:100]}", answer.code, answer.body or b"")


def _judge(name: str, what: str, code: int, body: bytes) -> list[str]:
    if code >= 500 and code not in (501, 503, 505, 599):
        return [f"{name}: {what}: answers {code}"]
    told = [word.decode() for word in _TELLTALES if word in body[:200_000]]
    if told and b"BokehJS" not in body[:2000] and not what.startswith("GET static/js"):
        return [f"{name}: {what}: tells {told}"]
    return []


_known: list[str] = []


def _addresses_once() -> list[str]:
    if not _known:
        _known.extend(_addresses())
    return _known


async def _raw(url: str, random_: random.Random, name: str) -> list[str]:
    """Bytes that are hardly HTTP."""
    good = "GET /?v=1 HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\nCookie: a=b\r\n\r\nabc"
    text = text_like(random_, [good, good.replace("GET", "POST"), good.replace("1.1", "1.0")])
    reader, writer = await asyncio.open_connection("localhost", urlparse(url).port)
    answer = b""
    try:
        writer.write(text.encode("utf-8", "surrogatepass") + b"\r\n\r\n")
        await writer.drain()
        answer = await asyncio.wait_for(reader.read(100_000), 2.0)
    except (TimeoutError, OSError):
        pass
    finally:
        writer.close()
    head = answer.split(b"\r\n", 1)[0].split(b" ")
    code = int(head[1]) if len(head) > 1 and head[1].isdigit() else 0
    return _judge(name, repr(text[:80]), code, answer)


class _Talker:
    """A stranger at the websocket, who comes again when the door is shut."""

    def __init__(self, url: str) -> None:
        self._url = url
        self._client: PageClient | None = None
        self.found: list[str] = []

    async def _there(self) -> PageClient:
        if self._client is None or self._client.closed:
            await self.close()
            client = PageClient(self._url)
            status = await client.open_page()
            if status != 200:
                raise RuntimeError(f"the page answers {status}")
            await client.connect()
            self._client = client
        return self._client

    async def _send(self, *frames: str | bytes) -> None:
        client = await self._there()
        with suppress(WebSocketClosedError, StreamClosedError):
            await client.send_frames(*frames)
        await asyncio.sleep(0.005)
        if client.errors:
            self.found.append(f"server: it tells {client.errors[:1]}")
            client.errors.clear()

    async def frames(self, random_: random.Random) -> None:
        """Frames with something wrong."""
        header = json.dumps(
            {
                "msgid": random_.choice(("a", 1, None, plain_text(random_))),
                "msgtype": random_.choice(_KINDS),
                "num_buffers": random_.choice((0, 0, 1, -1, 10**9, "x")),
            }
        )
        good = [header, "{}", json.dumps({"events": [_event(random_, {})]})]
        frames: list[str | bytes] = [text_like(random_, good) for _ in range(3)]
        if random_.random() < 0.5:
            frames = list(good)
            frames[random_.randrange(3)] = text_like(random_, good)
        if random_.random() < 0.2:
            frames.insert(random_.randrange(4), random_.randbytes(30))
        frames = [_sayable(frame) for frame in frames]
        if random_.random() < 0.05:
            at = random_.randrange(len(frames))
            frames[at] = str(frames[at]).encode()
        await self._send(*frames)

    async def patch(self, random_: random.Random) -> None:
        """A patch of the document: models that are there, and values that are not meant."""
        client = await self._there()
        events = [_event(random_, client.ids) for _ in range(random_.choice((1, 1, 2, 5)))]
        header = json.dumps({"msgid": "f", "msgtype": "PATCH-DOC"})
        await self._send(header, "{}", json.dumps({"events": events}))

    async def shape(self, random_: random.Random) -> None:
        """A message that is allowed to be as long as it is, and costs a parser much."""
        header = json.dumps({"msgid": "f", "msgtype": "PATCH-DOC", "num_buffers": 0})
        await self._send(header, "{}", _large(random_))

    async def close(self) -> None:
        """Leave."""
        if self._client is not None:
            await self._client.close()


def _large(random_: random.Random) -> str:
    """Megabytes of empty events, lists in lists, numbers without end."""
    count = random_.choice((100, 5_000, 400_000, 900_000))
    what = random_.choice(("[]", "{}", "1", '""', "null", '{"kind":"MessageSent"}', "1e999"))
    way = random_.randrange(5)
    if way == 0:
        return '{"events": [' + ",".join([what] * min(count, 3_500_000 // (len(what) + 1))) + "]}"
    if way == 1:
        return '{"events": ' + "[" * count + "]" * count + "}"
    if way == 2:
        return '{"events": ' + '{"a":' * (count // 3) + "1" + "}" * (count // 3) + "}"
    if way == 3:
        return '{"events": [' + random_.choice("19") * 3 * count + "]}"
    return (
        '{"events": ["'
        + random_.choice(("\\\\", '\\"', "[", ",", "\\u0000")) * (count // 2)
        + '"]}'
    )


def plain_text(random_: random.Random) -> str:
    """Some text of a value."""
    return str(plain_value(random_))[:200]


def _sayable(frame: str | bytes) -> str | bytes:
    return frame if isinstance(frame, bytes) else frame.encode("utf-8", "replace").decode()


def _event(random_: random.Random, ids: dict[str, str]) -> dict[str, Any]:
    kind = random_.choice(_EVENTS)
    name = random_.choice(
        (*ids.values(), f"p{random_.randrange(1000, 1500)}", "p1", plain_text(random_))
    )
    new = _notation(random_, plain_value(random_))
    if kind == "MessageSent" and random_.random() < 0.8:
        values = {"type": "map", "entries": [["model", {"id": name}], ["data", new]]}
        event = random_.choice(
            ("data_event", "data_event", "document_ready", "dom_event", "tap", "x")
        )
        return {
            "kind": kind,
            "msg_type": random_.choice(("bokeh_event", "bokeh_event", "x")),
            "msg_data": {"type": "event", "name": event, "values": values},
        }
    attribute = random_.choice(
        ("inner_width", "data", "visible", "code", "args", "tags", "children", "state", "text", "x")
    )
    if kind == "TitleChanged":
        return {"kind": kind, "title": new}
    if kind == "ColumnDataChanged":
        return {"kind": kind, "model": {"id": name}, "attr": "data", "data": new}
    return {"kind": kind, "model": {"id": name}, "attr": attribute, "new": new}


def _notation(random_: random.Random, value: Any) -> Any:
    """A value in Bokeh's notation, now and then with a model or an array in it."""
    if random_.random() < 0.15:
        return random_.choice(
            (
                {"type": "object", "name": "CustomJS", "id": "n1", "attributes": {"code": "x"}},
                {"type": "ndarray", "array": {"type": "bytes", "data": "AAAA"}, "dtype": "object"},
                {"type": "ndarray", "array": {"type": "bytes", "data": "AAAA"}, "shape": [10**9]},
                {"type": "bytes", "data": "!"},
                {"type": "symbol", "name": "x"},
                {"type": "slice", "start": 0},
                {"id": "p1001"},
            )
        )
    if isinstance(value, dict):
        return {"type": "map", "entries": [[k, _notation(random_, v)] for k, v in value.items()]}
    if isinstance(value, list):
        return [_notation(random_, item) for item in value]
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, str):
        return _sayable(value)
    return value if value == value else None
