"""A scene as the text behind the question mark of the page's address, and back.

    v=1&preset=fan-rig&extent_deg=38.6&fy_n=-120&tab=stiffness&cage_angle_deg=12.5

The text says what differs from a preset, under the names and in the units of the page: so a person
can read it, change a number by hand and see in a mail what a link is about. One packed word would
be hardly shorter, as most scenes differ from a preset in two or three numbers, and could not
be mended. Only the points of a measured floor are packed.

The rules of version 1, which later versions go on reading:

- `v` is 1, also where it is missing, `preset` a name of `bearingcore.presets`. What follows is left
  out where it is as in the preset; so the numbers of a preset must not change (a test holds them).
- A number is in the unit of its name, or in SI with ``SI`` behind it where its twelve digits in
  that unit stand for another scene. ``none`` is an optional number left open. Whatever is written
  is read back to the last bit.
- Of several defects (`defects` says how many) the second has its names behind ``defect2.``, and so
  on; each says what differs from the first defect of the preset. `selected` is the one the sliders
  move.
- `race`, `edge`, `law`, `balls`, `dofs` are words. `dofs` are names with dots between, ``free``
  (tilts are free), ``held`` (held, but for a moment), or ``auto``, which like nothing leaves tilts
  free where the load causes any: that was so before links could say ``held``. `floor` is
  ``flat``, ``rough`` with its three numbers, ``measured`` with `points`, or ``left-out``: it was
  too long for an address.
- `rows` is ``one``, or of each row place, facing, clearance, offset and turn in SI with ``_``
  between them, and ``~`` between rows; behind them what a row has of its own: contact angle, number
  of balls, ball and pitch diameter, inner and outer groove radius, nothing between the ``_`` of one
  it has not, and none of the last ones. `row_distance_mm`, `preload_um` and numbers of the second
  row are read too, and change two rows. `name` is what a person calls the bearing, `estimated` the
  dimensions that are estimates, with dots between them, `rating` a catalogue's C_r [N].
- What has ``compare1.`` in front are the first scene that is compared, by
  the same rules; `compare1.label` is the name of its curves.
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
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache, partial
from typing import Any
from urllib.parse import parse_qsl, urlencode

from bearing_explorer.explorer.state import field_values
from bearing_explorer.explorer.state.bearing_kinds import MOST_SHOWN_ROWS
from bearing_explorer.explorer.state.choice_list import OF_DEFECT, OF_SCENE, Choice, floor_name
from bearing_explorer.explorer.state.field_values import CAGE_ANGLE, SHOWN_FIELDS, defects_of
from bearing_explorer.explorer.state.references import Reference
from bearing_explorer.explorer.state.scene_editor import LONGEST_NAME, MOST_DEFECTS, SceneEditor
from bearing_explorer.kit.sentences import one_line, sentence_of
from bearing_explorer.kit.serve.address import TOO_LONG
from bearingcore import DOF_NAMES, Defect, MeasuredFloor, RoughFloor, Scene, presets
from bearingcore.bearings import BALL_MATERIAL, OPTIONAL_FIELDS, Row
from bearingcore.fields import Field, Range
from bearingcore.model.scene import MOST_ROWS, TILT_FREE, TILT_HELD

VERSION = "1"
LONGEST_LINK = 7_000
"""Characters of a link: servers in front of ours take lines of 8 kB as they come."""
LONGEST_TEXT = 2_500_000
"""Characters that are read at the most, of what a browser has kept: a floor of any length fits."""
_MOST_FIELDS = 400
_MOST_ESCAPES = 100_000
_LONGEST_NUMBER = 40

TAB_OF_OLD_LINKS = "load"
"""Links that name no tab are of days when this one came first."""
OTHER_NAMES_OF_TABS = {
    "sizing": "diagnosis",
    "ball-mass": "vibration",
    "orbits": "over-speed",
    "speed-run": "over-speed",
    "frequencies": "modes",
    "machine": "bearing",
    "more": "explore",
}
"""Former names of tabs, in links that people have, and what is written on them."""

_DOFS_OF_WORD = {"auto": None, "free": TILT_FREE, "held": TILT_HELD}
_MAY_BE_NONE = (*OPTIONAL_FIELDS, *BALL_MATERIAL, "roller_length", "groove_center_distance")
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
    page. `note` is a sentence for whoever opened the link; `compared` are the scenes drawn too.
    """

    scene: Scene
    preset: str
    selected: int = 0
    cage_angle: float = 0.0
    tab: str = ""
    note: str = ""
    name: str = ""
    compared: tuple[Reference, ...] = ()


def write(place: Place, longest: int | None = None) -> str:
    """The text of a place; floors that make it longer than `longest` are left out of it."""
    text = _written(place, False)
    return text if longest is None or len(text) <= longest else _written(place, True)


def leaves_out(text: str) -> bool:
    """True if `write` left a floor out."""
    return "floor=left-out" in text


def read(text: str) -> Place | None:
    """The place of a text; None where the text says nothing about a scene.

    Raises
    ------
    ValueError
        with a sentence for the page.
    """
    pairs, note = _known_pairs(text)
    if not pairs:
        return None
    place = _read(pairs)
    return dataclasses.replace(place, note=" ".join(filter(None, (place.note, note))))


def _known_pairs(text: str) -> tuple[dict[str, str], str]:
    """Values of a text under names that are known, and a sentence on those that are not."""
    if len(text) > LONGEST_TEXT:
        raise ValueError("It is far too long.")
    if text.count("%") > _MOST_ESCAPES:  # each is looked up one by one
        raise ValueError("It has far too many percent signs to be a scene.")
    try:
        pairs = parse_qsl(text.removeprefix("?"), True, max_num_fields=_MOST_FIELDS)
    except ValueError:
        raise ValueError(
            "It has far too many parts, or characters that do not belong in it."
        ) from None
    strange = [name for name, _ in pairs if not _is_known(name)]
    values: dict[str, str] = {}
    for name, value in pairs:
        if name in values:
            raise ValueError(f"“{_shown(name)}” is given twice.")
        if _is_known(name):
            values[name] = value
    if not strange:
        return values, ""
    more = f", like {len(strange) - 1} more," if len(strange) > 1 else ""
    return values, f"“{_shown(strange[0])}” in the address{more} is not known and was ignored."


_TAB = re.compile(r"(?:^|[?&])tab=([a-z-]{1,40})(?=&|$)")


def opened(text: str, editor: SceneEditor) -> Place:
    """Show the place of a text on an editor. Never fails: `note` says where it could not be."""
    tab, note = "", ""
    compared: tuple[Reference, ...] = ()
    try:
        place = read(text)
        if place is None:
            note = _known_pairs(text)[1]
        else:
            tab, note, compared = place.tab or TAB_OF_OLD_LINKS, place.note, place.compared
            show_place(place, editor)
    except ValueError as error:
        why = sentence_of(error)
        if match := _TAB.search(text[:LONGEST_TEXT]):
            tab = OTHER_NAMES_OF_TABS.get(match[1], match[1])
        note = f"The address could not be opened. {why} Showing the default bearing instead."
    return dataclasses.replace(place_of(editor, tab), note=note, compared=compared)


_LESSON = re.compile(r"(?:^|&)lesson=([a-z0-9-]{1,60})(?=&|$)")


def lesson_in(text: str) -> tuple[str, str]:
    """The lesson that an address names, or "", and the address without it."""
    text = text.removeprefix("?")
    match = _LESSON.search(text) if len(text) <= LONGEST_TEXT else None
    if match is None:
        return "", text
    return match[1], (text[: match.start()] + text[match.end() :]).removeprefix("&")


def show_place(place: Place, editor: SceneEditor) -> None:
    """Show the scene of a place on an editor; ValueError where the page cannot hold it."""
    editor.take_scene(place.scene, place.preset, place.selected, place.cage_angle, place.name)


def place_of(editor: SceneEditor, tab: str = "") -> Place:
    """The place that the editor shows."""
    angle = editor.values[CAGE_ANGLE]
    return Place(
        editor.scene, editor.preset, editor.selected, angle, tab, name=editor.name_in_links
    )


# Writing


def _written(place: Place, without_floors: bool) -> str:
    pairs = [("v", VERSION), *_scene_pairs(place, without_floors)]
    for number, other in enumerate(place.compared, 1):
        preset = min(presets, key=lambda name: len(_scene_pairs(Place(other.scene, name), True)))
        label = [("label", other.name)] if other.name else []
        own_place = Place(other.scene, preset, name=other.bearing)
        of_place = [*label, *_scene_pairs(own_place, without_floors)]
        pairs += [(f"compare{number}.{name}", value) for name, value in of_place]
    if place.cage_angle:
        pairs.append((CAGE_ANGLE, _short(place.cage_angle)))
    if place.tab:
        pairs.append(("tab", place.tab))
    return urlencode(pairs)


def _scene_pairs(place: Place, without_floors: bool) -> list[tuple[str, str]]:
    """The scene of a place, with the defect that is selected and its bearing's name."""
    scene, base = place.scene, presets[place.preset]
    pairs: list[tuple[str, str]] = [("preset", place.preset)]
    defects, usual = defects_of(scene), defects_of(base)[0]
    if len(defects) != 1:
        pairs.append(("defects", str(len(defects))))
    for number, defect in enumerate(defects):
        of_defect = [*_changes(_DEFECT, defect, usual), *_floor_pairs(defect.floor, without_floors)]
        pairs += [(_prefix(number) + name, value) for name, value in of_defect]
    if place.selected:
        pairs.append(("selected", str(place.selected + 1)))
    for part, entries in _SCENE.items():
        pairs += _changes(entries, _part_of(scene, part), _part_of(base, part))
    if scene.holds_tilt_unasked:
        pairs = [*(pair for pair in pairs if pair[0] != "dofs"), ("dofs", "held")]
    if place.name:
        pairs.append(("name", place.name))
    return pairs


def _prefix(number: int) -> str:
    return f"defect{number + 1}." if number else ""


def _part_of(scene: Scene, part: str) -> Any:
    return scene if part == "scene" else getattr(scene, part)


def _changes(entries: Iterable[Entry], owner: Any, usual: Any) -> Iterable[tuple[str, str]]:
    """The entries of an owner that are not as usual."""
    for entry in entries:
        if (value := getattr(owner, entry.field)) != getattr(usual, entry.field):
            yield entry.name, entry.text_of(value)


def _floor_pairs(floor: object, left_out: bool) -> Iterable[tuple[str, str]]:
    if isinstance(floor, RoughFloor):
        yield "floor", floor_name(floor)
        yield from ((entry.name, entry.text_of(getattr(floor, entry.field))) for entry in _FLOOR)
    elif isinstance(floor, MeasuredFloor) and left_out:
        yield "floor", "left-out"
    elif isinstance(floor, MeasuredFloor):
        yield "floor", floor_name(floor)
        yield "points", packed(floor)


def number_text(field: Field, value: float | None) -> str:
    """Text of a number in SI, of which `_number` makes the very same."""
    if value is None:
        return "none"
    shown = field_values.shown_number(field, value)
    return _short(shown) if field_values.si_number(field, shown) == value else f"{value!r}SI"


def rows_text(rows: tuple[Row, ...]) -> str:
    """Rows of balls as a word; `_rows` makes the very same of it."""
    if not rows:
        return "one"
    words = []
    for row in rows:
        numbers = [getattr(row, name) for name in _OF_ROW]
        words.append("_".join("" if each is None else _short(each) for each in numbers).rstrip("_"))
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


_OF_COMPARED = re.compile(r"compare([1-4])\.(.+)", re.ASCII)


def _is_known(name: str) -> bool:
    match = re.fullmatch(r"(compare[1-4]\.)?(defect[1-9]\d?\.)?([^.]+)", name, re.ASCII)
    if match is None:
        return False
    compared, defect, plain = match.groups()
    if defect:
        return plain in _DEFECT_NAMES
    known = {*_PLACE_NAMES, *_DEFECT_NAMES, *({"label"} if compared else _PLACE_ONLY)}
    return plain in known


def _compared(pairs: dict[str, str]) -> tuple[Reference, ...]:
    """The compared scenes of an address, in the order of their numbers; they are taken out."""
    parts: dict[str, dict[str, str]] = {}
    for name in list(pairs):
        if match := _OF_COMPARED.fullmatch(name):
            parts.setdefault(match[1], {})[match[2]] = pairs.pop(name)
    references = []
    for _, part in sorted(parts.items()):
        label = one_line(part.pop("label", ""), LONGEST_NAME)
        place = _read({"v": VERSION, **part})
        references.append(Reference(place.scene, label, bearing=place.name))
    return tuple(references)


def _read(pairs: dict[str, str]) -> Place:
    compared = _compared(pairs)
    version = pairs.pop("v", "")
    if version == TOO_LONG:
        raise ValueError("It is far too long.")
    if version not in ("", VERSION):
        raise ValueError(
            f"It has version “{_shown(version)}”; this program reads version {VERSION} only."
        )
    preset = pairs.pop("preset", "fan-rig")
    if preset not in presets:
        raise ValueError(f"There is no bearing “{_shown(preset)}”.")
    base = presets[preset]
    count = _count(pairs.pop("defects", "1"), "defects")
    selected = _count(pairs.pop("selected", "1"), "selected") - 1
    cage_angle, _ = _parsed(pairs.pop(CAGE_ANGLE, "0"), CAGE_ANGLE)
    tab = pairs.pop("tab", "")
    name = one_line(pairs.pop("name", ""), LONGEST_NAME)
    defects = []
    note = ""
    for number in range(count):
        here = {name: _prefix(number) + name for name in _DEFECT_NAMES}
        defect_pairs = {name: pairs.pop(there) for name, there in here.items() if there in pairs}
        if defect_pairs.get("floor") == "left-out":
            note = "A measured floor was too long for the address; here it is flat."
        defects.append(_defect(defect_pairs, defects_of(base)[0]))
    fields = {part: _taken(entries, pairs) for part, entries in _SCENE.items()}
    of_rows = _taken(_TWO_ROWS, pairs)
    if pairs:
        raise ValueError(f"“{_shown(next(iter(pairs)))}” belongs to a defect that is missing.")
    own_fields = fields.pop("scene")
    if fields["bearing"]:
        fields["bearing"]["kind"] = ""  # links do not say it: the numbers do
    parts = {
        part: dataclasses.replace(getattr(base, part), **changes)
        for part, changes in fields.items()
    }
    defect = defects[0] if count == 1 else tuple(defects)
    said = own_fields.get("dofs")
    if said == TILT_HELD:
        own_fields["dofs"] = None
    scene = dataclasses.replace(base, defect=defect, **parts, **own_fields).with_tilts_as(said)
    scene = scene.replace(**of_rows)
    tab = OTHER_NAMES_OF_TABS.get(tab, tab)[:40]
    return Place(scene, preset, selected, cage_angle, tab, note, name, compared)


def _taken(entries: Iterable[Entry], pairs: dict[str, str]) -> dict[str, Any]:
    """The values of the entries that are given, by their fields; they are taken out."""
    return {
        entry.field: entry.value_of(pairs.pop(entry.name))
        for entry in entries
        if entry.name in pairs
    }


def _rows(text: str) -> tuple[Row, ...]:
    if text == "one":
        return ()
    rows: list[Row] = []
    for word in text.split("~"):
        numbers = word.split("_")
        few = not _ALWAYS_OF_ROW <= len(numbers) <= len(_OF_ROW)
        if few or "" in numbers[:_ALWAYS_OF_ROW] or len(rows) == MOST_SHOWN_ROWS:
            raise ValueError(f"“{_shown(text)}” does not describe the rows of a bearing.")
        numbers_of_row: dict[str, Any] = {
            name: _parsed(number, "rows")[0]
            for name, number in zip(_OF_ROW, numbers, strict=False)
            if number
        }
        for name in ("facing", "n_balls"):
            if (number := numbers_of_row.get(name)) is not None and number == int(number):
                numbers_of_row[name] = int(number)
        rows.append(Row(**numbers_of_row))
    return tuple(rows)


def _defect(pairs: dict[str, str], usual: Defect) -> Defect:
    fields = _taken(_DEFECT, pairs)
    kind = pairs.get("floor", "rough" if any(entry.name in pairs for entry in _FLOOR) else "flat")
    if kind == "rough":
        fields["floor"] = RoughFloor(
            **{entry.field: entry.value_of(pairs.get(entry.name, "")) for entry in _FLOOR}
        )
    elif kind == "measured":
        fields["floor"] = unpacked(pairs.get("points", ""))
    elif kind in ("flat", "left-out"):
        fields["floor"] = None
    else:
        raise ValueError(f"There is no floor “{_shown(kind)}”.")
    return dataclasses.replace(usual, **fields)


def _number(field: Field, text: str) -> float | None:
    """A number in SI; ValueError with a sentence where it is no number."""
    if text == "none" and (field.optional or field.name in _MAY_BE_NONE):
        return None
    value, is_si = _parsed(text, field.key)
    if not is_si:
        # as it would be typed on the page: out of range it is refused in the words of the page
        field_values.read(field.key, text, _usual_limits())
    if field.whole and value == int(value):
        return int(value)
    return value if is_si else field_values.si_number(field, value)


@cache
def _usual_limits() -> Mapping[str, Range]:
    """Range of what can be typed: the same with every preset."""
    return field_values.limits_of(presets["fan-rig"])


def _parsed(text: str, name: str) -> tuple[float, bool]:
    """A number and whether it is said to be in SI."""
    match = _NUMBER.fullmatch(text) if len(text) <= _LONGEST_NUMBER else None
    value = float(match[1]) if match else math.nan
    if match is None or not math.isfinite(value):
        raise ValueError(f"“{_shown(text)}” is not a number for {name}.")
    return value, match[2] is not None


def _count(text: str, name: str) -> int:
    if not (text.isascii() and text.isdecimal() and 1 <= int(text[:3]) <= MOST_DEFECTS):
        raise ValueError(f"“{_shown(text)}” is out of range: {name} goes from 1 to {MOST_DEFECTS}.")
    return int(text[:3])


def _option(choice: Choice, text: str) -> Any:
    """The value of an option."""
    if text not in choice.link_options:
        raise ValueError(f"“{_shown(text)}” is not one of {', '.join(choice.link_options)}.")
    return choice.link_options[text]


def _option_text(choice: Choice, value: Any) -> str:
    return next(name for name, held in choice.link_options.items() if held == value)


def _dofs(text: str) -> tuple[str, ...] | str | None:
    if text in _DOFS_OF_WORD:
        return _DOFS_OF_WORD[text]
    names = tuple(text.split("."))
    if not set(names) <= set(DOF_NAMES) or len(set(names)) != len(names):
        raise ValueError(f"“{_shown(text)}” is not a list of directions that can move.")
    return names


def _dofs_text(dofs: tuple[str, ...] | str | None) -> str:
    words = (word for word, meant in _DOFS_OF_WORD.items() if meant == dofs)
    return ".".join(dofs) if isinstance(dofs, tuple) else next(words)


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


@dataclass(frozen=True)
class Entry:
    """A field of a scene in an address: its name there, and the way to its text and back."""

    name: str
    field: str
    text_of: Callable[[Any], str]
    value_of: Callable[[str], Any]


def _numbers_of(part: str) -> list[Entry]:
    return [
        Entry(field.key, field.full_name, partial(number_text, field), partial(_number, field))
        for field in SHOWN_FIELDS
        if field.part == part
    ]


def _choices_of(choices: Iterable[Choice]) -> list[Entry]:
    return [
        Entry(choice.name, choice.field, partial(_option_text, choice), partial(_option, choice))
        for choice in choices
    ]


_SCENE = {part: _numbers_of(part) for part in ("scene", "load", "bearing", "support")}
_SCENE["bearing"] += [
    Entry("rows", "rows", rows_text, _rows),
    Entry("estimated", "estimated", ".".join, lambda text: tuple(text.split("."))),
    Entry("rating", "dynamic_load_rating", "{!r}".format, lambda text: _parsed(text, "rating")[0]),
]
_SCENE["scene"] += [*_choices_of(OF_SCENE), Entry("dofs", "dofs", _dofs_text, _dofs)]
"""Entries of each part of a scene."""
_DEFECT = [*_numbers_of("defect"), *_choices_of(OF_DEFECT)]
_FLOOR = _numbers_of("floor")
_TWO_ROWS = [*_numbers_of("pair"), *_numbers_of("second")]
"""Numbers that `rows` holds too: links have that, a person may write these."""

_PLACE_ONLY = {"v", "tab", CAGE_ANGLE}
_PLACE_NAMES = {
    *("preset", "defects", "selected", "name"),
    *(entry.name for entry in _TWO_ROWS),
    *(entry.name for entries in _SCENE.values() for entry in entries),
}
_DEFECT_NAMES = ["floor", "points", *(entry.name for entry in (*_DEFECT, *_FLOOR))]
