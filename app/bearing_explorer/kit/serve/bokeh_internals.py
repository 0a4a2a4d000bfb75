"""Private names of Bokeh, which make the page quicker; no other file uses any.

The list says what each name is for, measured on two busy cores, and what happens without it.

* Those in `_WALK_NAMES`, `_property_values`, `_unstable_default_values`: opening three tabs holds
  the event loop for 253 ms (`find_models_quickly`). Without: 1,231 ms.
* `_held_events`, `_new_models`, `_references`, `_subscribed_connections`, `_socket`: a change is
  one message, and a class of 20 students gets 74 pictures a second (`send_changes`). Without: 50.
* `_event_callbacks`: an event goes to its model (`dispatch_event`). Without: every model is asked.
* `_needs_document_lock`, `_needs_document_lock_on_loop`, `_current_patch_connection`: changes are
  made on the event loop (`locked`, `apply_patch`). Without: from Bokeh 3.10 on in a thread each.
* `_http`, `_tornado`: the server limits its connections (`parts_of`). Without: a proxy has to.

Any release may remove them. At the start, `missing` logs which names of the first item are gone;
the others are checked whenever they are used.

With the environment variable ``BEARING_EXPLORER_PLAIN=1`` none of them is used, nor what
`panel_internals`, `tornado_internals`, `assets/scripts/fast_figures.js` and
`bearingcore/model/_kernels/compiling.py` use: only public ways are left, which are slower and give
the same results. Figures then get their data by Bokeh's own messages, and a step of a drag takes
82 ms instead of 52 (`PackedSource`).
"""

from __future__ import annotations

import logging
import os
from collections.abc import Awaitable, Callable
from functools import cache
from importlib.metadata import version
from typing import Any

from bokeh.core.has_props import HasProps
from bokeh.core.property.bases import Property
from bokeh.core.property.descriptors import PropertyDescriptor
from bokeh.core.property.wrappers import PropertyValueContainer
from bokeh.core.serialization import Serializer
from bokeh.document import Document
from bokeh.document.events import DocumentPatchedEvent
from bokeh.model import Model, util as model_util
from bokeh.protocol.message import Message
from bokeh.protocol.messages.patch_doc import patch_doc
from bokeh.server import session as bokeh_session
from bokeh.server.session import ServerSession
from bokeh.settings import settings
from panel.models.esm import DataEvent

PLAIN = os.environ.get("BEARING_EXPLORER_PLAIN", "0") not in ("", "0")
"""True where only public ways are used."""

log = logging.getLogger(__name__)

_WALK_NAMES: tuple[tuple[Any, str], ...] = (
    (model_util, "visit_immediate_value_references"),
    (HasProps, "_overridden_defaults"),
    (HasProps, "_initialized"),
    (HasProps, "query_properties_with_values"),
    (HasProps, "themed_values"),
    (Property, "_may_have_unstable_default"),
    (PropertyDescriptor, "is_unstable"),
    (PropertyDescriptor, "has_unstable_default"),
)


def missing() -> list[str]:
    """Names for `find_models_quickly` that this version of Bokeh does not have, in sentences."""
    gone = [(owner, name) for owner, name in _WALK_NAMES if not hasattr(owner, name)]
    return [
        f"{owner.__name__}.{name} is gone from bokeh {version('bokeh')}" for owner, name in gone
    ]


# The document of a session: changed on the event loop, sent as one message


def _locked(act: Callable[..., Awaitable[None]]) -> Callable[..., Awaitable[None]]:
    """Lock a document by Bokeh's own decorator.

    The public `with_document_locked` goes through a thread each time from Bokeh 3.10 on.
    """
    known = () if PLAIN else ("_needs_document_lock_on_loop", "_needs_document_lock")
    lock = next((getattr(bokeh_session, n) for n in known if hasattr(bokeh_session, n)), None)
    if lock is not None:
        decorated: Callable[..., Awaitable[None]] = lock(act)
        return decorated

    async def locked(session: Any, *args: Any) -> None:
        await session.with_document_locked(act, session, *args)

    return locked


@_locked
def locked(session: Any, act: Callable[[Document], Awaitable[None]]) -> Awaitable[None]:
    """Let `act` change the document of a session while nothing else can."""
    return act(session.document)


async def apply_patch(message: Any, connection: Any) -> None:
    """Apply a patch of a browser on the event loop; Bokeh from 3.10 on uses a thread."""
    session = connection.session
    if PLAIN or not hasattr(session, "_current_patch_connection"):
        await ServerSession.patch(message, connection)
        return

    async def apply(document: Document) -> None:
        session._current_patch_connection = connection
        try:
            message.apply_to_document(document, session)
        finally:
            session._current_patch_connection = None

    await locked(session, apply)


def parts_of(server: Any) -> tuple[Any, Any] | None:
    """Return the Tornado application and the server under it; None where they are hidden."""
    parts = getattr(server, "_tornado", None), getattr(server, "_http", None)
    return None if PLAIN or None in parts else parts


def dispatch_event(model: Model, event: DataEvent) -> None:
    """Give an event of the browser to the callbacks of `model`.

    Bokeh would ask each model of the document whether the event is meant for it.
    """
    callbacks = None if PLAIN else getattr(model, "_event_callbacks", None)
    if callbacks is None:
        if model.document is not None:
            model.document.callbacks.trigger_event(event)
        return
    for callback in callbacks.get(DataEvent.event_name, ()):
        callback(event)


def sockets_of(session: Any) -> list[Any]:
    """Return the websockets of a session; none where they are hidden."""
    connections = () if PLAIN else tuple(getattr(session, "_subscribed_connections", ()))
    sockets = (getattr(connection, "_socket", None) for connection in connections)
    return [socket for socket in sockets if socket is not None]


async def send_changes(session: Any, document: Document, change: Callable[[], None]) -> None:
    """Run `change` and send all that it changed as one message, written when this returns.

    Without private names, Bokeh chooses the number of messages.
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
        message = _patch_of(document, patches)
        for socket in sockets:
            await socket.send_message(message)


def _patch_of(document: Document, events: list[DocumentPatchedEvent]) -> Message[Any]:
    """Make a message of `events`.

    Bokeh lists all models of the document first, to distinguish new models from those that the
    browser has. If no model is new, the models of the events are enough.
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


# A quicker search for the models of a document


def find_models_quickly() -> None:
    """Make Bokeh look for models only where models can be.

    Whenever a model is added, made or written, Bokeh walks all models, asks each for every property
    that might hold another model, and makes defaults for them. That is most of the cost of a
    session. With this function, a default is made only when somebody asks for it; the browser makes
    the others, a third of all models, with the same properties. Only values that will be written
    are asked for, facts of a class are computed once instead of once per model, and values are
    walked without an import for each.
    """
    if PLAIN or getattr(model_util, "visit_immediate_value_references", None) is _visit:
        return
    if gone := missing():
        log.warning("the quick search for models is off: %s", "; ".join(gone))
        return
    model_util.visit_immediate_value_references = _visit
    # each model would look for these in the environment
    settings.simple_ids = settings.simple_ids()
    settings.serialize_include_defaults = settings.serialize_include_defaults()
    changed = HasProps.__dict__["_overridden_defaults"].__func__
    patched: Any = HasProps
    remembering: Any = cache(changed)
    patched._overridden_defaults = classmethod(remembering)
    patched.themed_values = lambda self: vars(self).get("__themed_values__")
    patched.query_properties_with_values = _values_to_write
    descriptor: Any = PropertyDescriptor
    descriptor.has_unstable_default = _has_unstable_default


@cache
def _is_made(descriptor: PropertyDescriptor, kind: type[HasProps]) -> bool:
    """Return True if each model of a class has a default of its own."""
    changed = kind._overridden_defaults().get(descriptor.name)
    return bool(descriptor.property._may_have_unstable_default() or descriptor.is_unstable(changed))


def _has_unstable_default(self: PropertyDescriptor, obj: HasProps) -> bool:
    """Return False while a model is made: the browser makes the defaults that nobody asks for."""
    return obj._initialized is not False and _is_made(self, type(obj))


_query = HasProps.query_properties_with_values


def _values_to_write(
    self: HasProps,
    query: Callable[[PropertyDescriptor], bool],
    *,
    include_defaults: bool = True,
    include_undefined: bool = False,
) -> dict[str, Any]:
    """Return the values of the properties that `query` accepts; without defaults, only set ones.

    Bokeh gets the value of each property before it checks whether the property is set.
    """
    themed = self.themed_values()
    if include_defaults or themed is not None:
        return _query(
            self, query, include_defaults=include_defaults, include_undefined=include_undefined
        )
    set_values, defaults = self._property_values, self._unstable_default_values
    values = {}
    for name in type(self).properties(_with_props=True):
        if (name in set_values or name in defaults) and query(descriptor := self.lookup(name)):
            value = descriptor.get_value(self)
            if name not in defaults or not isinstance(value, PropertyValueContainer):
                values[name] = value
    return values


_PLAIN = frozenset({int, float, str, bool, bytes, type(None)})


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


_references: dict[type[HasProps], tuple[str, ...]] = {}


def _visit(value: Any, visitor: Callable[[Any], None]) -> None:
    """Give `visitor` the models in the properties of a model that can hold any."""
    if not isinstance(value, HasProps):
        _walk(value, visitor)
        return
    kind = type(value)
    names = _references.get(kind)
    if names is None:
        names = _references[kind] = tuple(kind.properties_with_refs())
    set_values, defaults = value._property_values, value._unstable_default_values
    for name in names:
        if name in set_values:
            _walk(set_values[name], visitor)
        elif name in defaults:
            _walk(defaults[name], visitor)
