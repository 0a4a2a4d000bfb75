"""Messages of the page's scripts: good ones are read as they are, others ignored with a line."""

import logging
import random
from typing import Any

import pytest
from bearing_explorer.explorer.messages import LessonChange, LinksChange, SceneChange
from bearing_explorer.explorer.widgets.controls import Controls
from bearing_explorer.explorer.widgets.lesson import LessonPanel
from bearing_explorer.explorer.widgets.share import ShareBar
from bearing_explorer.kit.messages import TabChange, read
from bearing_explorer.kit.widgets.status import Tabs
from panel.models.esm import DataEvent

from tests.fuzz.hostile_messages import GOOD, broken

RECEIVED = {
    "Controls": (SceneChange, Controls),
    "ShareBar": (LinksChange, ShareBar),
    "LessonPanel": (LessonChange, lambda act: LessonPanel(act, [])),
    "Tabs": (TabChange, Tabs),
}


def handed_on(component: str, data: Any) -> list[dict[str, Any]]:
    """What a receiver gets of a message that its component's script sends."""
    received: list[dict[str, Any]] = []
    panel = RECEIVED[component][1](received.append)
    panel._process_event(DataEvent(None, data))
    return received


@pytest.mark.parametrize("component", RECEIVED)
def test_good_messages_are_handed_on_as_they_are(component: str) -> None:
    messages = [data for name, data in GOOD if name == component]
    for data in messages[:: max(1, len(messages) // 20)]:
        assert handed_on(component, data) == [data]


@pytest.mark.parametrize(
    ("component", "data"),
    [
        ("Controls", {"mark": -1, "set": {}}),
        ("Controls", {"mark": 1, "choose": {"kind": 3}}),
        ("ShareBar", {"undo": "yes"}),
        ("LessonPanel", {"lesson": []}),
        ("Tabs", {"show": None}),
        ("Controls", None),
        ("Controls", {"mark": 1e99, "set": {1: 2, None: 3}}),
        ("ShareBar", {"open": {"name": ["x"], "text": {}}}),
    ],
)
def test_others_are_ignored_with_a_line(
    component: str, data: Any, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.INFO):
        assert handed_on(component, data) == []
    assert "a message was ignored" in caplog.text


def test_broken_messages_are_read_whole_or_not_at_all() -> None:
    random_ = random.Random(7)
    good = [(RECEIVED[name][0], data) for name, data in GOOD if name in RECEIVED]
    read_ones = [read(kind, broken(random_, data)) for kind, data in random_.choices(good, k=500)]
    assert any(message is None for message in read_ones)
    assert any(message is not None for message in read_ones)
