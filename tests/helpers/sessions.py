"""A session of the scene's half alone, without a browser."""

from collections.abc import Sequence
from typing import Any

from bearing_explorer.explorer.front import Explorer
from bearing_explorer.kit.session import Section, Session


class SceneSession(Session):
    """A session with these tabs; what it does not have itself is of its half."""

    def __init__(self, sections: Sequence[Section], preset: str = "fan-rig", **given: Any) -> None:
        self.explorer = Explorer(sections, preset, **given)
        super().__init__(dict.fromkeys(sections, self.explorer))

    def __getattr__(self, name: str) -> Any:
        return getattr(self.explorer, name)
