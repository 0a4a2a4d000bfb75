"""What is asked with an address far longer than a link of ours is sent on to a short one.

A session's token holds the address, and goes back and forth in headers that have their limits:
the page would come and its connection never. So the page is asked for again with an address that
says what was wrong, in words that `bearing_explorer.state.address` knows.
"""

from __future__ import annotations

from typing import Any

from tornado.httputil import HTTPServerRequest
from tornado.routing import Matcher, Rule
from tornado.web import RequestHandler

from bearing_explorer.serve.bokeh_private import tornado_of
from bearing_explorer.state.address import TOO_LONG

LONGEST = 16_000
"""Characters of an address that reaches the page; links of the page have at most half of that."""
LONGEST_HEADER = 2_500_000
"""Bytes of headers that are read before a connection is cut: browsers send addresses of 2 MB."""


class _IsLong(Matcher):
    def match(self, request: HTTPServerRequest) -> dict[str, Any] | None:
        return {} if len(request.uri or "") > LONGEST else None


class _ToShort(RequestHandler):
    def get(self) -> None:
        """Send on to the same page with an address that says why."""
        # relative, or a path such as //elsewhere would lead there
        self.redirect(f"?v={TOO_LONG}")


def send_on(server: Any) -> None:
    """Look at the length of every address that `server` is asked with, before all else does."""
    application = tornado_of(server)
    if application is not None:
        application.default_router.rules.insert(0, Rule(_IsLong(), _ToShort))
