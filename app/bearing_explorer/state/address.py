"""A scene as the text behind the question mark of the page's address, and back.

    v=1&preset=fan-rig&extent_deg=38.6&fy_n=-120&tab=stiffness&cage_angle_deg=12.5

The text says what differs from a preset, under the names and in the units of the page: so a person
can read it, change a number by hand and see in a mail what a link is about. One packed word would
be hardly shorter, as most scenes differ from a preset in two or three numbers, and could not
be mended. Only the points of a measured floor are packed.

The rules of version 1, which later versions go on reading:

- `v` is 1, `preset` a name of `bearingcore.presets`. What follows is left out where it is as in the
  preset; so the numbers of a preset must not change (a test holds them).
- A number is in the unit of its name, or in SI with ``SI`` behind it where no number in that unit
  stands for the very same scene. ``none`` is an optional number left open. Whatever is written is
  read back to the last bit.
- Of several defects (`defects` says how many) the second has its names behind ``defect2.``, and so
  on; each says what differs from the first defect of the preset. `selected` is the one the sliders
  move.
- `race`, `edge`, `law`, `balls`, `dofs` (``auto`` or names with dots between) are words. `floor` is
  ``flat``, ``rough`` with its three numbers, ``measured`` with `points`, or ``left-out``: it was
  too long for an address.
- `rows` is ``one``, or of each row place, facing, clearance, offset and turn in SI with ``_``
  between them, and ``~`` between rows; behind them what a row has of its own: contact angle, number
  of balls, ball and pitch diameter, inner and outer groove radius, nothing between the ``_`` of one
  it has not, and none of the last ones. `name` is what a person calls the bearing.
- `tab` and `cage_angle_deg` are where and when one looks, `lesson` the name of the one that is
  open; alone it stands for the scene that the lesson begins with.
- `points` is base64url of zlib of the points' places and then depths, as little-endian doubles
  whose first bytes all come first, then all second ones: neighbours have their first bytes alike.

An address is not trusted: it is never evaluated, its length and what unpacks from it are
bounded, and what cannot be understood is answered with a sentence.
"""

from __future__ import annotations

import base64
import binascii
import dataclasses
import math
import re
import struct
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any
from urllib.parse import parse_qsl, urlencode

from bearing_explorer.state.bearing_kinds import MOST_SHOWN_ROWS
from bearing_explorer.state.choice_list import OF_DEFECT, OF_SCENE, Choice, floor_name
from bearing_explorer.state.field_values import (
    CAGE_ANGLE,
    FIELD_BY_KEY,
    SHOWN_FIELDS,
    defects_of,
    in_shown_unit,
    in_si,
    limits_of,
)
from bearing_explorer.state.field_values import read as read_number
from bearing_explorer.state.scene_editor import LONGEST_NAME, MOST_DEFECTS, SceneEditor
from bearing_explorer.state.sentences import one_line, sentence_of
from bearingcore import (
    DOF_NAMES,
    Bearing,
    Defect,
    MeasuredFloor,
    RoughFloor,
    Scene,
    presets,
)
from bearingcore.bearings.drawing import OPTIONAL_FIELDS
from bearingcore.bearings.rows import Row
from bearingcore.fields import SCENE_PARTS, Field, Range
from bearingcore.scene.floor import MOST_ROWS

TOO_LONG = "too-long"
"""Version of an address that the server put in place of one that was far too long."""

VERSION = "1"
LONGEST_LINK = 7_000
"""Characters of a link: servers in front of ours take lines of 8 kB as they come."""
LONGEST_TEXT = 2_500_000
"""Characters that are read at the most, of what a browser has kept: a floor of any length fits."""
_MOST_FIELDS = 400
_LONGEST_NUMBER = 40

TAB_OF_OLD_LINKS = "load"
"""Links that name no tab are of days when this one came first."""
FORMER_TABS = {"sizing": "diagnosis"}
"""Former names of tabs, in links that people have."""

_OWN_WORDS = (
    *("v", "preset", "defects", "selected", "dofs", "tab", "rows", "name", CAGE_ANGLE),
    *(choice.name for choice in OF_SCENE),
)
_DEFECT_WORDS = (*(choice.name for choice in OF_DEFECT), "floor", "points")
_OF_DEFECT = [field for field in SHOWN_FIELDS if field.part == "defect"]
_OF_FLOOR = [field for field in SHOWN_FIELDS if field.part == "floor"]
_OF_SCENE = [
    field for field in SHOWN_FIELDS if field.part in SCENE_PARTS and field.part != "defect"
]
_MAY_BE_NONE = (*OPTIONAL_FIELDS, "roller_length")
_OF_ROW = (
    *("place", "facing", "clearance", "offset", "turn", "contact_angle", "n_balls"),
    *("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"),
)
"""Numbers of a row in the order of links; those from the sixth on only where it has its own."""
_ALWAYS_OF_ROW = 5
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)(SI)?", re.IGNORECASE | re.ASCII)


@dataclass(frozen=True)
class Place:
    """A scene and how one looks at it: what a link stands for.

    `selected` is the defect that the sliders move, `cage_angle` in degrees, `tab` a section of the
    page. `note` is a sentence for whoever opened the link.
    """

    scene: Scene
    preset: str
    selected: int = 0
    cage_angle: float = 0.0
    tab: str = ""
    note: str = ""
    name: str = ""


def write(place: Place, longest: int | None = None) -> str:
    """The text of a place; floors that make it longer than `longest` are left out of it."""
    text = _written(place, False)
    return text if longest is None or len(text) <= longest else _written(place, True)


def leaves_out(text: str) -> bool:
    """Whether `write` left a floor out."""
    return "floor=left-out" in text


def read(text: str) -> Place | None:
    """The place of a text; None where the text says nothing about a scene.

    Raises
    ------
    ValueError
        with a sentence for the page.
    """
    if len(text) > LONGEST_TEXT:
        raise ValueError("It is far too long.")
    try:
        pairs = parse_qsl(
            text.removeprefix("?"), True, encoding="ascii", max_num_fields=_MOST_FIELDS
        )
    except ValueError:
        raise ValueError("It has far too many parts, or signs that do not belong there.") from None
    strange = [name for name, _ in pairs if not _is_known(name)]
    given: dict[str, str] = {}
    for name, value in pairs:
        if name in given:
            raise ValueError(f"“{_shown(name)}” stands there twice.")
        if _is_known(name):
            given[name] = value
    if not given:
        return None
    place = _read(given)
    if strange:
        note = f"“{_shown(strange[0])}” in the address means nothing here and was passed over."
        place = dataclasses.replace(place, note=" ".join(filter(None, (place.note, note))))
    return place


def opened(text: str, editor: SceneEditor) -> Place:
    """Show the place of a text on an editor. Never fails: `note` says where it could not be."""
    tab, note = "", ""
    try:
        place = read(text)
        if place is not None:
            tab, note = place.tab, place.note
            editor.take_scene(
                place.scene, place.preset, place.selected, place.cage_angle, place.name
            )
    except ValueError as error:
        why = sentence_of(error)
        note = f"The address could not be opened. {why} Showing the default bearing instead."
    return dataclasses.replace(place_of(editor, tab), note=note)


_LESSON = re.compile(r"(?:^|&)lesson=([a-z0-9-]{1,60})(?=&|$)")


def lesson_in(text: str) -> tuple[str, str]:
    """The lesson that an address names, or "", and the address without it."""
    text = text.removeprefix("?")
    found = _LESSON.search(text) if len(text) <= LONGEST_TEXT else None
    if found is None:
        return "", text
    return found[1], (text[: found.start()] + text[found.end() :]).removeprefix("&")


def holds_scene(text: str) -> bool:
    """Whether a text says something about a scene that can be read."""
    try:
        return read(text) is not None
    except ValueError:
        return False


def place_of(editor: SceneEditor, tab: str = "") -> Place:
    """The place that the editor shows."""
    angle = editor.values[CAGE_ANGLE]
    return Place(editor.scene, editor.preset, editor.selected, angle, tab, name=editor.own_name)


# Writing


def _written(place: Place, without_floors: bool) -> str:
    scene, base = place.scene, presets[place.preset]
    pairs: list[tuple[str, str]] = [("v", VERSION), ("preset", place.preset)]
    defects, usual = defects_of(scene), defects_of(base)[0]
    if len(defects) != 1:
        pairs.append(("defects", str(len(defects))))
    for number, defect in enumerate(defects):
        pairs += [
            (_behind(number) + name, value)
            for name, value in _defect_pairs(defect, usual, without_floors)
        ]
    if place.selected:
        pairs.append(("selected", str(place.selected + 1)))
    for field in _OF_SCENE:
        value, was = _value(scene, field), _value(base, field)
        if value != was:
            pairs.append((field.key, number_text(field, value)))
    if scene.bearing.rows != base.bearing.rows:
        pairs.append(("rows", rows_text(scene.bearing.rows)))
    if place.name:
        pairs.append(("name", place.name))
    pairs += _choice_pairs(OF_SCENE, scene, base)
    if scene.dofs != base.dofs:
        pairs.append(("dofs", "auto" if scene.dofs is None else ".".join(scene.dofs)))
    if place.cage_angle:
        pairs.append((CAGE_ANGLE, _short(place.cage_angle)))
    if place.tab:
        pairs.append(("tab", place.tab))
    return urlencode(pairs)


def _behind(number: int) -> str:
    return f"defect{number + 1}." if number else ""


def _defect_pairs(defect: Defect, usual: Defect, without_floors: bool) -> Iterable[tuple[str, str]]:
    for field in _OF_DEFECT:
        value = getattr(defect, field.name)
        if value != getattr(usual, field.name):
            yield field.key, number_text(field, value)
    yield from _choice_pairs(OF_DEFECT, defect, usual)
    floor = defect.floor
    if isinstance(floor, RoughFloor):
        yield "floor", floor_name(floor)
        for field in _OF_FLOOR:
            yield field.key, number_text(field, getattr(floor, field.name))
    elif isinstance(floor, MeasuredFloor) and without_floors:
        yield "floor", "left-out"
    elif isinstance(floor, MeasuredFloor):
        yield "floor", floor_name(floor)
        yield "points", packed(floor)


def _choice_pairs(choices: Iterable[Choice], owner: Any, usual: Any) -> Iterable[tuple[str, str]]:
    for choice in choices:
        if (name := choice.name_of(owner)) != choice.name_of(usual):
            yield choice.name, name.replace(" ", "-")


def _value(scene: Scene, field: Field) -> float | None:
    """A number of a scene that is not one of its defects', in SI."""
    value: float | None = getattr(getattr(scene, field.part, scene), field.name)
    return value


def number_text(field: Field, value: float | None) -> str:
    """A number in SI as the address has it; `_number` makes the very same of it."""
    if value is None:
        return "none"
    shown = in_shown_unit(field, value)
    if in_si(field, shown) == value:
        return _short(shown)
    return _short(value) + "SI"


def rows_text(rows: tuple[Row, ...]) -> str:
    """Rows of balls as a word; `_rows` makes the very same of it."""
    if not rows:
        return "one"
    words = []
    for row in rows:
        numbers = [getattr(row, name) for name in _OF_ROW]
        words.append("_".join("" if one is None else _short(one) for one in numbers).rstrip("_"))
    return "~".join(words)


def _short(value: float) -> str:
    """The shortest text of a float, whole numbers without a point."""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))


@lru_cache(maxsize=32)
def packed(floor: MeasuredFloor) -> str:
    """The points of a floor as a word."""
    numbers = floor.places + floor.depths
    raw = struct.pack(f"<{len(numbers)}d", *numbers)
    sorted_bytes = b"".join(raw[place::8] for place in range(8))
    return base64.urlsafe_b64encode(zlib.compress(sorted_bytes, 9)).rstrip(b"=").decode()


# Reading


def _is_known(name: str) -> bool:
    if name in _OWN_WORDS or name in _SCENE_NAMES:
        return True
    head, dot, tail = name.rpartition(".")
    behind = not dot or (re.fullmatch(r"defect[1-9]\d?", head, re.ASCII) is not None)
    return behind and tail in _DEFECT_NAMES


_SCENE_NAMES = frozenset(field.key for field in _OF_SCENE)
_DEFECT_NAMES = frozenset([*_DEFECT_WORDS, *(field.key for field in (*_OF_DEFECT, *_OF_FLOOR))])


def _read(given: dict[str, str]) -> Place:
    version = given.pop("v", None)
    if version is None:
        raise ValueError("It does not say its version (v=1).")
    if version == TOO_LONG:
        raise ValueError("It is far too long.")
    if version != VERSION:
        raise ValueError(
            f"It is of version “{_shown(version)}”, and this program knows version {VERSION} only."
        )
    preset = given.pop("preset", "fan-rig")
    if preset not in presets:
        raise ValueError(f"There is no bearing “{_shown(preset)}”.")
    base = presets[preset]
    count = _count(given.pop("defects", "1"), "defects")
    selected = _count(given.pop("selected", "1"), "selected") - 1
    chosen = _choices(OF_SCENE, given)
    for choice in OF_SCENE:
        given.pop(choice.name, None)
    dofs = _dofs(given.pop("dofs", None), base)
    cage_angle, _ = _parsed(given.pop(CAGE_ANGLE, "0"), CAGE_ANGLE)
    tab = given.pop("tab", "")
    tab = FORMER_TABS.get(tab, tab)
    name = one_line(given.pop("name", ""), LONGEST_NAME)
    rows = {"rows": _rows(given.pop("rows"))} if "rows" in given else {}
    defects, notes = [], []
    for number in range(count):
        own = {
            name: given.pop(_behind(number) + name)
            for name in _DEFECT_NAMES
            if _behind(number) + name in given
        }
        if own.get("floor") == "left-out":
            notes.append("A measured floor was too long for the address; here it is flat.")
        defects.append(_defect(own, defects_of(base)[0]))
    fields = {
        name: _number(given.pop(name), FIELD_BY_KEY[name]) for name in list(given)
        if name in _SCENE_NAMES
    }  # fmt: skip
    if given:
        raise ValueError(f"“{_shown(next(iter(given)))}” is about a defect that is not there.")
    scene = dataclasses.replace(
        base,
        bearing=_part(base.bearing, fields, **rows),
        defect=defects[0] if count == 1 else tuple(defects),
        load=_part(base.load, fields),
        support=_part(base.support, fields),
        dofs=dofs,
        **_own_of(base, fields),
    )
    scene = scene.replace(**chosen) if chosen else scene
    return Place(scene, preset, selected, cage_angle, tab[:40], " ".join(notes), name)


def _rows(text: str) -> tuple[Row, ...]:
    if text == "one":
        return ()
    rows: list[Row] = []
    for word in text.split("~"):
        numbers = word.split("_")
        few = not _ALWAYS_OF_ROW <= len(numbers) <= len(_OF_ROW)
        if few or "" in numbers[:_ALWAYS_OF_ROW] or len(rows) == MOST_SHOWN_ROWS:
            raise ValueError(f"“{_shown(text)}” are not the rows of a bearing.")
        given: dict[str, Any] = {
            name: _parsed(number, "rows")[0]
            for name, number in zip(_OF_ROW, numbers, strict=False)
            if number
        }
        for name in ("facing", "n_balls"):
            if (number := given.get(name)) is not None and number == int(number):
                given[name] = int(number)
        rows.append(Row(**given))
    return tuple(rows)


def _own_of(part: Any, fields: Mapping[str, float | None]) -> dict[str, Any]:
    """The numbers given, by names, for the fields that a part of a scene has."""
    return {
        field.name: fields[field.key]
        for field in _OF_SCENE
        if field.key in fields and hasattr(part, field.name)
    }


def _part(part: Any, fields: Mapping[str, float | None], **others: Any) -> Any:
    own = {**_own_of(part, fields), **others}
    for name, value in own.items():
        if name == "n_balls" and isinstance(value, float):
            own[name] = int(value) if value == int(value) else value
    if isinstance(part, Bearing):
        own["kind"] = ""  # links do not say it: the numbers do
    return dataclasses.replace(part, **own)


def _defect(given: dict[str, str], usual: Defect) -> Defect:
    fields: dict[str, Any] = {
        field.name: _number(given[field.key], field) for field in _OF_DEFECT if field.key in given
    }
    fields |= _choices(OF_DEFECT, given)
    kind = given.get("floor", "flat")
    if kind == "rough":
        numbers = {field.name: _number(given.get(field.key, ""), field) for field in _OF_FLOOR}
        seed = numbers.pop("seed")
        fields["floor"] = RoughFloor(**numbers, seed=int(seed or 0))  # type: ignore[arg-type]
    elif kind == "measured":
        fields["floor"] = unpacked(given.get("points", ""))
    elif kind in ("flat", "left-out"):
        fields["floor"] = None
    else:
        raise ValueError(f"There is no floor “{_shown(kind)}”.")
    return dataclasses.replace(usual, **fields)


def _number(text: str, field: Field) -> float | None:
    """A number in SI; ValueError with a sentence where it is none."""
    if text == "none" and (field.optional or field.name in _MAY_BE_NONE):
        return None
    value, is_si = _parsed(text, field.key)
    if is_si:
        return value
    # as it would be typed on the page: out of range it is refused in the words of the page
    read_number(field.key, text, _usual_limits())
    return in_si(field, value)


@cache
def _usual_limits() -> Mapping[str, Range]:
    """Range of what can be typed: the same with every preset."""
    return limits_of(presets["fan-rig"])


def _parsed(text: str, name: str) -> tuple[float, bool]:
    """A number and whether it is said to be in SI."""
    found = _NUMBER.fullmatch(text) if len(text) <= _LONGEST_NUMBER else None
    value = float(found[1]) if found else math.nan
    if found is None or not math.isfinite(value):
        raise ValueError(f"“{_shown(text)}” is not a number that {name} could have.")
    return value, found[2] is not None


def _count(text: str, name: str) -> int:
    if not (text.isascii() and text.isdecimal() and 1 <= int(text[:3]) <= MOST_DEFECTS):
        raise ValueError(f"“{_shown(text)}” is out of range: {name} goes from 1 to {MOST_DEFECTS}.")
    return int(text[:3])


def _choices(choices: Iterable[Choice], given: Mapping[str, str]) -> dict[str, Any]:
    """Fields of the choices that a text makes."""
    fields = {}
    for choice in choices:
        text = given.get(choice.name)
        if text is None:
            continue
        if text not in choice.in_links:
            raise ValueError(f"“{_shown(text)}” is not one of {', '.join(choice.in_links)}.")
        fields[choice.field] = choice.in_links[text]
    return fields


def _dofs(text: str | None, base: Scene) -> tuple[str, ...] | None:
    if text is None:
        return base.dofs
    if text == "auto":
        return None
    names = tuple(text.split("."))
    if not set(names) <= set(DOF_NAMES) or len(set(names)) != len(names):
        raise ValueError(f"“{_shown(text)}” are not directions that can move.")
    return names


def unpacked(word: str) -> MeasuredFloor:
    """The floor of `packed`; ValueError with a sentence for anything else."""
    most = 16 * MOST_ROWS
    try:
        squeezed = base64.b64decode(word + "=" * (-len(word) % 4), b"-_", validate=True)
        opener = zlib.decompressobj()
        raw = opener.decompress(squeezed, most + 1)  # no more, whatever it would swell to
    except (binascii.Error, ValueError, zlib.error):
        raise ValueError("The points of a measured floor cannot be read.") from None
    if len(raw) > most or len(raw) % 16 or not opener.eof:
        raise ValueError("The points of a measured floor cannot be read.")
    count = len(raw) // 8
    numbers = struct.unpack(f"<{count}d", b"".join(bytes(raw[k::count]) for k in range(count)))
    half = count // 2
    try:
        return MeasuredFloor(numbers[:half], numbers[half:])
    except ValueError as error:
        raise ValueError(sentence_of(error)) from None


def _shown(text: str) -> str:
    """Untrusted text for a sentence: short, on one line."""
    clean = one_line(text, 31)
    return clean if len(clean) <= 30 else clean[:29] + "…"
