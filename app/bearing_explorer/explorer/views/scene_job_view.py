"""Views of a long computation on the scene."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.kit.views.job_view import JobView

Found = TypeVar("Found")


class SceneJobView(JobView[Results, Found, SceneEditor], Generic[Found]):
    """A `JobView` whose form reads the editor of the scene."""

    def editor_on_page(self, parts: Any) -> SceneEditor:
        editor: SceneEditor = parts.editor
        return editor

    def editor_of(self, results: Results) -> SceneEditor:
        return editor_of(results)


def editor_of(results: Results) -> SceneEditor:
    """The controls as they are for a scene."""
    editor = SceneEditor("fan-rig")
    editor.take_scene(results.scene, selected=results.focus)
    return editor
