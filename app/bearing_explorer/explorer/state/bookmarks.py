"""Scenes that a session remembers: steps to undo, compared scenes, the address.

This module uses no Panel. Requests come from the browser and are not trusted: they are checked
here, and refused with a sentence. Scenes that a person keeps stay in the browser, as a name and the
text of `explorer.state.address`; the server stores none of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any
from urllib.parse import urlencode

from bearing_explorer.explorer.state.address import (
    LONGEST_LINK,
    LONGEST_TEXT,
    Place,
    leaves_out,
    lesson_in,
    place_of,
    read,
    show_place,
    show_text,
    write,
)
from bearing_explorer.explorer.state.difference import distinct_name
from bearing_explorer.explorer.state.field_values import CAGE_ANGLE
from bearing_explorer.explorer.state.history import History
from bearing_explorer.explorer.state.references import MOST_COMPARED, Reference, scene_line
from bearing_explorer.explorer.state.scene_editor import LONGEST_NAME, SceneEditor
from bearing_explorer.kit.sentences import one_line, sentence_of
from bearingcore import Scene
from bearingcore.common import LARGEST_TEXT

_COLORS = ("green", "pink", "brown", "light blue")  # of compared curves, in their order
_STEPS = ("set", "typed", "second", "choose", "reset")


@dataclass(frozen=True)
class OpenRequest:
    """A request to open or compare a scene; `read_request` reads it, in any thread."""

    kind: str
    name: str
    text: str


def open_request_of(message: Mapping[str, Any]) -> OpenRequest | None:
    """The request of a message to open ("open", "file") or "compare" a scene; else None."""
    for kind in ("open", "file", "compare"):
        if sent := message.get(kind):
            return OpenRequest(kind, name_of(sent["name"]), sent["text"][: LONGEST_TEXT + 1])
    return None


def read_request(request: OpenRequest) -> Place | str:
    """Read the requested place; return a sentence if that fails."""
    try:
        if request.kind == "file":
            if len(request.text) > LARGEST_TEXT:
                return f"{request.name} is longer than a scene can be."
            return Place(Scene.from_toml(request.text), "")
        place = read(request.text)
    except ValueError as error:
        return f"{request.name}: {sentence_of(error)}"
    return f"{request.name} holds no scene." if place is None else place


def name_of(text: str) -> str:
    """A name for a scene from untrusted text: short, on one line, not empty."""
    return one_line(text, LONGEST_NAME) or "Unnamed"


FIRST_TAB = "overview"
"""The tab of a page whose address names none; links to share name it all the same."""


State = tuple[SceneEditor, tuple[Reference, ...]]
"""The editor and the compared scenes at one time."""


class Bookmarks:
    """Undo, compared scenes, notice and address of one session."""

    def __init__(self, editor: SceneEditor, address: str = "") -> None:
        """`address`: the text after the question mark when the page was opened."""
        self._editor = editor
        #: name of the open lesson; empty without one
        self.lesson, address = lesson_in(address)
        #: True if the address names the scene to show
        self.has_scene = bool(address)
        place = show_text(address, editor)
        #: name of the section on screen; empty at first if the address has no scene
        self.tab = place.tab
        self._notice = (0, place.note)
        # compared scenes; a scene without a name is named by its differences
        self._compared: tuple[Reference, ...] = place.compared
        self._history: History[State] = History(self._state())

    def begin_anew(self, tab: str) -> None:
        """Begin a new history with the scene of the editor, on a tab."""
        self.tab = tab
        self._history = History(self._state())

    def _state(self) -> State:
        return self._editor.snapshot(), self._compared

    @property
    def moving(self) -> bool:
        """True during a drag: a step has begun and not ended."""
        return bool(self._history.moving)

    @property
    def compared(self) -> tuple[Reference, ...]:
        """Compared scenes, each with a name."""
        return tuple(
            reference
            if reference.name
            else replace(reference, name=self._usual_name(reference.scene, reference.bearing))
            for reference in self._compared
        )

    def _usual_name(self, scene: Scene, bearing: str) -> str:
        """Name of a scene by its differences from the current and the compared scenes."""
        others = [self._editor.scene, *(reference.scene for reference in self._compared)]
        return distinct_name(scene, others, self._editor.selected, bearing)

    def say(self, sentence: str) -> None:
        """Set the notice in the toolbar; the same sentence again counts as a new notice."""
        self._notice = (self._notice[0] + 1, sentence)

    def follow(self, message: Mapping[Any, Any]) -> bool:
        """Record the change that a message made to the scenes; True if a step has ended.

        Play may turn the bearing during a drag; its changes then belong to the step of the drag.
        """
        now = self._state()
        values = message.get("set")
        if message.get("turning") is True:
            self._history.amend(now)
            return message.get("released") is True
        if values is None or any(name in message for name in _STEPS[1:]):
            self._history.step(now)
            return True
        if values:
            names = sorted(str(name)[:40] for name in list(values)[:9] if name != CAGE_ANGLE)
            self._history.move(now, " ".join(names) or self._history.moving or CAGE_ANGLE)
        if message.get("released") is True:
            self._history.settle()
        return not self._history.moving

    def go(self, message: Mapping[Any, Any]) -> bool:
        """Undo or redo if a message asks for it; True if that changed the scenes."""
        if message.get("undo") is True:
            state = self._history.undo()
        elif message.get("redo") is True:
            state = self._history.redo()
        else:
            return False
        if state is None:
            return False
        editor, self._compared = state
        self._editor.restore(editor)
        return True

    def take(self, request: OpenRequest, place: Place | str) -> bool:
        """Open or compare the place of `read_request` as one step; True if anything changed."""
        if isinstance(place, str):
            self.say(place)
            return False
        if request.kind == "compare":
            self._compare(place.scene, request.name)
        else:
            try:
                show_place(place, self._editor)
            except ValueError as error:
                self.say(f"{request.name}: {sentence_of(error)}")
                return False
            self._compared = place.compared or self._compared
            self.say(place.note or f"{request.name} is open.")
        self._history.step(self._state())
        return True

    def change_compared(self, message: Mapping[Any, Any]) -> None:
        """Compare the current scene, or remove a compared one, if a message asks for it."""
        if isinstance(name := message.get("compare_here"), str):
            self._compare(self._editor.scene, one_line(name, LONGEST_NAME), self._editor.name)
        number = message.get("number")
        if message.get("remove") is True and isinstance(number, int) and number >= 0:
            self.say("")  # the last notice may name a colour that has changed
            self._compared = self._compared[:number] + self._compared[number + 1 :]

    def _compare(self, scene: Scene, name: str, bearing: str = "") -> None:
        if len(self._compared) == MOST_COMPARED:
            self.say(f"{MOST_COMPARED} scenes are compared; remove one first.")
            return
        self._compared += (Reference(scene, name, bearing="" if name else bearing),)
        words = f"“{name}”" if name else "the scene as it is now"  # its name follows from others
        self.say(f"Dashed {_COLORS[len(self._compared) - 1]}: {words}, for comparison.")

    def kept_scene(self, name: str) -> dict[str, str]:
        """The current scene for the browser to keep."""
        return {"name": name_of(name), "text": write(place_of(self._editor))}

    def toml(self) -> dict[str, str]:
        """The current scene as a file."""
        name = f"bearing-{self._editor.preset}.toml"
        return {"name": name, "type": "application/toml", "text": self._editor.scene.to_toml()}

    def state(self) -> dict[str, Any]:
        """State for the browser."""
        place = replace(place_of(self._editor, self.tab or FIRST_TAB), compared=self._compared)
        address = write(place, LONGEST_LINK)
        if self.lesson:
            address += "&" + urlencode({"lesson": self.lesson})
        return {
            "address": address,
            "whole": not leaves_out(address),
            "undo": self._history.can_undo,
            "redo": self._history.can_redo,
            "compared": [reference.name for reference in self.compared],
            "scene": scene_line(self._editor.name, self._editor.scene),
            "usual_name": self._usual_name(self._editor.scene, self._editor.name),
            "said": {"number": self._notice[0], "words": self._notice[1]},
        }
