"""Scenes that a session remembers: steps to undo, compared scenes, the address.

Holds no Panel. Requests come from the browser and are not trusted: they are checked here,
and refused with a sentence.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any
from urllib.parse import urlencode

from bearing_explorer.explorer.state.address import (
    TAB_OF_OLD_LINKS,
    Place,
    holds_scene,
    leaves_out,
    lesson_in,
    opened,
    place_of,
    write,
)
from bearing_explorer.explorer.state.field_values import CAGE_ANGLE
from bearing_explorer.explorer.state.history import History
from bearing_explorer.explorer.state.references import Reference, scene_line, usual_name
from bearing_explorer.explorer.state.scene_editor import LONGEST_NAME, SceneEditor, Snapshot
from bearing_explorer.kit.plots.compared_curves import MOST_COMPARED
from bearing_explorer.kit.sentences import one_line, sentence_of
from bearingcore import Scene
from bearingcore.common import LARGEST_TEXT

_COLORS = ("green", "pink", "brown", "light blue")  # of compared curves, in their order
_STEPS = ("set", "typed", "second", "choose", "reset", "floor")


def read_scene(text: str) -> Place | str:
    """The scene of a file, or a sentence. For any thread."""
    if len(text) > LARGEST_TEXT:
        return "It is longer than a scene can be."
    try:
        return Place(Scene.from_toml(text), "")
    except ValueError as error:
        return sentence_of(error)


def name_of(text: str) -> str:
    """A name for a scene from untrusted text: short, on one line, not empty."""
    return one_line(text, LONGEST_NAME) or "Unnamed"


FIRST_TAB = "overview"
"""The tab of a page whose address names none; links that are shared name it."""


class Bookmarks:
    """Undo, compared scenes, notice and address of one session."""

    def __init__(self, editor: SceneEditor, address: str = "") -> None:
        """`address`: what stood behind the question mark as the page was opened."""
        self._editor = editor
        #: the lesson that is open, by its name; empty without one
        self.lesson, address = lesson_in(address)
        #: whether the address said which scene to show
        self.has_scene = bool(address)
        place = opened(address, editor)
        self._tab = place.tab or (TAB_OF_OLD_LINKS if holds_scene(address) else "")
        self._said = (0, place.note)
        self._history: History[Snapshot] = History(editor.snapshot())
        #: scenes that are drawn too
        self.compared: tuple[Reference, ...] = place.compared
        self._left: tuple[Snapshot, tuple[Reference, ...], str] | None = None

    def begin_anew(self, tab: str) -> None:
        """The scene that the editor has now is the one to begin with."""
        self._tab = tab
        self._history = History(self._editor.snapshot())

    @property
    def tab(self) -> str:
        """The section that is to be shown; empty where the address says nothing of a scene."""
        return self._tab

    @property
    def moving(self) -> bool:
        """Whether a hand moves something: a step has begun and not ended."""
        return bool(self._history.moving)

    def say(self, sentence: str) -> None:
        """Set the notice shown in the toolbar; the same one again counts as new."""
        self._said = (self._said[0] + 1, sentence)

    def show(self, tab: str) -> None:
        """Another section is on screen."""
        self._tab = tab

    def follow(self, message: Mapping[Any, Any]) -> bool:
        """Note what a message did to the editor; whether a step has ended.

        Play turns the bearing while a hand moves something else: that belongs to the hand's step.
        """
        now = self._editor.snapshot()
        given = message.get("set")
        if message.get("turning") is True:
            self._history.amend(now)
            return message.get("released") is True
        if given is None or any(name in message for name in _STEPS[1:]):
            self._history.step(now)
            return True
        if given:
            names = sorted(str(name)[:40] for name in list(given)[:9] if name != CAGE_ANGLE)
            self._history.moved(now, " ".join(names) or self._history.moving or CAGE_ANGLE)
        if message.get("released") is True:
            self._history.settle()
        return not self._history.moving

    def step(self) -> None:
        """Note that the editor was changed at once."""
        self._history.step(self._editor.snapshot())

    def go(self, message: Mapping[Any, Any]) -> bool:
        """Undo or redo where a message asks for it; whether there was something to."""
        if message.get("undo") is True:
            kept = self._history.undo()
        elif message.get("redo") is True:
            kept = self._history.redo()
        else:
            return False
        if kept is not None:
            self._editor.restore(kept)
        return kept is not None

    def leave(self) -> None:
        """Keep scene, compared ones and tab of now for `back`."""
        self._left = self._editor.snapshot(), self.compared, self._tab

    @property
    def can_go_back(self) -> bool:
        """Whether something is kept for `back`."""
        return self._left is not None

    def back(self) -> str:
        """Set what `leave` has kept, as a step, and name its tab; "" where nothing is kept."""
        if self._left is None:
            return ""
        kept, self.compared, tab = self._left
        self._left = None
        self._editor.restore(kept)
        self.say("")
        self.step()
        return tab or FIRST_TAB

    def take(self, name: str, found: Place | str) -> None:
        """Open the place of a link or a file of that name, or say why there is none."""
        name = name_of(name)
        try:
            if isinstance(found, str):
                raise ValueError(found)
            self._editor.take_scene(
                found.scene, found.preset, found.selected, found.cage_angle, found.name
            )
        except ValueError as error:
            self.say(f"{name}: {error if isinstance(found, str) else sentence_of(error)}")
            return
        self.compared = found.compared or self.compared
        self.say(found.note or f"{name} is open.")
        self.step()

    def change_compared(self, message: Mapping[Any, Any]) -> None:
        """Add the scene of now, rename or remove compared scenes, where a message says so."""
        if isinstance(name := message.get("compare_here"), str):
            usual = usual_name(self._editor.scene, self._editor.selected)
            self._compare(self._editor.scene, one_line(name, LONGEST_NAME) or usual)
        compared = list(self.compared)
        number = message.get("number")
        if not isinstance(number, int) or number >= len(compared):
            return
        if message.get("remove") is True:
            del compared[number]
        if isinstance(name := message.get("rename"), str) and number < len(compared):
            compared[number] = replace(compared[number], name=name_of(name))
        self.compared = tuple(compared)

    def _compare(self, scene: Scene, name: str) -> None:
        if len(self.compared) == MOST_COMPARED:
            self.say(f"{MOST_COMPARED} scenes are compared; remove one first.")
            return
        self.compared += (Reference(scene, name),)
        self.say(f"Dashed {_COLORS[len(self.compared) - 1]}: “{name}”, for comparison.")

    def toml(self) -> dict[str, str]:
        """The scene of now as a file."""
        name = f"bearing-{self._editor.preset}.toml"
        return {"name": name, "type": "application/toml", "text": self._editor.scene.to_toml()}

    def state(self) -> dict[str, Any]:
        """State for the browser."""
        place = replace(place_of(self._editor, self._tab or FIRST_TAB), compared=self.compared)
        address = write(place)
        if self.lesson:
            address += "&" + urlencode({"lesson": self.lesson})
        return {
            "address": address,
            "whole": not leaves_out(address),
            "undo": self._history.can_undo,
            "redo": self._history.can_redo,
            "compared": [one.name for one in self.compared],
            "scene": scene_line(self._editor.name, self._editor.scene),
            "usual_name": usual_name(self._editor.scene, self._editor.selected),
            "said": {"number": self._said[0], "words": self._said[1]},
            "left": self.can_go_back,
        }
