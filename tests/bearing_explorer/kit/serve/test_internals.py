"""The private names of Bokeh and Panel: they are there, and something happens without them."""

import ast
import re
from importlib.metadata import version
from pathlib import Path
from typing import Any

import bearing_explorer
import bokeh
import panel as pn
import pytest
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.serve import bokeh_internals
from bokeh import models
from bokeh.core.property.descriptors import PropertyDescriptor
from bokeh.core.serialization import Serializer
from bokeh.document import Document
from bokeh.models import Range1d, Spacer
from bokeh.server import session as bokeh_session
from bokeh.server.session import ServerSession
from panel.viewable import Viewable

from tests.helpers.loops import run

APP = Path(bearing_explorer.__file__).parent
SCRIPT = Path(bokeh.__file__).parent / "server" / "static" / "js" / "bokeh.min.js"


def test_this_version_has_all_of_them() -> None:
    """The names that are gone, and of which version, are in the message when this fails."""
    assert bokeh_internals.missing() == []
    assert hasattr(bokeh_session, "_needs_document_lock")
    assert bokeh_internals.sockets_of(session_of(Document(), Socket()))
    for owner, name in (
        (Document().callbacks, "_held_events"),
        (Document().models, "_new_models"),
        (Serializer(), "_references"),
        (Viewable, "_preprocessing_hooks"),
        (pn.Template(""), "_render_items"),
        (Spacer(), "_property_values"),
        (Spacer(), "_unstable_default_values"),
        (Spacer(), "_event_callbacks"),
    ):
        assert hasattr(owner, name), name


def test_no_other_file_uses_a_private_name() -> None:
    """An attribute with an underscore is one that this program has made, or is in these files."""
    trees = {file: ast.parse(file.read_text()) for file in APP.rglob("*.py")}
    used: dict[str, set[str]] = {}
    # of os and of named tuples; documented by Panel
    made = {"_exit", "_replace", "_esm", "_stylesheets", "_send_msg"}
    for file, tree in trees.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                made.add(node.name)
            elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                made.add(node.id)
            elif isinstance(node, ast.Attribute) and node.attr[:1] == "_" != node.attr[1:2]:
                of_self = isinstance(node.value, ast.Name) and node.value.id == "self"
                if isinstance(node.ctx, ast.Store) and of_self:
                    made.add(node.attr)
                elif not file.stem.endswith("_internals"):
                    used.setdefault(node.attr, set()).add(file.name)
    assert {name: files for name, files in used.items() if name not in made} == {}


def test_this_version_of_bokehjs_has_them() -> None:
    """A failure names those that are gone, and the version."""
    named = set(re.findall(r'(?:method|getter)\(\w+, "(\w+)"\)', asset_text("fast_figures.js")))
    assert len(named) > 10, "the script is written differently now"
    library = SCRIPT.read_text(encoding="utf-8")
    gone = {name for name in named if not re.search(rf"\b{name}\(", library)}
    assert not gone, f"gone from BokehJS {version('bokeh')}: {sorted(gone)}"


def test_the_models_are_there_whose_views_are_changed() -> None:
    named = set(re.findall(r'(?:view_of|get)\("(\w+)"\)', asset_text("fast_figures.js")))
    assert {"GlyphRenderer", "Column"} <= named
    assert all(hasattr(models, name) for name in named)


def test_a_name_that_is_gone_is_named_with_the_version(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(PropertyDescriptor, "has_unstable_default")
    (sentence,) = bokeh_internals.missing()
    assert sentence.startswith("PropertyDescriptor.has_unstable_default is gone from bokeh 3.")


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


def changed(act: Any = bokeh_internals.locked) -> tuple[list[Any], Range1d]:
    """Return the messages that a browser gets when a range is moved to 1 to 2, and the range."""
    document, socket = Document(), Socket()
    moved = Range1d(0, 1)
    document.add_root(moved)

    async def live() -> None:
        session = session_of(document, socket)

        async def change(doc: Document) -> None:
            await bokeh_internals.send_changes(session, doc, lambda: moved.update(start=1, end=2))

        await act(session, change)

    run(live())
    return socket.sent, moved


def test_all_changes_are_one_message() -> None:
    sent, moved = changed()
    assert (moved.start, moved.end) == (1, 2)
    assert [len(message.content["events"]) for message in sent] == [2]
