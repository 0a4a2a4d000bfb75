"""A picture of what is on screen: computed off the event loop, failures as sentences."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from bearing_explorer.explorer.results.endurance import LifeInputs
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.compared import Compared
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.cache import Overtaken
from bearing_explorer.kit.sentences import words_of
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearing_explorer.kit.widgets.status import status_of
from bearingcore import Limit, Scene

log = logging.getLogger(__name__)

BROKEN = "This could not be computed; what is shown belongs to an earlier scene."
_DRAWN_LATER = "This is drawn by itself as soon as that is done."


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
    life_inputs
        steel, oil and surfaces as a person has entered them.
    """

    scene: Scene
    cage_angle: float
    mark: int
    focus: int = 0
    settings: Settings = field(default_factory=Settings)
    rested: bool = False
    compared: tuple[Compared, ...] = ()
    before: Scene | None = None
    life_inputs: LifeInputs = field(default_factory=LifeInputs)

    def results(self, give_up: Callable[[], bool] | None = None) -> Results:
        """The results of these inputs; `give_up` may end long searches."""
        return Results(
            self.scene,
            self.cage_angle,
            self.settings,
            self.focus,
            moving=not self.rested,
            compared=self.compared,
            before=self.before,
            life_inputs=self.life_inputs,
            give_up=give_up,
        )


@dataclass(frozen=True)
class Drawing:
    """Data and sentence of a view; `data` is None where it cannot be drawn."""

    view: View
    data: tuple[Sources, Ranges] | None
    sentence: str


@dataclass(frozen=True)
class Picture:
    """Drawings of some views, status of the computation, its duration and processor time [s]."""

    results: Results
    drawings: list[Drawing]
    status: dict[str, Any]
    limits: tuple[Limit, ...] | None
    seconds: float
    work: float


def picture_of(
    results: Results,
    views: Sequence[View],
    limits: bool = False,
    on_screen: Sequence[View] = (),
) -> Picture:
    """Draw `views`, and check the `limits` of the model.

    `on_screen`: the views that the status is of, where these are more than those drawn.
    """
    started, worked = time.perf_counter(), time.thread_time()  # of this thread: waiting is no cost
    shown = frozenset[str]().union(*(view.needs for view in on_screen or views))
    results.prefetch(shown)
    drawings = [drawing_of(results, view) for view in views]
    work = time.thread_time() - worked
    checked = None
    try:
        checked = results.limits if limits else None
        status = status_of(results, work, shown)
    except compiling.StillCompiling as wait:
        status = {"mood": "busy", "words": f"Not ready: {wait}", "details": []}
    return Picture(results, drawings, status, checked, time.perf_counter() - started, work)


def drawing_of(results: Results, view: View) -> Drawing:
    """The drawing of a view, or a sentence with the reason why there is none."""
    try:
        return Drawing(view, view.all_data(results), view.sentence(results))
    except Overtaken:
        raise
    except compiling.StillCompiling as wait:
        words = str(wait)
        return Drawing(view, None, f"{words[0].upper()}{words[1:]}. {_DRAWN_LATER}")
    except ValueError as error:
        return Drawing(view, None, f"Not shown for this scene: {words_of(error)}.")
    except Exception:
        log.exception("the view %s failed", view.name)
        return Drawing(view, None, BROKEN)
