"""Messages that no page sends, each made out of a random number: broken versions of good ones.

`GOOD` is the schema of the messages that the page's scripts send; tests of good messages and of
hostile ones take them from here. A message is a list of frames of a websocket: text or bytes.
"""

import copy
import json
import random
from collections.abc import Callable, Mapping
from typing import Any

from bearing_explorer.explorer.state.choice_list import CHOICE_LIST
from bearing_explorer.explorer.state.field_values import SHOWN_FIELDS
from bearing_explorer.page import SECTIONS

from tests.fuzz.inputs import NUMBERS, TOKENS, plain_value, text_like
from tests.helpers.page_client import message

LARGEST = 3_500_000
"""Characters of the largest message: below what the server takes in one."""

_FILE = {"name": "a.csv", "text": "0 1\n1 2\n2 3"}

GOOD: tuple[tuple[str, dict[str, Any]], ...] = (
    *(("Controls", {"mark": 1, "set": {field.key: 1.0}}) for field in SHOWN_FIELDS),
    *(("Controls", {"mark": 1, "typed": {field.key: "1.5"}}) for field in SHOWN_FIELDS),
    *(
        ("Controls", {"mark": 1, "choose": {choice.name: option.name}})
        for choice in CHOICE_LIST
        for option in choice.options
    ),
    *(("Tabs", {"show": section.name}) for section in SECTIONS),
    ("Controls", {"mark": 1, "choose": {"defect": "add"}}),
    ("Controls", {"mark": 1, "reset": True, "released": True}),
    ("Controls", {"search": "62"}),
    ("ShareBar", {"mark": 1, "open": _FILE}),
    ("ShareBar", {"mark": 1, "compare": _FILE}),
    ("ShareBar", {"mark": 1, "undo": True}),
    ("ShareBar", {"mark": 1, "redo": True, "compare_here": "a", "number": 0, "remove": True}),
    ("ShareBar", {"keep": "a", "want": "toml", "title": "a"}),
    ("ShareBar", {"report": "http://localhost/"}),
    ("LessonPanel", {"mark": 1, "lesson": "a", "words_only": True, "show": "load"}),
    ("LessonPanel", {"mark": 1, "simulate": {"noise": "20"}}),
    ("FileUpload", {"type": "begin", "name": "a.wav", "size": 64}),
    ("FileUpload", {"type": "piece", "of": 1, "content": "00"}),
)
"""Components of the page, by the names of their classes, and what their scripts send."""


Frames = list[str | bytes]
Ids = Mapping[str, str]
"""Of a page's components, by the names of their classes."""


def header(kind: str = "PATCH-DOC", **more: Any) -> str:
    """The first frame of a message of Bokeh's protocol."""
    return json.dumps({"msgid": "h", "msgtype": kind, **more})


def patch(*events: Any) -> Frames:
    """Events of the document as one message."""
    text = json.dumps({"events": list(events)}, default=repr)
    return [header(), "{}", text.encode("utf-8", "replace").decode()]


def component_event(model: Any, data: Any, name: Any = "data_event") -> dict[str, Any]:
    """A message of a component's script."""
    return message(name, model={"id": model}, data=data)


def broken(random_: random.Random, value: Any) -> Any:
    """A copy of plain data in which one thing is another."""
    if random_.random() < 0.4 or not isinstance(value, dict | list) or not value:
        number = random_.choice((*NUMBERS, f"{random_.uniform(-400, 400):.6g}"))
        return random_.choice((number, random_.choice(TOKENS), plain_value(random_)))
    copied = copy.copy(value)
    key = random_.choice(list(value)) if isinstance(value, dict) else random_.randrange(len(value))
    copied[key] = broken(random_, value[key])
    return copied


def quantities(random_: random.Random) -> dict[Any, Any]:
    """Some of the quantities of a scene, with what belongs there and what does not."""
    names = [random_.choice(SHOWN_FIELDS).key for _ in range(random_.choice((1, 2, 6, 40)))]
    return {
        name: random_.choice((random_.uniform(-500, 500), broken(random_, 1.0))) for name in names
    }


def fields(random_: random.Random, ids: Ids) -> Frames:
    """A message of the page in which something is broken, or nothing."""
    component, data = random_.choice(GOOD)
    if random_.random() < 0.3:
        component, data = "Controls", {"mark": 1, "set": quantities(random_)}
    for _ in range(random_.choice((0, 1, 1, 3))):
        data = broken(random_, data)
    return patch(component_event(ids.get(component, "p1"), data))


def wrong_events(random_: random.Random, ids: Ids) -> Frames:
    """Good events of other models and kinds; new models, code, tables of data."""
    made = {"type": "object", "name": "CustomJS", "id": "n1", "attributes": {"code": "x"}}
    name = random_.choice((*ids.values(), f"p{random_.randrange(1000, 4000)}", "", None, ["x"]))
    new = random_.choice(
        (made, [made], {"type": "ndarray", "shape": [10**9]}, 1, plain_value(random_))
    )
    names = ("tap", "document_ready", "data_event", "x")
    kinds = ("RootAdded", "RootRemoved", "TitleChanged", "ColumnDataChanged", "ColumnsPatched", "x")
    attributes = [
        "inner_width",
        "data",
        "visible",
        "code",
        "args",
        "tags",
        "children",
        "state",
        "esm",
    ]
    event = random_.choice(
        (
            {"kind": random_.choice(kinds), "model": random_.choice((made, {"id": name}))},
            {"kind": "ModelChanged", "model": {"id": name}, "attr": random_.choice(attributes)},
            component_event(name, new, random_.choice((*names, None))),
        )
    )
    return patch({"attr": "data", "data": new, "new": new, "title": "x", **event})


def large(random_: random.Random, ids: Ids) -> Frames:
    """Megabytes of empty events, lists in lists, digits, escapes and texts."""
    count = random_.choice((100, 5_000, 100_000, LARGEST))
    item = random_.choice(("[]", "{}", "1", '""', '{"kind":"MessageSent"}', "1e999"))
    sign = random_.choice(("\\\\", '\\"', "[", ",", "\\u0000", "\\ud800"))
    text = random_.choice(",;\n[=\t\"'#.") * count
    way = random_.randrange(6)
    bodies = (
        ",".join([item] * (count // (len(item) + 1) + 1)),
        "[" * (count // 2) + "]" * (count // 2),
        '{"a":' * (count // 6) + "1" + "}" * (count // 6),
        "9" * count,
        '"' + sign * (count // len(sign)) + '"',
    )
    if way < len(bodies):
        return [header(), "{}", f'{{"events": [{bodies[way]}]}}']
    opened = {"mark": 1, "open": {"name": "a", "text": text}}
    return patch(component_event(ids.get("ShareBar", "p1"), opened))


def framing(random_: random.Random, ids: Ids) -> Frames:
    """Frames that are missing, too many, no text, or not what they say."""
    good: Frames = [header(), "{}", '{"events": []}']
    noise = random_.randbytes(random_.choice((1, 30, 70_000)))
    kinds = ("PUSH-DOC", "SERVER-INFO-REQ", "OK", "ERROR", "ACK", "", "patch", "PULL-DOC-REPLY")
    buffers = random_.choice((1, 2, -1, 10**9, "x", None))
    mutated = text_like(random_, [str(frame) for frame in good]).encode("utf-8", "replace").decode()
    return random_.choice(
        (
            [header(random_.choice(kinds)), "{}", random_.choice(("{}", "[]", "null"))],
            [header(num_buffers=buffers), "{}", '{"events": []}', '{"id": "a"}', noise],
            [*good[: random_.randrange(3)], mutated],
            [header(msgid=random_.choice((None, [1], "x" * 10_000))), *good[1:]],
            [noise],
            [header("PULL-DOC-REQ"), "{}", "{}"],
        )
    )


def upload(random_: random.Random, ids: Ids) -> Frames:
    """A piece of a file with blocks of bytes that are there, or are not."""
    block = random_.randbytes(random_.choice((0, 1, 5_000, 2**20)))
    data = random_.choice(({"id": "b1"}, {"id": "other"}, "!", None))
    piece = {"type": "piece", "of": 1, "content": {"type": "bytes", "data": data}}
    event = component_event(ids.get("FileUpload", "p1"), piece)
    frames = [header(num_buffers=random_.choice((0, 1, 1, 2))), *patch(event)[1:]]
    return [*frames, '{"id": "b1"}', block]


SHAPES: dict[str, tuple[Callable[[random.Random, Ids], Frames], int]] = {
    "fields": (fields, 55),
    "wrong events": (wrong_events, 15),
    "framing": (framing, 18),
    "upload": (upload, 6),
    "large": (large, 6),
}
"""Makers of the messages, and their shares in a hundred."""


def any_shape(random_: random.Random) -> str:
    """The name of one, as often as they are to come."""
    names = list(SHAPES)
    return random_.choices(names, [SHAPES[name][1] for name in names])[0]
