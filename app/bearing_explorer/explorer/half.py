"""The scene's half of a session: controls -> Scene -> Results -> views."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from bearing_explorer.explorer.requests import Requests
from bearing_explorer.explorer.results.endurance import LifeInputs
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.bookmarks import Bookmarks
from bearing_explorer.explorer.state.field_values import CAGE_ANGLE
from bearing_explorer.explorer.state.history import LastState
from bearing_explorer.explorer.state.lessons import Fault, Lesson
from bearing_explorer.explorer.state.references import BEFORE, HEALTHY, Reference
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.explorer.state.value_range import focused
from bearing_explorer.kit.session import Section
from bearing_explorer.kit.views.base import View
from bearingcore import Scene


class Explorer(Requests):
    """The scene of a session, the panels that change it, and what its views draw of it.

    Its views are attached to it: they read `editor` and call its methods.

    Parameters
    ----------
    sections
        its tabs.
    address
        the query of the page's address; it is not trusted.
    """

    def __init__(
        self,
        sections: Sequence[Section],
        preset: str = "fan-rig",
        address: str = "",
        lessons: Sequence[Lesson | Fault] = (),
    ) -> None:
        self.sections = tuple(sections)
        self._settings = Settings()
        self._life_inputs = LifeInputs()
        self._grey = HEALTHY
        editor = SceneEditor(preset)
        super().__init__(editor, Bookmarks(editor, address), lessons)
        self._last_state = LastState(self.editor.scene)

    kind_of_content = Results

    def tab_opened(self, name: str) -> None:
        self.bookmarks.tab = name  # links always say which tab is open
        self.show_links()

    @property
    def scene(self) -> Scene:
        """The scene as the controls have it."""
        return self.editor.scene

    @property
    def focused_scene(self) -> Scene:
        """The same, the defect that the sliders move first."""
        return focused(self.editor.scene, self.editor.selected)

    def content(self) -> Results:
        before = self._last_state.before
        return Results(
            self.scene,
            math.radians(self.editor.values[CAGE_ANGLE]),
            self._settings,
            self.editor.focus,
            moving=True,
            held=self.bookmarks.moving,
            compared=self.bookmarks.compared,
            before=None if before is None else Reference(before, BEFORE),
            grey_kind=self._grey,
            life_inputs=self._life_inputs,
            lesson_term=self.lesson.term if self.bookmarks.lesson else "",
            mark=self.mark,
        )

    def draw(self) -> None:
        self._last_state.follow(self.scene, self.bookmarks.moving)
        self.page.mark = self.mark
        super().draw()

    def start_over(self) -> None:
        self._last_state = LastState(self.scene)

    def for_report(self) -> tuple[Results, list[type[View]], dict[str, Any]]:
        results = self.content().at_rest()
        kinds = [view for section in self.sections for view in section.views]
        of_views = {
            v.name: v.job_result for v in self.page.views_made() if v.job_result is not None
        }
        return results, kinds, of_views

    def set_life_inputs(self, inputs: LifeInputs) -> None:
        """Judge life and film with this steel, oil and these surfaces."""
        self._life_inputs = inputs
        self.draw()

    def set_grey(self, kind: str) -> None:
        """Draw the reference of this kind in grey."""
        self._grey = kind
        self.draw()
