"""Lines of Python as they grow: a scene as people would write it, and what must be imported."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from bearing_explorer.state.quantities import defects_of
from bearingcore import Defect, MeasuredFloor, RoughFloor, Scene, presets
from bearingcore.bearings.rows import Row

MOST_POINTS = 200
"""Points of a measured floor up to which it stands in the lines; else it comes from a file."""
FILE = "bearing-scene.toml"

_DEGREES = frozenset({"extent", "center", "contact_angle"})


NEEDED = {"matplotlib": "pip install matplotlib", "bearingcore.sweep": 'pip install ".[scale]"'}
"""What lines may import that is not installed with the explorer, and how to get it."""


class Script:
    """Lines that grow, and what they import."""

    def __init__(self, scene: Scene, scene_name: str = "scene") -> None:
        self._core: set[str] = set()
        self._from: dict[str, set[str]] = {}
        self._modules: set[str] = set()
        self._body: list[str] = []
        self.add(f"{scene_name} = {self.scene(scene)}")

    def add(self, *lines: str) -> None:
        """Go on with these lines."""
        self._body += lines

    def core(self, *names: str) -> None:
        """Import from `bearingcore`."""
        self._core |= set(names)

    def module(self, line: str) -> None:
        """Import a whole module."""
        self._modules.add(line)

    def numpy(self) -> None:
        """Import NumPy."""
        self.module("import numpy as np")

    def part(self, module: str, *names: str) -> None:
        """Import from a module of `bearingcore`."""
        self._from.setdefault(f"bearingcore.{module}", set()).update(names)

    @property
    def text(self) -> str:
        """All lines."""
        standard = sorted(m for m in self._modules if m == "import math" or "pathlib" in m)
        others = sorted(self._modules - set(standard))
        needed = [
            how for name, how in NEEDED.items() if any(name in m for m in [*others, *self._from])
        ]
        notes = [f"# beside the explorer this takes: {how}" for how in needed]
        core = [f"from bearingcore import {', '.join(sorted(self._core))}"] if self._core else []
        core += [f"from {m} import {', '.join(sorted(n))}" for m, n in sorted(self._from.items())]
        blocks = [block for block in (notes, standard, others, core) if block]
        return "\n\n".join("\n".join(block) for block in [*blocks, self._body]) + "\n"

    # The scene

    def scene(self, scene: Scene) -> str:
        """An expression that makes `scene`: a preset with changes where that is the very same."""
        floors = [d.floor for d in defects_of(scene) if isinstance(d.floor, MeasuredFloor)]
        if any(len(floor.places) > MOST_POINTS for floor in floors):
            self.core("Scene")
            self.module("from pathlib import Path")
            return f'Scene.from_toml(Path("{FILE}").read_text())  # “Scene (TOML)” of Download'
        name = _nearest(scene)
        base = presets[name]
        changes: dict[str, str] = {}
        values: dict[str, Any] = {}
        for part, kind in ((scene, base), (scene.load, base.load), (scene.support, base.support),
                           (scene.bearing, base.bearing)):  # fmt: skip
            for field in dataclasses.fields(part):
                value = getattr(part, field.name)
                if field.name in ("bearing", "defect", "load", "support"):
                    continue
                if value != getattr(kind, field.name):
                    changes[field.name] = self._number(field.name, value)
                    values[field.name] = value
        defects, usual = defects_of(scene), defects_of(base)
        if len(defects) == len(usual) == 1:
            for field in dataclasses.fields(Defect):
                value = getattr(defects[0], field.name)
                if value != getattr(usual[0], field.name):
                    changes[field.name] = self._value(field.name, value)
                    values[field.name] = value
        elif scene.defect != base.defect:
            inner = ",\n        ".join(self._defect(defect) for defect in defects)
            changes["defect"] = f"(\n        {inner},\n    )"
            values["defect"] = scene.defect
        self.core("presets")
        if base.replace(**values) != scene:
            # what follows from a drawing was set apart from it: only the whole says it exactly
            self.core("Scene")
            text = scene.to_toml().replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
            return f'Scene.from_toml("""\n{text}""")'
        if not changes:
            return f'presets["{name}"]'
        given = [f"{field}={text}" for field, text in changes.items()]
        one_line = f'presets["{name}"].replace({", ".join(given)})'
        if len(one_line) <= 88 and "\n" not in one_line:
            return one_line
        return f'presets["{name}"].replace(\n    ' + ",\n    ".join(given) + ",\n)"

    def _defect(self, defect: Defect) -> str:
        self.core("Defect")
        given = [
            f"{field.name}={self._value(field.name, value)}"
            for field in dataclasses.fields(Defect)
            if (value := getattr(defect, field.name)) != field.default
        ]
        return "Defect(\n            " + ",\n            ".join(given) + ",\n        )"

    def _value(self, name: str, value: Any) -> str:
        if isinstance(value, RoughFloor):
            self.core("RoughFloor")
            return repr(value)
        if isinstance(value, MeasuredFloor):
            self.core("MeasuredFloor")
            return repr(value)
        return self._number(name, value)

    def _number(self, name: str, value: Any) -> str:
        """A value as people write it where that is the very same number."""
        if isinstance(value, float):
            if name in _DEGREES:
                degrees = float(f"{math.degrees(value):.12g}")
                if math.radians(degrees) == value:
                    self.module("import math")
                    return f"math.radians({degrees:.12g})"
            if name == "shaft_speed":
                hertz = float(f"{value / (2.0 * math.pi):.12g}")
                if hertz * (2.0 * math.pi) == value:
                    self.module("import math")
                    return f"{hertz:.12g} * (2.0 * math.pi)"
            return short(value)
        if name == "rows":
            self.part("bearings.rows", "Row")
            return f"({''.join(f'{self._row(row)}, ' for row in value).rstrip()})"
        return quoted(repr(value))

    def _row(self, row: Row) -> str:
        """A row of balls with what it does not leave as it is."""
        given = [
            f"{field.name}={self._number(field.name, held)}"
            for field in dataclasses.fields(Row)
            if (held := getattr(row, field.name)) != field.default
        ]
        return f"Row({', '.join(given)})"


def quoted(text: str) -> str:
    """Strings in the quotes of the house."""
    return text if '"' in text else text.replace("'", '"')


def short(value: float) -> str:
    """The shortest text that is this float, such as 50e-6."""
    text = repr(float(value))
    if value and math.isfinite(value) and (abs(value) < 1e-2 or abs(value) >= 1e5):
        power = 3 * math.floor(math.log10(abs(value)) / 3.0)
        engineering = f"{float(f'{value / 10.0**power:.12g}'):.12g}e{power}"
        if float(engineering) == value:
            return engineering
    return text


def _nearest(scene: Scene) -> str:
    """The preset that differs least."""

    def apart(name: str) -> int:
        base = presets[name]
        parts = ((scene.bearing, base.bearing), (scene.load, base.load),
                 (scene.support, base.support))  # fmt: skip
        return sum(
            getattr(a, field.name) != getattr(b, field.name)
            for a, b in parts
            for field in dataclasses.fields(a)
        )

    return min(presets, key=apart)
