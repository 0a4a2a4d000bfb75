"""A half of the program as the page's session sees it: its tabs, inputs and messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

if TYPE_CHECKING:
    from bearing_explorer.kit.compute.jobs import Change, Jobs
    from bearing_explorer.kit.views.base import View
    from bearing_explorer.kit.views.content import Content

Found = TypeVar("Found")


@dataclass(frozen=True)
class Section:
    """A part of the page that is on screen as a whole: a tab, or one of the parts of a `tab`."""

    name: str
    title: str
    views: tuple[type[View], ...]
    tab: str = ""
    """Title of the tab, where that has several parts; they stand one after the other."""


class Page(Protocol):
    """The session as a half sees it."""

    mark: int
    """Number of the newest change of the browser."""
    jobs: Jobs

    def draw(self) -> None:
        """Bring what is on screen up to date."""

    def show_tab(self, message: Any) -> None:
        """Open the tab that a message names."""

    def in_background(self, compute: Callable[[], Found], take: Callable[[Found], None]) -> None:
        """Compute something off the event loop, then take it."""

    async def assign(self, change: Change) -> None:
        """Change models of the page, in one message."""

    def views_made(self) -> list[View]:
        """All views that have been on screen."""


class Half(Protocol):
    """A half of the program. Its methods are called on the event loop of the session."""

    sections: tuple[Section, ...]
    """Its tabs."""

    def join(self, page: Page) -> None:
        """Become a half of this session, once, before anything else."""

    @property
    def kind_of_content(self) -> type:
        """The type of its content, which another half's is not."""

    def content(self) -> Content:
        """The content of the next picture, while a slider moves."""

    def attach(self, view: View) -> None:
        """Give a view of its tabs the parts of the session."""

    def tab_opened(self, name: str) -> None:
        """A tab of the page was opened, of whichever half."""

    def stop(self) -> None:
        """The session is over."""
