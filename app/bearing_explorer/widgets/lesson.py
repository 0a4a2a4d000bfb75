"""The lesson beside the figures: its words, its answer when asked for, the way to the next."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar

import param
from panel.custom import JSComponent

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.state.lessons import Fault, Lesson


class LessonPanel(JSComponent):
    """Hidden until somebody asks for lessons; then it asks for one by its number.

    `asked` gets messages of the browser as they come, from strangers too: judge them.
    """

    #: [title, what is wrong with the file or ""] of each
    titles = param.List(default=[])
    #: of `Lesson.for_browser`; empty before the first
    lesson = param.Dict(default={})

    _esm = scripts("element.js", "lesson.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("lesson.css")]

    def __init__(
        self, asked: Callable[[Any], None], lessons: Sequence[Lesson | Fault], **params: Any
    ) -> None:
        titles = [
            [lesson.title, lesson.sentence if isinstance(lesson, Fault) else ""]
            for lesson in lessons
        ]
        super().__init__(titles=titles, margin=0, sizing_mode="stretch_width", **params)
        self._lessons = lessons
        self.on_msg(lambda event: asked(event.data))

    def begin(self, number: object) -> Lesson | None:
        """Show the lesson with this number and return it; None where there is none."""
        if not isinstance(number, int) or not 0 <= number < len(self._lessons):
            return None
        lesson = self._lessons[number]
        if isinstance(lesson, Fault):
            return None
        # a new object each time: the same lesson begun again is shown from its beginning
        self.lesson = lesson.for_browser(number)
        return lesson
