"""The panel of lessons: the words of a lesson, its prediction and answer, and the next lesson."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar

import param
from panel.custom import JSComponent

from bearing_explorer.explorer.messages import LessonChange
from bearing_explorer.explorer.state.lessons import Fault, Lesson
from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.messages import take


class LessonPanel(JSComponent):
    """The list of lessons, or the words of one lesson; hidden until a person opens it.

    A scene is set when a lesson begins, and not when its words are shown again.

    `on_message` is called with each message as a dictionary with fields of `LessonChange`.
    """

    #: [title, fault of the file or "", name] of each lesson
    titles = param.List(default=[])
    #: the open lesson by `Lesson.browser_data`; empty before the first
    lesson = param.Dict(default={})
    #: True if the panel is open when the page loads
    open_first = param.Boolean(default=False)

    _esm = scripts("element.js", "asking.js", "lesson.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("lesson.css")]

    def __init__(
        self, on_message: Callable[[Any], None], lessons: Sequence[Lesson | Fault], **params: Any
    ) -> None:
        titles = [
            [lesson.title, getattr(lesson, "sentence", ""), getattr(lesson, "name", "")]
            for lesson in lessons
        ]
        super().__init__(titles=titles, margin=0, sizing_mode="stretch_width", **params)
        self._lessons = lessons
        self._begun = 0
        #: stiffness term of the last lesson; empty without one
        self.term = ""
        self.on_msg(lambda event: take(on_message, LessonChange, event.data))

    def begin(self, which: object, *, again: bool = True) -> Lesson | None:
        """Show the lesson with this number or name and return it; None if there is no such lesson.

        The open lesson begins again only if `again` is True.
        """
        number = self._number(which)
        if number is None:
            return None
        lesson = self._lessons[number]
        if isinstance(lesson, Fault):
            return None
        self.term = lesson.term
        if again or self.lesson.get("number") != number:
            # the count makes a lesson that begins again a new value for the browser
            self._begun += 1
            self.lesson = {**lesson.browser_data(number), "begun": self._begun}
        return lesson

    def _number(self, which: object) -> int | None:
        if isinstance(which, int):
            return which if 0 <= which < len(self._lessons) else None
        names = [lesson.name if isinstance(lesson, Lesson) else "" for lesson in self._lessons]
        return names.index(which) if isinstance(which, str) and which and which in names else None
