"""Values as plain data and as TOML text, and back; what comes in is not trusted.

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

SI units and radians, as everywhere in the core. A field that is left out has its default; one that
does not exist is refused by name. Where a field can hold one of several classes, `kind` names
it: each has its name there as the class attribute `kind`.
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
"""Characters that are read at the most: a measured floor of 100,000 points fits."""

MOST_OF = {",": 220_000, "\n": 250_000, "=": 10_000, "[": 10_000, "{": 10_000}
"""Largest number of each sign in a text: reading takes time for each value, line and table, and a
measured floor of 100,000 points has no more."""

MOST_PARTS = 20
"""Parts of a name with dots: reading one takes time as the square of their number."""

MOST_DIGITS = 1000
"""Digits of a number: more than any float has; whole numbers of a million take time to be read and
more to be printed."""

_LONG_NUMBER = re.compile(rf"=[ \t]*[+-]?(?:0[xob])?[0-9a-fA-F_]{{{MOST_DIGITS}}}")

_LONG_NAME = re.compile(rf"(?:\.[ \t]*[\w\"'-]+[ \t]*){{{MOST_PARTS}}}")

MOST_TABLES = 20
"""Parts of one kind, defects for example, that are read at the most."""

LEFT_OUT = types.MappingProxyType({"left_out": True})
"""Metadata of a field that came after files were about: its default is not written."""

T = TypeVar("T")


def to_data(value: Any) -> dict[str, Any]:
    """A dataclass as dictionaries, lists, numbers and strings, without what is None or empty.

    A field marked LEFT_OUT is left out too where it has its default.
    """
    data: dict[str, Any] = {}
    for field in dataclasses.fields(value):
        held = getattr(value, field.name)
        if held is None or held == () or (field.metadata == LEFT_OUT and held == field.default):
            continue
        named = len(_parts(type(value))[field.name]) > 1
        data[field.name] = _plain(held, named)
    return data


def from_data(kind: type[T], name: str, data: object, *, top: bool = False) -> T:
    """The dataclass of `to_data`; sentences speak of it as `name`.

    Of the `top` table of a file they name the fields alone.

    Raises
    ------
    ValueError
        that names the table and field, what stands there and what is allowed.
    """
    entries = table(name, data)
    fields = {field.name: field for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    for asked in entries:
        if asked not in fields:
            raise checks.refuse(f"field of {name}", asked, ", ".join(sorted(fields)))
    parts = _parts(kind)
    values = {}
    for field in sorted(fields.values(), key=lambda field: not parts[field.name]):
        called = field.name if top else f"{field.name} of {name}"
        if field.name in entries:
            values[field.name] = _held(parts[field.name], called, entries[field.name])
        elif field.default is dataclasses.MISSING:
            raise checks.refuse(f"{field.name} of {name}", "missing", "a value")
    try:
        return kind(**values)
    except (TypeError, OverflowError) as error:
        raise checks.refuse(name, values, f"values that fit it ({error})") from None


def to_toml(data: Mapping[str, Any]) -> str:
    """Plain data as TOML text; floats keep all their digits."""
    import tomli_w  # imported late: only files need it

    return tomli_w.dumps(dict(data))


def from_toml(text: str) -> dict[str, Any]:
    """The plain data of a TOML text.

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
    except ValueError:  # the interpreter's own limit, inside a list
        raise digits from None


def table(name: str, data: object, allowed: str = "a table") -> dict[str, Any]:
    """`data` if it is a table, a copy; else ValueError."""
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


def _plain(held: Any, named: bool) -> Any:
    if dataclasses.is_dataclass(held):
        head = {"kind": type(held).kind} if named else {}  # type: ignore[union-attr]
        return {**head, **to_data(held)}
    return [_plain(item, named) for item in held] if isinstance(held, tuple) else held


def _held(kinds: tuple[type, ...], name: str, value: Any) -> Any:
    if kinds and isinstance(value, list):
        if len(value) > MOST_TABLES:
            raise checks.refuse(name, value, f"at most {MOST_TABLES} tables")
        return tuple(_held(kinds, f"{name} {i + 1}", item) for i, item in enumerate(value))
    if not kinds or dataclasses.is_dataclass(value):
        return tuple(value) if isinstance(value, list) else value
    values = table(name, value)
    kind = kinds[0]
    if len(kinds) > 1:
        known = {k.kind: k for k in kinds}  # type: ignore[attr-defined]
        kind = known[checks.choice(f"kind of the {name}", values.pop("kind", None), tuple(known))]
    return from_data(kind, name, values)
