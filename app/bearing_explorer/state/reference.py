"""The reference that figures draw in grey."""

from __future__ import annotations

from dataclasses import dataclass

from bearingcore import Scene

WITHOUT_DEFECT = "the bearing without its defect"
"""The reference while nothing is pinned."""


@dataclass(frozen=True)
class Reference:
    """A pinned scene by its name; nothing pinned is the scene's own bearing without defect."""

    scene: Scene
    name: str

    @property
    def words(self) -> str:
        """Words before its numbers in a sentence."""
        return f"pinned “{self.name}”"
