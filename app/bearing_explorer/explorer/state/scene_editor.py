"""Editor of the scene: the scene, the numbers as they were typed, the selected defect.

This module uses no Panel and draws nothing. Requests come from the browser and are not trusted:
they are checked here. A refused request changes nothing, and a sentence says why.
"""

from __future__ import annotations

import contextlib
import copy
import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from bearing_explorer.explorer.state.bearing_kinds import (
    MOST_SHOWN_ROWS,
    add_thrust,
    convert_to_kind,
    hidden_of,
    scene_with,
)
from bearing_explorer.explorer.state.choice_list import (
    CHOICE_LIST,
    IN_PART,
    Choice,
    chosen_of,
    floor_name,
)
from bearing_explorer.explorer.state.field_values import (
    CAGE_ANGLE,
    FIELD_BY_KEY,
    FIRST_ROUGHNESS,
    SHOWN_FIELDS,
    Values,
    defects_of,
    differ,
    groove_limits,
    limits_of,
    read,
    scene_with_fields,
    second_units,
    si_number,
    values_of,
)
from bearing_explorer.kit.bearing_list import find_bearing, origin_words
from bearing_explorer.kit.sentences import one_line, sentence_of
from bearingcore import (
    Bearing,
    Defect,
    RoughFloor,
    Scene,
    preset_notes,
    presets,
    scene_of,
)
from bearingcore.bearings import (
    BALL_MATERIAL,
    BALL_MATERIALS,
    OPTIONAL_FIELDS,
    USUAL_GROOVES,
    drawn,
)
from bearingcore.common import number, refuse
from bearingcore.fields import Range
from bearingcore.model.scene import TILT_FREE, preset_labels
from bearingcore.units import read_number

MOST_DEFECTS = 6
LONGEST_NAME = 60
"""Most characters of the name of a bearing."""
ESTIMATED = "inside estimated"
"""Words after the name of a bearing whose inside dimensions are estimates."""

_USUAL = {"defect": "defect", "load": "load", "shaft_speed": "speed", "support": "support"}
"""Parts of a scene that come with a listed bearing, and their names in a sentence."""
_NO_DEFECT = Defect(0.0, 50e-6, math.radians(270.0), edge="exact")
"""Defect without a length; once a slider gives it one, it lies in the middle of the load zone."""
_FIRST_DEFECT = (math.radians(10.0), 50e-6)
_OF_FLOOR = [field.key for field in SHOWN_FIELDS if field.part == "floor"]

Refused = dict[str, str]
"""Sentences by the names of the controls that they belong to."""


@dataclass(frozen=True)
class CatalogueOrigin:
    """The listed bearing from which the scene's bearing came: its name, source and numbers."""

    name: str
    words: str
    bearing: Bearing


@dataclass(eq=False)
class SceneEditor:
    """The state of the controls, and the scene that they describe.

    Its tables are replaced, never changed in place, so a shallow copy keeps a whole state.
    """

    preset: str
    scene: Scene = field(init=False)
    values: Values = field(init=False)
    limits: dict[str, Range] = field(init=False)
    selected: int = field(init=False)
    own_name: str = field(init=False, default="")
    """The name that a person gave the bearing; may be empty."""
    origin: CatalogueOrigin | None = field(init=False, default=None)
    """The entry of a list that the bearing was taken from."""
    base: Scene = field(init=False)
    """The preset, or the usual scene of a listed bearing, from which changes began."""
    effects: dict[str, str] = field(init=False, default_factory=dict)
    """Sentences on effects of the last choices that are not obvious, by names of choices."""

    def __post_init__(self) -> None:
        self.take_preset(self.preset)

    def take_preset(self, name: str) -> None:
        """Show the scene of a preset."""
        self.take_scene(presets[name], name)

    def take_scene(
        self,
        scene: Scene,
        preset: str = "",
        selected: int = 0,
        cage_angle: float = 0.0,
        name: str = "",
    ) -> None:
        """Show a scene that comes from a link or a file, at a cage angle in degrees.

        Without a `preset` it counts as a change of the preset that has its bearing, or else of the
        present one. If the page cannot show the scene, ValueError is raised and nothing changes.
        """
        if preset not in presets:
            alike = [name for name in presets if presets[name].bearing == scene.bearing]
            preset = self.preset if self.preset in alike or not alike else alike[0]
        defects = [_within_one_turn(defect) for defect in defects_of(scene)]
        if len(defects) > MOST_DEFECTS:
            raise refuse("number of defects", len(defects), f"at most {MOST_DEFECTS} here")
        if len(scene.bearing.all_rows) > MOST_SHOWN_ROWS:
            rows = len(scene.bearing.all_rows)
            raise refuse("number of rows", rows, f"at most {MOST_SHOWN_ROWS} here")
        if not 0 <= selected < len(defects):
            raise refuse("selected defect", selected + 1, f"1 to {len(defects)}")
        scene = scene.replace(defect=defects[0] if len(defects) == 1 else tuple(defects))
        limits = limits_of(presets[preset]) | groove_limits(scene)
        for index in range(len(defects)):
            values = {**values_of(scene, index), CAGE_ANGLE: cage_angle}
            for key, value in values.items():
                if not math.isnan(value):  # NaN: the scene does not have this number
                    read(key, repr(value), limits)
        self.preset, self.scene, self.selected = preset, scene, selected
        self.base = presets[preset]
        self.own_name, self.origin, self.effects = one_line(name, LONGEST_NAME), None, {}
        self.limits = limits
        self.values = {}
        self._write_values(cage_angle)

    def __eq__(self, other: object) -> bool:
        """True if a person would see no difference."""
        return isinstance(other, SceneEditor) and self._visible_state == other._visible_state

    __hash__ = None  # type: ignore[assignment]

    @property
    def _visible_state(self) -> tuple[object, ...]:
        return self.scene, self.preset, self.own_name, self.origin, self.values[CAGE_ANGLE]

    def snapshot(self) -> SceneEditor:
        """Copy the whole state, for `restore`."""
        return copy.copy(self)

    def restore(self, kept: SceneEditor) -> None:
        """Set all as it was when the snapshot was taken."""
        vars(self).update(vars(kept))

    @property
    def defects(self) -> tuple[Defect, ...]:
        """All defects of the list, also those without extent or depth."""
        return defects_of(self.scene)

    @property
    def changed(self) -> bool:
        """True if the bearing is no longer that of the preset."""
        return self.scene.bearing != presets[self.preset].bearing

    @property
    def name(self) -> str:
        """Name of the bearing: a person's name for it, else that of the preset it began from."""
        label = preset_labels[self.preset]
        name = self.name_in_links or label + (", changed" if self.changed else "")
        return f"{name} ({ESTIMATED})" if self.scene.bearing.estimated else name

    @property
    def name_in_links(self) -> str:
        """A person's name for the bearing, marked if its numbers have changed since; or empty."""
        changed = bool(self.own_name) and self.own_name == self._changed_listed_name
        return self.own_name + (", changed" if changed else "")

    @property
    def note(self) -> str:
        """Source of the bearing's numbers."""
        if not self.changed:
            return preset_notes.get(self.preset, "")
        if self.origin is not None and not self._changed_listed_name:
            return self.origin.words
        still = " Some numbers are still estimates." if self.scene.bearing.estimated else ""
        source = self._changed_listed_name or self.preset
        return f"Edited from “{source}”; its sources no longer apply.{still}"

    @property
    def _changed_listed_name(self) -> str:
        """Name of a listed bearing whose numbers have been changed; else empty."""
        if self.origin is None or self.origin.bearing == self.scene.bearing:
            return ""
        return self.origin.name

    def take_bearing(self, bearing: Bearing, name: str, origin: str) -> None:
        """Replace the bearing by a listed one.

        It comes without a defect, and with the load, speed and support that are usual for it
        (`scene_of`). Those of them that a person has changed stay as they are.

        If the remaining defects do not fit it, ValueError is raised and nothing changes.
        """
        # parts of the scene that a person has changed stay; the others are the usual ones
        usual = scene_of(bearing).replace(defect=_NO_DEFECT)
        kept = [part for part in _USUAL if getattr(self.scene, part) != getattr(self.base, part)]
        extents = " and ".join(f"{number(math.degrees(d.extent))}°" for d in self.scene.defects)
        loss = f"The defect of {extents} is gone. " if extents and "defect" not in kept else ""
        fresh = {part: getattr(usual, part) for part in _USUAL if part not in kept}
        # the old defect must not be checked against the new bearing if it is dropped anyway
        before = self.scene.replace(defect=fresh.get("defect", self.scene.defect))
        if before.dofs == self.base.dofs:
            before = before.replace(dofs=None)
        scene, effect = add_thrust(scene_with(before, bearing).replace(**fresh))
        self.selected = self.selected if "defect" in kept else 0
        self.base = usual
        self._show_scene(scene)
        self.limits = limits_of(self.scene)
        self._write_values()
        self.effects["preset"] = f"{loss}{_usual_words(scene, kept)} {effect}".rstrip()
        self.own_name = one_line(name, LONGEST_NAME)
        self.origin = CatalogueOrigin(self.own_name, origin, self.scene.bearing)

    @property
    def focus(self) -> int:
        """Index in `scene.defects` of the selected defect; 0 if that has no extent or depth."""
        defect = self.defects[self.selected]
        before = [d for d in self.defects[: self.selected] if not d.is_none]
        return 0 if defect.is_none else len(before)

    # Numbers

    def read_units(self, texts: Mapping[str, Any], second: bool) -> dict[str, Any]:
        """Convert typed texts to the units of the fields; `second`: from the second unit's box.

        A number may name either unit in both boxes. A text that is a number in neither is
        returned unchanged, and `set` refuses it.
        """
        units = second_units(self.scene, self.selected)

        def convert(name: str, text: str) -> str:
            word, _, _ = units[name]["unit"].partition(" ")  # of "µm dia."; "× ball" is a ratio
            other = (word.removeprefix("×"), units[name]["factor"])
            ways = [(FIELD_BY_KEY[name].shown_unit, 1.0), other]
            for unit, factor in reversed(ways) if second else ways:
                with contextlib.suppress(ValueError):
                    value = read_number(text[:40], unit) / factor
                    return text if factor == 1.0 else f"{value:.12g}"
            return text

        return {
            name: convert(name, text) if name in units and isinstance(text, str) else text
            for name, text in texts.items()
        }

    def set(self, values: Mapping[Any, Any]) -> tuple[Refused, Values]:
        """Set numbers, dragged or typed; return refusals and all values that changed."""
        refused: Refused = {}
        accepted: Values = {}
        for name, value in list(values.items())[: len(FIELD_BY_KEY)]:
            try:
                accepted[str(name)] = read(str(name), value, self.limits)
            except ValueError as error:
                refused[str(name)[:60]] = str(error)
        try:
            scene = self._scene_with(accepted)
        except ValueError as error:
            return refused | {name: sentence_of(error) for name in accepted}, {}
        before = self.values
        self.effects = self.effects if scene == self.scene else {}
        self._show_scene(scene, cage_angle=accepted.get(CAGE_ANGLE))
        self._set_values(self.values | accepted)
        changed = {
            name: value for name, value in self.values.items() if differ(before[name], value)
        }
        return refused, changed

    def _scene_with(self, accepted: Values) -> Scene:
        """The scene with these numbers of the page; ValueError if they do not fit together."""
        fields: dict[str, Any] = {}
        rough: dict[str, Any] = {}
        for name, value in accepted.items():
            field = FIELD_BY_KEY[name]
            if field.part:
                numbers = rough if field.part == "floor" else fields
                numbers[field.full_name] = si_number(field, value)
        bearing = self.scene.bearing
        if "ball_diameter" in fields:
            # grooves are made for their ball: they keep their ratio to it
            ratio = fields["ball_diameter"] / bearing.ball_diameter
            inputs = bearing.kind.inputs(bearing)
            for race in ("inner", "outer"):
                radius, name = bearing.groove_radius(race), f"{race}_groove_radius"
                if name in inputs and radius is not None:
                    fields.setdefault(name, radius * ratio)
        if rough:
            floor = self.defects[self.selected].floor
            if not isinstance(floor, RoughFloor):
                raise refuse("floor of the defect", floor_name(floor), "rough")
            fields["floor"] = dataclasses.replace(floor, **rough)
        return scene_with_fields(self.scene, fields, self.selected)

    def _show_scene(self, scene: Scene, cage_angle: float | None = None) -> None:
        """Show a scene; a bearing with other balls has other limits of its grooves."""
        if scene.bearing != self.scene.bearing:
            self.limits = self.limits | groove_limits(scene)
        self.scene = scene
        self._write_values(cage_angle)

    def _write_values(self, cage_angle: float | None = None) -> None:
        """Set the values of the controls from the scene."""
        angle = self.values.get(CAGE_ANGLE, 0.0) if cage_angle is None else cage_angle
        fresh = {**values_of(self.scene, self.selected), CAGE_ANGLE: angle}
        # a typed number stays as it was typed, although its last digit may differ in SI
        self._set_values(
            {
                name: self.values[name]
                if name in self.values and _close(self.values[name], fresh[name])
                else fresh[name]
                for name in FIELD_BY_KEY
            }
        )

    def _set_values(self, values: Values) -> None:
        """Set the values; limits widen to contain them."""
        self.values = values
        self.limits = {name: self.limits[name].around(value) for name, value in values.items()}

    # Choices

    def choose(self, choice: Mapping[str, str]) -> Refused:
        """Carry out choices; options that are not in the list of their choice are ignored."""
        self.effects = {}
        if (preset := choice.get("preset", "")) in presets:
            self.take_preset(preset)
        if "name" in choice:
            self.own_name = one_line(choice["name"], LONGEST_NAME)
        takers: dict[str, Callable[[str], None]] = {
            **{known.name: partial(self._take_option, known) for known in CHOICE_LIST},
            "floor": self._take_floor_kind,
            "numbers": self._take_numbers,
            "ball_material": self._take_ball_material,
            "kind": self._take_kind,
            "dofs": self._take_dofs,
            "defect": self._take_defect,
            "bearing": self._take_listed,
        }
        names = [known.name for known in CHOICE_LIST if choice.get(known.name) in known.names]
        names += [name for name in ("defect", "bearing") if name in choice]
        refused: Refused = {}
        for name in names:
            try:
                takers[name](choice[name])
            except ValueError as error:
                refused[name] = sentence_of(error)
        return refused

    def _change(self, **fields: Any) -> None:
        self._show_scene(scene_with_fields(self.scene, fields, self.selected))

    def _take_option(self, choice: Choice, name: str) -> None:
        """Take an option of a choice that is a field of the scene or of its defects."""
        fields = {choice.field: choice.value_of(name)}
        if not choice.all_alike:
            self._change(**fields)
            return
        self._change_defects(
            [dataclasses.replace(defect, **fields) for defect in self.defects], self.selected
        )

    def _take_listed(self, name: str) -> None:
        listed = find_bearing(name)
        origin = origin_words(listed)
        self.take_bearing(listed.bearing, listed.name, origin)
        if listed.assumed:  # shown beside the choice; sources are behind the question mark
            self.effects["preset"] += f" Assumed: {', '.join(listed.assumed)}."

    def _take_kind(self, kind: str) -> None:
        scene, effect = add_thrust(
            scene_with(self.scene, convert_to_kind(self.scene.bearing, kind))
        )
        self._show_scene(scene)
        if effect:
            self.effects["kind"] = effect
        self.limits = {**limits_of(self.scene), **groove_limits(self.scene)}
        self._write_values()

    def _take_floor_kind(self, kind: str) -> None:
        if kind == floor_name(self.defects[self.selected].floor):
            return
        if kind == "measured":
            raise ValueError(
                "A measured floor comes with a scene's link or file: `read_floor` makes it in "
                "Python."
            )
        self._change(floor=FIRST_ROUGHNESS if kind == "rough" else None)

    def _take_dofs(self, dofs: str) -> None:
        if dofs == IN_PART:
            raise ValueError("Single directions are held by a link or a file.")
        self._change(dofs=None if dofs == "auto" else TILT_FREE)

    def _take_defect(self, which: str) -> None:
        if which == "add":
            self._add_defect()
        elif which == "remove" and len(self.defects) > 1:
            rest = [d for i, d in enumerate(self.defects) if i != self.selected]
            self._change_defects(rest, min(self.selected, len(rest) - 1))
        elif which.isdecimal() and int(which[:3]) < len(self.defects):
            self.selected = int(which[:3])
            self._write_values()

    def _add_defect(self) -> None:
        """Add a defect like the last one where the race has most room, shortened to fit."""
        if len(self.defects) >= MOST_DEFECTS:
            raise ValueError(f"There are {MOST_DEFECTS} defects already, the most there can be.")
        last = self.defects[-1]
        extent, depth = _FIRST_DEFECT if last.is_none else (last.extent, last.depth)
        # the whole number of degrees that is farthest from all defects
        center = max(map(math.radians, range(360)), key=lambda angle: _gap_to(self.defects, angle))
        extent = min(extent, 1.6 * max(_gap_to(self.defects, center), 0.0))
        new = dataclasses.replace(last, center=center, floor=None, extent=extent, depth=depth)
        if new.is_none:
            raise ValueError("The defects leave no room on the race: make one shorter first.")
        self._change_defects([*self.defects, new], len(self.defects))

    def _change_defects(self, defects: list[Defect], selected: int) -> None:
        scene = self.scene.replace(defect=defects[0] if len(defects) == 1 else tuple(defects))
        self.selected = selected
        self._show_scene(scene)

    def _take_numbers(self, how: str) -> None:
        """Describe the bearing by a "drawing", or by "direct" numbers of the contact model."""
        bearing = self.scene.bearing
        if how == "drawing" and not bearing.is_drawn:
            as_drawn = drawn(bearing).replace(rows=bearing.rows, estimated=bearing.estimated)
            self._show_scene(self.scene.replace(bearing=as_drawn))
            self.effects["numbers"] = (
                f"The grooves begin with {USUAL_GROOVES['inner']} (inner) and "
                f"{USUAL_GROOVES['outer']} (outer) ball diameters, as is usual, in steel: change "
                "them where the drawing says otherwise. The load-deflection factor was "
                f"{number(bearing.load_deflection_factor / 1e6)} MN/m¹·⁵ and is now "
                f"{number(as_drawn.load_deflection_factor / 1e6)}."
            )
        elif how == "direct" and bearing.is_drawn:
            fields: dict[str, Any] = dict.fromkeys((*OPTIONAL_FIELDS, *BALL_MATERIAL))
            self._show_scene(self.scene.replace(bearing=dataclasses.replace(bearing, **fields)))

    def _take_ball_material(self, name: str) -> None:
        bearing = self.scene.bearing
        self._show_scene(self.scene.replace(bearing=bearing.with_balls_of(BALL_MATERIALS[name])))

    # State for the browser

    def state(self, values: Iterable[str] | None = None) -> dict[str, Any]:
        """State for the browser: all of it, or only that of the fields in `values`."""
        wanted = self.values if values is None else {name: self.values[name] for name in values}
        state: dict[str, Any] = {
            "values": {name: None if math.isnan(v) else v for name, v in wanted.items()},
            "limits": {
                name: {"least": limit.least, "most": limit.most, "step": limit.step}
                for name, limit in self.limits.items()
                if name in wanted
            },
            "changed": self.changed,
            "second_units": second_units(self.scene, self.selected),
            "bearing": {
                "name": self.name,
                "own": self.own_name,
                "note": self.note,
                "element": self.scene.bearing.kind.element,
            },
        }
        return state if values is not None else state | self._choices_state()

    def _choices_state(self) -> dict[str, Any]:
        """State of the choices and of the list of defects, for the browser."""
        scene, floor = self.scene, self.defects[self.selected].floor
        usual = {k: v for k, v in values_of(presets[self.preset]).items() if not math.isnan(v)}
        hidden = [] if isinstance(floor, RoughFloor) else _OF_FLOOR
        hidden = [*hidden, *hidden_of(scene.bearing)]
        return {
            "usual": {**usual, **chosen_of(presets[self.preset])},
            "choices": {**chosen_of(scene, self.selected), "preset": self.preset},
            "defects": {
                "names": [
                    f"{d.race} race at {round(math.degrees(d.center)) % 360}°" for d in self.defects
                ],
                "selected": self.selected,
                "most": MOST_DEFECTS,
            },
            "hidden": hidden,
            "effects": self.effects,
        }


def _usual_words(scene: Scene, kept: Iterable[str]) -> str:
    """Sentence on the parts that came with a listed bearing, and on those that were kept."""
    loads = ((-scene.load.fy, "down"), (scene.load.fz, "along the shaft"))
    words = {
        "defect": "no defect",
        "load": " and ".join(f"{number(load)} N {where}" for load, where in loads if load),
        "shaft_speed": f"{number(scene.shaft_speed * 30.0 / math.pi, 4)} turns a minute",
        "support": f"a rotor and a housing of {number(scene.support.inner_mass)} kg each, on "
        f"springs of {number(1e-6 * scene.support.stiffness_y)} N/µm",
    }
    new = [words[part] for part in _USUAL if part not in kept]
    names = [name for part, name in _USUAL.items() if part in kept]
    usual = f"Usual for it, and assumed: {', '.join(new)}." if new else ""
    return f"{usual} Kept as you set it: {', '.join(names)}.".strip() if names else usual


def _within_one_turn(defect: Defect) -> Defect:
    """The same defect with its centre within one turn, as the page shows it."""
    if 0.0 <= defect.center <= 2.0 * math.pi:
        return defect
    return dataclasses.replace(defect, center=defect.center % (2.0 * math.pi))


def _gap_to(defects: Iterable[Defect], angle: float) -> float:
    """Angle [rad] from `angle` to the nearest defect; negative inside one."""
    return min(
        abs(math.remainder(angle - defect.center, 2.0 * math.pi)) - 0.5 * defect.extent
        for defect in defects
    )


def _close(a: float, b: float) -> bool:
    """True if two numbers differ at most by the rounding of units."""
    return (math.isnan(a) and math.isnan(b)) or math.isclose(a, b, rel_tol=1e-10, abs_tol=1e-12)
