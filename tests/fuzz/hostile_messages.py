"""Messages that no page sends: of every shape, to every field, out of a number each.

A message is a list of frames of a websocket. Text goes as text, bytes as bytes, and a `Raw` frame
as it stands, with whatever opcode and flags. What is made is repeatable by the random numbers, but
for the ids of the models that a page was given.
"""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any, NamedTuple
from urllib.parse import quote

from bearing_explorer.page import SECTIONS
from bearing_explorer.state.choice_list import CHOICE_LIST
from bearing_explorer.state.quantity_list import QUANTITY_LIST

from bearingcore import catalogue, presets
from tests.fuzz.inputs import NUMBERS, TOKENS, plain_value, text_like

LARGEST = 3_500_000
"""Characters of the largest message: below what the server takes in one."""


class Raw(NamedTuple):
    """A frame with an opcode and flags of its own."""

    opcode: int
    payload: bytes
    whole: bool = True
    flags: int = 0


Frames = list[str | bytes | Raw]
Ids = Mapping[str, str]
"""Of a page's components, by the names of their classes."""


def header(kind: str = "PATCH-DOC", **more: Any) -> str:
    """The first frame of a message of Bokeh's protocol."""
    return json.dumps({"msgid": "h", "msgtype": kind, **more})


def patch(*events: Any) -> Frames:
    """Events of the document as one message."""
    return [header(), "{}", _text({"events": list(events)})]


def told(model: Any, data: Any, name: Any = "data_event") -> dict[str, Any]:
    """What a component of the page says."""
    values = {"type": "map", "entries": [["model", {"id": model}], ["data", notation(data)]]}
    event = {"type": "event", "name": name, "values": values}
    return {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}


def notation(value: Any) -> Any:
    """Plain data as the page's scripts write it: objects are maps."""
    if isinstance(value, dict):
        return {"type": "map", "entries": [[k, notation(v)] for k, v in value.items()]}
    if isinstance(value, list | tuple):
        return [notation(item) for item in value]
    return value.hex() if isinstance(value, bytes) else value


def _text(value: Any) -> str:
    text = json.dumps(value, default=repr)
    return text.encode("utf-8", "replace").decode()


# ------------------------------------------------------------------- what costs a parser much


def many(random_: random.Random, ids: Ids) -> Frames:
    """Empty events, empty lists and single signs by the million."""
    what = random_.choice(("[]", "{}", "1", '""', "null", '{"kind":"MessageSent"}', "1e999", "-0"))
    count = random_.choice((100, 4_000, 5_001, 100_000, LARGEST)) // (len(what) + 1) + 1
    body = ",".join([what] * count)
    inside = random_.choice(("events", "events", "x"))
    return [header(), "{}", f'{{"{inside}": [{body}]}}']


def deep(random_: random.Random, ids: Ids) -> Frames:
    """Lists in lists and maps in maps."""
    levels = random_.choice((31, 32, 33, 1000, 100_000, 1_000_000))
    way = random_.randrange(4)
    if way == 0:
        inner = "[" * levels + "]" * levels
    elif way == 1:
        inner = '{"a":' * levels + "1" + "}" * levels
    elif way == 2:
        inner = "[" * levels
    else:
        inner = '[{"type":"map","entries":[["a",' * (levels // 4) + "1" + "]]}]" * (levels // 4)
    return [header(), "{}", f'{{"events": {inner[:LARGEST]}}}']


def long_texts(random_: random.Random, ids: Ids) -> Frames:
    """Digits without end, escapes, signs that mean something elsewhere."""
    count = random_.choice((1_000, 30_000, 1_000_000))
    way = random_.randrange(4)
    if way == 0:
        return [header(), "{}", '{"events": [' + "9" * count + "]}"]
    sign = random_.choice(("\\\\", '\\"', "[", ",", "\\u0000", "\\ud800", "é"))
    text = sign * (count // len(sign))
    if way == 1:
        return [header(), "{}", '{"events": ["' + text + '"]}']
    if way == 2:
        return [header(), "{" + f'"{text}": 1' + "}", '{"events": []}']
    field = random_.choice(("floor", "catalogue", "open", "file", "pin"))
    body = {"name": random_.choice(TOKENS), "text": random_.choice(",;\n[=\t\"'#.") * count}
    return patch(told(ids.get(_HEARD_BY[field], "p1"), {"mark": 1, field: body}))


# ------------------------------------------------------------------- every field of the page

_QUANTITIES = [quantity.name for quantity in QUANTITY_LIST]
_TABS = [section.name for section in SECTIONS]
_HEARD_BY = {
    "floor": "Controls", "catalogue": "Controls", "open": "ShareBar", "file": "ShareBar",
    "pin": "ShareBar",
}  # fmt: skip


def _number_text(random_: random.Random) -> Any:
    return random_.choice((*NUMBERS, f"{random_.uniform(-400, 400):.6g}", "", " ", "1/0"))


def quantities(random_: random.Random) -> dict[Any, Any]:
    """Some of the quantities of a scene, with what belongs there and what does not."""
    return {
        random_.choice(_QUANTITIES): random_.choice(
            (random_.uniform(-500, 500), _number_text(random_), plain_value(random_))
        )
        for _ in range(random_.choice((1, 1, 2, 6, 40)))
    }


def _choices(random_: random.Random) -> Any:
    choice = random_.choice(CHOICE_LIST)
    options = [option.name for option in choice.options] or ["x"]
    other = {
        "name": random_.choice(TOKENS),
        "draft": "discard",
        "bearing": random_.choice((*list(catalogue())[:5], plain_value(random_))),
        "defect": random_.choice(("add", "remove", "0", "1", "99999999999", "٣")),
        "dofs": random_.choice(("auto", "x y", "x y z rx ry", "", "q")),
    }
    name = random_.choice((choice.name, *other))
    good = random_.choice(options) if name == choice.name else other[name]
    return {name: good if random_.random() < 0.7 else plain_value(random_)}


def _file(random_: random.Random) -> Any:
    return {"name": random_.choice(("a.csv", *TOKENS)), "text": hostile_text(random_)}


_COMMON: dict[str, Callable[[random.Random], Any]] = {
    "set": quantities,
    "typed": quantities,
    "choose": _choices,
    "reset": lambda r: True,
    "released": lambda r: True,
}
_FIELDS: dict[str, dict[str, Callable[[random.Random], Any]]] = {
    "Controls": {**_COMMON, "floor": _file, "catalogue": _file},
    "ShareBar": {
        **_COMMON,
        "open": _file,
        "file": _file,
        "pin": _file,
        "undo": lambda r: True,
        "redo": lambda r: True,
        "keep": lambda r: r.choice(TOKENS),
        "want": lambda r: "toml",
        "pin_here": lambda r: r.choice(TOKENS),
        "unpin": lambda r: True,
        "report": lambda r: r.choice(("http://x/", *TOKENS)),
        "title": lambda r: r.choice(TOKENS),
    },
    "LessonPanel": {
        **_COMMON,
        "lesson": lambda r: r.choice(("", *TOKENS)),
        "words_only": lambda r: True,
        "show": lambda r: r.choice(_TABS),
        "simulate": lambda r: {"noise": "20", "machine": "same", "pit": "scene"},
    },
    "Tabs": {"show": lambda r: r.choice((*_TABS, *TOKENS))},
    "PlanChoice": {
        "curve_budget": _number_text,
        "cage_angles": _number_text,
        "vibration_budget": _number_text,
        "step_rate": _number_text,
        "steady": lambda r: r.choice(("auto", "orbit", "march", *TOKENS)),
        "balls_up_to": _number_text,
        "own": lambda r: True,
    },
    "FileUpload": {
        "type": lambda r: r.choice(("begin", "piece", *TOKENS)),
        "name": lambda r: r.choice(("a.wav", "a.mat", *TOKENS)),
        "size": lambda r: r.choice((0, 1, 101, 2**20, 2**40, -1, 1.5, True, "1", None)),
        "content": plain_value,
        "of": lambda r: r.choice((0, 1, 2, -1, True, [1], 2**70)),
    },
}


def fields(random_: random.Random, ids: Ids) -> Frames:
    """Each field that the page takes, with what belongs there and what does not."""
    component = random_.choice([name for name in _FIELDS if name in ids] or ["Controls"])
    known = _FIELDS[component]
    names = random_.sample(list(known), min(random_.choice((1, 1, 2, 4)), len(known)))
    data: dict[str, Any] = {
        name: known[name](random_) if random_.random() < 0.5 else plain_value(random_)
        for name in names
    }
    data["mark"] = random_.choice((1, 7, 2**24, -1, True, plain_value(random_)))
    said: Any = data if random_.random() < 0.95 else plain_value(random_)
    return patch(told(ids.get(component, "p1"), said))


def wrong_ids(random_: random.Random, ids: Ids) -> Frames:
    """What is right elsewhere: said by other models, of other kinds, or by none."""
    name = random_.choice(
        (*ids.values(), f"p{random_.randrange(1000, 4000)}", "", "p1", 1, None, {"id": "p1"}, ["x"])
    )
    way = random_.randrange(4)
    if way == 0:
        event = told(name, {"mark": 1, "set": quantities(random_)})
        return patch(event)
    if way == 1:
        attribute = random_.choice(
            ("inner_width", "data", "visible", "code", "args", "tags", "children", "state", "text",
             "syncable", "subscribed_events", "name", "start", "end", "esm", "stylesheets")
        )  # fmt: skip
        new = notation(plain_value(random_))
        return patch({"kind": "ModelChanged", "model": {"id": name}, "attr": attribute, "new": new})
    if way == 2:
        events = ("document_ready", "dom_event", "tap", "button_click", "data_event", "x", 1, None)
        return patch(told(name, plain_value(random_), random_.choice(events)))
    kinds = ("RootAdded", "RootRemoved", "TitleChanged", "ColumnDataChanged", "ColumnsStreamed",
             "ColumnsPatched", "x", None, 1)  # fmt: skip
    made = {"type": "object", "name": "CustomJS", "id": "n1", "attributes": {"code": "x"}}
    event = {"kind": random_.choice(kinds), "model": random_.choice((made, {"id": name})),
             "attr": "data", "data": notation(plain_value(random_)), "title": "x"}  # fmt: skip
    return patch(event)


def pieces(random_: random.Random, ids: Ids) -> list[Frames]:
    """An upload in wrong pieces and orders: several messages, with blocks of bytes."""
    panel = ids.get("FileUpload", "p1")
    size = random_.choice((1, 64, 5_000, 2**20, 2**20 + 7))
    name = random_.choice(("a.wav", "b.mat", "c.csv"))
    begun = patch(told(panel, {"type": "begin", "name": name, "size": size}))
    made = [begun] if random_.random() < 0.8 else []
    left = size
    for _ in range(random_.choice((1, 2, 4))):
        length = random_.choice((left, left, 0, 1, min(2 * left, 2**20), 2**20 + 1))
        block = random_.randbytes(min(length, 2**20 + 1))
        left = max(left - length, 0)
        data = random_.choice(
            (
                {"type": "bytes", "data": {"id": "b1"}},
                {"type": "bytes", "data": {"id": "other"}},
                {"type": "bytes", "data": "!"},
                {"type": "ndarray", "array": {"type": "bytes", "data": {"id": "b1"}},
                 "dtype": random_.choice(("uint8", "object", "float64", 1)),
                 "shape": random_.choice(([length], [10**9], [-1], "x")), "order": "little"},
            )
        )  # fmt: skip
        of = random_.choice((1, 1, 1, 0, 2, True))
        message = {"type": "map", "entries": [["type", "piece"], ["content", data], ["of", of]]}
        values = {"type": "map", "entries": [["model", {"id": panel}], ["data", message]]}
        event = {"kind": "MessageSent", "msg_type": "bokeh_event",
                 "msg_data": {"type": "event", "name": "data_event", "values": values}}  # fmt: skip
        blocks = random_.choice((1, 1, 1, 0, 2))
        frames: Frames = [header(num_buffers=blocks), "{}", _text({"events": [event]})]
        for number in range(random_.choice((blocks, blocks, 0, 1))):
            frames += ['{"id": "b1"}' if number == 0 else "{}", block]
        made.append(frames)
    random_.shuffle(made)
    return made


# ------------------------------------------------------------------- frames and their bytes


def framing(random_: random.Random, ids: Ids) -> Frames:
    """Frames of Bokeh's protocol that are missing, too many, or not what they say."""
    good: Frames = [header(), "{}", '{"events": []}']
    way = random_.randrange(6)
    if way == 0:
        kinds = ("PUSH-DOC", "SERVER-INFO-REQ", "OK", "ERROR", "ACK", "", "patch", "PULL-DOC-REPLY")
        return [header(random_.choice(kinds)), "{}", random_.choice(("{}", "[]", "1", "null"))]
    if way == 1:
        count = random_.choice((1, -1, 10**9, "x", 1.5, None, [1]))
        return [header(num_buffers=count), "{}", '{"events": []}', '{"id": "a"}', b"abc"]
    if way == 2:
        return [*good[: random_.randrange(3)], random_.choice(("", "x", "{", "[1]", "null"))]
    if way == 3:
        frames = list(good)
        frames[random_.randrange(3)] = _sayable(text_like(random_, [str(g) for g in good]))
        return frames
    if way == 4:
        return [header(msgid=random_.choice((None, 1, [1], "x" * 10_000))), *good[1:]]
    return [random_.choice(("", "{}", "[]", "null", '{"msgtype": "PATCH-DOC"}')), *good[1:]]


def not_text(random_: random.Random, ids: Ids) -> Frames:
    """Bytes that are no UTF-8, binary frames where text belongs, and frames that are no frames."""
    noise = random_.randbytes(random_.choice((1, 30, 70_000)))
    way = random_.randrange(7)
    if way == 0:
        return [Raw(1, b'{"msgid": "\xff\xfe"}')]
    if way == 1:
        return [header(), "{}", Raw(1, b'{"events": ["\xc3\x28\xed\xa0\x80"]}')]
    if way == 2:
        return [noise]
    if way == 3:
        return [header().encode(), b"{}", b'{"events": []}']
    if way == 4:
        return [Raw(random_.choice((3, 7, 0xB, 0xF)), noise[:100])]
    if way == 5:
        return [Raw(0, b"goes on with nothing"), Raw(1, b"{", whole=False), Raw(1, b"}")]
    return [Raw(1, b"{}", flags=random_.choice((0x40, 0x20, 0x10))), Raw(9, noise[:200])]


# ------------------------------------------------------------------- files


@cache
def _good_texts() -> tuple[str, ...]:
    scenes = [scene.to_toml() for scene in list(presets.values())[:4]]
    floor = "\n".join(f"{k * 0.5} {20 + 5 * (k % 7)}" for k in range(60))
    table = "name,balls,ball_diameter_mm,pitch_diameter_mm\na,9,7.94,39.04"
    return (*scenes, floor, table, "?v=1&preset=fan-rig&extent=0.3", "v=1&" + quote(scenes[0][:99]))


def _ways(random_: random.Random) -> Sequence[str]:
    """Texts that cost a reader much, none longer than a message may be."""
    n = random_.choice((50, 2_000, 90_000))
    return (
        "a = " + "[" * n,
        "a = " + "[" * n + "]" * n,
        "a = " + "{b=" * n + "1" + "}" * n,
        "a." * n + "b = 1",
        f"[{'a.' * (n - 1)}a]\n" * 3,
        "[a]\n" * n,
        "[[a]]\n" * n,
        "".join(f"k{i} = 1\n" for i in range(n)),
        "shaft_speed = " + "9" * n,
        "shaft_speed = 0x" + "f" * n,
        "shaft_speed = 1" + "_1" * n,
        "shaft_speed = 1e" + "9" * min(n, 5000),
        'a = """' + '"' * n,
        'a = "' + "\\u0041" * n + '"',
        "\n" * n,
        "1,2\n" * n,
        "1;" * n,
        ",".join("1" * 9 for _ in range(n)),
        "\x00" * n,
        "name,balls\n" + "a,9\n" * n,
        "1e400 -1e400\nnan inf\n",
        "2026-11-22T00:00:00 1\n" * (n // 10),
    )


def hostile_text(random_: random.Random) -> str:
    """The text of a scene, a floor, a list of bearings or a link, with something wrong."""
    if random_.random() < 0.6:
        return _sayable(text_like(random_, _good_texts()))
    return random_.choice(_ways(random_))


def files(random_: random.Random, ids: Ids) -> Frames:
    """Texts to be opened, pinned, or read as a floor or a list of bearings."""
    field = random_.choice(list(_HEARD_BY))
    body = {"name": random_.choice(("a.toml", *TOKENS)), "text": hostile_text(random_)}
    return patch(told(ids.get(_HEARD_BY[field], "p1"), {"mark": 3, field: body}))


def burst(random_: random.Random, ids: Ids) -> list[Frames]:
    """A slider that nobody could move so fast, and all that can be asked for between."""
    controls, share = ids.get("Controls", "p1"), ids.get("ShareBar", "p1")
    made = []
    for number in range(random_.choice((5, 20))):
        way = random_.random()
        if way < 0.7:
            values = {"extent_deg": random_.uniform(0, 90), "fy_n": random_.uniform(-200, 0)}
            made.append(patch(told(controls, {"mark": number, "set": values})))
        elif way < 0.85:
            made.append(
                patch(told(share, {"mark": number, random_.choice(("undo", "redo")): True}))
            )
        else:
            made.append(patch(told(ids.get("Tabs", "p1"), {"show": random_.choice(_TABS)})))
    return made


def _sayable(text: str) -> str:
    return text.encode("utf-8", "replace").decode()


SHAPES: dict[str, tuple[Callable[..., Any], int]] = {
    "fields": (fields, 30),
    "wrong ids": (wrong_ids, 15),
    "framing": (framing, 12),
    "files": (files, 10),
    "not text": (not_text, 10),
    "burst": (burst, 1),
    "pieces": (pieces, 5),
    "deep": (deep, 5),
    "many": (many, 4),
    "long texts": (long_texts, 3),
}
"""Who makes them, and how often of a hundred."""


def any_shape(random_: random.Random) -> str:
    """The name of one, as often as they are to come."""
    names = list(SHAPES)
    return random_.choices(names, [SHAPES[name][1] for name in names])[0]


def made(random_: random.Random, shape: str, ids: Ids) -> list[Frames]:
    """The messages of one try of a shape."""
    messages = SHAPES[shape][0](random_, ids)
    several = bool(messages) and isinstance(messages[0], list)
    return messages if several else [messages]
