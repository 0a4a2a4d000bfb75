"""A scene as the text behind the question mark of the page's address, and back.

    v=1&preset=fan-rig&extent_deg=38.6&fy_n=-120&tab=stiffness&cage_angle_deg=12.5

The text lists the differences from a preset, under the names and in the units of the page. So a
person can read it, change a number by hand and see in a mail what a link is about. One packed word
would hardly be shorter, because most scenes differ from a preset in two or three numbers, and it
could not be corrected by hand. Only the points of a measured floor are packed.

The rules of version 1, which later versions go on reading:

- `v` is 1, also if it is missing. `preset` is a name of `bearingcore.presets`. A value that equals
  that of the preset is left out; so the numbers of a preset must not change (a test holds them).
- A number is in the unit of its name, or, if its twelve digits in that unit would give another
  scene, in SI with ``SI`` behind it. Every number is read back to the last bit. ``none`` is an
  optional number that is left open.
- `defects` is the number of defects. Names of the second begin with ``defect2.``, and so on; each
  lists its differences from the first defect of the preset. `selected` is the defect that the
  sliders move.
- `race`, `edge`, `law`, `balls`, `dofs` are words. `dofs` are names with dots between, ``free``
  (tilts are free), ``held`` (held, unless a moment acts), or ``auto``. Without `dofs`, and with
  ``auto``, tilts are free if the load causes any, as before links knew ``held``. `floor` is
  ``flat``, ``rough`` with its three numbers, ``measured`` with `points`, or ``left-out`` if it
  was too long for an address.
- `rows` is ``one``, or the rows with ``~`` between them. A row is its place, facing, clearance,
  offset and turn in SI, with ``_`` between them, and then the numbers in which it differs from the
  bearing: contact angle, number of balls, ball and pitch diameter, inner and outer groove radius.
  Equal ones are empty; at the end they are left out. `row_distance_mm`, `preload_um` and numbers
  of the second row are read too, and change two rows. `name` is a person's name for the bearing,
  `estimated` the dimensions that are estimates, with dots between, `rating` a catalogue's C_r [N].
- Names that begin with ``compare1.`` belong to the first compared scene, by the same rules;
  `compare1.label` is the name of its curves.
- `tab` is the open tab, `cage_angle_deg` the cage angle, `lesson` the name of the open lesson. A
  lesson alone stands for the scene that it begins with.
- `points` is base64url of zlib of the points' places and then depths, as little-endian doubles.
  All their first bytes come first, then all second ones: like bytes in a row pack well.

An address is not trusted: it is never evaluated, its length and its unpacked size are bounded, and
a sentence says which part cannot be understood.
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
"""Most characters of a link: servers in front of ours accept lines of 8 kB by default."""
LONGEST_TEXT = 2_500_000
"""Most characters of a text that a browser has kept: a floor of any length fits."""
_MOST_FIELDS = 400
_MOST_ESCAPES = 100_000
_LONGEST_NUMBER = 40

TAB_OF_OLD_LINKS = "load"
"""Tab of links that name none: they are from a version in which this tab came first."""
OTHER_NAMES_OF_TABS = {
    "sizing": "diagnosis",
    "ball-mass": "vibration",
    "orbits": "over-speed",
    "speed-run": "over-speed",
    "frequencies": "modes",
    "machine": "bearing",
    "more": "explore",
}
"""Present names of tabs by the former names in old links, or by the words on the tab."""

_DOFS_OF_WORD = {"auto": None, "free": TILT_FREE, "held": TILT_HELD}
_MAY_BE_NONE = (*OPTIONAL_FIELDS, *BALL_MATERIAL, "roller_length", "groove_center_distance")
_OF_ROW = (
    *("place", "facing", "clearance", "offset", "turn", "contact_angle", "n_balls"),
    *("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"),
)
"""Numbers of a row in the order of links; from the sixth on only if they differ."""
_ALWAYS_OF_ROW = 5
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)(SI)?", re.IGNORECASE | re.ASCII)


@dataclass(frozen=True)
class Place:
    """The content of a link: a scene, and the way in which it is shown.

    `selected` is the index of the defect that the sliders move, `cage_angle` is in degrees, `tab`
    is a section of the page. `note` is a sentence for the person who opened the link.
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
    """Write a place as text; without its floors if it would be longer than `longest`."""
    text = _text_of(place, False)
    return text if longest is None or len(text) <= longest else _text_of(place, True)


def leaves_out(text: str) -> bool:
    """True if `write` left a floor out."""
    return "floor=left-out" in text


def read(text: str) -> Place | None:
    """Read the place of a text; None if it has no scene, ValueError with a sentence if bad."""
    pairs, note = _known_pairs(text)
    if not pairs:
        return None
    place = _read_place(pairs)
    return dataclasses.replace(place, note=" ".join(filter(None, (place.note, note))))


def _known_pairs(text: str) -> tuple[dict[str, str], str]:
    """Values of a text by their known names, and a sentence on unknown names."""
    if len(text) > LONGEST_TEXT:
        raise ValueError("It is far too long.")
    if text.count("%") > _MOST_ESCAPES:  # `parse_qsl` would be slow
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
            raise ValueError(f"“{_quoted(name)}” is given twice.")
        if _is_known(name):
            values[name] = value
    if not strange:
        return values, ""
    more = f", like {len(strange) - 1} more," if len(strange) > 1 else ""
    return values, f"“{_quoted(strange[0])}” in the address{more} is not known and was ignored."


_TAB = re.compile(r"(?:^|[?&])tab=([a-z-]{1,40})(?=&|$)")


def show_text(text: str, editor: SceneEditor) -> Place:
    """Show the place of a text on an editor. It never fails: `note` names a reason instead."""
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
    """Show the scene of a place on an editor; ValueError if the page cannot show it."""
    editor.take_scene(place.scene, place.preset, place.selected, place.cage_angle, place.name)


def place_of(editor: SceneEditor, tab: str = "") -> Place:
    """The place that the editor shows."""
    angle = editor.values[CAGE_ANGLE]
    return Place(
        editor.scene, editor.preset, editor.selected, angle, tab, name=editor.name_in_links
    )


# Writing


def _text_of(place: Place, without_floors: bool) -> str:
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
    """Names and values of a scene, with the selected defect and the bearing's name."""
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
    """Names and values of the entries in which `owner` differs from `usual`."""
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
        yield "points", pack_points(floor)


def number_text(field: Field, value: float | None) -> str:
    """Text of a number in SI; `_read_number` returns exactly the same number."""
    if value is None:
        return "none"
    shown = field_values.shown_number(field, value)
    return _short(shown) if field_values.si_number(field, shown) == value else f"{value!r}SI"


def rows_text(rows: tuple[Row, ...]) -> str:
    """Rows of balls as a word; `_read_rows` returns exactly the same rows."""
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
def pack_points(floor: MeasuredFloor) -> str:
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


def _pop_compared(pairs: dict[str, str]) -> tuple[Reference, ...]:
    """Remove the compared scenes from the pairs and return them in the order of their numbers."""
    parts: dict[str, dict[str, str]] = {}
    for name in list(pairs):
        if match := _OF_COMPARED.fullmatch(name):
            parts.setdefault(match[1], {})[match[2]] = pairs.pop(name)
    references = []
    for _, part in sorted(parts.items()):
        label = one_line(part.pop("label", ""), LONGEST_NAME)
        place = _read_place({"v": VERSION, **part})
        references.append(Reference(place.scene, label, bearing=place.name))
    return tuple(references)


def _read_place(pairs: dict[str, str]) -> Place:
    """Read the place of pairs of a name and a value; every pair must have been used at the end."""
    compared = _pop_compared(pairs)
    version = pairs.pop("v", "")
    if version == TOO_LONG:
        raise ValueError("It is far too long.")
    if version not in ("", VERSION):
        raise ValueError(
            f"It has version “{_quoted(version)}”; this program reads version {VERSION} only."
        )
    preset = pairs.pop("preset", "fan-rig")
    if preset not in presets:
        raise ValueError(f"There is no bearing “{_quoted(preset)}”.")
    base = presets[preset]
    count = _read_count(pairs.pop("defects", "1"), "defects")
    selected = _read_count(pairs.pop("selected", "1"), "selected") - 1
    cage_angle, _ = _parse_number(pairs.pop(CAGE_ANGLE, "0"), CAGE_ANGLE)
    tab = pairs.pop("tab", "")
    name = one_line(pairs.pop("name", ""), LONGEST_NAME)
    # defects: each lists its differences from the first defect of the preset
    defects = []
    note = ""
    for number in range(count):
        keys = {name: _prefix(number) + name for name in _DEFECT_NAMES}
        defect_pairs = {name: pairs.pop(key) for name, key in keys.items() if key in pairs}
        if defect_pairs.get("floor") == "left-out":
            note = "A measured floor was too long for the address; here it is flat."
        defects.append(_read_defect(defect_pairs, defects_of(base)[0]))
    # all other fields, by the part of the scene to which they belong
    fields = {part: _pop_fields(entries, pairs) for part, entries in _SCENE.items()}
    of_rows = _pop_fields(_TWO_ROWS, pairs)
    if pairs:
        raise ValueError(f"“{_quoted(next(iter(pairs)))}” belongs to a defect that is missing.")
    scene_fields = fields.pop("scene")
    if fields["bearing"]:
        fields["bearing"]["kind"] = ""  # not in links: it follows from the numbers
    parts = {
        part: dataclasses.replace(getattr(base, part), **changes)
        for part, changes in fields.items()
    }
    defect = defects[0] if count == 1 else tuple(defects)
    dofs = scene_fields.get("dofs")
    if dofs == TILT_HELD:
        scene_fields["dofs"] = None
    scene = dataclasses.replace(base, defect=defect, **parts, **scene_fields).with_tilts_as(dofs)
    scene = scene.replace(**of_rows)  # fields of two rows change the rows that were read before
    tab = OTHER_NAMES_OF_TABS.get(tab, tab)[:40]
    return Place(scene, preset, selected, cage_angle, tab, note, name, compared)


def _pop_fields(entries: Iterable[Entry], pairs: dict[str, str]) -> dict[str, Any]:
    """Remove the values of these entries from the pairs and return them by their fields."""
    return {
        entry.field: entry.value_of(pairs.pop(entry.name))
        for entry in entries
        if entry.name in pairs
    }


def _read_rows(text: str) -> tuple[Row, ...]:
    if text == "one":
        return ()
    rows: list[Row] = []
    for word in text.split("~"):
        numbers = word.split("_")
        few = not _ALWAYS_OF_ROW <= len(numbers) <= len(_OF_ROW)
        if few or "" in numbers[:_ALWAYS_OF_ROW] or len(rows) == MOST_SHOWN_ROWS:
            raise ValueError(f"“{_quoted(text)}” does not describe the rows of a bearing.")
        numbers_of_row: dict[str, Any] = {
            name: _parse_number(number, "rows")[0]
            for name, number in zip(_OF_ROW, numbers, strict=False)
            if number
        }
        for name in ("facing", "n_balls"):
            if (number := numbers_of_row.get(name)) is not None and number == int(number):
                numbers_of_row[name] = int(number)
        rows.append(Row(**numbers_of_row))
    return tuple(rows)


def _read_defect(pairs: dict[str, str], usual: Defect) -> Defect:
    fields = _pop_fields(_DEFECT, pairs)
    kind = pairs.get("floor", "rough" if any(entry.name in pairs for entry in _FLOOR) else "flat")
    if kind == "rough":
        fields["floor"] = RoughFloor(
            **{entry.field: entry.value_of(pairs.get(entry.name, "")) for entry in _FLOOR}
        )
    elif kind == "measured":
        fields["floor"] = unpack_points(pairs.get("points", ""))
    elif kind in ("flat", "left-out"):
        fields["floor"] = None
    else:
        raise ValueError(f"There is no floor “{_quoted(kind)}”.")
    return dataclasses.replace(usual, **fields)


def _read_number(field: Field, text: str) -> float | None:
    """Read a number in SI; ValueError with a sentence if the text is no number."""
    if text == "none" and (field.optional or field.name in _MAY_BE_NONE):
        return None
    value, is_si = _parse_number(text, field.key)
    if not is_si:
        # out of range it is refused in the same words as a number typed on the page
        field_values.read(field.key, text, _usual_limits())
    if field.whole and value == int(value):
        return int(value)
    return value if is_si else field_values.si_number(field, value)


@cache
def _usual_limits() -> Mapping[str, Range]:
    """Ranges of typed numbers, which are the same with every preset."""
    return field_values.limits_of(presets["fan-rig"])


def _parse_number(text: str, name: str) -> tuple[float, bool]:
    """A number, and True if it is marked as SI."""
    match = _NUMBER.fullmatch(text) if len(text) <= _LONGEST_NUMBER else None
    value = float(match[1]) if match else math.nan
    if match is None or not math.isfinite(value):
        raise ValueError(f"“{_quoted(text)}” is not a number for {name}.")
    return value, match[2] is not None


def _read_count(text: str, name: str) -> int:
    if not (text.isascii() and text.isdecimal() and 1 <= int(text[:3]) <= MOST_DEFECTS):
        raise ValueError(
            f"“{_quoted(text)}” is out of range: {name} goes from 1 to {MOST_DEFECTS}."
        )
    return int(text[:3])


def _read_option(choice: Choice, text: str) -> Any:
    """The value of an option."""
    if text not in choice.link_options:
        raise ValueError(f"“{_quoted(text)}” is not one of {', '.join(choice.link_options)}.")
    return choice.link_options[text]


def _option_text(choice: Choice, value: Any) -> str:
    return next(name for name, held in choice.link_options.items() if held == value)


def _read_dofs(text: str) -> tuple[str, ...] | str | None:
    if text in _DOFS_OF_WORD:
        return _DOFS_OF_WORD[text]
    names = tuple(text.split("."))
    if not set(names) <= set(DOF_NAMES) or len(set(names)) != len(names):
        raise ValueError(f"“{_quoted(text)}” is not a list of directions that can move.")
    return names


def _dofs_text(dofs: tuple[str, ...] | str | None) -> str:
    words = (word for word, meant in _DOFS_OF_WORD.items() if meant == dofs)
    return ".".join(dofs) if isinstance(dofs, tuple) else next(words)


def unpack_points(word: str) -> MeasuredFloor:
    """Read the floor of a word of `pack_points`; ValueError with a sentence for any other text."""
    most = 16 * MOST_ROWS
    try:
        squeezed = base64.b64decode(word + "=" * (-len(word) % 4), b"-_", validate=True)
        opener = zlib.decompressobj()
        raw = opener.decompress(squeezed, most + 1)  # bounded: a short word may unpack to much
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


def _quoted(text: str) -> str:
    """Untrusted text for a sentence: short, on one line."""
    clean = one_line(text, 31)
    return clean if len(clean) <= 30 else clean[:29] + "…"


@dataclass(frozen=True)
class Entry:
    """A field of a scene in an address: its name there, and functions to its text and back."""

    name: str
    field: str
    text_of: Callable[[Any], str]
    value_of: Callable[[str], Any]


def _numbers_of(part: str) -> list[Entry]:
    return [
        Entry(field.key, field.full_name, partial(number_text, field), partial(_read_number, field))
        for field in SHOWN_FIELDS
        if field.part == part
    ]


def _choices_of(choices: Iterable[Choice]) -> list[Entry]:
    return [
        Entry(
            choice.name, choice.field, partial(_option_text, choice), partial(_read_option, choice)
        )
        for choice in choices
    ]


_SCENE = {part: _numbers_of(part) for part in ("scene", "load", "bearing", "support")}
_SCENE["bearing"] += [
    Entry("rows", "rows", rows_text, _read_rows),
    Entry("estimated", "estimated", ".".join, lambda text: tuple(text.split("."))),
    Entry(
        "rating",
        "dynamic_load_rating",
        "{!r}".format,
        lambda text: _parse_number(text, "rating")[0],
    ),
]
_SCENE["scene"] += [*_choices_of(OF_SCENE), Entry("dofs", "dofs", _dofs_text, _read_dofs)]
"""Entries of each part of a scene."""
_DEFECT = [*_numbers_of("defect"), *_choices_of(OF_DEFECT)]
_FLOOR = _numbers_of("floor")
_TWO_ROWS = [*_numbers_of("pair"), *_numbers_of("second")]
"""Numbers that `rows` also holds: links have `rows`, but a person may write these."""

_PLACE_ONLY = {"v", "tab", CAGE_ANGLE}
_PLACE_NAMES = {
    *("preset", "defects", "selected", "name"),
    *(entry.name for entry in _TWO_ROWS),
    *(entry.name for entries in _SCENE.values() for entry in entries),
}
_DEFECT_NAMES = ["floor", "points", *(entry.name for entry in (*_DEFECT, *_FLOOR))]
