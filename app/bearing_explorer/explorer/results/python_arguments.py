"""Arguments with which lines of Python make the figure of a scene, if not as usual."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bearing_explorer.explorer.results.endurance import LifeInputs
from bearing_explorer.explorer.state.references import HEALTHY
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.kit.views.python_lines import changed_fields, code_of, scene_code, short

if TYPE_CHECKING:
    from bearing_explorer.explorer.results.results import Results
    from bearing_explorer.kit.views.base import View


def arguments(view: View, results: Results) -> dict[str, str]:
    """Arguments of the figure's function besides the scene and choices, as expressions."""
    given: dict[str, str] = {}
    if results.cage_angle:
        given["cage_angle"] = short(results.cage_angle)
    if results.focus:
        given["focus"] = str(results.focus)
    if results.compared and view.compares:
        named = (f"{code_of(one.name)}: {scene_code(one.scene)}" for one in results.compared)
        given["compared"] = "{" + ", ".join(named) + "}"
    if results.before is not None and "before" in view.needs:
        given["before"] = scene_code(results.before.scene)
    if results.grey_kind != HEALTHY and "reference" in view.needs:
        given["grey"] = code_of(results.grey_kind)
    for name, value, usual in (
        ("settings", results.settings, Settings()),
        ("endurance", results.life_inputs, LifeInputs()),
    ):
        if changed := changed_fields(value, usual):
            given[name] = code_of(changed)
    return given
