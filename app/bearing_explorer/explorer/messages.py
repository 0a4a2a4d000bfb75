"""Messages of the page's scripts about the scene, its links and its lessons."""

from __future__ import annotations

from typing import Annotated, Any

import msgspec

Mark = Annotated[int, msgspec.Meta(ge=0, lt=2**24)]


class TextFile(msgspec.Struct):
    """Name and text of a file that a person chose, or of a scene that the browser has kept."""

    name: str
    text: str


class SceneChange(msgspec.Struct, omit_defaults=True):
    """A change of the scene: numbers, choices, a reset.

    Attributes
    ----------
    mark
        number of the change; the picture that shows it carries the same number.
    set, typed, second
        numbers by the keys of their fields: dragged, in the units of the page; typed; or typed in
        the second unit of the field.
    choose
        options by the names of their lists.
    released
        True if a drag ends with this change; the drag is one step to undo.
    turning
        True if the bearing turns by itself, which is no step to undo.
    search
        text for which bearings are searched; it changes nothing, and has no mark.
    """

    mark: Mark | None = None
    set: dict[str, Any] | None = None
    typed: dict[str, Any] | None = None
    second: dict[str, str] | None = None
    choose: dict[str, str] | None = None
    reset: bool = False
    released: bool = False
    turning: bool = False
    search: str | None = None


class LinksChange(SceneChange, omit_defaults=True):
    """A message of the bar above the controls: steps, scenes that are kept or compared, files.

    Attributes
    ----------
    open, file, compare
        a kept scene to be opened; a file to be opened; a scene to be compared.
    compare_here
        name under which the current scene is compared; empty for the usual name.
    number
        number of the compared scene to `remove`.
    keep
        name under which the browser keeps the current scene.
    want
        kind of the file to download.
    report
        address of the page, for the link in the report on the measured signal. The report also
        contains `title`, `machine` and `remarks`.
    """

    undo: bool = False
    redo: bool = False
    open: TextFile | None = None
    file: TextFile | None = None
    compare: TextFile | None = None
    compare_here: str | None = None
    number: Annotated[int, msgspec.Meta(ge=0)] | None = None
    remove: bool = False
    keep: str | None = None
    want: str | None = None
    report: Annotated[str, msgspec.Meta(max_length=2000)] | None = None
    title: Annotated[str, msgspec.Meta(max_length=120)] = ""
    machine: Annotated[str, msgspec.Meta(max_length=200)] = ""
    remarks: Annotated[str, msgspec.Meta(max_length=4000)] = ""


class Simulation(msgspec.Struct):
    """A request to simulate a measurement, with the name of its noise."""

    noise: str


class LessonChange(SceneChange, omit_defaults=True):
    """A message of the lessons: one begins, its words are shown, or one of its buttons is pressed.

    Attributes
    ----------
    lesson
        number or name of a lesson; an empty name closes the open one.
    words_only
        True if the lesson is shown but its scene is not set.
    show
        name of a tab to open.
    simulate
        a measurement to simulate.
    """

    lesson: int | str | None = None
    words_only: bool = False
    show: str | None = None
    simulate: Simulation | None = None
