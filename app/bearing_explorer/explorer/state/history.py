"""Steps that can be undone and redone.

A whole drag is one step: `move` follows the drag, and `settle` ends the step. A drag that ends
where it began is no step.
"""

from __future__ import annotations

from collections import deque
from typing import Generic, TypeVar

from bearingcore import Scene

MOST_STEPS = 100

State = TypeVar("State")


class History(Generic[State]):
    """Past, present and future states. Equal states count as no change."""

    def __init__(self, now: State, most: int = MOST_STEPS) -> None:
        self._now = now
        self._begun = now  # state at the beginning of the present step
        self._past: deque[State] = deque(maxlen=most)
        self._future: deque[State] = deque(maxlen=most)
        #: name of the control being moved; empty between steps
        self.moving = ""

    @property
    def can_undo(self) -> bool:
        """True if there is a step to undo."""
        return bool(self._past) or self._now != self._begun

    @property
    def can_redo(self) -> bool:
        """True if a step was undone that can be done again."""
        return bool(self._future)

    def move(self, now: State, control: str) -> None:
        """Continue the step that moves `control`, or begin it."""
        if self.moving != control:
            self.settle()
        self.moving = control
        self._now = now

    def amend(self, now: State) -> None:
        """Change the present state without a step of its own to undo."""
        self._now = now
        if not self.moving:
            self._begun = now

    def settle(self) -> None:
        """End the present step."""
        if self._now != self._begun:
            self._past.append(self._begun)
            self._future.clear()
        self._begun = self._now
        self.moving = ""

    def step(self, now: State) -> None:
        """Make a whole step at once."""
        self.settle()
        self._now = now
        self.settle()

    def undo(self) -> State | None:
        """Go back to the state before the last step; None if there is none."""
        return self._go(self._past, self._future)

    def redo(self) -> State | None:
        """Go to the state after the step that was undone last; None if there is none."""
        return self._go(self._future, self._past)

    def _go(self, source: deque[State], target: deque[State]) -> State | None:
        self.settle()
        if not source:
            return None
        target.append(self._now)
        self._now = self._begun = source.pop()
        return self._now


class LastState:
    """The scene before the last change. A whole drag is one change."""

    def __init__(self, scene: Scene) -> None:
        self._settled = scene
        self._moving = False
        #: the scene before the last change; None before the first
        self.before: Scene | None = None

    def follow(self, scene: Scene, moving: bool) -> None:
        """Record the current scene; `moving` is True during a drag."""
        if scene != self._settled and not self._moving:
            self.before = self._settled
            self._moving = True
        if not moving:
            self._settled = scene
            self._moving = False
