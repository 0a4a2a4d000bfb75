"""What a browser may say: the page's own scripts decide what is needed, all else is dropped.

Bokeh trusts its browser: a message may put any model with any value into the document. Here
messages of the page's components and plain values of properties pass.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

_LONGEST_VALUE = 20_000  # characters of a changed property, written out
_PLAIN = (str, int, float, bool, type(None))
#: what says what a model does, and how the server finds it again
_NEVER = {"code", "args", "esm", "tags", "name", "js_property_callbacks", "js_event_callbacks"}
_EVENTS = {"document_ready", "data_event", "dom_event"}


def welcome(event: Any, known: Any = None) -> bool:
    """Whether an event of a browser's patch is one that the page's own scripts may send.

    Messages of the page's components and plain values of properties pass; new models, new roots,
    tables of data, titles, and code never do. `known` holds the models of the session by id.
    """
    if not isinstance(event, dict):
        return False
    if event.get("kind") == "MessageSent":
        data = event.get("msg_data")
        if event.get("msg_type") != "bokeh_event" or not isinstance(data, dict):
            return False
        return data.get("type") == "event" and _event_name(data) and _without_models(data)
    if event.get("kind") != "ModelChanged":
        return False
    model, attribute = event.get("model"), event.get("attr")
    if not (isinstance(model, dict) and set(model) == {"id"} and isinstance(attribute, str)):
        return False
    if attribute in _NEVER:
        return False
    if known is not None and not _may_change(known, model["id"], attribute):
        return False
    return _is_plain(event.get("new")) and len(json.dumps(event.get("new"))) <= _LONGEST_VALUE


def by_name(event: Any) -> Any:
    """An event whose component is called by its id alone.

    BokehJS writes a model out in full that it believes the server has not heard of yet, as after a
    tab has been added; but whatever it says of a model, the server's own is meant.
    """
    try:
        entries = event["msg_data"]["values"]["entries"]
        changed = [
            [key, {"id": value["id"]}]
            if key == "model" and value["type"] == "object"
            else [key, value]
            for key, value in entries
        ]
        values = {**event["msg_data"]["values"], "entries": changed}
    except (KeyError, TypeError, ValueError):
        return event
    return {**event, "msg_data": {**event["msg_data"], "values": values}}


def _event_name(data: Mapping[str, Any]) -> bool:
    name = data.get("name")
    return isinstance(name, str) and (name in _EVENTS or name in _POINTER_EVENTS)


#: what figures tell that somebody listens to
_POINTER_EVENTS = {
    "tap", "doubletap", "press", "pan", "panstart", "panend", "mousemove", "mouseenter",
    "mouseleave", "wheel", "reset", "selectiongeometry", "rangesupdate", "lodstart", "lodend",
    "button_click", "menu_item_click", "value_submit",
}  # fmt: skip


def _may_change(known: Any, name: Any, attribute: str) -> bool:
    model = known.get(name) if isinstance(name, str) else None
    if model is None or model.__class__.__name__ in ("CustomJS", "CustomJSHover"):
        return False
    return attribute in type(model).properties()


def _is_plain(value: Any) -> bool:
    """Numbers and words, and lists and maps of them; nothing that makes a model or an array."""
    if isinstance(value, _PLAIN):
        return True
    if isinstance(value, list):
        return len(value) <= 2000 and all(_is_plain(item) for item in value)
    if isinstance(value, dict) and value.get("type") == "number":
        return set(value) == {"type", "value"} and isinstance(value["value"], str)
    if isinstance(value, dict) and value.get("type") == "map":
        entries = value.get("entries", [])
        return isinstance(entries, list) and all(_is_plain(entry) for entry in entries)
    return False


#: what Bokeh's notation may hold in messages: plain values, maps, and the bytes of a file
_HARMLESS = {"map", "number", "event", "bytes", "ndarray"}


def _without_models(value: Any, depth: int = 0) -> bool:
    """Whether a message only refers to models, and makes none."""
    if depth > 30:
        return False
    if isinstance(value, list):
        return all(_without_models(item, depth + 1) for item in value)
    if isinstance(value, dict):
        if "type" in value and value["type"] not in _HARMLESS:
            return False
        return all(_without_models(item, depth + 1) for item in value.values())
    return isinstance(value, _PLAIN)


def message_of(event: Mapping[str, Any]) -> tuple[str, Any] | None:
    """Id of the model and plain data of a component's message; None where it is no such thing."""
    data = event.get("msg_data")
    if not isinstance(data, dict) or data.get("name") != "data_event":
        return None
    try:
        values = _read(data.get("values"))
        return str(values["model"]["id"]), values["data"]
    except (ValueError, TypeError, KeyError):
        return None


def _read(value: Any) -> Any:
    """Plain data out of Bokeh's notation; ValueError where it holds more than that."""
    if isinstance(value, list):
        return [_read(item) for item in value]
    if not isinstance(value, dict):
        return value
    kind = value.get("type")
    if kind == "map":
        return {key: _read(item) for key, item in value.get("entries", [])}
    if kind == "number":
        return float(value["value"])
    if kind is None and set(value) == {"id"}:
        return value
    raise ValueError(f"{kind} is not plain")


class ById:
    """Models of a document by id, without an error where there is none."""

    def __init__(self, models: Any) -> None:
        self._models = models

    def get(self, name: str) -> Any:
        return self._models.get_by_id(name)
