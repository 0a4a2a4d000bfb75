"""All private names of Bokeh and Panel that the page uses, and what it does without them.

A page that is dragged is drawn some twenty times a second, and a class of thirty comes all at once.
What Bokeh and Panel offer in public for that costs several times as much, see the functions here.
Private names may go with any release. `missing` says which of them are gone and of which version,
and a test prints it; each use here has a public way that it falls back to, slower and as right.
"""

from __future__ import annotations

import logging
from collections.abc import Awaitable, Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from typing import Any

import panel as pn
from bokeh.core.has_props import HasProps
from bokeh.core.property.descriptors import PropertyDescriptor
from bokeh.core.serialization import Serializer
from bokeh.document import Document
from bokeh.document.events import DocumentPatchedEvent
from bokeh.document.models import DocumentModelManager
from bokeh.model import Model
from bokeh.model import util as model_util
from bokeh.protocol.message import Message
from bokeh.protocol.messages.patch_doc import patch_doc
from bokeh.server import session as bokeh_session
from bokeh.server.connection import ServerConnection
from bokeh.server.server import BaseServer
from bokeh.util.callback_manager import EventCallbackManager
from panel.custom import JSComponent
from panel.io import document as panel_document
from panel.io.state import set_curdoc, state
from panel.models.esm import DataEvent
from panel.template.base import BaseTemplate
from panel.viewable import Viewable

log = logging.getLogger(__name__)


# What is there


@dataclass(frozen=True)
class PrivateName:
    """A private name of a library, and whether this version has it."""

    library: str
    name: str
    there: bool


def _set_in(kind: type, name: str) -> bool:
    """Whether the constructor of a class mentions an attribute: it is no attribute of the class."""
    codes = [
        base.__dict__["__init__"].__code__ for base in kind.__mro__ if _has_code(base.__dict__)
    ]
    return any(name in code.co_names for code in codes)


def _has_code(names: Any) -> bool:
    return hasattr(names.get("__init__"), "__code__")


def _names() -> Iterator[PrivateName]:
    for module, name in (
        (bokeh_session, "_needs_document_lock"),
        (model_util, "visit_immediate_value_references"),
    ):
        yield PrivateName("bokeh", f"{module.__name__}.{name}", hasattr(module, name))
    for kind, name in (
        (HasProps, "_overridden_defaults"),
        (PropertyDescriptor, "is_unstable"),
        (PropertyDescriptor, "has_unstable_default"),
        (HasProps, "__overridden_defaults__"),
    ):
        yield PrivateName("bokeh", f"{kind.__name__}.{name}", hasattr(kind, name))
    for kind, name in (
        (bokeh_session.ServerSession, "_subscribed_connections"),
        (ServerConnection, "_socket"),
        (BaseServer, "_tornado"),
        (DocumentModelManager, "_new_models"),
        (Serializer, "_references"),
        (EventCallbackManager, "_event_callbacks"),
        (HasProps, "_property_values"),
        (HasProps, "_unstable_default_values"),
    ):
        yield PrivateName("bokeh", f"{kind.__name__}().{name}", _set_in(kind, name))
    held = hasattr(Document().callbacks, "_held_events")
    yield PrivateName("bokeh", "Document().callbacks._held_events", held)
    kept = hasattr(pn.Spacer(), "_param__private")
    yield PrivateName("param", "Parameterized()._param__private", kept)
    collects = hasattr(panel_document, "_garbage_collect")
    yield PrivateName("panel", "panel.io.document._garbage_collect", collects)
    for name in ("_views", "_fake_roots"):
        yield PrivateName("panel", f"panel.state.{name}", hasattr(state, name))
    for kind, name in (
        (JSComponent, "_process_bokeh_event"),
        (JSComponent, "_send_msg"),
        (Viewable, "_preprocessing_hooks"),
        (Viewable, "_get_model"),
    ):
        yield PrivateName("panel", f"{kind.__name__}.{name}", hasattr(kind, name))
    for kind, name in (
        (JSComponent, "_msg__callbacks"),
        (JSComponent, "_models"),
        (BaseTemplate, "_render_items"),
        (pn.pane.HoloViews, "_plots"),
    ):
        yield PrivateName("panel", f"{kind.__name__}().{name}", _set_in(kind, name))


def missing() -> list[str]:
    """Names that this version of a library does not have, each in a sentence."""
    return [
        f"{one.name} is gone from {one.library} {version(one.library)}"
        for one in _names()
        if not one.there
    ]


# The document of a session: changed on the event loop, sent as one message


def _with_lock(act: Callable[..., Awaitable[None]]) -> Callable[..., Awaitable[None]]:
    """Bokeh's decorator that locks a document.

    Its `with_document_locked` takes, from 3.10 on, a way through a thread each time.
    """
    known = ("_needs_document_lock_on_loop", "_needs_document_lock")
    lock = next((getattr(bokeh_session, n) for n in known if hasattr(bokeh_session, n)), None)
    if lock is not None:
        decorated: Callable[..., Awaitable[None]] = lock(act)
        return decorated

    async def locked(session: Any, *args: Any) -> None:
        await session.with_document_locked(act, session, *args)

    return locked


@_with_lock
def locked(session: Any, act: Callable[[Document], Awaitable[None]]) -> Awaitable[None]:
    """Let `act` change the document of a session, while nobody else does."""
    return act(session.document)


def hear(model: Model, event: DataEvent) -> None:
    """Give an event of the browser to what listens to `model`.

    Bokeh would ask each model of the document whether the event is meant for it.
    """
    callbacks = getattr(model, "_event_callbacks", None)
    if callbacks is None:
        if model.document is not None:
            model.document.callbacks.trigger_event(event)
        return
    for heard in callbacks.get(DataEvent.event_name, ()):
        heard(event)


async def drop_session(context: Any, name: str) -> None:
    """Let a session of an application go whose page never connected."""
    session = getattr(context, "_sessions", {}).get(name)
    discard = getattr(context, "_discard_session", None)
    if session is not None and session.connection_count == 0 and discard is not None:
        await discard(session, lambda one: one.connection_count == 0)


def http_server_of(server: Any) -> Any:
    """Tornado's HTTP server in Bokeh's; None where it cannot be found."""
    return getattr(server, "_http", None)


def contexts_of(server: Any) -> list[Any]:
    """What holds the sessions of a server, of each of its pages; none where it is not found."""
    return list(getattr(tornado_of(server), "_applications", {}).values())


def sockets_of(session: Any) -> list[Any]:
    """The websockets of a session; none where they cannot be found."""
    connections = tuple(getattr(session, "_subscribed_connections", ()))
    sockets = (getattr(connection, "_socket", None) for connection in connections)
    return [socket for socket in sockets if socket is not None]


Write = Callable[[Callable[[], Message[Any]]], Awaitable[Message[Any]]]


async def send_changes(
    session: Any, document: Document, change: Callable[[], None], write: Write | None = None
) -> None:
    """Run `change` and send all that it changed as one message, written when this returns.

    `write` is given what composes the message and may do so in a thread: nobody else changes the
    document meanwhile. Without the private names Bokeh sends it, in as many messages as it likes.
    """
    callbacks: Any = document.callbacks
    document.hold("combine")
    patches: list[DocumentPatchedEvent] = []
    try:
        change()
    finally:
        sockets = sockets_of(session)
        held = getattr(callbacks, "_held_events", None)
        if held is not None and sockets:
            patches = [event for event in held if isinstance(event, DocumentPatchedEvent)]
            callbacks._held_events = [event for event in held if event not in patches]
        document.unhold()
    if patches:

        def compose() -> Message[Any]:
            message = _patch_of(document, patches)
            _ = message.content_json  # the text of it, which is kept
            return message

        message = compose() if write is None else await write(compose)
        for socket in sockets:
            await socket.send_message(message)


def _patch_of(document: Document, events: list[DocumentPatchedEvent]) -> Message[Any]:
    """A message of `events`.

    Bokeh lists all models of the document first, so as to know new ones from those that the
    browser has. Where there are none new, those that the events are about will do.
    """
    if not getattr(document.models, "_new_models", True):
        known = {model for event in events if (model := getattr(event, "model", None)) is not None}
        serializer = Serializer(references=known)
        content = {"events": serializer.encode(events)}
        if len(getattr(serializer, "_references", ())) == len(known):
            message: Message[Any] = patch_doc(patch_doc.create_header(), {}, content)
            message.add_buffers(*serializer.buffers)
            return message
    return patch_doc.create(events)


@contextmanager
def patched_by(session: Any, connection: Any) -> Iterator[None]:
    """While a patch of `connection` is applied: Bokeh then does not send it back there."""
    session._current_patch_connection = connection
    try:
        yield
    finally:
        session._current_patch_connection = None


def make_models(layout: Viewable, child: Viewable, document: Document) -> None:
    """Make the models of `child`, which is about to come into `layout`. For any thread.

    They are in no document yet. Panel finds them when the child comes; without the private names
    it makes them then.
    """
    views, roots_of_templates = getattr(state, "_views", {}), getattr(state, "_fake_roots", ())
    with set_curdoc(document):
        for ref, (model, _) in list(getattr(layout, "_models", {}).items()):
            if ref not in views or ref in roots_of_templates or ref in child._models:
                continue
            _, root, shown_in, comm = views[ref]
            if shown_in is document:
                child._get_model(document, root, model, comm)


# A component that hears and says much


def send_message(component: JSComponent, message: Any) -> None:
    """Send something to the script of a component."""
    component._send_msg(message)


class DirectComponent(JSComponent):
    """Panel's component with short ways to the models in the browser, see `LiveComponent`."""

    def models_shown(self) -> list[Any]:
        """Bokeh's models of this component, in all documents; none before it is shown."""
        shown = getattr(self, "_models", {})
        return list({id(model): model for model, _ in shown.values()}.values())

    def listeners(self) -> list[Callable[[Any], None]]:
        """What was given to `on_msg`."""
        return list(getattr(self, "_msg__callbacks", ()))

    def send(self, message: Any) -> None:
        """Send something to the component's script."""
        send_message(self, message)

    def take(self, doc: Document, event: Any) -> bool:
        """Take an event of the browser; whether it was taken."""
        raise NotImplementedError

    def _process_bokeh_event(self, doc: Document, event: Any) -> None:
        if not (isinstance(event, DataEvent) and self.take(doc, event)):
            super()._process_bokeh_event(doc, event)


# A server, its page and its garbage


def tornado_of(server: Any) -> Any:
    """The Tornado application of a server; None where it cannot be found."""
    return getattr(server, "_tornado", None)


def parts_of(template: BaseTemplate) -> Iterable[str]:
    """Names of the parts of a template."""
    return list(getattr(template, "_render_items", ()))


def shown_in(document: Document) -> list[object]:
    """What Panel shows in a document, and its models; a template has some that only Panel knows."""
    views = getattr(state, "_views", {})
    return [part for view in views.values() if view[2] is document for part in view[:2]]


def plots_of(pane: Any) -> list[object]:
    """HoloViews' plots of a pane, and the panes that show them; none where they are not found."""
    found: list[object] = []
    for plot, shown_by in getattr(pane, "_plots", {}).values():
        found += [shown_by, *plot.traverse(lambda one: one)]
    return found


def inside(parameterized: object) -> object:
    """Where Param keeps the values of an object and who watches them; None where it is unknown."""
    return getattr(parameterized, "_param__private", None)


def collect_elsewhere(ask: Callable[[], None]) -> None:
    """Have Panel ask for a garbage collection after a session, where it would do it on the spot."""
    if hasattr(panel_document, "_garbage_collect"):
        panel_document._garbage_collect = ask
    else:
        log.warning("panel %s collects garbage as it likes", pn.__version__)


# Models, looked for where models can be


def visit_quickly() -> None:
    """Have Bokeh look for models only where models can be.

    It walks all models whenever one is added, and asks each for the value of every property that
    might hold another, making up defaults that never hold one. That is most of what a session
    costs. Here defaults are asked for only where they are made anew for each model; and what
    Bokeh works out about a class for each of its models is worked out once. Values are walked
    without an import for each of them.
    """
    if getattr(model_util, "visit_immediate_value_references", None) is _visit:
        return
    if gone := missing():
        log.warning("models are looked for everywhere: %s", "; ".join(gone))
        return
    model_util.visit_immediate_value_references = _visit
    changed = HasProps.__dict__["_overridden_defaults"].__func__
    patched: Any = HasProps
    remembering: Any = cache(changed)
    patched._overridden_defaults = classmethod(remembering)
    descriptor: Any = PropertyDescriptor
    descriptor.has_unstable_default = _has_unstable_default


_unstable: dict[tuple[type, PropertyDescriptor], bool] = {}


def _has_unstable_default(self: PropertyDescriptor, obj: HasProps) -> bool:
    key = (type(obj), self)
    found = _unstable.get(key)
    if found is None:
        changed = type(obj).__overridden_defaults__.get(self.name)
        found = self.property._may_have_unstable_default() or self.is_unstable(changed)
        _unstable[key] = bool(found)
    return bool(found)


_PLAIN = frozenset({int, float, str, bool, bytes, type(None)})
_places: dict[type, list[tuple[str, bool]]] = {}


def _places_of(kind: type[HasProps]) -> list[tuple[str, bool]]:
    """Properties of a class that may hold models, and whether their default may."""
    found = _places.get(kind)
    if found is None:
        changed = kind._overridden_defaults()
        found = []
        for name in kind.properties_with_refs():
            descriptor = kind.lookup(name)
            own = descriptor.property._may_have_unstable_default()
            here = kind.__overridden_defaults__.get(name)
            changes = (here, changed.get(name))
            found.append((name, own or any(map(descriptor.is_unstable, changes))))
        _places[kind] = found
    return found


def _walk(value: Any, visitor: Callable[[Any], None]) -> None:
    """Give `visitor` the models that a value is or holds."""
    kind = type(value)
    if kind in _PLAIN:
        return
    if issubclass(kind, Model):
        visitor(value)
    elif issubclass(kind, list | tuple):
        for item in value:
            if type(item) not in _PLAIN:
                _walk(item, visitor)
    elif issubclass(kind, dict):
        for name, item in value.items():
            _walk(name, visitor)
            _walk(item, visitor)
    elif issubclass(kind, HasProps):
        _visit(value, visitor)
    else:
        for name in getattr(kind, "__dataclass_fields__", ()):
            _walk(getattr(value, name), visitor)


def _visit(value: Any, visitor: Callable[[Any], None]) -> None:
    if not isinstance(value, HasProps):
        _walk(value, visitor)
        return
    given, made = value._property_values, value._unstable_default_values
    for name, unstable in _places_of(type(value)):
        if name in given:
            _walk(given[name], visitor)
        elif name in made:
            _walk(made[name], visitor)
        elif unstable:
            _walk(getattr(value, name), visitor)


# What is made outside of a server


def before_showing(change: Callable[[Any, Any], None]) -> None:
    """Have `change` see the roots of all that Panel shows; where it cannot, they stay as made."""
    hooks = getattr(Viewable, "_preprocessing_hooks", None)
    if hooks is not None and change not in hooks:
        hooks.append(change)
