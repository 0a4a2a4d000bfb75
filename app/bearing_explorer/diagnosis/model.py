"""The scene as the model of a measured machine: what views of a signal draw besides the signal."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bearing_explorer.kit.views.base import View
    from bearingcore import Limit, Scene


@dataclass(frozen=True)
class _Nothing:
    name: str = ""


NOT_TAKEN = "Not taken: see the top of Diagnosis"
"""In the status line where a file or an answer is refused."""


@dataclass(frozen=True)
class Model:
    """All that views of a signal draw at one moment: the scene, and whether a slider moves it.

    `at_work` says what is under way with the signal; `mark` is the number of the newest change.
    """

    scene: Scene
    moving: bool = False
    at_work: str = ""
    mark: int = 0

    slow = frozenset[str]()
    compared = ()
    grey = _Nothing()
    limits: tuple[Limit, ...] = ()

    @property
    def fine_key(self) -> tuple[object, ...]:
        """All that a fine picture depends on."""
        return (self.scene,)

    def at_rest(self, rested: bool = True, give_up: Callable[[], bool] | None = None) -> Model:
        """The same, as it is once the slider rests; nothing here is searched for long."""
        return replace(self, moving=not rested)

    def prefetch(self, needed: frozenset[str]) -> None:
        """Nothing is begun beforehand."""

    def status(self, seconds: float, needed: frozenset[str]) -> dict[str, Any]:
        """The status line: a signal has no equilibrium to converge."""
        details = [f"{1e3 * seconds:.1f} ms of computing"]
        resting = not self.moving
        mood = "bad" if self.at_work == NOT_TAKEN else "busy" if self.at_work else "good"
        words = self.at_work or "Ready"
        return {"mood": mood, "words": words, "details": details, "resting": resting}

    def is_finer_at_rest(self, needed: frozenset[str]) -> bool:
        """Only what is simulated is, and that says so by itself."""
        return False

    def arguments(self, view: View) -> Mapping[str, str]:
        """Arguments of the figure besides those of the view."""
        return {}
