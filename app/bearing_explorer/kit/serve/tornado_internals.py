"""Limits on requests by private parts of Tornado; no other file uses any.

Tornado reads a whole request before it asks the page: a body of up to a hundred megabytes, which no
page here takes, and headers for as long as they come. `HTTP_OPTIONS` limits each request by public
options. The rest needs private parts:

* `close` of a stream, which is replaced, and the `stream` of a request: connections whose headers
  are under way are counted (`BoundedServer`). Without them a proxy has to count.
* `rules` of the first router: a path with control characters becomes a missing page. Without
  them the answer is 500, with a traceback in the log.

At the start, `bound` logs which of them are gone. With
``BEARING_EXPLORER_PLAIN=1`` it is not called (`bokeh_internals`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import tornado
from tornado.httpserver import HTTPServer
from tornado.httputil import HTTPMessageDelegate, RequestStartLine, ResponseStartLine
from tornado.iostream import IOStream
from tornado.routing import Rule

from bearing_explorer.kit.serve.log import log
from bearing_explorer.kit.serve.pages import HasControls, Missing

LARGEST_HEADERS = 64_000
"""Size [bytes] of the largest headers of a request, with its address."""
LARGEST_BODY = 64_000
"""Size [bytes] of the largest body of a request; only GET and HEAD are answered."""
SLOWEST_HEADERS = 8.0
"""Time [s] that headers may take, and that a connection may wait for its next request."""
MOST_UNFINISHED = 60
"""Largest number of connections that have not sent all headers; the oldest makes room for more."""
HTTP_OPTIONS = {
    "max_header_size": LARGEST_HEADERS,
    "max_body_size": LARGEST_BODY,
    "idle_connection_timeout": SLOWEST_HEADERS,
    "body_timeout": SLOWEST_HEADERS,
}
"""Options of Tornado's server."""


class _Started(HTTPMessageDelegate):
    """Passes a request on, and reports the arrival of its headers."""

    def __init__(self, inner: HTTPMessageDelegate, arrived: Callable[[], None]) -> None:
        self._inner, self._arrived = inner, arrived

    def headers_received(
        self, start_line: RequestStartLine | ResponseStartLine, headers: Any
    ) -> Any:
        self._arrived()
        return self._inner.headers_received(start_line, headers)

    def data_received(self, chunk: bytes) -> Any:
        return self._inner.data_received(chunk)

    def finish(self) -> None:
        self._inner.finish()

    def on_connection_close(self) -> None:
        self._inner.on_connection_close()


class BoundedServer(HTTPServer):
    """Tornado's server with a bound on connections whose headers are under way."""

    _unfinished: dict[int, IOStream]

    def handle_stream(self, stream: IOStream, address: tuple) -> None:
        """Count a new connection, and close the oldest if there are too many."""
        while len(self._unfinished) >= MOST_UNFINISHED:
            self._unfinished.pop(next(iter(self._unfinished))).close()
        self._unfinished[id(stream)] = stream
        close = stream.close

        def close_and_forget(exc_info: Any = False) -> None:
            self._unfinished.pop(id(stream), None)
            close(exc_info)

        stream.close = close_and_forget  # type: ignore[method-assign]
        super().handle_stream(stream, address)

    def start_request(self, server_conn: object, request_conn: Any) -> HTTPMessageDelegate:
        """Watch the headers that a connection is about to send."""
        stream = request_conn.stream

        def arrived() -> None:
            self._unfinished.pop(id(stream), None)

        return _Started(super().start_request(server_conn, request_conn), arrived)


def bound(application: Any, server: HTTPServer) -> None:
    """Bound the connections of a library's server, and refuse paths with control characters."""
    rules = getattr(getattr(application, "default_router", None), "rules", None)
    if rules is None or not hasattr(server, "start_request"):
        log.warning("connections are not bound: Tornado %s has other names", tornado.version)
        return
    rules.insert(0, Rule(HasControls(), Missing))
    server.__class__ = BoundedServer
    server._unfinished = {}  # type: ignore[attr-defined]
