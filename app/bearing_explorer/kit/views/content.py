"""The content of a picture, as modules above know it: of a scene, or of a measured signal."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, Self

if TYPE_CHECKING:
    from bearing_explorer.kit.views.base import View
    from bearingcore import Limit, Scene


class Named(Protocol):
    """Something that a figure draws too, under a name."""

    @property
    def name(self) -> str:
        """Its name on the page."""


@dataclass(frozen=True)
class _Nothing:
    name: str = ""


class Content:
    """All that views draw at one moment; a value, read in any thread. Subclasses are dataclasses.

    What it says of itself here is so of content without a model.
    """

    scene: Scene
    """The scene of the controls."""
    moving: bool
    """Whether a slider moves; at rest it is drawn as finely as can be."""
    mark: int
    """Number of the newest change of the browser that it holds."""
    slow: ClassVar[Set[str]] = frozenset()
    """Attributes that take long: views that need them are drawn after the others."""
    compared: Sequence[Named] = ()
    """References that are drawn too, each under a name."""

    @property
    def fine_key(self) -> tuple[object, ...]:
        """All that a fine picture depends on: content with the same key needs no other."""
        return (self.scene,)

    def at_rest(self, rested: bool = True, give_up: Callable[[], bool] | None = None) -> Self:
        """The same, as it is once the slider rests; `give_up` may end long searches."""
        return replace(self, moving=not rested)  # type: ignore[type-var]

    @property
    def grey(self) -> Named:
        """The reference that is drawn in grey."""
        return _Nothing()

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model; none where no model is drawn."""
        return ()

    def prefetch(self, needed: frozenset[str]) -> None:
        """Begin in other threads what views that need these attributes can share."""

    def status(self, seconds: float, needed: frozenset[str]) -> dict[str, Any]:
        """The status line, after `seconds` [s] of computing for views that need these."""
        raise NotImplementedError

    def is_finer_at_rest(self, needed: frozenset[str]) -> bool:
        """Whether any of these attributes is computed more finely once the slider rests."""
        return False

    def arguments(self, view: View) -> Mapping[str, str]:
        """Arguments with which lines of Python make the figure, as expressions."""
        return {}
