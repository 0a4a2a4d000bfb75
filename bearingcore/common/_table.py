"""A result as a table: names, units and numbers in columns.

Every result of the core has `.table()`. CSV files, tables on the page, lines of Python and labels
of axes are made from it. Numbers are in SI units and radians. `in_units` converts them to the units
that people read; names with units, such as `extent_deg`, then follow them.
"""

from __future__ import annotations

import csv
import dataclasses
import io
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import _checks as checks
from bearingcore.units import UNITS, factor_between, units_like

if TYPE_CHECKING:
    from pandas import DataFrame

T = TypeVar("T")

READ_UNITS = {"rad": "deg", "m": "µm"}
"""Units for people instead of radians and metres."""

MOST_ROWS, MOST_COLUMNS = 10, 8
"""Size of a printed table; the middle of a larger one is left out."""

LONGEST_VALUE, LONGEST_REPR = 24, 120
"""Most letters of a value beside its meaning, and of a result on one line."""


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
        meaning in a few words; may be empty.
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

    def convert(self, unit: str) -> Column:
        """Return the column in another unit.

        Raises
        ------
        ValueError
            for a unit of another kind.
        """
        if unit == self.unit:
            return self
        factor = factor_between(self.unit, unit)
        if factor is None:
            raise checks.refuse(f"unit of {self.name}", unit, ", ".join(units_like(self.unit)))
        return Column(self.name, unit, self.values * factor, self.meaning)


class ResultTable(Mapping[str, NDArray[Any]]):
    """Columns of a result by name: `table["k_yy"]` has its numbers, `unit("k_yy")` their unit.

    Columns differ in length if a result has several kinds of rows.
    """

    def __init__(self, columns: Iterable[Column]) -> None:
        self.columns = tuple(columns)
        self._by_name = {column.name: column for column in self.columns}
        if len(self._by_name) != len(self.columns):
            names = [column.name for column in self.columns]
            raise checks.refuse("names of columns", names, "each once")

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the numbers (n,) of a column."""
        return self._by_name[name].values

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names of the columns."""
        return iter(self._by_name)

    def __len__(self) -> int:
        """Return the number of columns."""
        return len(self.columns)

    def unit(self, name: str) -> str:
        """Return the unit of a column."""
        return self._by_name[name].unit

    def meaning(self, name: str) -> str:
        """Return the meaning of a column, in a few words."""
        return self._by_name[name].meaning

    def in_units(self, units: Mapping[str, str] = READ_UNITS) -> ResultTable:
        """Return the table in other units: `{"rad": "deg"}` converts every column in rad to deg."""
        return ResultTable(
            column.convert(units.get(column.unit, column.unit)) for column in self.columns
        )

    def prefixed(self, prefix: str) -> ResultTable:
        """Return the table with a prefix before each name, to combine it with another."""
        return ResultTable(
            Column(f"{prefix}_{c.name}", c.unit, c.values, c.meaning) for c in self.columns
        )

    def only(self, *names: str) -> ResultTable:
        """Return the columns of these names, in their order."""
        return ResultTable(self._by_name[name] for name in names)

    def __or__(self, other: ResultTable) -> ResultTable:
        """Return both tables side by side."""
        return ResultTable([*self.columns, *other.columns])

    def named(self) -> dict[str, NDArray[Any]]:
        """Return the numbers under names with units: "cage_angle_deg"."""
        return {column.named: column.values for column in self.columns}

    def csv(self) -> str:
        """Return comma-separated text under names with units; short ones end with empty cells."""
        return as_csv(self.named())

    def frame(self) -> DataFrame:
        """Return a pandas data frame under names with units; short columns are filled with NaN."""
        import pandas as pd  # imported late: it takes as long as all of this package

        return pd.DataFrame({name: pd.Series(values) for name, values in self.named().items()})

    @property
    def _is_one_row(self) -> bool:
        return all(column.values.size == 1 for column in self.columns)

    def _lines(self) -> list[tuple[str, str, str]]:
        """Return a line for each column of a single row: name, value with unit, meaning."""
        return [
            (column.name, f"{_digits(column.values[0])} {_unit(column)}".rstrip(), column.meaning)
            for column in self.columns
        ]

    def _first_rows(self) -> DataFrame:
        size = self.columns[0].values.size  # columns as long as the first one share its rows
        columns = [column for column in self.columns if column.values.size == size]
        heads = [f"{column.name} [{_unit(column)}]".removesuffix(" []") for column in columns]
        return self.only(*(column.name for column in columns)).frame().set_axis(heads, axis=1)

    def __str__(self) -> str:
        """Return the first and last rows as text; for a single row, a line for each column.

        pandas leaves out the middle. Without pandas a table of several rows is complete CSV.
        """
        if not self._is_one_row and find_spec("pandas") is None:
            return self.csv()
        if not self._is_one_row:
            frame = self._first_rows()
            return str(frame.to_string(max_cols=MOST_COLUMNS, max_colwidth=60, **_PRINTED))
        lines = self._lines()
        wide, value_wide = (max(len(line[i]) for line in lines) for i in (0, 1))
        value_wide = min(value_wide, LONGEST_VALUE)
        rows = (f"{name:<{wide}}  {value:<{value_wide}}  {text}" for name, value, text in lines)
        filled = (textwrap.fill(row.rstrip(), 100, subsequent_indent=" " * 4) for row in rows)
        return "\n".join(filled)

    def _repr_html_(self) -> str:
        """Return the table as HTML for a notebook, with the rows of the text."""
        if find_spec("pandas") is None:
            return f"<pre>{escape(str(self))}</pre>"
        if not self._is_one_row:
            return str(self._first_rows().to_html(max_cols=2 * MOST_COLUMNS, border=0, **_PRINTED))
        import pandas as pd

        frame = pd.DataFrame(self._lines(), columns=["", "value", "meaning"])
        with pd.option_context("display.max_colwidth", None):  # sentences are long
            return str(frame.to_html(index=False, border=0, justify="left"))

    def __repr__(self) -> str:
        """Return the names of the columns."""
        return _cut(f"ResultTable({', '.join(self)})")


def table_of(
    *columns: tuple[str, str, ArrayLike] | tuple[str, str, ArrayLike, str], of: Sequence[Any] = ()
) -> ResultTable:
    """Return a table of columns (name, unit, numbers) or (name, unit, numbers, meaning).

    Instead of numbers a column may have the name of an attribute of the objects in `of`.
    """
    table = []
    for name, unit, values, *meaning in columns:
        if isinstance(values, str):
            values = [getattr(item, values) for item in of]
        table.append(Column(name, unit, np.asarray(values).ravel(), meaning[0] if meaning else ""))
    return ResultTable(table)


def shown_as_table(result: type[T]) -> type[T]:
    """Return a class with `.table()`, which is then printed as its table, also in notebooks.

    Its `repr` is one line: the first fields, and the shapes of arrays.
    """

    def heading(self: Any) -> str:
        name, sentence = type(self).__name__, getattr(self, "sentence", "")
        return f"{name}: {sentence}" if sentence and "sentence" not in self.table() else name

    def text(self: Any) -> str:
        return f"{heading(self)}\n{self.table()}"

    def html(self: Any) -> str:
        return f"<p>{escape(heading(self))}</p>{self.table()._repr_html_()}"

    shown: Any = result
    shown.__repr__, shown._repr_html_ = short_repr, html
    if "__str__" not in vars(result):
        shown.__str__ = text
    return result


def short_repr(value: Any) -> str:
    """Return class and first fields of a dataclass or named tuple, and the shapes of arrays."""
    fields = dataclasses.fields(value) if dataclasses.is_dataclass(value) else ()
    names = [field.name for field in fields if field.repr] or value._fields
    parts = [f"{name}{text}" for name in names if (text := _short(getattr(value, name)))]
    return _cut(f"{type(value).__name__}({', '.join(parts or names)})")


def _short(value: Any) -> str:
    """Return a short text for a field; empty for None and for a value with its own fields."""
    if isinstance(value, np.ndarray) and value.ndim:
        return f" {value.shape}"
    if value is None or (isinstance(value, str) and not value):
        return ""
    if isinstance(value, str | tuple):
        text = repr(value)
        long = f" ({len(value)},)" if isinstance(value, tuple) else ""
        return f"={text}" if len(text) <= 40 else long
    return f"={_digits(value)}" if np.ndim(value) == 0 and np.isreal(value) is True else ""


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST_REPR else f"{text[: LONGEST_REPR - 2]}…)"


def _unit(column: Column) -> str:
    return "" if column.unit == "1" else column.unit


def _digits(value: Any) -> str:
    """Return a float with six digits, and anything else by `str`."""
    return f"{value:.6g}" if isinstance(value, float | np.floating) else str(value)


def as_csv(columns: Mapping[str, NDArray[Any]]) -> str:
    """Return columns as comma-separated text; shorter columns end with empty cells."""
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
    """Return a float with nine digits, or words that no spreadsheet takes for a formula."""
    if isinstance(value, float | np.floating):
        return f"{value:.9g}"
    text = str(value)
    return f"'{text}" if isinstance(value, str) and text.startswith(_FORMULA) else text


_PRINTED: dict[str, Any] = {
    "max_rows": MOST_ROWS, "show_dimensions": True, "float_format": _digits
}  # fmt: skip
