"""The messages that the server takes from a browser: those that the page's own scripts send.

Bokeh trusts its browser: a message may put any model with any value into the document. This server
accepts messages to existing components, and plain values for properties of existing models. It
drops new models, new roots, tables of data, and code.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping
from typing import Any

MOST_EVENTS = 100
"""Largest number of events in a message."""
_MOST_ITEMS = 5_000
"""Largest number of values in an event."""
_DEEPEST = 30
"""Greatest depth of lists in lists."""
_PLAIN = (str, int, float, bool, type(None))
_NEVER = {
    "code", "args", "esm", "tags", "name", "js_property_callbacks", "js_event_callbacks",
    "options", "labels",
}  # fmt: skip
"""Properties that say what a model does or offers, or by which the server finds it."""
_EVENTS = {
    "document_ready", "dom_event", "tap", "doubletap", "press", "pan", "panstart", "panend",
    "mousemove", "mouseenter", "mouseleave", "wheel", "reset", "selectiongeometry", "rangesupdate",
    "lodstart", "lodend", "button_click", "menu_item_click", "value_submit",
}  # fmt: skip


def is_costly(text: str) -> bool:
    """True if parsing a frame would delay all sessions: 2.6 s for a million empty lists.

    Strings do not count: text that people wrote may hold any number of commas and brackets.
    """
    if len(text) < 20 * _MOST_ITEMS:
        return False
    if text.count('"') > 4 * _MOST_ITEMS:
        return True
    rest = _STRING.sub("", text)
    return sum(map(rest.count, ",[{")) > _MOST_ITEMS


_STRING = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"')


def component_message(event: Any, buffers: Mapping[str, bytes]) -> tuple[str, Any] | None:
    """Return the id of a model, and the plain data that a component's script sends it.

    None if `event` is no such message; ValueError if its data are not plain. `buffers` are
    the blocks of bytes that belong to the message, by their ids.
    """
    data = event.get("msg_data") if isinstance(event, dict) else None
    if not isinstance(data, dict) or data.get("name") != "data_event":
        return None
    try:
        # BokehJS writes a model in full if it takes it for a new one; the id is enough
        values = dict(data["values"]["entries"])
        return str(values["model"]["id"]), _Reader(buffers).read(values["data"])
    except (TypeError, KeyError) as error:
        raise ValueError("the message is of another form") from error


def name_model_by_id(event: Any) -> Any:
    """Return an event that names its model by the id alone.

    BokehJS writes a model in full if it takes it for a new one, as after a tab has been added.
    """
    try:
        values = event["msg_data"]["values"]
        entries = [[k, {"id": v["id"]} if k == "model" else v] for k, v in values["entries"]]
        data = {**event["msg_data"], "values": {**values, "entries": entries}}
    except (KeyError, TypeError, ValueError):
        return event
    return {**event, "msg_data": data}


def is_allowed(event: Any, models: Any) -> bool:
    """Return True if an event that is no message to a component may reach the document.

    `models` are the models of the document (`Document.models`).
    """
    kind = event.get("kind") if isinstance(event, dict) else None
    if kind == "MessageSent" and set(event) == {"kind", "msg_type", "msg_data"}:
        data = event["msg_data"]
        if not isinstance(data, dict) or set(data) != {"type", "name", "values"}:
            return False
        return data["type"] == "event" and data["name"] in _EVENTS and _is_plain(data["values"])
    if kind == "ModelChanged" and set(event) == {"kind", "model", "attr", "new"}:
        reference, attribute = event["model"], event["attr"]
        if not isinstance(reference, dict) or set(reference) != {"id"} or attribute in _NEVER:
            return False
        model = models.get_by_id(reference["id"])
        known = model is not None and attribute in type(model).properties()
        return known and _is_plain(event["new"]) and _is_offered(model, attribute, event["new"])
    return False


def _is_offered(model: Any, attribute: str, new: Any) -> bool:
    """Return True if a choice is in its list; Panel raises for any other."""
    offers = type(model).properties()
    if attribute == "value" and "options" in offers:
        groups = model.options.values() if isinstance(model.options, dict) else [model.options]
        options = [option for group in groups for option in group]
        return new in [option[0] if isinstance(option, tuple) else option for option in options]
    if attribute == "active" and "labels" in offers:
        chosen = new if isinstance(new, list) else [new]
        return all(type(i) is int and 0 <= i < len(model.labels) for i in chosen)
    return True


def _is_plain(value: Any) -> bool:
    """Return True if a value only refers to models, and makes none."""
    try:
        _Reader({}).read(value)
    except (ValueError, TypeError):
        return False
    return True


class _Reader:
    """Reads plain data from Bokeh's notation; ValueError for other data, or for too much."""

    def __init__(self, buffers: Mapping[str, bytes]) -> None:
        self._buffers = buffers
        self._left = _MOST_ITEMS

    def read(self, value: Any, depth: int = 0) -> Any:
        """Return lists, maps, numbers, texts, bytes and references to models."""
        self._left -= 1
        if self._left < 0 or depth > _DEEPEST:
            raise ValueError("it holds too much")
        if isinstance(value, _PLAIN):
            return value
        if isinstance(value, list):
            return [self.read(item, depth + 1) for item in value]
        kind = value.get("type")
        if kind == "map":
            entries = value.get("entries", [])
            return {key: self.read(item, depth + 1) for key, item in entries}
        if kind == "number":
            return float(value["value"])
        if kind == "bytes":
            return self._bytes(value["data"])
        if kind is None and set(value) == {"id"}:
            return value
        raise ValueError(f"{kind} is not plain")

    def _bytes(self, data: Any) -> bytes:
        if isinstance(data, str):
            return base64.b64decode(data, validate=True)
        return self._buffers[data["id"]]
