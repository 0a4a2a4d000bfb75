"""Differences of two scenes, in words."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from bearing_explorer.explorer.state.choice_list import OF_DEFECT, OF_SCENE
from bearing_explorer.explorer.state.field_values import (
    SHOWN_FIELDS,
    Values,
    defects_of,
    differ,
    values_of,
)
from bearing_explorer.explorer.state.references import usual_name
from bearing_explorer.kit.sentences import label_inside
from bearingcore import Scene
from bearingcore.common import number, with_prefix
from bearingcore.fields import Field

MOST_NUMBERS = 3
"""Numbers that are named one by one; more are said to be another bearing, or several at once."""
WHOLE = 0.02
"""Of a ball spacing: nearer to a whole number of them a change counts as one."""


def difference(now: Scene, before: Scene, focus: int = 0) -> str:
    """Changes from one scene to the other; `focus` is the selected defect."""
    if not (now.defects and before.defects) and now.healthy() == before.healthy():
        return "With the defect" if now.defects else "Without the defect"
    defects, earlier = defects_of(now), defects_of(before)
    if len(defects) != len(earlier):
        return "A defect more" if len(defects) > len(earlier) else "A defect less"
    focus = min(focus, len(defects) - 1)
    changed = _numbers(values_of(now, focus), values_of(before, focus))
    if len(changed) > MOST_NUMBERS:
        return "Another bearing" if now.bearing != before.bearing else "Several changes at once"
    words = [
        f"{choice.label} ({choice.name_of(b)} → {choice.name_of(a)})"
        for choices, a, b in ((OF_SCENE, now, before), (OF_DEFECT, defects[focus], earlier[focus]))
        for choice in choices
        if choice.name_of(a) != choice.name_of(b)
    ]
    if now.dofs != before.dofs:
        words.append("Other free directions")
    words += [_change_words(field, *values, now) for field, values in changed]
    if not words:
        return "Another defect has changed" if defects != earlier else "The scene has changed"
    first, *others = words
    return ", ".join([first, *(word[0].lower() + word[1:] for word in others)])


def distinct_name(scene: Scene, others: Iterable[Scene], focus: int = 0, bearing: str = "") -> str:
    """A name by what differs from other scenes: "100 N", "6208, 7 Hz", "12.9°, 50 µm".

    By at most MOST_NUMBERS of these, by the size of the defect `focus` where nothing does. Another
    bearing comes first, by its name `bearing` where that is known.
    """
    focus = min(focus, len(defects_of(scene)) - 1)
    values, changed, words = values_of(scene, focus), set[Field](), dict[str, None]()
    others = tuple(others)
    for other in others:
        changed |= _changed_numbers(scene, other, values, focus)
        words |= dict.fromkeys(_changed_choices(scene, other, focus))
    turned = any(
        not math.isclose(_direction(scene), _direction(other), abs_tol=1e-6) for other in others
    )
    of_bearing = [field for field in changed if field.part in ("bearing", "pair", "second")]
    is_another = len(of_bearing) > MOST_NUMBERS
    numbers: dict[str, None] = {bearing: None} if bearing and is_another else {}
    for field in (field for field in SHOWN_FIELDS if field in changed):
        if field.name in ("extent", "depth"):
            name = usual_name(scene, focus)
        elif field.name in ("fx", "fy"):
            at_angle = f" at {math.degrees(_direction(scene)) % 360.0:.4g}°" if turned else ""
            name = f"{with_prefix(math.hypot(scene.load.fx, scene.load.fy), 'N')}{at_angle}"
        elif field in of_bearing and is_another:
            if bearing:
                continue
            size = number(1e3 * scene.bearing.ball_diameter)
            name = f"{scene.bearing.total_balls} {scene.bearing.kind.element}s of {size} mm"
        else:
            unit = field.shown_unit if field.shown_unit in ("", "°") else f" {field.shown_unit}"
            name = f"{_number(field.read_sign * values[field.key], 4)}{unit}"
            name = name if field.name == "shaft_speed" else f"{label_inside(field)} {name}"
        numbers[name] = None
    return ", ".join([*numbers, *words][:MOST_NUMBERS]) or usual_name(scene, focus)


def _changed_numbers(scene: Scene, other: Scene, values: Values, focus: int) -> set[Field]:
    """Fields whose numbers differ; places of defects only where both scenes have some."""
    at = min(focus, len(defects_of(other)) - 1)
    return {
        field
        for field, _ in _numbers(values, values_of(other, at))
        if field.name != "center" or (scene.defects and other.defects)
    }


def _changed_choices(scene: Scene, other: Scene, focus: int) -> Iterator[str]:
    """Names of the choices of a scene that another one has not."""
    theirs = defects_of(other)
    defect, their_defect = defects_of(scene)[focus], theirs[min(focus, len(theirs) - 1)]
    for choices, now, then in ((OF_SCENE, scene, other), (OF_DEFECT, defect, their_defect)):
        for choice in choices:
            if choice.name_of(now) != choice.name_of(then):
                yield choice.name_of(now)


def _direction(scene: Scene) -> float:
    """Of the radial load [rad]; 0 without one."""
    return math.atan2(scene.load.fy, scene.load.fx)


def _numbers(now: Values, before: Values) -> list[tuple[Field, tuple[float, float]]]:
    return [
        (field, (before[field.key], now[field.key]))
        for field in SHOWN_FIELDS
        if field.part and differ(before[field.key], now[field.key])
    ]


def _change_words(field: Field, before: float, now: float, scene: Scene) -> str:
    unit = field.shown_unit if field.shown_unit in ("", "°") else f" {field.shown_unit}"
    digits = 4 if f"{before:.4g}" != f"{now:.4g}" else 12
    read = [_number(field.read_sign * value, digits) for value in (before, now)]
    numbers = f"({' → '.join(read)}{unit})"
    if field.name != "extent":
        return f"{field.read_label} {numbers}"
    spacings = (now - before) * field.factor / scene.bearing.ball_spacing
    count = round(abs(spacings))
    if count and abs(abs(spacings) - count) < WHOLE:
        many = "one ball spacing" if count == 1 else f"{count} ball spacings"
        return f"Defect {'longer' if spacings > 0 else 'shorter'} by {many} {numbers}"
    return f"{field.label} {numbers}"


def _number(value: float, digits: int) -> str:
    return "left empty" if math.isnan(value) else number(value, digits)
