"""What a session leaves behind when it ends, and that nobody else notices."""

from __future__ import annotations

import asyncio
import gc
import threading
from functools import partial
from typing import Any

import panel as pn
import pytest
from bearing_explorer.results.executors import PICTURES
from bearing_explorer.serve import places, serving, taking_apart
from bearing_explorer.serve.bokeh_private import drop_session
from bearing_explorer.serve.connections import Connection
from bearing_explorer.serve.taking_apart import models_at_end, parts_of, take_apart
from bokeh.document import Document
from bokeh.models import Column, Div
from bokeh.protocol.receiver import Receiver
from bokeh.server.protocol_handler import ProtocolHandler
from panel.io import server as panel_server

from tests.helpers.loops import run
from tests.helpers.page_client import PageClient
from tests.helpers.served import served, session_of


@pytest.fixture(autouse=True)
def soon(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(taking_apart, "SETTLES", 0.2)
    monkeypatch.setattr(taking_apart, "LOOKS", 0.02)
    taking_apart._at_work.clear()  # of tests whose event loop is over


async def _opened(url: str, *tabs: str) -> PageClient:
    client = PageClient(url)
    await client.open_page()
    await client.connect()
    for tab in ("load", *tabs):
        await client.show(tab)
        while tab not in client.words.values():  # what it is made of is there
            await client.news(10.0)
        await client.ask(set={"extent_deg": 21.0})
        assert await client.until_drawn()
    return client


def _done(client: PageClient) -> list[str]:
    return [name for name, said in client.words.items() if " points after " in str(said)]


async def _map(client: PageClient, output: str = "") -> None:
    """Wait until a map of HoloViews is there, and whole; of another output where one is named."""
    if output:
        for name in _done(client):
            del client.words[name]
        await client.choose("Map of", output)
    while not _done(client):
        await client.news(10.0)


async def _end(server: Any, client: PageClient) -> None:
    await client.close()
    [context] = server._tornado._applications.values()
    while any(one.connection_count for one in context.sessions if one.token == client.token):
        await asyncio.sleep(0.01)
    for session in [one for one in session_of(server) if not one.connection_count]:
        await drop_session(context, session.id)
    while taking_apart._at_work:
        await asyncio.sleep(0.01)


@pytest.mark.parametrize("tab", ["stiffness", "explore"])
def test_a_session_that_ends_leaves_nearly_nothing_to_be_collected(tab: str) -> None:
    async def open_tabs(url: str) -> PageClient:
        client = await _opened(url, tab)
        if tab == "explore":
            await _map(client)
        return client

    async def come_and_go(url: str, server: Any) -> None:
        await _end(server, await open_tabs(url))  # what is made once a process
        gc.collect()
        gc.freeze()
        gc.disable()
        try:
            client = await open_tabs(url)
            gc.collect()  # what was garbage before
            had = len(gc.get_objects())
            await _end(server, client)
            del client
            left = gc.collect()
        finally:
            gc.enable()
            gc.unfreeze()
        assert had > 20_000
        assert left < 0.02 * had, f"{left} of {had} objects wait for a garbage collection"

    served(come_and_go)


def test_figures_that_are_replaced_leave_nearly_nothing_to_be_collected() -> None:
    async def look_at_maps(url: str, server: Any) -> None:
        client = await _opened(url, "explore")
        await _map(client)

        async def another(output: str) -> None:
            await _map(client, output)
            await asyncio.sleep(0.1)  # until it is on the page
            while taking_apart._at_work:
                await asyncio.sleep(0.01)

        await another("k_xx_mean")
        gc.collect()
        had = len(gc.get_objects())
        gc.disable()
        try:
            for output in ("k_yy_mean", "k_xx_mean", "k_yy_mean"):
                gc.collect()  # what is garbage as soon as it is made
                gc.freeze()
                await another(output)
            gc.collect()
            gc.unfreeze()
            left = gc.collect()
        finally:
            gc.enable()
        assert left < 6_000, f"{left} objects of three maps wait for a garbage collection"
        assert had > 100_000
        await client.ask(set={"extent_deg": 33.0})
        assert await client.until_drawn(), "what is on the page still works"
        assert not client.errors
        await _end(server, client)

    served(look_at_maps)


def test_connections_leave_nothing_to_be_collected() -> None:
    async def ask(url: str, server: Any) -> None:
        async def come_and_go(n: int) -> None:
            for _ in range(n):
                reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
                writer.write(b"GET /liveness HTTP/1.1\r\nHost: here\r\nConnection: close\r\n\r\n")
                await reader.read()
                writer.close()
                client = PageClient(url)  # that is cut off in the middle of a message
                await client.open_page()
                await client.open_socket()
                await client.send_frames('{"msgid": "1"}')
                await client.send_frames("{}")
                await client.close()
            await asyncio.sleep(0.1)
            while taking_apart._at_work:
                await asyncio.sleep(0.01)

        await come_and_go(1)
        gc.collect()
        gc.disable()
        gc.set_debug(gc.DEBUG_SAVEALL)
        try:
            await come_and_go(3)
            gc.collect()
            left = [one for one in gc.garbage if isinstance(one, Connection | Receiver)]
            left += [one for one in gc.garbage if isinstance(one, ProtocolHandler)]
        finally:
            gc.set_debug(0)
            gc.garbage.clear()
            gc.enable()
        assert not left

    served(ask)


def test_who_stays_is_not_taken_apart() -> None:
    async def one_goes(url: str, server: Any) -> None:
        stays, goes = await _opened(url), await _opened(url)
        await _end(server, goes)
        await stays.show("stiffness")
        await stays.ask(set={"extent_deg": 33.0})
        assert await stays.until_drawn()
        # a connection that breaks and comes again is none that has ended
        await stays.close()
        await stays.connect()
        await stays.ask(set={"extent_deg": 22.0})
        assert await stays.until_drawn()
        await stays.close()

    served(one_goes)


def test_sessions_end_one_after_the_other_and_those_in_use_stay(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    turns, ends = [0], []
    drop = places.drop_session

    async def noted(context: Any, name: str) -> None:
        ends.append(turns[0])
        await drop(context, name)

    async def count() -> None:
        while True:
            turns[0] += 1
            await asyncio.sleep(0.0)

    async def leave(url: str, server: Any) -> None:
        stays, *others = [PageClient(url) for _ in range(3)]
        for client in (stays, *others):
            await client.open_page()
        await stays.connect()
        monkeypatch.setattr(places, "LINGERS", -1.0)
        monkeypatch.setattr(places, "drop_session", noted)
        counting = asyncio.create_task(count())
        [context] = server._tornado._applications.values()
        await places.drop_ended(context)
        counting.cancel()
        assert len(session_of(server)) == 1
        first, second = ends
        assert second > first, "others had a turn between"
        await stays.close()

    served(leave)


def test_a_thread_that_is_at_work_still_has_all_it_works_with() -> None:
    go_on = threading.Event()

    async def end() -> None:
        shown = pn.Column("words")
        begun = threading.Event()

        def work() -> str:
            begun.set()
            assert go_on.wait(60.0)
            return str(shown[0].object)

        future = PICTURES.submit(work)
        assert begun.wait(60.0)
        take_apart([shown])
        await asyncio.sleep(3.0 * taking_apart.SETTLES)
        assert vars(shown), "not yet"
        go_on.set()
        assert await asyncio.wrap_future(future) == "words"
        while taking_apart._at_work:
            await asyncio.sleep(0.01)
        assert not vars(shown)

    run(end())


def test_parts_are_found_through_closures_and_lists_and_nothing_else_is() -> None:
    shared = {"scene": object()}
    words = pn.pane.Str("words")
    button = pn.widgets.Button()
    button.on_click(lambda _: words.object)
    model = Div(text="words")

    class Mine:
        def __init__(self) -> None:
            self.known = [partial(max, (model,))]
            self.shared = shared
            self.state = pn.state  # of the whole process

    mine = Mine()
    found = parts_of([mine, [button]], (Mine,))
    for part in (mine, button, words, model):
        assert any(one is part for one in found), part
    assert not any(one in (shared, pn.state) for one in found if type(one) is type(shared))
    assert not any(one is pn.state or one is pn.config for one in found)


def test_the_models_of_a_document_are_known_after_its_end() -> None:
    document = Document()
    document.add_root(Column(Div(text="one"), Div(text="two")))
    models = models_at_end(document)
    assert models == []
    document.models.destroy()
    assert {type(model) for model in models} == {Column, Div}
    assert len(models) == 3


def test_a_ping_may_find_out_first_that_a_connection_is_lost(
    caplog: pytest.LogCaptureFixture,
) -> None:
    async def lose(url: str, server: Any) -> None:
        client = await _opened(url)
        [socket] = serving.sockets
        server._tornado.client_lost(socket.connection)
        await client.close()
        while serving.sockets:
            await asyncio.sleep(0.01)

    served(lose)
    assert not any(record.exc_info for record in caplog.records)


def test_a_connection_that_is_gone_before_it_is_ready_keeps_no_session(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ready, tried = panel_server.WSHandler._async_open, []

    async def too_late(socket: Any, token: str) -> None:
        socket.on_close()
        await ready(socket, token)
        tried.append(socket)

    async def come(url: str, server: Any) -> None:
        client = PageClient(url)
        await client.open_page()
        await client.open_socket()
        await asyncio.sleep(0.0)
        [session] = session_of(server)
        while session.connection_count:
            await asyncio.sleep(0.01)
        await client.close()

    monkeypatch.setattr(panel_server.WSHandler, "_async_open", too_late)
    served(come)
    assert len(tried) == 1
