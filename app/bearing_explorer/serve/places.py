"""Who has a place: those who are connected, and for a while those who were given a page.

Pages that were asked for and never connect take no more than a quarter of the places for each
address, and no more memory than `Limits.unclaimed` sessions.
"""

from __future__ import annotations

import asyncio
from collections import Counter
from typing import Any

from bearing_explorer.serve import limits
from bearing_explorer.serve import log as write
from bearing_explorer.serve.bokeh_private import drop_session

_connected: Counter[str] = Counter()
_unclaimed: dict[str, str] = {}  # addresses by names of sessions, the oldest first


LINGERS = 15.0
"""[s] for which a session is kept that has no browser: it may come, or come back."""
_PAUSE = 0.02  # [s] between the ends of two sessions, for everybody else


async def drop_ended(context: Any) -> None:
    """Let sessions go that nobody has come back to, one after the other.

    Bokeh would let all of them go at once: with a class that leaves, a second without an answer.
    """
    for session in list(context.sessions):
        left_for = 1e-3 * session.milliseconds_since_last_unsubscribe
        in_use = session.connection_count or session.expiration_blocked
        if left_for > LINGERS and not in_use:
            await drop_session(context, session.id)
            await asyncio.sleep(_PAUSE)


def reset() -> None:
    """A server begins: nobody is there."""
    _connected.clear()
    _unclaimed.clear()


def came(session: str) -> None:
    """A browser has connected."""
    _connected[session] += 1
    _unclaimed.pop(session, None)


def left(session: str) -> None:
    """A browser is gone."""
    _connected[session] -= 1
    if _connected[session] <= 0:
        del _connected[session]


def connected() -> int:
    """How many sessions have a browser."""
    return len(_connected)


def all_taken() -> bool:
    """Whether there is no place for somebody who asks for the page."""
    most = limits.current().sessions
    quarter = max(1, most // 4)
    asked = sum(min(n, quarter) for n in Counter(_unclaimed.values()).values())
    return len(_connected) + asked >= most


def may_connect(session: str) -> bool:
    """Whether the browser of a session may connect: it does already, or there is a place."""
    return session in _connected or len(_connected) < limits.current().sessions


async def give_page(context: Any, session: Any, address: str) -> None:
    """Note that `address` was given the page of a session; its oldest one may have to go."""
    alive = {one.id for one in context.sessions}
    for name in [name for name in _unclaimed if name not in alive]:
        del _unclaimed[name]
    _unclaimed[session.id] = address
    its = [name for name, where in _unclaimed.items() if where == address]
    for name in its[: max(len(its) - limits.current().unclaimed, 0)]:
        del _unclaimed[name]
        write.trouble("given-up", pages=len(its))
        await drop_session(context, name)
