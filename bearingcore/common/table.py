"""A result as a table: names, units and numbers in columns.

Every result of the core has `.table()`. What is shown or saved of it comes from there: CSV files,
tables on the page, lines of Python, labels of axes. Numbers are SI and radians; `in_units` turns
them into what people read, and puts the unit into the name (`extent_deg`).
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks
from bearingcore.units import UNITS, factor_between

READ_UNITS = {"rad": "deg", "m": "µm"}
"""Units for people instead of radians and metres."""


@dataclass(frozen=True)
class Column:
    """Numbers or words of one kind.

    Attributes
    ----------
    name
        the field's term, without its unit: "cage_angle".
    unit
        "" for words and counts, "1" for ratios.
    values : (n,)
    meaning
        what it is, in a few words; may be empty.
    """

    name: str
    unit: str
    values: NDArray[Any] = field(repr=False)
    meaning: str = ""

    @property
    def named(self) -> str:
        """Name and unit as one word: "cage_angle_deg"."""
        suffix = UNITS[self.unit].suffix
        return f"{self.name}_{suffix}" if suffix else self.name

    def within(self, unit: str) -> Column:
        """The column in another unit.

        Raises
        ------
        ValueError
            for a unit that it has no factor to.
        """
        if unit == self.unit:
            return self
        factor = factor_between(self.unit, unit)
        if factor is None:
            si = UNITS[self.unit].si
            known = ", ".join(name for name, other in UNITS.items() if other.si == si)
            raise checks.refuse(f"unit of {self.name}", unit, known)
        return Column(self.name, unit, self.values * factor, self.meaning)


class ResultTable(Mapping[str, NDArray[Any]]):
    """Columns of a result by name: `table["k_yy"]` its numbers, `unit("k_yy")` their unit.

    Columns may differ in length where a result has several kinds of rows.
    """

    def __init__(self, columns: Iterable[Column]) -> None:
        self.columns = tuple(columns)
        self._by_name = {column.name: column for column in self.columns}
        if len(self._by_name) != len(self.columns):
            names = [column.name for column in self.columns]
            raise checks.refuse("names of columns", names, "each once")

    def __getitem__(self, name: str) -> NDArray[Any]:
        """The numbers (n,) of a column."""
        return self._by_name[name].values

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        return iter(self._by_name)

    def __len__(self) -> int:
        """Number of columns."""
        return len(self.columns)

    def unit(self, name: str) -> str:
        """Unit of a column."""
        return self._by_name[name].unit

    def meaning(self, name: str) -> str:
        """Meaning of a column, in a few words."""
        return self._by_name[name].meaning

    def in_units(self, units: Mapping[str, str] = READ_UNITS) -> ResultTable:
        """The table in other units: `{"rad": "deg"}` turns every column in rad into one in deg."""
        return ResultTable(
            column.within(units.get(column.unit, column.unit)) for column in self.columns
        )

    def prefixed(self, prefix: str) -> ResultTable:
        """The table with a word before each name, so that two can stand side by side."""
        return ResultTable(
            Column(f"{prefix}_{c.name}", c.unit, c.values, c.meaning) for c in self.columns
        )

    def only(self, *names: str) -> ResultTable:
        """The columns of these names, in their order."""
        return ResultTable(self._by_name[name] for name in names)

    def __or__(self, other: ResultTable) -> ResultTable:
        """Both tables side by side."""
        return ResultTable([*self.columns, *other.columns])

    def named(self) -> dict[str, NDArray[Any]]:
        """The numbers under names that hold their units: "cage_angle_deg"."""
        return {column.named: column.values for column in self.columns}

    def csv(self) -> str:
        """Comma-separated text under names that hold their units; short columns end empty."""
        return as_csv(self.named())


def table_of(*columns: tuple[str, str, ArrayLike] | tuple[str, str, ArrayLike, str]) -> ResultTable:
    """A table of (name, unit, numbers) or (name, unit, numbers, meaning)."""
    made = []
    for name, unit, values, *meaning in columns:
        made.append(Column(name, unit, np.asarray(values).ravel(), meaning[0] if meaning else ""))
    return ResultTable(made)


def as_csv(columns: Mapping[str, NDArray[Any]]) -> str:
    """Columns as comma-separated text; shorter columns end in empty cells."""
    rows = [np.asarray(column).ravel() for column in columns.values()]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([_cell(name) for name in columns])
    for i in range(max((row.size for row in rows), default=0)):
        writer.writerow([_cell(row[i]) if i < row.size else "" for row in rows])
    return text.getvalue()


_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")
"""Beginnings of cells that a spreadsheet would compute (OWASP, CSV injection)."""


def _cell(value: Any) -> str:
    """A number with nine digits, or words that no spreadsheet takes for a formula."""
    if isinstance(value, float | np.floating):
        return f"{value:.9g}"
    text = str(value)
    return f"'{text}" if isinstance(value, str) and text.startswith(_FORMULA) else text
