"""The figure of a view for a scene, outside of the page."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bearing_explorer.explorer.results.endurance import LifeInputs
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import BEFORE, HEALTHY, Reference
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.views.still_figure import Figure
from bearingcore import Scene


def figure_of(
    kind: type[View],
    scene: Scene,
    *,
    cage_angle: float = 0.0,
    focus: int = 0,
    compared: Mapping[str, Scene] | None = None,
    before: Scene | None = None,
    grey: str = HEALTHY,
    settings: Mapping[str, Any] | None = None,
    endurance: Mapping[str, Any] | None = None,
    **more: Any,
) -> Figure[Results]:
    """Draw the figure of a view for a scene.

    Parameters
    ----------
    cage_angle
        [rad] shown.
    focus
        index of the selected defect.
    compared
        further scenes that are drawn, by their names.
    before
        the scene before the last change, for the view of the last change.
    grey
        kind of the reference that is drawn in grey: "healthy" or "other-balls".
    settings, endurance
        fields of `Settings` (fineness of the computation) and of steel, oil and surfaces.
    more
        further parameters of `Figure`.
    """
    results = Results(
        scene,
        cage_angle,
        Settings(**(settings or {})),
        focus,
        compared=[Reference(other, name) for name, other in (compared or {}).items()],
        before=None if before is None else Reference(before, BEFORE),
        grey_kind=grey,
        life_inputs=LifeInputs(**(endurance or {})),
    )
    return Figure(kind, results, **more)
