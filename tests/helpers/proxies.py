"""A reverse proxy of a few lines, as operators have one in front of the explorer."""

import asyncio
import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager


class Proxy:
    """Hands on all below `under` from one port to another."""

    def __init__(self, port: int, under: str, to: int) -> None:
        self.port, self._under, self._to = port, under, to
        self._server: asyncio.Server | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    async def start(self) -> None:
        """Listen on the port."""
        self._server = await asyncio.start_server(self._serve, "127.0.0.1", self.port)

    async def stop(self) -> None:
        """Listen no more, and end what is open."""
        assert self._server is not None
        self._server.close()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        self._tasks.add(task)
        try:
            await self._relay(reader, writer)
        except (OSError, asyncio.IncompleteReadError, asyncio.CancelledError):
            pass
        finally:
            self._tasks.discard(task)
            writer.close()

    async def _relay(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """One connection of a browser."""
        head = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1")
        method, path, version = head.split("\r\n", 1)[0].split(" ")
        if not path.startswith(self._under):
            writer.write(b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n")
            return
        rest = head.split("\r\n", 1)[1]
        if "upgrade: websocket" not in head.lower():
            rest = re.sub(r"(?im)^connection:.*\r\n", "", rest)
            rest = "Connection: close\r\n" + rest
        there, back = await asyncio.open_connection("127.0.0.1", self._to)
        back.write(f"{method} {path} {version}\r\n{rest}".encode("latin-1"))
        await asyncio.gather(pipe(reader, back), pipe(there, writer))


@contextmanager
def running(proxy: Proxy) -> Iterator[None]:
    """A proxy in a thread of this process."""
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    asyncio.run_coroutine_threadsafe(proxy.start(), loop).result(10)
    try:
        yield
    finally:
        asyncio.run_coroutine_threadsafe(proxy.stop(), loop).result(10)
        loop.call_soon_threadsafe(loop.stop)
        thread.join(10)


async def pipe(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    """Hand on what is read until there is no more."""
    try:
        while data := await reader.read(65536):
            writer.write(data)
            await writer.drain()
    except OSError:
        pass
    finally:
        writer.close()
