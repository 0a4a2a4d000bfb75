"""The page, made for one after the other, or a friendly one that asks to come back later."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from panel.io import server as panel_server

from bearing_explorer.serve import limits, places
from bearing_explorer.serve.small_pages import tell, tell_error
from bearing_explorer.serve.turns import Turns

_turns = Turns()
_not_yet: Callable[[], str] = str


def begin(not_yet: Callable[[], str] = str) -> None:
    """A server begins: nobody waits. `not_yet` says why there is no page yet; empty once there is.

    (`str` without an argument is the empty text.)
    """
    global _turns, _not_yet
    _turns, _not_yet = Turns(), not_yet


class PageHandler(panel_server.DocHandler):  # type: ignore[misc]
    """The page, or a friendly one that asks to come back later."""

    async def get(self, *arguments: Any, **named: Any) -> None:
        """A session, and the page that connects to it."""
        if words := _not_yet():
            self.set_status(503)
            self.set_header("Retry-After", "1")
            self.set_header("Refresh", "1")  # browsers ask again by themselves
            tell(self, "The explorer is getting ready", words)
            return
        if places.all_taken():
            self.set_status(503)
            self.set_header("Retry-After", "60")
            most = limits.current().sessions
            tell(self, "All places are taken", _FULL.format(most))
            return
        named_in_address = any(
            name in self.request.arguments for name in ("bokeh-token", "bokeh-session-id")
        )
        if named_in_address or "Bokeh-Session-Id" in self.request.headers:
            self.set_status(400)
            tell(self, "This address does not work", _NO_SESSION)
            return
        async with _turns.turn(self.request.remote_ip or ""):
            if not self.request.connection.stream.closed():  # type: ignore[union-attr]
                await super().get(*arguments, **named)

    async def get_session(self) -> Any:
        """A new session; between its making and the page's, others are served."""
        session = await super().get_session()
        await places.give_page(self.application_context, session, self.request.remote_ip or "")
        await asyncio.sleep(0)
        return session

    def write_error(self, status_code: int, **named: Any) -> None:
        """A page with a sentence."""
        tell_error(self, status_code)

    def head(self, *arguments: Any, **named: Any) -> None:
        """For monitors: no session is made."""


_FULL = "This server has room for {} people at once. Try again in a minute."
_NO_SESSION = "A session cannot be named in an address. Leave the part after the question mark out."
