"""Differences of two scenes, in words."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from bearing_explorer.explorer.state.choice_list import OF_DEFECT, OF_SCENE, Choice
from bearing_explorer.explorer.state.field_values import (
    SHOWN_FIELDS,
    defects_of,
    differ,
    values_of,
)
from bearing_explorer.explorer.state.references import usual_name
from bearing_explorer.kit.sentences import label_inside, with_unit
from bearingcore import Scene
from bearingcore.common import number, with_prefix
from bearingcore.fields import Field

MOST_NUMBERS = 3
"""Most changed numbers that are named; more are called another bearing, or several changes."""
WHOLE = 0.02
"""Share of a ball spacing: a change so close to whole spacings is called whole."""


def difference(now: Scene, before: Scene, focus: int = 0) -> str:
    """Changes from the scene `before` to `now` in words; `focus` is the selected defect."""
    if not (now.defects and before.defects) and now.healthy() == before.healthy():
        return "With the defect" if now.defects else "Without the defect"
    defects, earlier = defects_of(now), defects_of(before)
    if len(defects) != len(earlier):
        return "A defect more" if len(defects) > len(earlier) else "A defect less"
    changed = _changed_fields(now, before, focus)
    if len(changed) > MOST_NUMBERS:
        return "Another bearing" if now.bearing != before.bearing else "Several changes at once"
    words = [
        f"{choice.label} ({name_before} → {name})"
        for choice, name, name_before in _changed_choices(now, before, focus)
    ]
    if now.dofs != before.dofs:
        words.append("Other free directions")
    words += [_change_words(field, *numbers, now) for field, numbers in changed.items()]
    if not words:
        return "Another defect has changed" if defects != earlier else "The scene has changed"
    first, *others = words
    return ", ".join([first, *(word[0].lower() + word[1:] for word in others)])


def distinct_name(scene: Scene, others: Iterable[Scene], focus: int = 0, bearing: str = "") -> str:
    """Name a scene by its differences from others: "100 N", "6208, 7 Hz", "12.9°, 50 µm".

    The name has at most MOST_NUMBERS of them. Another bearing comes first, by its name `bearing`
    if it has one. Without a difference the name is the size of the defect `focus`.
    """
    changed: dict[Field, float] = {}
    options: dict[str, None] = {}
    turned = False
    for other in others:
        changed |= {
            field: number
            for field, (number, _) in _changed_fields(scene, other, focus).items()
            if field.name != "center" or (scene.defects and other.defects)
        }
        options |= {name: None for _, name, _ in _changed_choices(scene, other, focus)}
        turned |= not math.isclose(_direction(scene), _direction(other), abs_tol=1e-6)
    of_bearing = [field for field in changed if field.part in ("bearing", "pair", "second")]
    names: dict[str, None] = {}
    if len(of_bearing) > MOST_NUMBERS:
        size = number(1e3 * scene.bearing.ball_diameter)
        elements = f"{scene.bearing.total_balls} {scene.bearing.kind.element}s of {size} mm"
        names[bearing or elements] = None
        changed = {field: changed[field] for field in changed if field not in of_bearing}
    for field in (field for field in SHOWN_FIELDS if field in changed):
        if field.name in ("extent", "depth"):
            name = usual_name(scene, focus)
        elif field.name in ("fx", "fy"):
            at_angle = (
                f" at {round(math.degrees(_direction(scene)), 1) % 360.0:.4g}°" if turned else ""
            )
            name = f"{with_prefix(math.hypot(scene.load.fx, scene.load.fy), 'N')}{at_angle}"
        else:
            name = _read_number(field, changed[field])
            name = name if field.name == "shaft_speed" else f"{label_inside(field)} {name}"
        names[name] = None
    return ", ".join([*names, *options][:MOST_NUMBERS]) or usual_name(scene, focus)


def _defect_at(scene: Scene, focus: int) -> int:
    """Index of the defect `focus`, or of the last defect if the scene has fewer."""
    return min(focus, len(defects_of(scene)) - 1)


def _changed_fields(scene: Scene, other: Scene, focus: int) -> dict[Field, tuple[float, float]]:
    """Fields in which two scenes differ, each with its number in both."""
    numbers, others = (values_of(each, _defect_at(each, focus)) for each in (scene, other))
    return {
        field: (numbers[field.key], others[field.key])
        for field in SHOWN_FIELDS
        if field.part and differ(numbers[field.key], others[field.key])
    }


def _changed_choices(scene: Scene, other: Scene, focus: int) -> Iterator[tuple[Choice, str, str]]:
    """Choices in which two scenes differ, each with its option in both."""
    defects = (defects_of(each)[_defect_at(each, focus)] for each in (scene, other))
    for choices, (owner, other_owner) in ((OF_SCENE, (scene, other)), (OF_DEFECT, defects)):
        for choice in choices:
            name, other_name = choice.name_of(owner), choice.name_of(other_owner)
            if name != other_name:
                yield choice, name, other_name


def _direction(scene: Scene) -> float:
    """Direction of the radial load [rad]; 0 without one."""
    return math.atan2(scene.load.fy, scene.load.fx)


def _change_words(field: Field, now: float, before: float, scene: Scene) -> str:
    """A change of a field in words; a longer defect also in whole ball spacings."""
    digits = 4 if f"{before:.4g}" != f"{now:.4g}" else 12
    former = _read_number(field, before, digits).removesuffix(field.shown_unit).rstrip()
    numbers = f"({former} → {_read_number(field, now, digits)})"
    if field.name != "extent":
        return f"{field.read_label} {numbers}"
    spacings = (now - before) * field.factor / scene.bearing.ball_spacing
    count = round(abs(spacings))
    if count and abs(abs(spacings) - count) < WHOLE:
        many = "one ball spacing" if count == 1 else f"{count} ball spacings"
        return f"Defect {'longer' if spacings > 0 else 'shorter'} by {many} {numbers}"
    return f"{field.label} {numbers}"


def _read_number(field: Field, value: float, digits: int = 4) -> str:
    """A number of a field with its unit and sign, as on the page."""
    if math.isnan(value):
        return "left empty"
    return with_unit(field.read_sign * value, field.shown_unit, digits)
