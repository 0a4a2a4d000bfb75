"""The page, and small pages with a sentence for when it cannot be shown."""

from __future__ import annotations

import asyncio
import html
from typing import Any, ClassVar
from urllib.parse import unquote

from panel.io import server as panel_server
from tornado.httputil import HTTPServerRequest
from tornado.routing import Matcher
from tornado.web import RequestHandler

from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.serve.address import LONGEST_ADDRESS, TOO_LONG
from bearing_explorer.kit.serve.hosts import AllowedHosts


def message_page(title: str, words: str) -> str:
    """Return a small page with a sentence."""
    page = asset_text("message.html")
    return page.replace("{title}", html.escape(title)).replace("{words}", html.escape(words))


def write_html(handler: RequestHandler, status: int, title: str, words: str) -> None:
    """Answer with a small page that is not cached."""
    handler.set_status(status)
    handler.set_header("Content-Type", "text/html; charset=utf-8")
    handler.set_header("Cache-Control", "no-store")
    handler.write(message_page(title, words))


class PageHandler(panel_server.DocHandler):  # type: ignore[misc]
    """The page, or a sentence that asks to come back later."""

    hosts: ClassVar[AllowedHosts]
    most_sessions: ClassVar[int] = 100
    one_at_a_time: ClassVar[asyncio.Lock] = asyncio.Lock()
    """Lock for making pages. A pause follows each page, in which the pages made before it draw:
    without it, all of 20 people who came at once waited for the last page."""

    async def get(self, *arguments: Any, **named: Any) -> None:
        """Make a session, and write the page that connects to it."""
        if len(self.request.uri or "") > LONGEST_ADDRESS:
            self.redirect(f"?v={TOO_LONG}")  # relative: a path such as //elsewhere is another host
        elif not self.hosts.allow_page(self.request):
            write_html(self, 403, "This address does not work", _UNKNOWN_HOST)
        elif {"bokeh-token", "bokeh-session-id"} & set(self.request.arguments):
            write_html(self, 400, "This address does not work", _NO_SESSION)
        elif self.is_full(self.application_context):
            self._ask_to_come_back()
        else:
            async with self.one_at_a_time:
                if self.is_full(self.application_context):  # it may have filled meanwhile
                    self._ask_to_come_back()
                    return
                await super().get(*arguments, **named)
                await asyncio.sleep(0.03)

    @classmethod
    def is_full(cls, context: Any) -> bool:
        """Return True if an application may have no more sessions."""
        return len(list(context.sessions)) >= cls.most_sessions

    @classmethod
    async def make_session(cls, context: Any, name: Any, request: Any, token: str) -> Any | None:
        """Return the session of a token, made again if it is over; None if there is no room.

        A page's token outlives its session, and may be used at any time.
        """
        known = {session.id: session for session in context.sessions}
        if name in known:
            return known[name]
        async with cls.one_at_a_time:
            if cls.is_full(context) and all(name != session.id for session in context.sessions):
                return None
            return await context.create_session_if_needed(name, request, token)

    def _ask_to_come_back(self) -> None:
        self.set_header("Retry-After", "60")
        words = f"{SERVER_IS_FULL.format(self.most_sessions)} Try again in a minute."
        write_html(self, 503, "The server is full", words)

    def head(self, *arguments: Any, **named: Any) -> None:
        """Answer monitors without a session."""

    def write_error(self, status_code: int, **named: Any) -> None:
        """Write a page with a sentence; the log has the error."""
        words = f"The server answers {status_code}. Try the page again."
        write_html(self, status_code, "This did not work", words)
        self.finish()


SERVER_IS_FULL = "This server has room for {} people at once."
_UNKNOWN_HOST = (
    "This server does not know the name in the address. Whoever runs it can allow the name with "
    "--allow-websocket-origin."
)
_NO_SESSION = "A session cannot be named in an address. Leave the part after the question mark out."


class Missing(RequestHandler):
    """Handler of all other paths."""

    def prepare(self) -> None:
        """Answer any method with a sentence."""
        write_html(self, 404, "There is no such page", "The explorer is one page up.")
        self.finish()


class HasControls(Matcher):
    """Matches paths with control characters, at which Tornado's file handler fails."""

    def match(self, request: HTTPServerRequest) -> dict[str, Any] | None:
        """Return the parameters of the handler; None if the path is an ordinary one."""
        return None if unquote(request.path or "").isprintable() else {}


class Icon(RequestHandler):
    """The logo as the page's icon, also under a path in front of the page."""

    def get(self) -> None:
        """Write the picture."""
        self.set_header("Content-Type", "image/svg+xml")
        self.set_header("Cache-Control", "max-age=86400")
        self.write(asset_text("logo.svg"))
