"""A real server, a real browser and a record of what went wrong, for the browser tests."""

import itertools
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from urllib.error import URLError
from urllib.parse import urlparse
from urllib.request import urlopen

import pytest
from bearing_explorer.kit.serve.bokeh_internals import PLAIN
from playwright.sync_api import BrowserContext, Locator, Page, Playwright

CHROMIUM_OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
QUICK_ONLY = pytest.mark.skipif(
    PLAIN, reason="looks at what only private names of BokehJS do, which PLAIN leaves out"
)
ROOT = Path(__file__).resolve().parents[2]
PAGES = Path(__file__).parent / "pages"


def find_chromium() -> str | None:
    """The browser's program, if there is one."""
    return shutil.which("chromium") or shutil.which("chromium-browser")


def free_port() -> int:
    """A port that nobody listens on."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@dataclass
class Server:
    """A server in a process of its own, with what it printed."""

    command: Sequence[str]
    port: int
    path: str = "/"
    environment: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._log = tempfile.NamedTemporaryFile("w+b", suffix=".log")  # noqa: SIM115
        self.process = subprocess.Popen(
            self.command,
            stdout=self._log,
            stderr=subprocess.STDOUT,
            cwd=ROOT,
            env={**os.environ, **self.environment, "PYTHONUNBUFFERED": "1"},
            start_new_session=True,
        )

    @property
    def url(self) -> str:
        """Where the page is."""
        return f"http://localhost:{self.port}{self.path}"

    @property
    def log(self) -> str:
        """The lines that the server has printed so far."""
        return Path(self._log.name).read_text(encoding="utf-8", errors="replace")

    def wait(self, seconds: float = 300.0) -> None:
        """Wait until the page answers."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise RuntimeError(f"the server ended with {self.process.returncode}:\n{self.log}")
            try:
                with urlopen(self.url, timeout=60):
                    return
            except (URLError, OSError):
                time.sleep(0.1)
        raise TimeoutError(f"no page at {self.url} after {seconds} s:\n{self.log}")

    def stop(self, number: int = signal.SIGTERM) -> int:
        """Ask the server to end and return its exit code."""
        if self.process.poll() is None:
            self.process.send_signal(number)
            try:
                self.process.wait(60)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        return int(self.process.returncode)


def explorer_server(*options: str, environment: dict[str, str] | None = None) -> Server:
    """The explorer as a person starts it."""
    port = free_port()
    command = [
        sys.executable,
        "-m",
        "bearing_explorer",
        "--port",
        str(port),
        "--no-browser",
        *options,
    ]
    return Server(command, port, environment=environment or {})


def page_server(file: Path) -> Server:
    """The page of a file, under `panel serve`."""
    port = free_port()
    command = [sys.executable, "-m", "panel", "serve", str(file), "--port", str(port)]
    return Server(command, port, path=f"/{file.stem}")


@contextmanager
def serving(server: Server) -> Iterator[Server]:
    """The server, up for as long as the block lasts."""
    try:
        server.wait()
        yield server
    finally:
        server.stop()


@contextmanager
def chromium(
    playwright: Playwright, width: int = 1366, height: int = 768
) -> Iterator[BrowserContext]:
    """A new browser with nothing remembered, in which nothing moves by itself."""
    folder = tempfile.mkdtemp(prefix="chromium-")
    context = playwright.chromium.launch_persistent_context(
        folder,
        executable_path=find_chromium(),
        args=list(CHROMIUM_OPTIONS),
        viewport={"width": width, "height": height},
        reduced_motion="reduce",
    )
    try:
        yield context
    finally:
        context.close()
        shutil.rmtree(folder, ignore_errors=True)


@dataclass
class Watch:
    """Faults of a page: console errors, exceptions, requests that leave the server."""

    errors: list[str] = field(default_factory=list)
    strangers: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)
    frames_sent: int = 0

    def follow(self, page: Page) -> None:
        """Listen to `page` from now on."""
        page.on("console", lambda m: self._note(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda error: self._note(str(error)))
        page.on("request", lambda request: self._request(request.url))
        page.on("websocket", self._websocket)

    def assert_clean(self) -> None:
        """Nothing went wrong and nothing left the server."""
        assert not self.errors, "errors in the browser:\n" + "\n".join(self.errors)
        assert not self.strangers, "requests that left the server:\n" + "\n".join(self.strangers)

    def _note(self, text: str) -> None:
        self.errors.append(text)

    def _request(self, url: str) -> None:
        self.requests.append(url)
        parts = urlparse(url)
        if parts.scheme in ("http", "https", "ws", "wss") and parts.hostname not in (
            "localhost",
            "127.0.0.1",
        ):
            self.strangers.append(url)

    def _websocket(self, websocket: object) -> None:
        self._request(websocket.url)  # type: ignore[attr-defined]
        websocket.on("framesent", self._frame)  # type: ignore[attr-defined]

    def _frame(self, _: object) -> None:
        self.frames_sent += 1


def move(slider: Locator, *values: float) -> int:
    """Move a slider to one value after the other at once; how many changes the page sent then."""
    sent = slider.evaluate(
        """(slider, values) => {
          const before = window.__asked || 0
          for (const value of values) {
            slider.value = value
            slider.dispatchEvent(new Event("input"))
          }
          return (window.__asked || 0) - before
        }""",
        list(values),
    )
    return int(sent)


def drag(page: Page, slider: Locator, start: float, end: float, steps: int = 12) -> None:
    """Drag the thumb of a slider with the mouse; `start` and `end` are fractions of its track."""
    hand = holding(page, slider, start, end, steps)
    for _ in range(steps):
        next(hand)
    page.mouse.up()


def holding(
    page: Page, slider: Locator, start: float, end: float, steps: int = 12
) -> Iterator[None]:
    """Take the thumb of a slider and move it a step each time, there and back, never letting go."""
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    assert box is not None, "the slider is not on the page"
    y = box["y"] + box["height"] / 2
    # The thumb's middle stays half a thumb away from the ends of the track.
    thumb = 16.0
    x = [box["x"] + thumb / 2 + f * (box["width"] - thumb) for f in (start, end)]
    page.mouse.move(x[0], y)
    page.mouse.down()
    there = [*range(1, steps + 1)]
    for step in itertools.cycle(there + there[-2::-1]):
        page.mouse.move(x[0] + (x[1] - x[0]) * step / steps, y)
        yield


def unfold(page: Page) -> None:
    """Unfold the controls behind "All settings", where they are folded."""
    more = page.locator("aside .more[aria-expanded=false]")
    if more.is_visible():
        more.click()


def choose_tab(page: Page, name: str) -> None:
    """Ask for a tab or a part of one, as the screen offers it: in a list where it is narrow."""
    page.locator(".tabs select").wait_for(state="attached")
    narrow, part = page.get_by_role("combobox", name="Views"), page.locator(f".part-{name}")
    if narrow.is_visible():
        narrow.select_option(name)
    elif part.count():
        if not part.is_visible():  # parts are behind the tabs while theirs is open
            title = part.evaluate("part => part.parentElement.getAttribute('aria-label')")
            page.get_by_role("tab", name=title, exact=True).click()
        part.click()
    else:
        page.locator(f".tab-{name}").click()


def slug(text: str) -> str:
    """A name a file can have."""
    return re.sub(r"[^A-Za-z0-9]+", "-", text).strip("-")
