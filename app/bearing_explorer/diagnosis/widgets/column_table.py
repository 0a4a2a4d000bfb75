"""The first lines of a file as a table, with a choice of its role over each column."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

import msgspec
import param
from panel.custom import JSComponent

from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.messages import read


class RoleOfColumn(msgspec.Struct):
    """A role, or the unit of a signal, was chosen for a column; `column` counts from 0."""

    column: int
    role: str
    unit: str = ""


class ColumnTable(JSComponent):
    """A table of a file's first lines, with a list of roles over each column.

    Parameters
    ----------
    chosen
        called with the number of a column, its role, and the unit of a signal.
    """

    roles = param.List(doc="Possible roles of a column: [value, words].")
    signals = param.List(doc="Roles that have a unit.")
    units = param.List(doc="Possible units of a signal: [value, words].")
    shown = param.Dict({}, doc="Names, places, first lines, roles, units, and open questions.")

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

        `marks` of "columns" and "unit" are "open" for a question, "refused" for a refused answer.
        """
        answers = {"roles": [*roles], "units": [*units], "marks": {**marks}}
        self.shown = {**columns, **answers}

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
