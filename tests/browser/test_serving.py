"""The page in a real browser behind a proxy, and what a browser shows when there is no room."""

import asyncio
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import BrowserContext, Page, expect

from tests.browser.explorer_page import can_be_used, wait
from tests.browser.helpers import (
    ROOT,
    Server,
    Watch,
    choose_tab,
    drag,
    explorer_server,
    free_port,
    page_server,
    serving,
)


@contextmanager
def forwarding(port: int, to: int) -> Iterator[None]:
    """Hand on what comes at one port to another, as a proxy does that changes no path."""

    async def pipe(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while data := await reader.read(65536):
            writer.write(data)
        writer.close()

    async def relay(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        there, back = await asyncio.open_connection("127.0.0.1", to)
        await asyncio.gather(pipe(reader, back), pipe(there, writer), return_exceptions=True)

    loop = asyncio.new_event_loop()  # the browser's runs in this thread
    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    server = asyncio.start_server(relay, "127.0.0.1", port)
    asyncio.run_coroutine_threadsafe(server, loop).result(10)
    try:
        yield
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join(10)


@pytest.mark.proof
def test_the_page_works_behind_a_proxy_and_says_when_it_is_full(
    watch: tuple[Page, Watch],
) -> None:
    page, watching = watch
    missing: list[str] = []
    page.on("response", lambda answer: missing.append(answer.url) if answer.status == 404 else None)
    port = free_port()
    server = explorer_server(
        *("--root-path", "/bearing", "--max-sessions", "2"),
        *("--allow-websocket-origin", f"localhost:{port}"),
    )
    server.path = "/bearing/liveness"  # waiting for the page itself would take a place
    url = f"http://localhost:{port}/bearing/"
    with serving(server), forwarding(port, server.port):
        wait(page, lambda: "Ready after" in server.log)
        answer = page.goto(url)
        assert answer is not None
        assert "unsafe-eval" in answer.headers["content-security-policy"]
        can_be_used(page)
        drag(page, page.locator("#control-extent_deg"), 0.2, 0.6)
        page.wait_for_function("window.__asked > 0 && window.__mark === window.__asked")
        page.locator(".tab-stiffness").click()
        expect(page.locator(".view-stiffness canvas").first).to_be_visible()
        outside = [
            url for url in watching.requests if "/bearing/" not in url and "blob:" not in url
        ]
        assert missing == []
        assert not outside, f"asked for beside the path of the proxy: {outside}"

        second = page.context.new_page()
        second.goto(url)
        second.wait_for_function("window.__mark !== undefined")
        third = page.context.new_page()
        answer = third.goto(url)
        assert answer is not None
        assert answer.status == 503
        expect(third.get_by_role("heading")).to_have_text("The server is full")
        expect(third.locator("p").first).to_contain_text("Try again in a minute")
        second.close()
        third.close()
        assert server.stop(signal.SIGINT) == 0, server.log
        for words in ("Loading the page", "Ready after", str(server.port), "Stopped."):
            assert words in server.log
        assert "Traceback" not in server.log


@pytest.mark.proof
def test_panel_serve_shows_the_page_too(page: Page) -> None:
    with serving(page_server(ROOT / "app" / "app.py")) as server:
        page.goto(server.url)
        can_be_used(page)
        drag(page, page.locator("#control-extent_deg"), 0.2, 0.6)
        page.wait_for_function("window.__asked > 0 && window.__mark === window.__asked")
        choose_tab(page, "stiffness")
        expect(page.locator(".view-stiffness canvas").first).to_be_visible()
        page.locator(".control-fy_n .number").fill("150")
        page.locator(".control-fy_n .number").press("Enter")
        page.wait_for_function("window.__mark === window.__asked")
        expect(page.locator(".view-stiffness [role=status]").first).not_to_be_empty()


@pytest.mark.parametrize(
    ("code", "reason", "words"),
    [
        (1013, "The server is full.", "The server is full. Reload the page in a minute."),
        (4000, "", "The connection to the server is lost. Reload the page to go on."),
    ],
)
def test_a_connection_that_is_over_is_told_on_the_page(
    explorer: Server, browser: BrowserContext, code: int, reason: str, words: str
) -> None:
    """Too late for a place, cut off, or lost: Bokeh tells the console alone."""
    page = browser.new_page()
    page.route_web_socket("**/ws", lambda route: route.close(code=code, reason=reason))
    page.goto(explorer.url)
    line = page.get_by_role("alert")
    expect(line).to_contain_text(words)
    box = line.bounding_box()
    assert box is not None
    assert box["y"] + box["height"] <= page.viewport_size["height"] + 1  # type: ignore[index]
    page.close()
