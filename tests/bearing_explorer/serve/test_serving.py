"""Who may come in, what a browser may say, and what it is told."""

from __future__ import annotations

import asyncio
import json
import logging
import re
import signal
import threading
import time
from pathlib import Path
from typing import Any

import pytest
from bearing_explorer.serve import serving
from bearing_explorer.serve.allowed_messages import by_name, welcome
from bearing_explorer.serve.headers import policy
from bearing_explorer.serve.limits import Limits
from bearing_explorer.serve.small_pages import message_page
from bokeh.model import util as model_util
from bokeh.protocol.messages.pull_doc_reply import pull_doc_reply
from tornado.httpclient import HTTPClientError
from tornado.websocket import websocket_connect

from tests.browser.helpers import explorer_server
from tests.browser.helpers import serving as server_up
from tests.helpers.loops import run
from tests.helpers.page_client import PageClient
from tests.helpers.proxies import Proxy
from tests.helpers.served import SMALL, closed, get, origin, served, session_of, wait_until


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


def test_another_site_may_show_the_page_where_the_operator_says_so() -> None:
    assert policy(("'self'", "https://lms.example.org")).endswith(
        "frame-ancestors 'self' https://lms.example.org"
    )


def test_until_there_is_a_page_words_stand_in_its_place() -> None:
    words = ["It is being compiled & made."]

    async def wait(url: str, server: Any) -> None:
        answer = await get(url + "?v=1")
        assert answer.code == 503
        assert answer.headers["Refresh"] == "1", "browsers ask again by themselves, the same"
        assert b"being compiled &amp; made" in answer.body
        assert (await get(url + "liveness")).code == 200
        assert not session_of(server)
        words[0] = ""
        assert (await get(url)).code == 200

    served(wait, not_yet=lambda: words[0])


def test_whoever_comes_too_late_is_asked_to_come_back() -> None:
    async def fill(url: str, server: Any) -> None:
        there = [PageClient(url) for _ in range(SMALL.sessions)]
        for client in there:
            assert await client.open_page() == 200
        for client in there[1:]:
            await client.open_socket(origin(url))
        late = await get(url)
        assert late.code == 503
        assert late.headers["Retry-After"] == "60"
        assert "room for 3 people" in late.body.decode()
        # those that are in stay in, and can connect
        await there[0].open_socket(origin(url))
        assert not there[0].closed
        # a name of one's own does not lead past the door
        assert (await get(url + "?bokeh-session-id=mine")).code in (400, 503)

    served(fill)


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
        with pytest.raises(HTTPClientError):
            await client.open_socket("http://another.example")

    served(forge)


NEW_MODEL = {"type": "object", "name": "CustomJS", "id": "x1", "attributes": {"code": "alert(1)"}}


@pytest.mark.parametrize(
    "event",
    [
        {"kind": "TitleChanged", "title": "mine"},
        {"kind": "RootAdded", "model": NEW_MODEL},
        {"kind": "RootRemoved", "model": {"id": "p1"}},
        {"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "tags", "new": [NEW_MODEL]},
        {"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "code", "new": "alert(1)"},
        {"kind": "ModelChanged", "model": NEW_MODEL, "attr": "width", "new": 1},
        {"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "x", "new": [0] * 50_000},
        {"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "x", "new": {"type": "ndarray"}},
        {"kind": "ColumnDataChanged", "model": {"id": "p1"}, "attr": "data", "data": {}},
        {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": NEW_MODEL},
        {
            "kind": "MessageSent",
            "msg_type": "bokeh_event",
            "msg_data": {"type": "event", "name": "data_event", "values": [NEW_MODEL]},
        },
        {"kind": "MessageSent", "msg_type": "other", "msg_data": {}},
        "text",
        None,
        {},
    ],
)
def test_what_the_page_never_says_is_dropped(event: Any) -> None:
    assert not welcome(event)


def test_what_the_page_says_passes() -> None:
    changed = {"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "inner_width", "new": 300}
    assert welcome(changed)
    values = {"type": "map", "entries": [["model", {"id": "p1"}], ["data", {"type": "map"}]]}
    message = {"type": "event", "name": "data_event", "values": values}
    assert welcome({"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": message})


@pytest.mark.parametrize("model", [{"id": "p1"}, NEW_MODEL])
def test_a_component_that_is_written_out_is_taken_by_its_id_alone(model: dict[str, Any]) -> None:
    """As BokehJS does with the first message of a component that came with a second tab."""
    values = {"type": "map", "entries": [["model", model], ["data", {"type": "map"}]]}
    message = {"type": "event", "name": "data_event", "values": values}
    event = by_name({"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": message})
    assert welcome(event)
    assert event["msg_data"]["values"]["entries"][0] == ["model", {"id": model["id"]}]
    assert event["msg_data"]["values"]["entries"][1] == values["entries"][1]


@pytest.mark.parametrize("event", ["text", None, {"msg_data": {"values": {"entries": [1, [2]]}}}])
def test_what_is_no_message_stays_what_it_is(event: Any) -> None:
    assert by_name(event) is event


def test_a_browser_can_change_no_more_than_its_own_scene(caplog: pytest.LogCaptureFixture) -> None:
    async def attack(url: str, server: Any) -> None:
        mine, other = PageClient(url), PageClient(url)
        for client in (mine, other):
            await client.open_page()
            await client.connect()
            assert await client.until_drawn()
        [document] = [
            s.document
            for s in session_of(server)
            if s.document.models.get_by_id(mine.ids["packet"])
        ]
        unpack = document.models.get_by_id(mine.ids["unpack"])
        code, count = unpack.code, len(document.models)
        for new in ("alert(1)", NEW_MODEL, [NEW_MODEL]):
            await mine.patch(
                {"kind": "ModelChanged", "model": {"id": unpack.id}, "attr": "code", "new": new},
                {"kind": "RootAdded", "model": NEW_MODEL},
                {"kind": "ModelChanged", "model": {"id": "p0"}, "attr": "x", "new": 1},
                {
                    "kind": "ModelChanged",
                    "model": {"id": other.ids["Controls"]},
                    "attr": "visible",
                    "new": False,
                },
            )
        # one's own controls hear one, another session's do not
        await mine.ask(set={"extent_deg": 33.0})
        assert await mine.until_drawn()
        mine.ids["Controls"] = other.ids["Controls"]
        await mine.ask(set={"extent_deg": 77.0})
        await asyncio.sleep(0.3)
        assert unpack.code == code
        assert len(document.models) == count
        assert not other.closed
        # as an angle: 77 alone may be milliseconds or digits of a residual
        assert [words for words in map(str, other.words.values()) if "77°" in words] == []
        assert other.drawn == 0

    with caplog.at_level(logging.WARNING):
        served(attack)
    assert "Traceback" not in caplog.text


@pytest.mark.parametrize(
    "frames",
    [
        ["no json", "{}", "{}"],
        ['{"msgid": "1", "msgtype": "PUSH-DOC"}', "{}", '{"doc": {}}'],
        ['{"msgid": "1", "msgtype": "UNKNOWN"}', "{}", "{}"],
        ['{"msgid": "1", "msgtype": "PATCH-DOC", "num_buffers": -3}', "{}", "[]", "{}"],
        [b"\x00\x01", "{}", "{}"],
        ["[" * 100_000, "{}", "{}"],
        ['{"msgid": "1", "msgtype": "PATCH-DOC"}', "{}", '"' + "x" * 290_000 + '"'],
        [
            *('{"msgid": "1", "msgtype": "PATCH-DOC", "num_buffers": 9}', "{}", '{"events": []}'),
            *('{"id": "a"}', b"x" * 200_000, '{"id": "b"}', b"x" * 200_000),
        ],
    ],
    ids=range(8),
)
def test_bad_frames_end_the_connection_with_a_sentence(
    frames: list[Any], caplog: pytest.LogCaptureFixture
) -> None:
    async def attack(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.open_socket(origin(url))
        await client.send_frames(*frames)
        await closed(client)
        assert client._socket is not None
        assert client._socket.close_code in (1002, 1008, 1009), client._socket.close_code
        assert not client.errors
        assert (await get(url)).code == 200, "others are not concerned"

    with caplog.at_level(logging.WARNING):
        served(attack)
    assert "Traceback" not in caplog.text
    assert len(caplog.text) < 3000, "and the log is not flooded"


def test_a_page_that_nobody_touches_is_closed_and_told_so() -> None:
    async def wait(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.connect()
        assert await client.until_drawn()
        for socket in serving.sockets:  # a minute passes
            socket._heard -= 61.0
        await closed(client)
        assert any("session is over" in str(words) for words in client.words.values())

    served(wait, Limits(idle=60.0))


@pytest.mark.proof
def test_a_flood_waits_and_others_do_not() -> None:
    async def flood(url: str, server: Any) -> None:
        loud, quiet = PageClient(url), PageClient(url)
        for client in (loud, quiet):
            await client.open_page()
            await client.connect()
            assert await client.until_drawn()
        for k in range(100):
            await loud.ask(set={"extent_deg": 10.0 + 0.1 * k})
        await quiet.ask(set={"extent_deg": 40.0})
        assert await quiet.until_drawn()
        assert loud.drawn < loud.mark, "the flood is not over yet"
        assert await loud.until_drawn(), "nothing is lost of what was sent too fast"

    served(flood, Limits(messages_a_second=25.0))


def test_long_work_of_some_does_not_keep_others_from_dragging() -> None:
    async def work(url: str, server: Any) -> None:
        busy, slow, quick = PageClient(url), PageClient(url), PageClient(url)
        for client in (busy, slow, quick):
            await client.open_page()
            await client.connect()
            assert await client.until_drawn()
        await busy.show("speed-run", "Run up")
        await busy.choose("Speeds", "193")
        await busy.press("Run up")
        await slow.show("vibration")
        for k in range(20):
            await slow.ask(set={"extent_deg": 10.0 + k})
            await quick.ask(set={"extent_deg": 20.0 + k})
            assert await quick.until_drawn()
        words = [str(said) for said in busy.words.values()]
        assert any(said.startswith("Computing") for said in words), "the job is not done yet"

    served(work)


def test_lines_of_the_log_name_session_scene_view_and_time(
    caplog: pytest.LogCaptureFixture,
) -> None:
    names: list[str] = []

    async def look(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.connect()
        assert await client.until_drawn()
        await client.ask(set={"extent_deg": 21.0})
        assert await client.until_drawn()
        names.extend(session.id for session in session_of(server))
        await client.close()
        end = time.monotonic() + 120.0
        while not any(r.getMessage().startswith("left ") for r in caplog.records):
            assert time.monotonic() < end
            await asyncio.sleep(0.01)

    with caplog.at_level(logging.INFO, "bearing_explorer"):
        served(look)
    lines = [r.getMessage() for r in caplog.records if r.name == "bearing_explorer"]
    updates = [
        re.fullmatch(r"update session=(\S{8}) scene=([0-9a-f]{8}) view=overview ms=[\d.]+", line)
        for line in lines
        if line.startswith("update")
    ]
    assert len(updates) >= 2
    assert all(found is not None and names[0].startswith(found[1]) for found in updates)
    assert updates[0][2] != updates[-1][2], "another scene has another name"  # type: ignore[index]
    assert any(line.startswith("came session=") for line in lines)
    assert any(line.startswith("left session=") for line in lines)


@pytest.mark.parametrize("strip", [False, True], ids=["path kept", "path stripped"])
def test_behind_a_proxy_under_a_path(strip: bool) -> None:
    async def through(url: str, server: Any) -> None:
        proxy = Proxy(server.port, "/bearing/", strip)
        await proxy.start()
        client = PageClient(f"http://127.0.0.1:{proxy.port}/bearing/")
        assert await client.open_page() == 200
        for path in set(
            re.findall(r'(?:src|href)="([^":]+\.(?:js|css)[^"]*)"', client.body.decode())
        ):
            assert not path.startswith("/"), f"{path} does not know where the page is"
            assert (await get(client.url + path)).code == 200, path
        assert (await get(client.url + "favicon.ico")).code == 200
        await client.connect()
        await client.ask(set={"extent_deg": 25.0})
        assert await client.until_drawn()
        await client.close()
        await proxy.stop()

    served(through, root_path="" if strip else "/bearing")


@pytest.mark.proof
def test_two_processes_share_the_port_and_end_together() -> None:
    async def many(url: str) -> None:
        people = [PageClient(url) for _ in range(6)]

        async def come(client: PageClient) -> None:
            assert await client.open_page() == 200
            await client.connect()
            await client.ask(set={"extent_deg": 30.0})
            assert await client.until_drawn()

        await asyncio.gather(*(come(client) for client in people))
        for client in people:
            await client.close()

    with server_up(explorer_server("--num-procs", "2", "--log-level", "info")) as server:
        tasks = Path(f"/proc/{server.process.pid}/task/{server.process.pid}/children")
        children = [int(pid) for pid in tasks.read_text().split()]
        run(many(server.url))
        assert server.stop(signal.SIGTERM) in (0, 143)
        log = server.log
    assert len(children) >= 2, log
    assert "Traceback" not in log
    assert len(re.findall(r"^\S+ \S+ INFO came ", log, re.M)) >= 6
    for child in children:
        wait_until(lambda child=child: not Path(f"/proc/{child}").exists())


def test_models_are_found_as_bokeh_finds_them() -> None:
    """The quick walk through a document sees what the slow one sees."""

    async def look(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.connect()
        assert await client.until_drawn()
        [session] = session_of(server)
        found = _slow_walk(session.document)
        assert {model.id for model in found} == set(session.document.models._models)
        assert len(found) > 200
        session.document.validate()

    served(look)


def test_the_document_is_written_beside_the_event_loop(monkeypatch: pytest.MonkeyPatch) -> None:
    """With all tabs in it that takes a second, in which nobody else would be heard."""
    writers: list[str] = []
    written = pull_doc_reply.create.__func__

    def create(cls: Any, *given: Any, **named: Any) -> Any:
        writers.append(threading.current_thread().name)
        return written(cls, *given, **named)

    monkeypatch.setattr(pull_doc_reply, "create", classmethod(create))

    async def look(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.connect()
        assert await client.until_drawn()

    served(look)
    assert [name.partition("_")[0] for name in writers] == ["document"]


def _slow_walk(document: Any) -> set[Any]:
    quick = model_util.visit_immediate_value_references

    def visit(value: Any, visitor: Any) -> None:
        for name in value.properties_with_refs():
            model_util.visit_value_and_its_immediate_references(getattr(value, name), visitor)

    model_util.visit_immediate_value_references = visit
    try:
        return {model for root in document.roots for model in root.references()}
    finally:
        model_util.visit_immediate_value_references = quick


def test_messages_are_plain(tmp_path: Path) -> None:
    page_text = message_page("<b>", "a & b")
    assert "&lt;b&gt;" in page_text
    assert "a &amp; b" in page_text
    assert json.dumps(page_text)
