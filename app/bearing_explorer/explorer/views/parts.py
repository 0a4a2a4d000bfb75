"""Parts of the session that views of the scene are attached to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from bearing_explorer.explorer.results.endurance import LifeInputs
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.widgets.controls import Rows
from bearing_explorer.kit.views.base import SessionParts


@dataclass(frozen=True)
class SceneParts(SessionParts):
    """Parts of the session that views of the scene need besides.

    Parameters
    ----------
    editor
        the scene as the controls have it.
    ask
        takes a message of the browser about the scene, which may be invalid.
    add_controls
        has a panel of controls follow the scene.
    take_steps
        sets the step rate [Hz] of time integration; None: the program's own.
    open_link
        opens what a link holds: a scene, compared ones, a tab; by a name and the link's text.
    set_life_inputs
        sets the data of steel, oil and surfaces.
    set_grey
        sets the kind of the reference that is drawn in grey.
    """

    editor: SceneEditor
    ask: Callable[[Any], None]
    add_controls: Callable[[Rows], None]
    take_steps: Callable[[float | None], None]
    open_link: Callable[[str, str], None]
    set_life_inputs: Callable[[LifeInputs], None]
    set_grey: Callable[[str], None]
