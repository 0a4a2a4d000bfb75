"""What figures draw in grey beside the scene."""

from __future__ import annotations

from dataclasses import dataclass

from bearingcore import Scene

WITHOUT_DEFECT = "the bearing without its defect"
"""What figures draw in grey while nothing is pinned."""


@dataclass(frozen=True)
class Reference:
    """A pinned scene by its name; nothing pinned is the scene's own bearing without defect."""

    scene: Scene
    name: str

    @property
    def words(self) -> str:
        """What stands before its numbers in a sentence."""
        return f"pinned “{self.name}”"
