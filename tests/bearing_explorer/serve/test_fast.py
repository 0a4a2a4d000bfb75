"""The private names of Bokeh and Panel: whether they are there, and what happens without them."""

from __future__ import annotations

import ast
import re
import types
from pathlib import Path
from typing import Any

import panel as pn
import pytest
from bearing_explorer.serve import fast, live
from bearing_explorer.serve.live_component import LiveComponent
from bokeh.core.property.descriptors import PropertyDescriptor
from bokeh.core.serialization import Serializer
from bokeh.document import Document
from bokeh.models import ColumnDataSource, Range1d, Spacer
from bokeh.server import session as bokeh_session
from bokeh.server.session import ServerSession
from panel.viewable import Viewable

from tests.helpers.loops import run


def test_this_version_has_all_of_them() -> None:
    """The names that are gone, and of which version, are in the message when this fails."""
    assert fast.missing() == []
    assert hasattr(bokeh_session, "_needs_document_lock")
    assert fast.sockets_of(session_of(Document(), Socket()))
    assert hasattr(Document().callbacks, "_held_events")
    assert hasattr(Document().models, "_new_models")
    assert hasattr(Serializer(), "_references")
    assert hasattr(ColumnDataSource(), "_event_callbacks")
    assert hasattr(Viewable, "_preprocessing_hooks")
    assert pn.Template("")._render_items == {}
    component = Component()
    component.get_root(Document())
    assert component._models
    assert component._msg__callbacks == []
    assert hasattr(Spacer(), "_property_values")
    assert hasattr(Spacer(), "_unstable_default_values")


def test_a_name_that_is_gone_is_named_with_the_version(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(PropertyDescriptor, "has_unstable_default")
    (sentence,) = fast.missing()
    assert sentence.startswith("PropertyDescriptor.has_unstable_default is gone from bokeh 3.")


class Component(LiveComponent):
    """A component without a script."""

    _esm = "export function render() {}"


class Socket:
    """A websocket that remembers what it was sent."""

    def __init__(self) -> None:
        self.sent: list[Any] = []

    async def send_message(self, message: Any) -> None:
        self.sent.append(message)


class Connection:
    """A browser that listens to a session."""

    def __init__(self, socket: Socket) -> None:
        self._socket = socket


def session_of(document: Document, socket: Socket) -> ServerSession:
    """A session with one browser."""
    session = ServerSession("one", document)
    session.subscribe(Connection(socket))  # type: ignore[arg-type]
    return session


def changed(act: Any = fast.locked) -> tuple[list[Any], Range1d]:
    """What a browser is sent when a range is moved to 1 to 2, and the range."""
    document, socket = Document(), Socket()
    moved = Range1d(0, 1)
    document.add_root(moved)

    async def live() -> None:
        session = session_of(document, socket)

        async def change(doc: Document) -> None:
            await fast.send_changes(session, doc, lambda: moved.update(start=1, end=2))

        await act(session, change)

    run(live())
    return socket.sent, moved


def test_all_changes_are_one_message() -> None:
    sent, moved = changed()
    assert (moved.start, moved.end) == (1, 2)
    assert [len(message.content["events"]) for message in sent] == [2]


def test_without_a_lock_decorator_bokehs_own_way_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_needs_document_lock_on_loop", "_needs_document_lock"):
        monkeypatch.delattr(bokeh_session, name, raising=False)
    sent, _ = changed(fast._with_lock(lambda session, act: act(session.document)))
    assert len(sent) == 1


def test_without_known_new_models_bokeh_writes_the_message(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(fast, "Serializer", None)  # it would not be asked
    document, moved = Document(), Range1d(0, 1)
    document.add_root(moved)
    document.models = types.SimpleNamespace(  # type: ignore[assignment]
        synced_references=set(document.models), flush_synced=lambda *_: None
    )
    document.hold("combine")
    moved.start = 2
    message = fast._patch_of(document, list(document.callbacks._held_events))
    assert len(message.content["events"]) == 1


def test_models_are_looked_for_bokehs_way_where_a_name_is_gone(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    from bokeh.model import util

    def slow(*_: object) -> None: ...

    monkeypatch.setattr(util, "visit_immediate_value_references", slow)
    monkeypatch.setattr(fast, "missing", lambda: ["it is gone"])
    fast.find_models_quickly()
    assert util.visit_immediate_value_references is slow
    assert "it is gone" in caplog.text


def test_without_a_session_there_is_nothing_to_send_to() -> None:
    assert live.send_at_once(None) == 0
    assert fast.sockets_of(object()) == []
    changes: list[int] = []
    run(live.one_message(None, lambda: changes.append(1)))
    assert changes == [1]


def test_private_names_of_others_stand_here_alone() -> None:
    """But for those that a class in `serve` overrides or finds in its base."""
    package = Path(fast.__file__).parents[1]
    own = {"_exit", "_take", "_asdict", "_replace"}  # public, of `os` and named tuples, but one
    of_server = {"_async_open", "_current_patch_connection", "_tornado", "_process_bokeh_event"}
    found = []
    for path in package.rglob("*.py"):
        allowed = own | of_server if path.parent.name == "serve" else own
        for node in ast.walk(ast.parse(path.read_text())):
            if not isinstance(node, ast.Attribute) or not re.match(r"_[a-z]", node.attr):
                continue
            of_itself = isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")
            if not of_itself and node.attr not in allowed and path.name != "fast.py":
                found.append(f"{path.name}:{node.lineno} {ast.unparse(node)}")
    assert not found
