"""The content of a picture: all that the views of a half draw at one moment."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

from bearing_explorer.kit.plots.element_words import with_elements_of
from bearing_explorer.kit.serve.log import short_digest
from bearingcore import Scene


@dataclass(frozen=True)
class Warnings:
    """The strip of warnings below the page: its rows, crossed limits first, and a summary."""

    rows: tuple[dict[str, Any], ...] = ()
    summary: str = ""


class Content:
    """All that views draw at one moment; a value, read in any thread. Subclasses are dataclasses.

    The methods of this class describe content without a scene.
    """

    moving: bool
    """True if a slider moves; at rest it is drawn as finely as can be."""
    mark: int
    """Number of the newest change of the browser that it holds."""
    slow: ClassVar[Set[str]] = frozenset()
    """Attributes that take long: views that need them are drawn after the others."""

    @property
    def fine_key(self) -> tuple[object, ...]:
        """All that a fine picture depends on: content with the same key needs no other."""
        raise NotImplementedError

    @property
    def picture_key(self) -> object:
        """Key of a picture: while nothing can be drawn, the last one of the same key stays."""
        return None

    def log_name(self) -> str:
        """Return the name of the content in the log; equal content has the same name."""
        return ""

    def in_words(self, text: str) -> str:
        """Return a title or caption in the words of this content."""
        return text

    def at_rest(self, rested: bool = True) -> Self:
        """Return the content as it is drawn once the slider rests."""
        return replace(self, moving=not rested)  # type: ignore[type-var]

    @property
    def warnings(self) -> Warnings:
        """Warnings on the content; not computed for each picture."""
        return Warnings()

    def prefetch(self, needed: frozenset[str]) -> None:
        """Begin, in other threads, the computations that views with these needs can share."""

    def status(self, seconds: float, needed: frozenset[str]) -> dict[str, Any]:
        """Return the status line, after `seconds` [s] of computing for views with these needs."""
        raise NotImplementedError

    def is_finer_at_rest(self, needed: frozenset[str]) -> bool:
        """Return True if any of these attributes is computed more finely at rest."""
        return False

    def scene_drawn(self) -> Scene:
        """Return the scene with which lines of Python begin."""
        raise NotImplementedError

    def arguments(self, needed: frozenset[str]) -> Mapping[str, str]:
        """Return the arguments of the figure of a view with these needs, as Python expressions."""
        return {}


class SceneContent(Content):
    """Content with a scene: that of the controls, or the model of a measured machine."""

    scene: Scene

    @property
    def fine_key(self) -> tuple[object, ...]:
        return (self.scene,)

    @property
    def picture_key(self) -> object:
        return self.scene.bearing

    def log_name(self) -> str:
        return short_digest(self.scene.to_data())

    def in_words(self, text: str) -> str:
        """Return a text in the words of the bearing: its balls may be rollers."""
        return with_elements_of(self.scene.bearing, text)

    def scene_drawn(self) -> Scene:
        return self.scene
