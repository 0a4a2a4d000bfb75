"""Keeping a dragged page lively: newest inputs win, small frames leave at once.

The one place that touches private attributes of Bokeh and Panel; `tests/app/test_live.py`
and `tests/browser/test_wire.py` notice when an upgrade moves them.
"""

from __future__ import annotations

import asyncio
import logging
import os
from collections.abc import Awaitable, Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, nullcontext, suppress
from functools import cache
from typing import Any, Generic, TypeVar

from bokeh.core.has_props import HasProps
from bokeh.core.property.descriptors import PropertyDescriptor
from bokeh.core.serialization import Serializer
from bokeh.document import Document
from bokeh.document.events import DocumentPatchedEvent
from bokeh.model import util as model_util
from bokeh.protocol.message import Message
from bokeh.protocol.messages.patch_doc import patch_doc
from bokeh.server import session as bokeh_session
from panel.custom import JSComponent
from panel.io import document as panel_document
from panel.io.state import set_curdoc
from panel.models.esm import DataEvent
from tornado.iostream import StreamClosedError

log = logging.getLogger(__name__)

Inputs = TypeVar("Inputs")
Result = TypeVar("Result")

_CORES = os.cpu_count() or 2
#: threads shared by all sessions; kernels release the interpreter lock, so they do run together
_THREADS = ThreadPoolExecutor(_CORES, "compute")
#: others for what takes long, or a few sessions that simulate would keep all others from dragging
_SLOW_THREADS = ThreadPoolExecutor(max(1, _CORES // 2), "compute-slow")


async def in_thread(function: Callable[..., Result], *args: object, slow: bool = False) -> Result:
    """Run `function` off the event loop, in the threads that all sessions share."""
    threads = _SLOW_THREADS if slow else _THREADS
    return await asyncio.get_running_loop().run_in_executor(threads, function, *args)


#: how to say a last word on the page of a document whose session ends
good_byes: dict[Any, Callable[[str], Awaitable[None]]] = {}


class LiveComponent(JSComponent):
    """A component that hears and says much, at a tenth of what Panel's own ways cost.

    Panel counts a session as busy while it handles a message, and tells all of its models so; and
    it compares, links and walks models at each change of a parameter. Here messages are simply
    handed on, and `put` writes to the browser's models.
    """

    def put(self, **values: Any) -> None:
        """Give parameters new values. They show in the browser; before it is there they wait.

        Call it on the event loop of the session, inside `one_message`.
        """
        models = {id(model): model for model, _ in self._models.values()}
        if not models:
            self.param.update(**values)
        for model in models.values():
            changed = {name: v for name, v in values.items() if getattr(model.data, name) != v}
            if changed:
                model.data.update(**changed)

    def _process_bokeh_event(self, doc: Document, event: Any) -> None:
        if not isinstance(event, DataEvent):
            super()._process_bokeh_event(doc, event)
            return

        def hear() -> None:
            for heard in self._msg__callbacks:
                heard(event)

        on_loop(doc, hear)


def on_loop(doc: Document | None, act: Callable[[], None]) -> None:
    """Have `act` happen on the event loop of a session: now where this is it, else soon.

    From 3.10 on Bokeh hands over in threads, which have no loop, what a browser says.
    """
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        assert doc is not None

        async def soon() -> None:
            with set_curdoc(doc):
                act()

        doc.add_next_tick_callback(soon)
    else:
        with set_curdoc(doc) if doc is not None else nullcontext():
            act()


@getattr(bokeh_session, "_needs_document_lock_on_loop", bokeh_session._needs_document_lock)
def locked(session: Any, act: Callable[[Document], Awaitable[None]]) -> Awaitable[None]:
    """Let `act` change the document of a session, while nobody else does.

    Bokeh's own `with_document_locked` takes, from 3.10 on, a way through a thread each time.
    """
    return act(session.document)


async def hand_on(session: Any, model: Any, data: Any) -> None:
    """Give a message of the browser to the component that `model` shows.

    Bokeh would list all models of the document to read it, and ask each whether it is meant.
    """

    async def act(document: Document) -> None:
        event = DataEvent(model, data)
        with set_curdoc(document):
            for heard in model._event_callbacks.get(DataEvent.event_name, ()):
                heard(event)

    await locked(session, act)


class LatestWins(Generic[Inputs]):
    """One worker that always works on the newest inputs and drops what they overtook.

    Slider events come faster than scenes can be drawn. A queue would grow into a tail that
    moves on after the hand has stopped; here at most one set of inputs waits.
    """

    def __init__(
        self,
        work: Callable[[Inputs], Awaitable[None]],
        failed: Callable[[Exception], Awaitable[None]] | None = None,
    ) -> None:
        self._work = work
        self._failed = failed
        self._newest: list[Inputs] = []
        self._task: asyncio.Task[None] | None = None
        self._stopped = False

    @property
    def waiting(self) -> bool:
        """Whether newer inputs wait than those at work."""
        return bool(self._newest)

    def newest(self, inputs: Inputs) -> Inputs:
        """The newest inputs there are in place of `inputs`, from any thread.

        Where many sessions wait for their turn, a hand has moved on meanwhile.
        """
        waiting = self._newest
        try:
            return waiting.pop()
        except IndexError:
            return inputs

    @property
    def idle(self) -> bool:
        """Whether all that was submitted has been worked on or overtaken."""
        return not self._newest and (self._task is None or self._task.done())

    async def finished(self) -> None:
        """Wait until all that was submitted has been worked on or overtaken."""
        while self._task is not None and not self._task.done():
            await asyncio.wait({self._task})

    def submit(self, inputs: Inputs) -> None:
        """Take these inputs as the newest. Call it on the event loop of the session."""
        if self._stopped:
            return
        self._newest = [inputs]
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._run())

    def stop(self) -> None:
        """Take no more inputs; the session is gone."""
        self._stopped = True
        self._newest = []
        if self._task is not None:
            self._task.cancel()

    async def _run(self) -> None:
        while True:
            try:
                inputs = self._newest.pop()
            except IndexError:
                return
            try:
                await self._work(inputs)
            except Exception as error:
                log.exception("drawing a scene failed")
                if self._failed is not None:
                    await self._failed(error)


async def one_message(
    doc: Document | None, change: Callable[[], None], new_models: bool = False
) -> None:
    """Run `change`, which changes models of `doc`, and send all its changes as one message.

    For tasks of the event loop, which hold no lock on the document. The lock is taken and held
    until the message is written, so messages arrive in the order of the changes. Panel's own
    ``unlocked`` does not promise that: where two of its writes meet, the second may lie about
    until a third comes, and the last position of a slider would not be drawn.

    With `new_models` Bokeh counts the models of the document once, after all of the change.
    """
    session = getattr(getattr(doc, "session_context", None), "session", None)
    if doc is None or session is None:
        change()
        return

    async def act(document: Document) -> None:
        callbacks = document.callbacks
        document.hold("combine")
        try:
            with set_curdoc(document), document.models.freeze() if new_models else nullcontext():
                change()
        finally:
            held = list(callbacks._held_events)
            patches = [event for event in held if isinstance(event, DocumentPatchedEvent)]
            callbacks._held_events = [event for event in held if event not in patches]
            document.unhold()
        connections = tuple(session._subscribed_connections)
        if patches and connections:
            message = _patch_of(document, patches)
            for connection in connections:
                await connection._socket.send_message(message)

    await locked(session, act)


def _patch_of(document: Document, events: list[DocumentPatchedEvent]) -> Message[Any]:
    """A message that tells of `events`.

    Bokeh lists all models of the document first, so as to tell new ones from those that the
    browser has. Where there are none new, those that the events are about will do.
    """
    if not document.models._new_models:
        known = {model for event in events if (model := getattr(event, "model", None)) is not None}
        serializer = Serializer(references=known)
        content = {"events": serializer.encode(events)}
        if len(serializer._references) == len(known):
            message: Message[Any] = patch_doc(patch_doc.create_header(), {}, content)
            message.add_buffers(*serializer.buffers)
            return message
    return patch_doc.create(events)


def send_at_once(doc: Document | None) -> int:
    """Set TCP_NODELAY on the websockets of `doc`; return how many there were.

    A Bokeh message is several small frames; without this the kernel holds them back until
    the browser acknowledges the one before (about 30 ms a drawing).
    """
    context = getattr(doc, "session_context", None)
    session = getattr(context, "session", None)
    count = 0
    for connection in getattr(session, "_subscribed_connections", ()):
        socket = getattr(connection, "_socket", None)
        if socket is not None and getattr(socket, "ws_connection", None) is not None:
            socket.set_nodelay(True)
            count += 1
    return count


@contextmanager
def one_write(handler: Any) -> Iterator[None]:
    """Gather what a websocket writes and hand it to the system at once.

    A message of Bokeh is five frames or more; each would be a call of the system of its own, which
    is most of what a small message costs.
    """
    connection: Any = getattr(handler, "ws_connection", None)
    stream = getattr(connection, "stream", None)
    if stream is None or isinstance(stream, _Gathered):
        yield
        return
    gathered = connection.stream = _Gathered(stream)
    try:
        yield
    finally:
        connection.stream = stream
        gathered.write_all()


class _Gathered:
    """Stands for a stream; what is written waits."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream
        self._parts: list[bytes] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, data: bytes) -> asyncio.Future[None]:
        self._parts.append(bytes(data))
        done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        done.set_result(None)
        return done

    def write_all(self) -> None:
        if self._parts:
            with suppress(StreamClosedError):
                self._stream.write(b"".join(self._parts))


def collect_elsewhere(ask: Callable[[], None]) -> None:
    """Have Panel ask for a garbage collection after a session, where it would do it on the spot."""
    panel_document._garbage_collect = ask


def visit_quickly() -> None:
    """Have Bokeh look for models only where models can be.

    It walks all models whenever one is added, and asks each for the value of every property that
    might hold another, making up defaults that never hold one. That is most of what a session
    costs. Here defaults are asked for only where they are made anew for each model; and what
    Bokeh works out about a class for each of its models is worked out once.
    """
    if model_util.visit_immediate_value_references is _visit:
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


_walk = model_util.visit_value_and_its_immediate_references
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
