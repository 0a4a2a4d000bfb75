"""Views with a long computation on the scene."""

from __future__ import annotations

from typing import Any, ClassVar, Generic, TypeVar

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.kit.compute.jobs import JobState
from bearing_explorer.kit.views.job_view import JobView
from bearing_explorer.kit.widgets.facts import sentence_html

Result = TypeVar("Result")


class SceneJobView(JobView[Results, Result, SceneEditor], Generic[Result]):
    """A `JobView` whose form reads the editor of the scene."""

    noun: ClassVar[str] = ""
    """Name of its result, for a view that has nothing to show before the first; else empty."""

    @property
    def words_of_nothing(self) -> str:
        """The sentence before the first result: it is being computed, or there is none."""
        if self.job.state.running:
            return f"The first {self.noun} is being computed."
        return f"There is no {self.noun} yet."

    def report(self, state: JobState) -> None:
        super().report(state)
        if self.noun and self.is_empty:
            self._sentence.put(text=sentence_html(self.words_of_nothing))

    def editor_of(self, owner: Any) -> SceneEditor:
        editor: SceneEditor = owner.editor
        return editor
