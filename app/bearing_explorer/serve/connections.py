"""Open connections: how many there may be, and how long one may do nothing.

A process has so many file descriptors. Where all of them are held by connections that never
finish their request, nobody else comes in, and accepting fails over and over. So there are fewer
connections than descriptors; whoever is not done asking makes room for whoever comes, first at
the address that has most of them; and what does nothing for long is closed.
"""

from __future__ import annotations

import logging
import os
import socket
import time
from collections import Counter
from collections.abc import Awaitable
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.iostream import IOStream, UnsatisfiableReadError

from bearing_explorer.serve import log as write
from bearing_explorer.serve.long_addresses import LONGEST, LONGEST_HEADER

ASKING = 15.0
"""[s] for a request to arrive, and for the next one on a connection that is kept."""
STUCK = 30.0
"""[s] in which somebody who is sent something takes none of it."""
SPARE = 64
"""File descriptors that are kept for all but connections."""
MOST = 4096
"""Connections of a process, where the system allows that many."""
LARGEST_HEADERS = 65_536
"""[bytes] of a request but its address: a session's token is among them."""
LONGEST_ADDRESS = LONGEST + 1000
"""[bytes] that are kept of the first line of a request."""
_PAUSE = 0.5  # [s] in which none is accepted, when the system refused
_BACKLOG = 128  # as Tornado has it

log = logging.getLogger(__name__)


def most_connections() -> int:
    """How many connections a process may have open under the system's limit."""
    try:
        import resource
    except ImportError:  # not on Windows, which has no such limit
        return MOST
    limit, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    if limit == resource.RLIM_INFINITY:
        return MOST
    try:
        here = len(os.listdir("/proc/self/fd"))
    except OSError:
        here = 32
    return max(min(int(limit) - here - SPARE, MOST), 8)


class Connection(IOStream):
    """The stream of one connection, which knows what it is waiting for."""

    def __init__(self, taken: socket.socket, server: BoundedServer, address: str) -> None:
        super().__init__(taken)
        self._server = server
        self.address = address
        self.since = time.monotonic()  # when it began to wait for a request
        self._written = 0
        self._took = self.since  # when it last took something that was sent
        self._looked = 0  # how much of a request has been searched for its end
        self._left_out = 0  # of an address that is far too long [bytes]
        #: the request that is being read, as Tornado has it
        self.request: Any = None

    def close_fd(self) -> None:
        """Close the socket, and let go of the request, which holds this stream."""
        self._server.forget(self)
        self.request = None
        super().close_fd()

    @property
    def asking(self) -> bool:
        """Whether a request is awaited or has come in part."""
        return self.request is None or not getattr(self.request, "_read_finished", True)

    def stuck_since(self) -> float | None:
        """Since when something that is to be sent is not taken; None where all is."""
        written = getattr(self, "_total_write_done_index", 0)
        if not self.writing() or written != self._written:
            self._written = written
            self._took = time.monotonic()
            return None
        return self._took

    def read_until_regex(self, regex: bytes, max_bytes: int | None = None) -> Awaitable[bytes]:
        """The head of a request."""
        self._looked = self._left_out = 0
        return super().read_until_regex(regex, max_bytes)

    def _find_read_pos(self) -> int | None:
        """Look for the end of a request's head where it was not looked for before.

        Tornado searches all that has come again with each byte that comes: of an address of
        2 MB that takes a tenth of a second each time. Of such an address the beginning is kept.
        """
        if self._read_regex is None or not self._read_buffer:
            return super()._find_read_pos()
        head = self._read_buffer
        begin = max(self._looked - 3, 0)
        ends = [end for end in (head.find(b"\n\r\n", begin), head.find(b"\n\n", begin)) if end >= 0]
        line = head.find(b"\n", 0, LONGEST_ADDRESS + 8)
        if line < 0 and len(head) > LONGEST_ADDRESS:
            line = head.find(b"\n")
            kept = len(head) - 8 if line < 0 else max(line - 16, LONGEST_ADDRESS)
            self._left_out += max(kept - LONGEST_ADDRESS, 0)
            del head[LONGEST_ADDRESS:kept]
            self._read_buffer_size = len(head)
            line = head.find(b"\n")
        self._looked = len(head)
        headers = (min(ends) if ends else len(head)) - max(line, 0)
        if self._left_out > LONGEST_HEADER or (line >= 0 and headers > LARGEST_HEADERS):
            raise UnsatisfiableReadError("the head of a request is too large")  # it is closed then
        return super()._find_read_pos() if ends else None


class BoundedServer(HTTPServer):
    """Tornado's server with a bound on the connections that are open."""

    def initialize(self, *arguments: Any, **options: Any) -> None:
        """As Tornado's."""
        super().initialize(
            *arguments,
            **{"idle_connection_timeout": ASKING, "body_timeout": ASKING, **options},
        )
        self.most = MOST
        self._open: set[Connection] = set()
        self._listening: list[socket.socket] = []

    @property
    def connections(self) -> int:
        """How many are open."""
        return len(self._open)

    def add_sockets(self, sockets: Any) -> None:
        """Begin to accept connections on listening sockets."""
        self.most = most_connections()
        for one in sockets:
            self._sockets[one.fileno()] = one
            self._listen(one)
        PeriodicCallback(self._close_stuck, 1000.0 * STUCK / 6).start()

    def forget(self, connection: Connection) -> None:
        """A connection is over."""
        self._open.discard(connection)

    def start_request(self, server_conn: object, request_conn: Any) -> Any:
        """Hear that a connection begins to wait for a request."""
        stream = getattr(request_conn, "stream", None)
        if isinstance(stream, Connection) and not stream.closed():
            stream.request, stream.since = request_conn, time.monotonic()
        return super().start_request(server_conn, request_conn)

    def _listen(self, listening: socket.socket) -> None:
        if self._stopped:
            return
        loop = IOLoop.current()
        removed = [False]

        def accept(fd: Any, events: int) -> None:
            for _ in range(_BACKLOG):
                if removed[0]:
                    return
                try:
                    taken, address = listening.accept()
                except BlockingIOError:
                    return
                except ConnectionAbortedError:
                    continue
                except OSError as error:
                    # trying again at once would fail again, as fast as it can be written down
                    write.trouble("not-accepting", why=error.strerror, connections=len(self._open))
                    remove()
                    loop.call_later(_PAUSE, self._listen, listening)
                    return
                self._take(taken, address)

        def remove() -> None:
            if not removed[0]:
                loop.remove_handler(listening)
                removed[0] = True

        loop.add_handler(listening, accept, IOLoop.READ)
        self._handlers[listening.fileno()] = remove

    def _take(self, taken: socket.socket, address: Any) -> None:
        if len(self._open) >= self.most and not self._make_room():
            write.trouble("no-room", connections=len(self._open))
            taken.close()
            return
        where = str(address[0]) if isinstance(address, tuple) else str(address)
        stream = Connection(taken, self, where)
        self._open.add(stream)
        self.handle_stream(stream, address)

    def _make_room(self) -> bool:
        """Close a connection that can be spared; whether there was one."""
        spare = [one for one in self._open if one.asking and not one.closed()]
        if not spare:
            spare = [one for one in self._open if self._stuck(one, 2.0)]
        if not spare:
            return False
        held = Counter(one.address for one in spare)
        most = max(held.values())
        oldest = min((one for one in spare if held[one.address] == most), key=lambda one: one.since)
        write.trouble("made-room", connections=len(self._open))
        oldest.close()
        return True

    @staticmethod
    def _stuck(one: Connection, seconds: float) -> bool:
        since = one.stuck_since()
        return since is not None and time.monotonic() - since > seconds

    def _close_stuck(self) -> None:
        for one in [one for one in self._open if self._stuck(one, STUCK)]:
            one.close()
