"""Opening a tab: what is done on the event loop, where all others wait for it, and what is not."""

from __future__ import annotations

import threading
from collections import Counter
from typing import Any

import pytest
from bokeh.model import Model

from tests.helpers.page_client import PageClient
from tests.helpers.served import served, session_of


def test_sections_are_made_and_written_in_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    made: Counter[int] = Counter()
    written: Counter[int] = Counter()
    make, write = Model.__init__, Model.to_serializable

    def making(self: Model, *given: Any, **named: Any) -> None:
        made[threading.get_ident()] += 1
        make(self, *given, **named)

    def writing(self: Model, serializer: Any) -> Any:
        written[threading.get_ident()] += 1
        return write(self, serializer)

    monkeypatch.setattr(Model, "__init__", making)
    monkeypatch.setattr(Model, "to_serializable", writing)

    async def test(url: str, server: Any) -> None:
        loop = threading.get_ident()
        client = PageClient(url)
        assert await client.open_page() == 200
        await client.connect()
        assert await client.until_drawn()
        (session,) = session_of(server)
        made.clear()
        written.clear()
        before = len(session.document.models)
        await client.show("load")
        while "load" not in client.words.values():
            await client.news(10.0)
        new = len(session.document.models) - before
        assert new > 100
        for counted in (made, written):
            assert counted[loop] <= 2
            assert counted.total() >= new
        await client.close()

    served(test)
