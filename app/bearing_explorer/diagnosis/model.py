"""The scene as the model of a measured machine, which views draw besides the signal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from bearing_explorer.kit.views.content import SceneContent
from bearingcore import Scene

NOT_TAKEN = "Not taken: see step {}"
"""Words of the status line for a refused file or answer; they name the step that says why."""
WANTED = "An answer is missing: see step 1"
"""Words of the status line while nothing can be drawn."""


@dataclass(frozen=True)
class Model(SceneContent):
    """Content of the views of a signal at one moment: the scene, and whether a slider moves it.

    `at_work` says what is under way with the signal; `mark` is the number of the newest change.
    """

    scene: Scene
    moving: bool = False
    at_work: str = ""
    mark: int = 0

    def status(self, seconds: float, needed: frozenset[str]) -> dict[str, Any]:
        """The status line: a signal has no equilibrium to converge."""
        details = [f"{1e3 * seconds:.1f} ms of computing"]
        resting = not self.moving
        refused = self.at_work in {NOT_TAKEN.format(step) for step in (1, 2)}
        mood = "bad" if refused else "busy" if self.at_work else "good"
        words = self.at_work or "Ready"
        return {"mood": mood, "words": words, "details": details, "resting": resting}
