"""A session and the bar above its controls: asked for it happens; strangers change nothing."""

import asyncio
from collections.abc import Callable

import pytest
from bearing_explorer.messages import LinksChange, take
from bearing_explorer.session import Explorer

from bearingcore import presets
from tests.helpers.loops import run
from tests.helpers.sections import SECTIONS


@pytest.fixture
def answers(monkeypatch: pytest.MonkeyPatch) -> list[dict]:
    """What the bar was given."""
    given: list[dict] = []
    monkeypatch.setattr(
        "bearing_explorer.widgets.share.ShareBar.answer", lambda self, **news: given.append(news)
    )
    monkeypatch.setattr(
        "bearing_explorer.widgets.controls.Controls.show", lambda self, **news: None
    )
    return given


def session(*acts: Callable[[Explorer], None], address: str = "") -> Explorer:
    """A session in which each act was drawn before the next."""

    async def live() -> Explorer:
        explorer = Explorer(SECTIONS, address=address)
        for act in (Explorer.draw, *acts):
            act(explorer)
            while explorer._tasks or not explorer._loop.drawn:
                await asyncio.sleep(0.002)
        return explorer

    return run(live())


def test_one_report_at_a_time(answers: list[dict]) -> None:
    def ask_twice(explorer: Explorer) -> None:
        for _ in range(2):
            explorer.requests.change_links({"report": "http://localhost:5006/"})

    session(ask_twice)
    assert [list(news) for news in answers] == [["report"]]
    assert "http://localhost:5006/?v=1&amp;preset=fan-rig" in answers[0]["report"]["html"]


SENSELESS: tuple[dict, ...] = (
    {"mark": 2, "open": {"name": "x", "text": "v=1&n_balls=1e99"}},
    {"mark": 2, "open": {"name": "x", "text": "[" * 100_000}},
    {"mark": 2, "compare": {"name": "x", "text": "v=1&floor=measured&points=" + "A" * 100_000}},
    {"want": "../../etc/passwd"},
)
"""Messages of the form that the page's have; others are ignored, as `test_messages` shows."""


def test_senseless_messages_change_nothing(answers: list[dict]) -> None:
    def send_all(explorer: Explorer) -> None:
        for message in SENSELESS:
            take(explorer.requests.change_links, LinksChange, message)

    explorer = session(send_all)
    assert explorer.scene == presets["fan-rig"]
    assert explorer.inputs.compared == ()
    assert answers == []
    assert len(explorer.share.state["said"]["words"]) < 400
