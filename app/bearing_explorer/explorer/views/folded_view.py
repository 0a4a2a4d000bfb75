"""Views that are folded at first; they are computed and drawn when a person opens them."""

from __future__ import annotations

from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import C, Ranges, SessionParts, Sources, View
from bearing_explorer.kit.widgets.form import button


class FoldedView(View[C]):
    """A view that a button opens on the page; in reports and scripts it is always open."""

    def __init__(self, packed: PackedSource) -> None:
        super().__init__(packed)
        self.opened = True
        self._last_title = self.title
        self._opener = button("", self._toggle, css_classes=["unfold"])
        self._body = list(self.panel)[1:]  # below its caption
        self.panel.insert(1, self._opener)
        self._show_fold()

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self.opened = False
        for picture in self._pictures:
            self.withhold(picture)
        self._show_fold()

    def _toggle(self) -> None:
        self.opened = not self.opened
        self._show_fold()
        if self.parts is not None:
            self.parts.draw()

    def _show_fold(self) -> None:
        self.needs = type(self).needs if self.opened else frozenset()
        self._opener.visible = self.parts is not None
        self._opener.name = "Hide" if self.opened else f"Show: {self._last_title}"
        if not self.opened:
            for part in self._body:
                part.visible = False

    def all_data(self, results: C) -> tuple[Sources, Ranges]:
        return super().all_data(results) if self.opened else (self._empty, {})

    def say(self, results: C | None, sentence: str) -> None:
        for part in self._body:
            part.visible = self.opened
        super().say(results, sentence)
        self._show_fold()

    def put_head(self, content: C) -> None:
        self._last_title = content.in_words(self.title_of(content))
        super().put_head(content)

    def words(self, results: C) -> str:
        """The sentence of the open view, see `View.sentence`."""
        raise NotImplementedError

    def sentence(self, results: C) -> str:
        return self.words(results) if self.opened else ""

    @property
    def is_empty(self) -> bool:
        return not self.opened or super().is_empty
