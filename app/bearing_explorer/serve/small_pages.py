"""Pages with a sentence: where something is missing, or did not work."""

from __future__ import annotations

import html
from typing import Any
from urllib.parse import unquote

from tornado.httputil import HTTPServerRequest
from tornado.routing import Matcher
from tornado.web import RequestHandler

from bearing_explorer.assets import asset_text


def message_page(title: str, words: str) -> str:
    """A small page with a sentence."""
    return (
        asset_text("message.html")
        .replace("{title}", html.escape(title))
        .replace("{words}", html.escape(words))
    )


def tell(handler: RequestHandler, title: str, words: str) -> None:
    """Answer with a small page that is not kept."""
    handler.set_header("Content-Type", "text/html; charset=utf-8")
    handler.set_header("Cache-Control", "no-store")
    handler.write(message_page(title, words))


def tell_error(handler: RequestHandler, status_code: int) -> None:
    """Say that something did not work, and nothing of what it was: that stands in the log."""
    handler.clear_header("Content-Length")
    tell(handler, "This did not work", f"The server answers {status_code}. Try the page again.")
    handler.finish()


class Missing(RequestHandler):
    """Whatever else is asked for."""

    def prepare(self) -> None:
        self.set_status(404)
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.finish(message_page("There is no such page", "The explorer is one page up."))


class HasControls(Matcher):
    """Signs in a path that no file's name has; some would end in an error of the system."""

    def match(self, request: HTTPServerRequest) -> dict[str, Any] | None:
        path = unquote(request.path or "")
        return {} if any(ord(sign) < 32 or ord(sign) == 127 for sign in path) else None


class Icon(RequestHandler):
    """The logo as the page's icon, also under a path in front of the page."""

    def get(self) -> None:
        self.set_header("Content-Type", "image/svg+xml")
        self.set_header("Cache-Control", "max-age=86400")
        self.write(asset_text("logo.svg"))
