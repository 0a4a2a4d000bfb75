"""The scene before the last change."""

from __future__ import annotations

from bearingcore import Scene


class LastState:
    """Remembers the scene before the last change. A drag is one change, from where it began."""

    def __init__(self, scene: Scene) -> None:
        self._settled = scene
        self._moving = False
        #: the scene before the last change; None before the first
        self.before: Scene | None = None

    def follow(self, scene: Scene, moving: bool) -> None:
        """Note the scene of now, and whether a drag is still `moving` it."""
        if scene != self._settled and not self._moving:
            self.before = self._settled
            self._moving = True
        if not moving:
            self._settled = scene
            self._moving = False
