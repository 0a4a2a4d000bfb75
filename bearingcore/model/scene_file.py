"""A scene as plain data and as TOML text, and back; what comes in is not trusted.

The text has a version, the scene's own fields, and a table for each part::

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
does not exist is refused by name.
"""

from __future__ import annotations

import dataclasses
import tomllib
from collections.abc import Callable, Mapping
from typing import Any

from bearingcore.common import checks
from bearingcore.model.bearing import Bearing
from bearingcore.model.defect import Defect
from bearingcore.model.floor import MeasuredFloor, RoughFloor
from bearingcore.model.scene import Load, Scene, Support

VERSION = 1
"""Of the format. A reader refuses other versions instead of guessing."""

LARGEST_TEXT = 2_000_000
"""Characters that are read at the most: a measured floor of 100,000 points fits."""

MOST_DEFECTS = 20

_FLOORS = {"rough": RoughFloor, "measured": MeasuredFloor}


def scene_data(scene: Scene) -> dict[str, Any]:
    """A scene as dictionaries, lists, numbers and strings; what is None is left out."""
    data: dict[str, Any] = {"version": VERSION}
    for field in dataclasses.fields(Scene):
        value = getattr(scene, field.name)
        if field.name in ("bearing", "load", "support"):
            continue
        if field.name == "defect":
            continue
        if value is not None:
            data[field.name] = list(value) if isinstance(value, tuple) else value
    for name in ("bearing", "load", "support"):
        data[name] = _plain(getattr(scene, name))
    data["defect"] = [_defect_data(defect) for defect in scene.defects]
    return data


def scene_from_data(data: object) -> Scene:
    """The scene of `scene_data`.

    Raises
    ------
    ValueError
        that names the table and field, what stands there and what is allowed.
    """
    table = _table("scene", data)
    version = table.pop("version", VERSION)
    if version != VERSION or isinstance(version, bool):
        raise checks.refuse("version", version, str(VERSION))
    defects = table.pop("defect", [])
    if isinstance(defects, Mapping):
        defects = [defects]
    if not isinstance(defects, list) or len(defects) > MOST_DEFECTS:
        raise checks.refuse("defect", _short(defects), f"at most {MOST_DEFECTS} tables")
    parts: dict[str, Any] = {}
    for name, kind in (("bearing", Bearing), ("load", Load), ("support", Support)):
        if name not in table and name != "load":
            raise checks.refuse(name, "missing", f"a table [{name}]")
        parts[name] = _make(kind, name, table.pop(name, {}))
    made = tuple(_defect(f"defect {i + 1}", item) for i, item in enumerate(defects))
    parts["defect"] = made[0] if len(made) == 1 else made or Defect.none()
    if "dofs" in table:
        if not isinstance(table["dofs"], list):
            raise checks.refuse("dofs", _short(table["dofs"]), "a list of names")
        table["dofs"] = tuple(table["dofs"])
    return _make(Scene, "scene", {**table, **parts})


def to_toml(scene: Scene) -> str:
    """A scene as TOML text; floats keep all their digits."""
    import tomli_w  # imported late: only files need it

    return tomli_w.dumps(scene_data(scene))


def from_toml(text: str) -> Scene:
    """The scene of a TOML text.

    Raises
    ------
    ValueError
        for text that is too long or not TOML, and as `scene_from_data`.
    """
    if len(text) > LARGEST_TEXT:
        raise checks.refuse("length of the text", len(text), f"at most {LARGEST_TEXT} characters")
    try:
        data = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise ValueError(f"the text is not TOML: {error}") from None
    return scene_from_data(data)


def _plain(part: Any) -> dict[str, Any]:
    return {
        field.name: value
        for field in dataclasses.fields(part)
        if (value := getattr(part, field.name)) is not None
    }


def _defect_data(defect: Defect) -> dict[str, Any]:
    data = _plain(dataclasses.replace(defect, floor=None))
    floor = defect.floor
    if floor is not None:
        kind = next(name for name, cls in _FLOORS.items() if isinstance(floor, cls))
        values = {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in _plain(floor).items()
        }
        data["floor"] = {"kind": kind, **values}
    return data


def _defect(name: str, data: object) -> Defect:
    table = _table(name, data)
    if "floor" in table:
        floor = _table(f"floor of {name}", table["floor"])
        kind = checks.choice(
            f"kind of the floor of {name}", floor.pop("kind", None), tuple(_FLOORS)
        )
        for field, value in floor.items():
            if isinstance(value, list):
                floor[field] = tuple(value)
        table["floor"] = _make(_FLOORS[kind], f"floor of {name}", floor)
    return _make(Defect, name, table)


def _table(name: str, data: object) -> dict[str, Any]:
    if not isinstance(data, Mapping):
        raise checks.refuse(name, _short(data), "a table")
    return dict(data)


def _make(kind: Callable[..., Any], name: str, data: object) -> Any:
    """An object of a dataclass from a table, refusing fields that it does not have or lacks."""
    table = _table(name, data)
    fields = dataclasses.fields(kind)  # type: ignore[arg-type]
    known = {field.name for field in fields}
    for given in table:
        if given not in known:
            raise checks.refuse(f"field of {name}", _short(given), ", ".join(sorted(known)))
    for field in fields:
        if field.default is dataclasses.MISSING and field.name not in table:
            raise checks.refuse(f"{field.name} of {name}", "missing", "a value")
    try:
        return kind(**table)
    except (TypeError, OverflowError) as error:
        raise ValueError(f"{name}: {error}") from None


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
