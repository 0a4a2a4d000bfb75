"""Access, the messages a browser may send, what a connection may send, and what is sent back."""

import asyncio
import logging
import os
import time
from socket import IPPROTO_TCP, TCP_NODELAY
from types import SimpleNamespace
from typing import Any
from urllib.parse import urlsplit

import numpy as np
import panel as pn
import psutil
import pytest
from bearing_explorer.kit.serve.allowed_messages import (
    component_message,
    is_allowed,
    name_model_by_id,
)
from bearing_explorer.kit.serve.headers import policy
from bearing_explorer.kit.serve.hosts import AllowedHosts
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.serve.pages import SERVER_IS_FULL, message_page
from bearing_explorer.kit.serve.serving import Limits
from bearing_explorer.kit.serve.tornado_internals import LARGEST_HEADERS, MOST_UNFINISHED
from bearing_explorer.kit.serve.websocket import MOST_SOCKETS, LiveSocket
from bokeh.document import Document
from bokeh.model import util as model_util
from bokeh.models import CustomJS, Spacer
from tornado.httpclient import HTTPClientError
from tornado.websocket import websocket_connect

from tests.helpers.page_client import PageClient
from tests.helpers.served import SMALL, closed, get, origin, served, session_of, until


def test_every_answer_has_the_headers_and_no_more_than_it_needs() -> None:
    async def look(url: str, server: Any) -> None:
        missing = ("nothing/here", "autoload.js", "static/%00", "static/..%2f..%2fpyproject.toml")
        for path in ("", "liveness", "static/js/bokeh.min.js", *missing):
            answer = await get(url + path)
            headers = answer.headers
            assert headers["X-Content-Type-Options"] == "nosniff"
            assert headers["X-Frame-Options"] == "SAMEORIGIN"
            assert headers["Referrer-Policy"] == "same-origin"
            assert "camera=()" in headers["Permissions-Policy"]
            content = headers["Content-Security-Policy"]
            assert "default-src 'self'" in content
            assert "object-src 'none'" in content
            assert "Server" not in headers
            assert "Traceback" not in answer.body.decode("utf-8", "replace")
            assert answer.code in ((403, 404) if path in missing else (200,)), path
        assert b"no such page" in (await get(url + "metadata")).body
        before = len(session_of(server))
        assert (await get(url, method="HEAD")).code == 200
        assert len(session_of(server)) == before, "asking whether it is there makes no session"

    served(look)
    allowed = policy(("'self'", "https://lms.example.org"))
    assert allowed.endswith("frame-ancestors 'self' https://lms.example.org")
    assert "&lt;b&gt;" in message_page("<b>", "")


def test_names_of_sessions_cannot_be_made_up() -> None:
    async def forge(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        client.token = client.token[:-3] + ("AAA" if client.token[-3:] != "AAA" else "BBB")
        socket = await websocket_connect(
            url.replace("http", "ws") + "ws", subprotocols=["bokeh", client.token]
        )
        assert await socket.read_message() is None
        await client.open_page()

    served(forge)


LAB, OWN = "lab.example.org", "127.0.0.1:{port}"


@pytest.mark.parametrize(
    ("named", "host", "origin", "connects"),
    [
        ("", OWN, "http://" + OWN, True),
        ("", "localhost", "http://localhost:{port}", True),
        ("", "[::1]:{port}", "http://[::1]:{port}", True),
        ("", OWN, None, True),  # no browser
        ("", OWN, "https://localhost:{port}", False),
        ("", OWN, "http://localhost:1", False),
        ("", OWN, "null", False),
        ("", OWN, "", False),
        ("", "evil.example", "http://evil.example", False),
        ("", "evil.example:{port}", "http://evil.example:{port}", False),
        ("", "evil.example", "http://" + OWN, False),
        ("", "evil.example", None, False),
        ("", OWN, "http://evil.example", False),
        ("", OWN, "http://localhost:{port}@evil.example", False),
        ("", OWN, "http://localhost.evil.example:{port}", False),
        (LAB, OWN, "http://" + OWN, True),
        ("127.0.0.1:443", OWN, "https://127.0.0.1", True),
        (LAB, LAB, "https://" + LAB, True),
        (LAB, OWN, "https://" + LAB, True),  # a proxy that does not hand the name on
        (LAB, LAB, f"https://{LAB}:8443", False),
        (LAB, LAB, f"https://{LAB}.evil.example", False),
        (LAB, "evil.example", "https://" + LAB, False),
        ("https://" + LAB, LAB, "https://" + LAB, True),
        ("https://" + LAB, LAB, "http://" + LAB, False),
        (f"https://{LAB}:8443", LAB, f"https://{LAB}:8443", True),
        (f"{LAB}:443", LAB, "https://" + LAB, True),
    ],
)
@pytest.mark.parametrize("site", [None, "same-origin", "cross-site"])
def test_only_pages_of_allowed_hosts_connect(
    named: str, host: str, origin: str | None, connects: bool, site: str | None
) -> None:
    """Whatever a browser says of its site, and whether or not the names of both agree."""
    hosts = AllowedHosts(5006, "127.0.0.1", (named,) if named else ())
    names = {"Host": host, "Origin": origin, "Sec-Fetch-Site": site}
    headers = {name: text.format(port=5006) for name, text in names.items() if text is not None}
    request: Any = SimpleNamespace(host=headers["Host"], headers=headers)
    assert hosts.allow_socket(request) == connects


def test_strangers_get_neither_page_nor_websocket() -> None:
    """With the Tornado that is here, which may not ask about origins itself."""

    async def knock(url: str, server: Any) -> None:
        own = f"localhost:{server.port}"
        for host, comes_from in (
            ("evil.example", "http://evil.example"),
            (own, "http://evil.example"),
            (own, f"https://{own}"),
            (own, f"http://{own}"),
        ):
            names = {"Host": host, "Origin": comes_from}
            for site in ({}, {"Sec-Fetch-Site": "same-origin"}):
                client = PageClient(url)
                await client.open_page()
                if comes_from == f"http://{own}":
                    await client.open_socket(headers=names | site)
                    assert not client.closed
                    await client.close()
                    continue
                with pytest.raises(HTTPClientError, match="403"):
                    await client.open_socket(headers=names | site)
        before = len(session_of(server))
        stranger = await get(url, headers={"Host": "evil.example"})
        assert stranger.code == 403
        assert "--allow-websocket-origin" in stranger.body.decode()
        assert len(session_of(server)) == before
        assert (await get(url + "liveness", headers={"Host": "10.0.0.7:5006"})).code == 200

    served(knock, Limits(sessions=20, message=300_000, idle=3600.0))


NEW_MODEL = {"type": "object", "name": "CustomJS", "id": "x1", "attributes": {"code": "alert(1)"}}


def component_event(model: Any, data: Any) -> dict[str, Any]:
    """A message to a component, as BokehJS writes it."""
    values = {"type": "map", "entries": [["model", model], ["data", data]]}
    event = {"type": "event", "name": "data_event", "values": values}
    return {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}


def changed(attribute: str, new: Any, model: Any = "known") -> dict[str, Any]:
    return {"kind": "ModelChanged", "model": model, "attr": attribute, "new": new}


@pytest.mark.parametrize(
    "event",
    [
        {"kind": "TitleChanged", "title": "mine"},
        {"kind": "RootAdded", "model": NEW_MODEL},
        changed("tags", [NEW_MODEL]),
        changed("code", "alert(1)"),
        changed("width", 1, NEW_MODEL),
        changed("width", 1, {"id": "other"}),
        changed("css_classes", ["a"] * 50_000),
        changed("width", {"type": "ndarray"}),
        {"kind": "ColumnDataChanged", "model": {"id": "known"}, "attr": "data", "data": {}},
        {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": NEW_MODEL},
        "text",
        None,
    ],
)
def test_new_models_and_code_are_dropped(event: Any) -> None:
    document, known, script = Document(), Spacer(), CustomJS()
    for root in (known, script):
        document.add_root(root)
    if isinstance(event, dict) and event.get("model") == "known":
        event = event | {"model": {"id": known.id}}
    assert component_message(event, {}) is None
    assert not is_allowed(event, document.models)
    assert is_allowed(changed("width", 300, {"id": known.id}), document.models)
    assert not is_allowed(changed("code", "alert(1)", {"id": script.id}), document.models)


def test_only_choices_that_are_offered_are_taken() -> None:
    document = Document()
    plain = pn.widgets.Select(options={"one": "1", "two": "2"}).get_root(document)
    grouped = pn.widgets.Select(groups={"few": {"one": "1"}, "many": {"ten": "10"}}).get_root()
    boxes = pn.widgets.CheckBoxGroup(options=["a", "b"]).get_root()
    for root in (plain, grouped, boxes):
        document.add_root(root)

    def taken(model: Any, attribute: str, new: Any) -> bool:
        return is_allowed(changed(attribute, new, {"id": model.id}), document.models)

    assert taken(plain, "value", "2")
    assert taken(grouped, "value", "10")
    assert taken(boxes, "active", [0, 1])
    for wrong in ("3", "two", None, 1, ["1"], {"type": "map", "entries": []}):
        assert not taken(plain, "value", wrong)
        assert not taken(grouped, "value", wrong)
    for outside in ([2], [-1], [True], ["a"], "a", None):
        assert not taken(boxes, "active", outside)
    assert not taken(plain, "options", ["3"])
    assert not taken(boxes, "labels", [])


def test_a_button_that_is_written_out_is_taken_by_its_id() -> None:
    values = {"type": "map", "entries": [["model", NEW_MODEL]]}
    click = {"type": "event", "name": "button_click", "values": values}
    event = {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": click}
    assert not is_allowed(event, Document().models)
    assert is_allowed(name_model_by_id(event), Document().models)
    assert is_allowed(name_model_by_id(event | {"more": NEW_MODEL}), Document().models) is False


@pytest.mark.parametrize("model", [{"id": "p1"}, NEW_MODEL])
def test_a_message_reaches_a_component_by_its_id_alone(model: dict[str, Any]) -> None:
    """BokehJS writes a component out in full that came with a second tab."""
    data = {"type": "map", "entries": [["a", [1, {"type": "number", "value": "nan"}]]]}
    name, read = component_message(component_event(model, data), {})
    assert name == model["id"]
    assert str(read) == "{'a': [1, nan]}"
    piece = {"type": "bytes", "data": {"id": "b1"}}
    assert component_message(component_event(model, piece), {"b1": b"abc"}) == (name, b"abc")
    for wrong in (NEW_MODEL, {"type": "ndarray"}, [0] * 6000, piece):
        with pytest.raises(ValueError, match=r"plain|too much|form"):
            component_message(component_event(model, wrong), {})


def test_models_are_found_as_bokeh_finds_them() -> None:
    """The quick walk through a document sees what the slow one sees, but no mere defaults."""

    async def look(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.connect()
        assert await client.until_drawn()
        [session] = session_of(server)
        models = _slow_walk(session.document)
        assert {model.id for model in models} == set(session.document.models._models)
        assert len(models) > 150
        session.document.validate()

    served(look)


def _slow_walk(document: Any) -> set[Any]:
    quick = model_util.visit_immediate_value_references

    def visit(value: Any, visitor: Any) -> None:
        for name in {*value._property_values, *value._unstable_default_values}:
            model_util.visit_value_and_its_immediate_references(getattr(value, name), visitor)

    model_util.visit_immediate_value_references = visit
    try:
        return {model for root in document.roots for model in root.references()}
    finally:
        model_util.visit_immediate_value_references = quick


def test_those_who_come_too_late_are_asked_to_come_back() -> None:
    async def fill(url: str, server: Any) -> None:
        there = [PageClient(url) for _ in range(SMALL.sessions)]
        for client in there:
            assert await client.open_page() == 200
        late = await get(url)
        assert late.code == 503
        assert late.headers["Retry-After"] == "60"
        assert "room for 3 people" in late.body.decode()
        await there[0].open_socket(origin(url))
        assert not there[0].closed, "those who are in can connect"
        assert (await get(url + "?bokeh-session-id=mine")).code == 400
        assert (await get(url + "?v=" + "x" * 20_000)).code == 302

    served(fill)


def test_tokens_make_no_more_sessions_than_there_is_room_for() -> None:
    """A page's token outlives its session; one that is over is made anew."""

    async def fill(url: str, server: Any) -> None:
        people = [PageClient(url) for _ in range(4 * SMALL.sessions)]
        for client in people:
            assert await client.open_page() == 200
            for session in session_of(server):
                session.request_expiration()
            await until(lambda: not session_of(server))
        await asyncio.gather(*(client.open_socket(origin(url)) for client in people))
        assert len(session_of(server)) == SMALL.sessions
        there = [client for client in people if not client.closed]
        late = [client._socket for client in people if client.closed]
        assert len(there) == SMALL.sessions
        assert {socket.close_code for socket in late} == {1013}
        assert {socket.close_reason for socket in late} == {SERVER_IS_FULL.format(SMALL.sessions)}
        again = [PageClient(url) for _ in range(MOST_SOCKETS)]
        for client in again:
            client.token = there[0].token
        await asyncio.gather(*(client.open_socket(origin(url)) for client in again))
        assert [client.closed for client in again].count(True) == 1
        assert not there[0].closed

    served(fill)


BAD_FRAMES: tuple[tuple[str | bytes, ...], ...] = (
    ("no json", "{}", "{}"),
    ('{"msgid": "1", "msgtype": "PUSH-DOC"}', "{}", '{"doc": {}}'),
    (b"\x00\x01", "{}", "{}"),
    ("[" * 100_000, "{}", "{}"),
    ('{"msgid": "1", "msgtype": "PATCH-DOC"}', "{}", '"' + "x" * 290_000 + '"'),
    (
        *('{"msgid": "1", "msgtype": "PATCH-DOC", "num_buffers": 9}', "{}", '{"events": []}'),
        *('{"id": "a"}', b"x" * 200_000, '{"id": "b"}', b"x" * 200_000),
    ),
)


def test_bad_frames_end_the_connection_with_a_sentence(caplog: pytest.LogCaptureFixture) -> None:
    async def attack(url: str, server: Any) -> None:
        for frames in BAD_FRAMES:
            client = PageClient(url)
            await client.open_page()
            await client.open_socket(origin(url))
            await client.send_frames(*frames)
            await closed(client)
            assert client._socket is not None
            assert client._socket.close_code in (1002, 1008, 1009), frames
            assert not client.errors
        assert (await get(url)).code == 200, "others are not concerned"

    with caplog.at_level(logging.WARNING):
        served(attack, Limits(sessions=20, message=300_000, idle=3600.0))
    assert "Traceback" not in caplog.text


@pytest.mark.proof
def test_an_idle_page_is_disconnected_with_a_sentence() -> None:
    async def wait(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.connect()
        assert await client.until_drawn()
        for socket in LiveSocket.connected:
            stream = socket.ws_connection.stream.socket
            assert stream.getsockopt(IPPROTO_TCP, TCP_NODELAY), "a message is sent at once"
            socket.last_message_at -= 61.0  # a minute passes
        await closed(client)
        assert client._socket is not None
        assert "The page was not used for 1 min." in str(client._socket.close_reason)

    served(wait, Limits(idle=60.0))


async def connect(url: str) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    return await asyncio.open_connection("127.0.0.1", urlsplit(url).port)


async def answer(reader: asyncio.StreamReader) -> str:
    return (await asyncio.wait_for(reader.read(), 30.0)).decode()


@pytest.mark.parametrize("framing", ["Content-Length: 95000000", "Transfer-Encoding: chunked"])
def test_bodies_are_refused_at_once(framing: str) -> None:
    """Before they come: eight of 95 MB held 750 MB."""

    async def post(url: str, server: Any) -> None:
        reader, writer = await connect(url)
        writer.write(f"POST / HTTP/1.1\r\nHost: localhost\r\n{framing}\r\n\r\n".encode())
        if "chunked" in framing:
            writer.write(b"f0000\r\n" + b"a" * 0xF0000)
        try:
            said = await answer(reader)  # to its end: the connection is closed
        except ConnectionResetError:  # while the body was still under way
            said = ""
        assert "200" not in said.partition("\r\n")[0]
        writer.close()

    served(post)


def test_an_address_that_is_far_too_long_is_said_to_be() -> None:
    """Up to the most that headers may have; the page makes links of an eighth of that."""

    async def ask(url: str, server: Any) -> None:
        reader, writer = await connect(url)
        head = f"GET /?v=1&points={'A' * LARGEST_HEADERS} HTTP/1.1\r\nHost: localhost\r\n\r\n"
        writer.write(head.encode())
        assert await answer(reader) == "", "the line is cut"
        writer.close()
        shorter = await get(f"{url}?v=1&points={'A' * 40_000}", max_redirects=0)
        assert shorter.headers["Location"].endswith("v=too-long")

    served(ask)


def test_dripping_connections_hold_nobody_up() -> None:
    """A hundred send headers byte by byte; the server answers others, and keeps little of it."""

    async def drip(url: str, server: Any) -> None:
        before = psutil.Process(os.getpid()).memory_info().rss
        writers = []
        for _ in range(100):
            reader, writer = await connect(url)
            writer.write(b"GET / HTTP/1.1\r\nX-Long: " + b"a" * 50_000)
            writers.append((reader, writer))
        await asyncio.sleep(0.2)
        assert len(server._http._unfinished) <= MOST_UNFINISHED
        worked = []
        for _ in range(10):
            for _, writer in writers:
                if not writer.is_closing():
                    writer.write(b"a" * 100)
            began = time.thread_time()  # of this loop: a clock counts what neighbours take as well
            assert (await get(f"{url}liveness")).code == 200
            worked.append(time.thread_time() - began)
        assert sorted(worked)[5] < 0.3
        assert psutil.Process(os.getpid()).memory_info().rss - before < 50e6
        for _, writer in writers:
            writer.close()

    served(drip)


def packed_source() -> PackedSource:
    made = PackedSource()
    made.source("a", "x", "y")
    made.source("b", "z")
    made.range("r", 0, 1)
    return made


def test_the_packet_says_what_it_holds() -> None:
    packed = packed_source().pack(
        {"b": {"z": [1, np.nan]}, "a": {"y": [3], "x": [2]}}, {"r": (5, 6)}, 7, 0.25
    )
    head = [7, 0.25, 2, 1, 1, 1, 2, 0, 2, 1, 0, 5, 6]
    np.testing.assert_array_equal(packed, np.float32([*head, 1, np.nan, 2, 3]))
    assert packed.dtype == np.float32


def test_what_did_not_change_is_not_sent_again() -> None:
    made = packed_source()
    first = {"a": {"x": [1, np.nan], "y": [0, 0]}, "b": {"z": [1]}}
    made.pack(first, {"r": (0, 2)})
    np.testing.assert_array_equal(made.pack(first, {"r": (0, 2)}, 1), [1, 0, 0, 0])
    first["b"]["z"] = [2]
    np.testing.assert_array_equal(made.pack(first, {"r": (0, 2)}, 2), [2, 0, 1, 0, 1, 1, 1, 2])


@pytest.mark.parametrize(
    ("data", "ranges", "message"),
    [
        ({"c": {"x": [1]}}, {}, "'c' was not declared"),
        ({}, {"s": (0, 1)}, "'s' was not declared"),
        ({"a": {"x": [1]}}, {}, "'a' has columns"),
        ({"a": {"x": [1], "y": [1, 2]}}, {}, "differ in length"),
    ],
)
def test_what_the_browser_could_not_place_is_refused(data, ranges, message) -> None:
    with pytest.raises(ValueError, match=message):
        packed_source().pack(data, ranges)


def test_names_are_one_per_session() -> None:
    made = packed_source()
    with pytest.raises(ValueError, match="declared twice"):
        made.source("a", "x")
    with pytest.raises(ValueError, match="declared twice"):
        made.range("r", 0, 1)
    with pytest.raises(ValueError, match="no columns"):
        made.source("c")
