"""Conversion of values to plain data and TOML text, and back. Input is not trusted.

Works for any frozen dataclass whose fields are numbers, names, tuples of them, or further
dataclasses; `Scene.to_toml` and `Scene.from_toml` are its users. The text of a scene has a version,
the scene's own fields, and a table for each part::

    version = 1
    shaft_speed = 43.98

    [bearing]
    n_balls = 14
    ...
    [[defect]]
    extent = 0.225
    ...
    [defect.floor]
    kind = "rough"
    ...

Numbers are in SI units and radians. A field that is left out has its default; one that does not
exist is refused by name. If a field can hold one of several classes, `kind` names the class by its
class attribute `kind`.
"""

from __future__ import annotations

import dataclasses
import re
import tomllib
import types
import typing
from collections.abc import Mapping
from typing import Any, TypeVar

from bearingcore.common import _checks as checks

VERSION = 1
"""Version of the format. A reader refuses other versions instead of guessing."""

LARGEST_TEXT = 2_000_000
"""Most characters that are read: a measured floor of 100,000 points fits."""

MOST_OF = {",": 220_000, "\n": 250_000, "=": 10_000, "[": 10_000, "{": 10_000}
"""Largest number of each sign in a text: every value, line and table takes time to read, and a
measured floor of 100,000 points has no more."""

MOST_PARTS = 20
"""Most parts of a dotted name: the time to read one grows with the square of their number."""

MOST_DIGITS = 1000
"""Most digits of a number, more than any float has: whole numbers of a million digits take long to
read, and longer to print."""

_LONG_NUMBER = re.compile(rf"=[ \t]*[+-]?(?:0[xob])?[0-9a-fA-F_]{{{MOST_DIGITS}}}")

_LONG_NAME = re.compile(rf"(?:\.[ \t]*[\w\"'-]+[ \t]*){{{MOST_PARTS}}}")

MOST_TABLES = 20
"""Most parts of one kind, such as defects, that are read."""

LEFT_OUT = types.MappingProxyType({"left_out": True})
"""Metadata of a field that is newer than the first files: its default is not written."""

T = TypeVar("T")


def to_data(value: Any) -> dict[str, Any]:
    """Return a dataclass as dictionaries, lists, numbers and strings, without empty fields.

    A field marked LEFT_OUT is also left out if it has its default.
    """
    data: dict[str, Any] = {}
    for field in dataclasses.fields(value):
        item = getattr(value, field.name)
        if item is None or item == () or (field.metadata == LEFT_OUT and item == field.default):
            continue
        needs_kind = len(_parts(type(value))[field.name]) > 1
        data[field.name] = _to_plain(item, needs_kind)
    return data


def from_data(kind: type[T], name: str, data: object, *, top: bool = False) -> T:
    """Return the dataclass from plain data, as made by `to_data`; errors call it `name`.

    Errors about the `top` table of a file name only the fields.

    Raises
    ------
    ValueError
        naming the table and field, its value and what is allowed.
    """
    entries = table(name, data)
    fields = {field.name: field for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    for entry in entries:
        if entry not in fields:
            raise checks.refuse(f"field of {name}", entry, ", ".join(sorted(fields)))
    parts = _parts(kind)
    values = {}
    for field in sorted(fields.values(), key=lambda field: not parts[field.name]):
        field_name = field.name if top else f"{field.name} of {name}"
        if field.name in entries:
            values[field.name] = _from_plain(parts[field.name], field_name, entries[field.name])
        elif field.default is dataclasses.MISSING:
            raise checks.refuse(f"{field.name} of {name}", "missing", "a value")
    try:
        return kind(**values)
    except (TypeError, OverflowError) as error:
        raise checks.refuse(name, values, f"values that fit it ({error})") from None


def to_toml(data: Mapping[str, Any]) -> str:
    """Return plain data as TOML text; floats keep all their digits."""
    import tomli_w  # imported late: only files need it

    return tomli_w.dumps(dict(data))


def from_toml(text: str) -> dict[str, Any]:
    """Return the plain data of a TOML text.

    Raises
    ------
    ValueError
        for text that is too long or not TOML.
    """
    checks.instance("text", text, str, "a text in TOML")
    if len(text) > LARGEST_TEXT:
        raise checks.refuse("length of the text", len(text), f"at most {LARGEST_TEXT} characters")
    for sign, most in MOST_OF.items():
        if (count := text.count(sign)) > most:
            what = {"\n": "lines"}.get(sign, f"signs {sign}")
            raise checks.refuse(f"number of {what} in the text", count, f"at most {most}")
    digits = checks.refuse("a number in the text", "one of many digits", f"{MOST_DIGITS} at most")
    if _LONG_NUMBER.search(text):
        raise digits
    if _LONG_NAME.search(text):
        raise checks.refuse("a name in the text", "one with many dots", f"{MOST_PARTS} at most")
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise checks.refuse("text", " ".join(text.split()), f"TOML ({error})") from None
    except ValueError:  # Python's own limit of digits, which a number inside a list can reach
        raise digits from None


def table(name: str, data: object, allowed: str = "a table") -> dict[str, Any]:
    """Return a copy of `data` if it is a table, else raise ValueError."""
    if not isinstance(data, Mapping):
        raise checks.refuse(name, "missing" if data is None else data, allowed)
    return dict(data)


def _parts(kind: type) -> dict[str, tuple[type, ...]]:
    """Return, for each field of a dataclass, the dataclasses that it can hold."""

    def inside(hint: Any) -> tuple[type, ...]:
        if dataclasses.is_dataclass(hint) and isinstance(hint, type):
            return (hint,)
        if isinstance(hint, types.UnionType) or typing.get_origin(hint) is not None:
            return tuple(dict.fromkeys(p for a in typing.get_args(hint) for p in inside(a)))
        return ()

    hints = typing.get_type_hints(kind)
    return {field.name: inside(hints[field.name]) for field in dataclasses.fields(kind)}


def _to_plain(value: Any, needs_kind: bool) -> Any:
    if dataclasses.is_dataclass(value):
        head = {"kind": type(value).kind} if needs_kind else {}  # type: ignore[union-attr]
        return {**head, **to_data(value)}
    return [_to_plain(item, needs_kind) for item in value] if isinstance(value, tuple) else value


def _from_plain(kinds: tuple[type, ...], name: str, value: Any) -> Any:
    if kinds and isinstance(value, list):
        if len(value) > MOST_TABLES:
            raise checks.refuse(name, value, f"at most {MOST_TABLES} tables")
        return tuple(_from_plain(kinds, f"{name} {i + 1}", item) for i, item in enumerate(value))
    if not kinds or dataclasses.is_dataclass(value):
        return tuple(value) if isinstance(value, list) else value
    values = table(name, value)
    kind = kinds[0]
    if len(kinds) > 1:
        known = {k.kind: k for k in kinds}  # type: ignore[attr-defined]
        kind = known[checks.choice(f"kind of the {name}", values.pop("kind", None), tuple(known))]
    return from_data(kind, name, values)
