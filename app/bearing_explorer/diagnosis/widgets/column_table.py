"""The first lines of a file as a table, with what each column is to choose over it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

import msgspec
import param
from panel.custom import JSComponent

from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.messages import read


class RoleOfColumn(msgspec.Struct):
    """The role of a column of a file, from 0, was chosen, or the unit of a signal."""

    column: int
    role: str
    unit: str = ""


class ColumnTable(JSComponent):
    """A table of a file's first lines; over each column a list of what it may be.

    Parameters
    ----------
    chosen
        called with the number of a column, its role and, of a signal, its unit.
    """

    roles = param.List(doc="What a column may be: [value, words].")
    signals = param.List(doc="Which of the roles have a unit.")
    units = param.List(doc="In which units a signal may be: [value, words].")
    shown = param.Dict({}, doc="Names, places, first lines, roles, units, and what is asked for.")

    _esm = scripts("element.js", "column_table.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("column_table.css")]

    def __init__(self, chosen: Callable[[int, str, str], None], **params: Any) -> None:
        super().__init__(margin=(8, 0, 8, 0), sizing_mode="stretch_width", **params)
        self._chosen = chosen
        self.on_msg(lambda event: self._take(event.data))

    def show(
        self,
        columns: Mapping[str, Any],
        roles: Sequence[str],
        units: Sequence[str],
        marks: Mapping[str, str],
    ) -> None:
        """Show columns: their names, places of sensors, first lines, and how many rows there are.

        `marks` of "columns" and "unit": "open" where an answer is wanted, "refused" where it cannot
        be.
        """
        said = {"roles": [*roles], "units": [*units], "marks": {**marks}}
        self.shown = {**columns, **said}

    def _take(self, data: Any) -> None:
        message = read(RoleOfColumn, data)
        if message is None or message.column < 0:
            return
        known = (
            message.role in {value for value, _ in self.roles},
            message.unit in {value for value, _ in self.units},
        )
        if all(known):
            self._chosen(message.column, message.role, message.unit)
