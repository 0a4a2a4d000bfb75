"""What jammed the server once: half requests, huge messages, pages that nobody connects to."""

from __future__ import annotations

import asyncio
import json
import logging
import sys
import time
from contextlib import suppress
from typing import Any
from urllib.request import urlopen

import pytest
from bearing_explorer.serve import connections, limits, places, serving
from bearing_explorer.serve.limits import Limits
from bearing_explorer.serve.log import OneLine, Seldom, meant_so
from bearing_explorer.serve.long_addresses import LONGEST_HEADER, send_on
from bearing_explorer.serve.message_cost import too_much, weight
from bearing_explorer.serve.turns import Turns
from panel.io import server as panel_server

from tests.browser.helpers import Server, free_port
from tests.browser.helpers import serving as server_up
from tests.helpers.loops import run
from tests.helpers.page_client import PageClient
from tests.helpers.served import get, origin, served, session_of

HALF = b"GET / HTTP/1.1\r\nHost: x\r\n"


async def half_requests(port: int, count: int) -> list[asyncio.StreamWriter]:
    """Connections that never finish their request."""
    writers = []
    for _ in range(count):
        _, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(HALF)
        writers.append(writer)
    return writers


def test_half_requests_make_room_for_whole_ones(caplog: pytest.LogCaptureFixture) -> None:
    async def hold(url: str, server: Any) -> None:
        server._http.most = 24
        there = PageClient(url)
        await there.open_page()
        await there.open_socket(origin(url))
        writers = await half_requests(server.port, 60)
        for _ in range(5):
            assert (await get(url + "liveness")).code == 200
        assert server._http.connections <= 24
        assert not there.closed, "who is connected stays so"
        for writer in writers:
            writer.close()

    with caplog.at_level(logging.WARNING):
        served(hold)
    assert "Traceback" not in caplog.text


def test_a_request_that_does_not_come_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "ASKING", 0.3)

    async def hold(url: str, server: Any) -> None:
        readers = []
        for begun in (b"", HALF, b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\nabc"):
            reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
            writer.write(begun)
            readers.append(reader)
        for reader in readers:
            assert await asyncio.wait_for(reader.read(), 5.0) == b""
        assert server._http.connections == 0

    served(hold)


def test_accepting_goes_on_after_the_system_refused(caplog: pytest.LogCaptureFixture) -> None:
    class Refusing:
        """A listening socket of a process without a file descriptor left."""

        def __init__(self, listening: Any) -> None:
            self._listening = listening
            self.asked = 0

        def __getattr__(self, name: str) -> Any:
            return getattr(self._listening, name)

        def accept(self) -> Any:
            self.asked += 1
            if self.asked <= 2:
                raise OSError(24, "Too many open files")
            return self._listening.accept()

    async def hold(url: str, server: Any) -> None:
        [(number, listening)] = server._http._sockets.items()
        server._http._handlers.pop(number)()
        refusing = Refusing(listening)
        server._http._listen(refusing)
        assert (await get(url + "liveness")).code == 200
        assert refusing.asked < 10, "it is not tried over and over"

    with caplog.at_level(logging.WARNING):
        served(hold)
    assert "not-accepting" in caplog.text
    assert "Traceback" not in caplog.text


def test_a_head_without_end_costs_little_and_is_cut(caplog: pytest.LogCaptureFixture) -> None:
    async def drip(url: str, server: Any) -> None:
        send_on(server)
        # what came is not searched again with each byte, and not kept
        reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
        writer.write(b"GET /?" + b"a" * 2_000_000)
        for _ in range(50):
            writer.write(b"a")
            await writer.drain()
            await asyncio.sleep(0.001)
        [stream] = server._http._open
        assert len(stream._read_buffer) < 100_000
        writer.write(b" HTTP/1.1\r\nHost: x\r\n\r\n")
        answer = await asyncio.wait_for(reader.read(4000), 5.0)
        assert answer.startswith(b"HTTP/1.1 302")
        assert b"too-long" in answer
        writer.close()
        for endless in (b"GET /?" + b"a" * 4_000_000, HALF + b"a: b\r\n" * 100_000):
            reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
            with suppress(ConnectionError):
                writer.write(endless)
                await writer.drain()
                assert await asyncio.wait_for(reader.read(), 5.0) == b""
            writer.close()
        assert (await get(url + "liveness")).code == 200

    served(drip, longest_header=LONGEST_HEADER)


# Messages


def deep(levels: int) -> str:
    return "[" * levels + "]" * levels


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ('{"events": [' + ",".join(["[]"] * 400_000) + "]}", "too many values"),
        ('{"events": [' + ",".join(["{}"] * 400_000) + "]}", "too many values"),
        ("[" + "1," * 400_000 + "1]", "too many values"),
        ("[" + '"",' * 400_000 + "1]", "too many texts"),
        (deep(33), "too deep"),
        (deep(400_000), "too many values"),
        ('["' + '\\"' * 30_000 + '"' + ",[]" * 6000 + "]", "too many"),
    ],
    ids=range(7),
)
def test_what_would_cost_much_to_parse_is_seen_before(text: str, why: str) -> None:
    assert why in str(too_much(text, 5000, 32))


@pytest.mark.parametrize(
    "text",
    [
        "{}",
        json.dumps({"set": {f"field {k}": k for k in range(100)}}),
        # what people wrote: commas, brackets and quotes in a text are none of JSON's
        json.dumps({"floor": "1.25,30\n" * 100_000}),
        json.dumps({"file": {"name": "a.toml", "text": '[[defect]]\nname = "x"\n' * 400}}),
        deep(32),
        '["' + "[" * 100_000 + '"]',
    ],
    ids=range(6),
)
def test_what_a_page_sends_is_not_too_much(text: str) -> None:
    assert too_much(text, 5000, 32) is None


def test_large_messages_count_as_several() -> None:
    assert weight(100, "{}") == 1.0
    assert weight(2**20, "") == pytest.approx(10.5, abs=0.1)
    assert weight(9000, "[" + "1," * 3000 + "1]") > 25.0


@pytest.mark.parametrize("what", ["[]", "{}", '{"kind":"TitleChanged","title":"a"}'])
def test_five_million_of_something_are_never_parsed(
    what: str, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """15 MB of it were ten seconds of silence and a gigabyte, and the sender stayed."""
    consumed: list[int] = []

    async def attack(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.open_socket(origin(url))
        [socket] = serving.sockets
        consume = socket.receiver.consume

        async def watched(fragment: Any) -> Any:
            consumed.append(len(fragment))
            return await consume(fragment)

        monkeypatch.setattr(socket.receiver, "consume", watched)
        text = '{"events": [' + ",".join([what] * (3_500_000 // (len(what) + 1))) + "]}"
        await client.send_frames(json.dumps({"msgid": "a", "msgtype": "PATCH-DOC"}), "{}", text)
        for _ in range(100):
            if client.closed:
                break
            await client.news(0.1)
        assert client.closed
        assert client._socket is not None
        assert client._socket.close_code == 1008
        assert max(consumed) < 100

    with caplog.at_level(logging.WARNING):
        served(attack, Limits())
    assert "Traceback" not in caplog.text


def test_what_comes_after_the_end_is_not_heard() -> None:
    async def attack(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.open_socket(origin(url))
        [socket] = serving.sockets
        heard: list[Any] = []
        socket.receiver.consume = lambda fragment: heard.append(fragment)
        with suppress(Exception):
            await client.send_frames(deep(100), *['{"msgid": "a"}'] * 50)
        while not client.closed:
            await client.news(0.1)
        assert not heard

    served(attack)


def test_buffers_without_end_are_cut() -> None:
    async def attack(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.open_socket(origin(url))
        header = json.dumps({"msgid": "a", "msgtype": "PATCH-DOC", "num_buffers": 10**9})
        with suppress(Exception):
            await client.send_frames(header, "{}", '{"events": []}', *['{"id": "a"}', b""] * 30)
        while not client.closed:
            await client.news(0.1)
        assert client._socket is not None
        assert client._socket.close_code == 1009

    served(attack)


# Places


def test_pages_that_never_connect_take_no_places_of_others() -> None:
    async def ask(url: str, server: Any) -> None:
        for _ in range(9):
            assert (await get(url)).code == 200, "places belong to those who connect"
        assert len(session_of(server)) <= 5, "and nobody's pages fill the memory"
        people = [PageClient(url) for _ in range(3)]
        for client in people:
            assert await client.open_page() == 200
            await client.open_socket(origin(url))
        assert places.connected() == 3
        assert (await get(url)).code == 503, "a quarter of the places is for pages of this address"

    served(ask, Limits(sessions=4, unclaimed=4))


def test_a_session_that_is_connected_to_again_has_one_place() -> None:
    async def twice(url: str, server: Any) -> None:
        client, again = PageClient(url), PageClient(url)
        await client.open_page()
        await client.open_socket(origin(url))
        again.token = client.token
        await again.open_socket(origin(url))
        while not client.closed:
            await client.news(0.1)
        assert not again.closed
        assert places.connected() == 1

    served(twice)


def test_who_leaves_while_being_let_in_takes_no_place(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """It was counted for ever, and whoever came next was not let in."""
    begun, go_on = asyncio.Event(), asyncio.Event()
    let_in = panel_server.WSHandler._async_open

    async def slowly(self: Any, token: str) -> None:
        await let_in(self, token)
        begun.set()
        await go_on.wait()

    async def leave(url: str, server: Any) -> None:
        monkeypatch.setattr(panel_server.WSHandler, "_async_open", slowly)
        client, other = PageClient(url), PageClient(url)
        await client.open_page()
        opening = asyncio.create_task(client.open_socket(origin(url)))
        await begun.wait()
        opening.cancel()
        await client.close()
        monkeypatch.undo()
        await asyncio.sleep(0.1)
        go_on.set()
        await asyncio.sleep(0.1)
        assert places.connected() == 0
        assert not serving.sockets
        await other.open_page()
        await other.open_socket(origin(url))
        assert not other.closed
        assert places.connected() == 1

    with caplog.at_level(logging.WARNING):
        served(leave)
    assert not any(record.exc_info for record in caplog.records)


def test_a_session_cannot_be_named_in_a_header() -> None:
    async def name(url: str, server: Any) -> None:
        assert (await get(url, headers={"Bokeh-Session-Id": "mine"})).code == 400
        assert not session_of(server)

    served(name)


def test_addresses_take_turns() -> None:
    async def line() -> list[str]:
        turns, done = Turns(pause=0.0), []

        async def come(key: str, name: str) -> None:
            async with turns.turn(key):
                done.append(name)
                await asyncio.sleep(0)

        tasks = [asyncio.create_task(come("a", f"a{k}")) for k in range(4)]
        await asyncio.sleep(0)
        tasks += [asyncio.create_task(come("b", f"b{k}")) for k in range(2)]
        await asyncio.sleep(0)
        tasks[2].cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        return done

    assert run(line()) == ["a0", "a1", "b0", "a3", "b1"]


def test_no_more_people_than_the_system_has_connections(caplog: pytest.LogCaptureFixture) -> None:
    limits.use(Limits(sessions=100))
    with caplog.at_level(logging.WARNING):
        serving._fit(84)
    assert limits.current().sessions == 60
    assert "few-descriptors connections=84 sessions=60" in caplog.text
    limits.use(Limits())


# What is said


def test_a_broken_origin_is_answered_with_a_sentence(caplog: pytest.LogCaptureFixture) -> None:
    async def ask(url: str, server: Any) -> None:
        for named in ("http://[x", "http://[::1", "//["):
            answer = await get(
                url + "ws",
                headers={
                    "Origin": named,
                    "Upgrade": "websocket",
                    "Connection": "Upgrade",
                    "Sec-WebSocket-Version": "13",
                    "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
                },
            )
            assert answer.code == 403
            assert b"must be opened from this server" in answer.body

    with caplog.at_level(logging.WARNING):
        served(ask)
    assert "Traceback" not in caplog.text
    assert "its Origin is no address" in caplog.text


def record(words: str, line: int = 1, level: int = logging.WARNING) -> logging.LogRecord:
    return logging.LogRecord("tornado", level, "file.py", line, words, (), None)


def test_trouble_of_one_kind_is_written_once_a_second() -> None:
    now = [0.0]
    seldom = Seldom(now=lambda: now[0])
    assert seldom.filter(record("first"))
    assert not any(seldom.filter(record("again")) for _ in range(1000))
    assert seldom.filter(record("another place", line=2))
    assert all(seldom.filter(record("an update", level=logging.INFO)) for _ in range(5))
    now[0] = 1.1
    late = record("late")
    assert seldom.filter(late)
    assert late.getMessage() == "late (1000 more like it)"


@pytest.mark.parametrize(("status", "written"), [(503, False), (500, True), (404, True)])
def test_whoever_is_asked_to_come_back_is_no_trouble(status: int, written: bool) -> None:
    words = (status, "GET / (127.0.0.1)", 0.4)
    line = logging.LogRecord(
        "tornado.access", logging.ERROR, "web.py", 1, "%d %s %.2fms", words, None
    )
    assert meant_so(line) is written


def test_what_strangers_send_stays_on_its_line() -> None:
    line = OneLine("%(levelname)s %(message)s").format(
        record("a\nERROR b\x1b[2J\u202e" + "c" * 5000)
    )
    assert line.startswith("WARNING a\\nERROR b\\x1b[2J\\u202ecc")
    assert len(line) < 1100


@pytest.mark.proof
@pytest.mark.skipif(sys.platform == "win32", reason="there is no such limit")
def test_a_process_with_few_file_descriptors_goes_on_answering() -> None:
    port = free_port()
    start = f"ulimit -n 256; exec {sys.executable} -m bearing_explorer --port {port} --no-browser"
    server = Server(["sh", "-c", start], port, path="/liveness")

    async def hold() -> None:
        with suppress(OSError):
            writers = await half_requests(port, 300)
        for _ in range(20):
            with await asyncio.to_thread(urlopen, server.url, timeout=5) as answer:
                assert answer.status == 200
            await asyncio.sleep(0.1)
        for writer in writers:
            writer.close()

    with server_up(server):
        began = time.monotonic()
        run(hold())
        lines = server.log.splitlines()
        assert len(lines) < 12 + 3 * (time.monotonic() - began), "one line a second of each kind"
        assert "Traceback" not in server.log
