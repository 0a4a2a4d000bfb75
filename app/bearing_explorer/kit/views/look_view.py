"""Views with choices of their look, such as the map, the scale or the lines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import C, View
from bearing_explorer.kit.widgets.form import FieldSpec
from bearing_explorer.kit.widgets.look import LookPanel, checked


class LookView(View[C]):
    """A view with choices below its figures; `build` puts `self.panel_of_look` among its parts."""

    look_fields: ClassVar[Sequence[FieldSpec]]
    first_look: ClassVar[Mapping[str, Any]]
    """First values of the choices, by name."""

    def __init__(self, packed: PackedSource) -> None:
        self.look = dict(self.first_look)
        self.panel_of_look = LookPanel(self.look_changed, self.look_fields)
        super().__init__(packed)
        self.show_look()

    def look_changed(self, name: str, value: Any) -> None:
        """Draw with a new choice; a refused one changes nothing."""
        try:
            self.take_look({name: value})
        except ValueError as error:
            self.panel_of_look.refuse(str(error))
            return
        self.panel_of_look.refuse("")
        if self.parts is not None:
            self.parts.draw()

    def take_look(self, choices: Mapping[str, Any]) -> None:
        """Take choices; ValueError with a sentence for an impossible one."""
        # a new dictionary, because a thread may be reading the old one
        self.look = {
            **self.look,
            **{name: checked(self.look_fields, name, value) for name, value in choices.items()},
        }

    def choices(self) -> dict[str, Any]:
        return {name: v for name, v in self.look.items() if v != self.first_look[name]}

    def choose(self, choices: Mapping[str, Any], results: C) -> None:
        self.take_look(choices)

    def show_look(self) -> None:
        """Show the current choices."""
        self.panel_of_look.show(self.look)

    def say(self, results: C | None, sentence: str) -> None:
        super().say(results, sentence)
        self.show_look()
