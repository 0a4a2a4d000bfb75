"""Inputs of a picture of the scene."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Set
from dataclasses import dataclass, field
from typing import ClassVar

from bearing_explorer.explorer.results.endurance import LifeInputs
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import HEALTHY, Reference
from bearing_explorer.explorer.state.settings import Settings
from bearingcore import Scene


@dataclass(frozen=True)
class Inputs:
    """Inputs of a picture.

    Parameters
    ----------
    scene, cage_angle
        cage angle in [rad].
    mark
        number of the newest change of the browser that it holds.
    focus
        which of the scene's defects the sliders move.
    settings
        how finely it is computed.
    rested
        whether the slider is at rest, and it is drawn as finely as can be.
    compared
        scenes that are drawn too, each under a name.
    before
        the scene before the last change.
    grey
        kind of the reference that is drawn in grey.
    life_inputs
        steel, oil and surfaces as a person has entered them.
    """

    slow: ClassVar[Set[str]] = Results.slow

    scene: Scene
    cage_angle: float
    mark: int
    focus: int = 0
    settings: Settings = field(default_factory=Settings)
    rested: bool = False
    compared: tuple[Reference, ...] = ()
    before: Reference | None = None
    grey: str = HEALTHY
    life_inputs: LifeInputs = field(default_factory=LifeInputs)

    @property
    def fine_key(self) -> tuple[object, ...]:
        """All that a fine picture depends on: turning the bearing leaves one fine."""
        return self.scene, self.settings, self.compared, self.grey

    def at_rest(self, rested: bool = True) -> Inputs:
        """The same, as they are once the slider rests."""
        return dataclasses.replace(self, rested=rested)

    def content(self, give_up: Callable[[], bool] | None = None) -> Results:
        """The results of these inputs; `give_up` may end long searches."""
        return Results(
            self.scene,
            self.cage_angle,
            self.settings,
            self.focus,
            moving=not self.rested,
            compared=self.compared,
            before=self.before,
            grey=self.grey,
            life_inputs=self.life_inputs,
            give_up=give_up,
        )
