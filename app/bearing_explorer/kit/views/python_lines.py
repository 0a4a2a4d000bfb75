"""Lines of Python that make the figure of a view; they run as they are, without the page."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

from bearingcore import Defect, Scene, presets, scene_of
from bearingcore.bearings import name_of

FILE = "bearing-scene.toml"
LONGEST_SCENE = 6000
"""Longest scene [characters] that is part of the lines; a longer one is read from its file."""
NOTHING_YET = "# Nothing has been computed in this view yet."
_DEGREES = frozenset({"extent", "center", "contact_angle"})


def figure_lines(
    scene: Scene, before: Sequence[str], figure: str, arguments: Mapping[str, str], *,
    has_numbers: bool, is_shown: bool,
) -> str:  # fmt: skip
    """Write lines that make a scene, one of its figures, and its numbers.

    Parameters
    ----------
    before
        lines between those of the scene and of the figure.
    figure, arguments
        name of its view, and its parameters with their expressions.
    has_numbers, is_shown
        the first is True if the figure has numbers, the second if it has a picture to show.
    """
    body = [f"scene = {scene_code(scene)}", *before]
    if not has_numbers:
        body.append(NOTHING_YET)
    else:
        parameters = ["scene", *(f"{name}={code}" for name, code in arguments.items())]
        call = f"drawn = figures.{figure.replace('-', '_')}({', '.join(parameters)})"
        if len(call) > 88 or "\n" in call:
            lines = "".join(f"    {code},\n" for code in parameters)
            call = f"{call.partition('(')[0]}(\n{lines})"
        body += [call, "print(drawn.sentence)", "columns = drawn.table()  # as in the CSV file"]
        if is_shown:
            body.append("drawn.show()  # in the browser")
    text = "\n".join(body)
    known = ("Recording", "Scene", "presets", "read_table", "scene_of", "simulate")
    core = [name for name in known
            if f"{name}(" in text or f"{name}[" in text or f"{name}." in text]  # fmt: skip
    imports = [
        "import math\n" if "math." in text else "",
        "from pathlib import Path\n" if "Path(" in text else "",
        "\n" if "math." in text or "Path(" in text else "",
        "from bearing_explorer import figures\n",
        f"from bearingcore import {', '.join(core)}\n",
        "from bearingcore.measured.files import Column\n" if "Column(" in text else "",
    ]
    return f"{''.join(imports)}\n{text}\n"


def changed_fields(value: Any, usual: Any) -> dict[str, Any]:
    """Return the fields in which a dataclass differs from the usual one."""
    return {
        field.name: getattr(value, field.name)
        for field in dataclasses.fields(value)
        if getattr(value, field.name) != getattr(usual, field.name)
    }


def scene_code(scene: Scene) -> str:
    """Write an expression for `scene`: a bearing by name, or a preset, with the fewest changes.

    If these do not make exactly the same scene, the expression has the whole scene as TOML.
    """
    bases = {f"presets[{code_of(name)}]": base for name, base in presets.items()}
    with suppress(ValueError):  # a bearing without a rating
        if known := name_of(scene.bearing):
            bases = {f"scene_of({code_of(known)})": scene_of(known)} | bases
    name = min(bases, key=lambda base: len(_differences(scene, bases[base])))
    changes = _differences(scene, bases[name])
    plain = all(value is None or isinstance(value, str | int | float) or
                (isinstance(value, tuple) and all(isinstance(item, str) for item in value))
                for value in changes.values())  # fmt: skip
    try:
        same = plain and bases[name].replace(**changes) == scene
    except ValueError:
        same = False
    if same:
        arguments = [f"{field}={_field_code(field, value)}" for field, value in changes.items()]
        if not arguments:
            return name
        line = f"{name}.replace({', '.join(arguments)})"
        broken = f"{name}.replace(\n    " + ",\n    ".join(arguments) + ",\n)"
        return line if len(line) <= 80 else broken
    text = scene.to_toml()
    if len(text) > LONGEST_SCENE:
        return f'Scene.from_toml(Path("{FILE}").read_text())  # “Scene (TOML)” of Share'
    escaped = text.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    return f'Scene.from_toml("""\n{escaped}""")'


def _differences(scene: Scene, base: Scene) -> dict[str, Any]:
    """Return the values of `scene` that differ from `base`, by their names in `Scene.replace`."""
    parts: list[tuple[Any, Any]] = [
        (scene, base), (scene.load, base.load), (scene.support, base.support),
        (scene.bearing, base.bearing),
    ]  # fmt: skip
    if isinstance(scene.defect, Defect) and isinstance(base.defect, Defect):
        parts.append((scene.defect, base.defect))
    changes: dict[str, Any] = {}
    for part, other in parts:
        changes |= changed_fields(part, other)
    if len(parts) == 5:
        changes.pop("defect", None)
    return {name: v for name, v in changes.items() if name not in ("load", "support", "bearing")}


def _field_code(name: str, value: Any) -> str:
    """Write a value of a scene, in degrees or hertz if that gives exactly the same number."""
    if isinstance(value, float):
        degrees = float(f"{math.degrees(value):.12g}")
        if name in _DEGREES and math.radians(degrees) == value:
            return f"math.radians({degrees:.12g})"
        hertz = float(f"{value / (2.0 * math.pi):.12g}")
        if name == "shaft_speed" and hertz * (2.0 * math.pi) == value:
            return f"{hertz:.12g} * (2.0 * math.pi)"
    return code_of(value)


def code_of(value: Any) -> str:
    """Write a plain value as an expression, with strings in double quotes."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, float):
        return short(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{code_of(k)}: {code_of(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list | tuple):
        inner = ", ".join(map(code_of, value))
        if isinstance(value, list):
            return f"[{inner}]"
        return f"({inner},)" if len(value) == 1 else f"({inner})"
    return repr(value)


def short(value: float) -> str:
    """Return the shortest text that reads as this float, such as 50e-6."""
    text = repr(float(value))
    if value and math.isfinite(value) and (abs(value) < 1e-2 or abs(value) >= 1e5):
        power = 3 * math.floor(math.log10(abs(value)) / 3.0)
        engineering = f"{float(f'{value / 10.0**power:.12g}'):.12g}e{power}"
        if float(engineering) == value:
            return engineering
    return text
