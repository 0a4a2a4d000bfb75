"""A balancer before several explorers: the one of the operators' page, or one of a few lines.

Whoever came first to an explorer comes to it again: a page and its websocket belong together, and
each process knows its own sessions only. What tells people apart is a cookie.
"""

from __future__ import annotations

import asyncio
import re
import shutil
import subprocess
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from urllib.error import HTTPError
from urllib.request import urlopen

from tests.browser.helpers import free_port
from tests.helpers.proxies import Relay, pipe

OPERATING = Path(__file__).resolve().parents[2] / "assets/docs/OPERATING.md"
COOKIE = "explorer"


def haproxy_text(port: int, ports: Sequence[int]) -> str:
    """The configuration of the operators' page, with these ports in place of its own."""
    block = re.search(r"(?ms)^    defaults\n.*?^(?=\S)", OPERATING.read_text(encoding="utf-8"))
    assert block is not None, "the operators' page has a configuration of haproxy"
    lines = [line[4:] for line in block[0].splitlines()]
    kept = [line for line in lines if not line.strip().startswith("server ")]
    text = re.sub(r"bind \S+", f"bind 127.0.0.1:{port}", "\n".join(kept).rstrip())
    for number, other in enumerate(ports):
        text += f"\n    server p{number} 127.0.0.1:{other} check cookie p{number}"
    return text + "\n"


@contextmanager
def balanced(
    ports: Sequence[int], *, port: int | None = None, haproxy: bool = True
) -> Iterator[int]:
    """A balancer before servers on `ports`; gives its own port."""
    own = free_port() if port is None else port
    program = shutil.which("haproxy") or shutil.which("haproxy", path="/usr/sbin")
    way = _haproxy(program, own, ports) if program and haproxy else _own(own, ports)
    with way:
        end = time.monotonic() + 60.0
        while time.monotonic() < end:
            with suppress(OSError, HTTPError), urlopen(f"http://127.0.0.1:{own}/liveness"):
                break
            time.sleep(0.1)
        yield own


@contextmanager
def _haproxy(program: str, port: int, ports: Sequence[int]) -> Iterator[None]:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "haproxy.cfg"
        file.write_text(haproxy_text(port, ports), encoding="utf-8")
        process = subprocess.Popen([program, "-f", str(file)], stderr=subprocess.DEVNULL)
        try:
            yield
        finally:
            process.terminate()
            process.wait(10)


@contextmanager
def _own(port: int, ports: Sequence[int]) -> Iterator[None]:
    """In a thread of this process."""
    loop, balancer = asyncio.new_event_loop(), Balancer(port, ports)
    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    asyncio.run_coroutine_threadsafe(balancer.start(), loop).result(10)
    try:
        yield
    finally:
        asyncio.run_coroutine_threadsafe(balancer.stop(), loop).result(10)
        loop.call_soon_threadsafe(loop.stop)
        thread.join(10)
        loop.close()


class Balancer(Relay):
    """Looks at the head of the first request of a connection and at that of its answer."""

    def __init__(self, port: int, ports: Sequence[int]) -> None:
        super().__init__(port)
        self._ports = list(ports)
        self.open = [0] * len(ports)

    async def relay(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """One connection, to the explorer that its cookie names, else to the emptiest."""
        head = await reader.readuntil(b"\r\n\r\n")
        known = re.search(rb"(?im)^cookie:.*\b%s=(\d+)" % COOKIE.encode(), head)
        place = int(known[1]) if known else -1
        if not 0 <= place < len(self._ports):
            known, place = None, self.open.index(min(self.open))
        self.open[place] += 1
        try:
            if b"upgrade: websocket" not in head.lower():
                head = re.sub(rb"(?im)^connection:.*\r\n", b"", head)
                head = head.replace(b"\r\n", b"\r\nConnection: close\r\n", 1)
            there, back = await asyncio.open_connection("127.0.0.1", self._ports[place])
            back.write(head)
            answer = await there.readuntil(b"\r\n\r\n")
            if known is None:
                cookie = f"\r\nSet-Cookie: {COOKIE}={place}; Path=/; HttpOnly\r\n"
                answer = answer.replace(b"\r\n", cookie.encode(), 1)
            writer.write(answer)
            await asyncio.gather(pipe(reader, back), pipe(there, writer))
        finally:
            self.open[place] -= 1
