"""The content of a picture, as modules above know it: of a scene, or of a measured signal."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from bearing_explorer.kit.views.base import View
    from bearingcore import Limit, Scene


class Named(Protocol):
    """Something that a figure draws too, under a name."""

    @property
    def name(self) -> str:
        """Its name on the page."""


class Content(Protocol):
    """All that views draw at one moment; a value, read in any thread."""

    @property
    def scene(self) -> Scene:
        """The scene of the controls."""

    @property
    def mark(self) -> int:
        """Number of the newest change of the browser that it holds."""

    @property
    def moving(self) -> bool:
        """Whether a slider moves; at rest it is drawn as finely as can be."""

    @property
    def slow(self) -> Set[str]:
        """Attributes that take long: views that need them are drawn after the others."""

    @property
    def fine_key(self) -> tuple[object, ...]:
        """All that a fine picture depends on: content with the same key needs no other."""

    def at_rest(self, rested: bool = True, give_up: Callable[[], bool] | None = None) -> Content:
        """The same, as it is once the slider rests; `give_up` may end long searches."""

    @property
    def compared(self) -> Sequence[Named]:
        """References that are drawn too, each under a name."""

    @property
    def grey(self) -> Named:
        """The reference that is drawn in grey."""

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model; none where no model is drawn."""

    def prefetch(self, needed: frozenset[str]) -> None:
        """Begin in other threads what views that need these attributes can share."""

    def status(self, seconds: float, needed: frozenset[str]) -> dict[str, Any]:
        """The status line, after `seconds` [s] of computing for views that need these."""

    def is_finer_at_rest(self, needed: frozenset[str]) -> bool:
        """Whether any of these attributes is computed more finely once the slider rests."""

    def arguments(self, view: View) -> Mapping[str, str]:
        """Arguments with which lines of Python make the figure, as expressions."""
