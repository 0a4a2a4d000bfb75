"""Variables of a file: matrices of numbers and words by name, and a table made of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, _checks as checks
from bearingcore.measured.files._facts import is_steady
from bearingcore.recordings import FEWEST_SAMPLES

DEEPEST = 8
"""Greatest depth of structs, cells and groups inside one another."""

MOST_NUMBERS = 16_000_000
"""Greatest count of numbers in all columns of a file."""

MOST_COLUMNS = 1024

MOST_SCALARS = 200
"""Most single numbers, and most words, of a file that are kept."""

LONGEST_TEXT = 1000
"""Longest text [characters] that is kept."""

Answer = tuple[dict[str, Any], Array]


@dataclass
class Variables:
    """Variables of a file: matrices in their stored number type, and words.

    `scalars` are the matrices with a single number, or with one number that repeats. `instead` are
    words for what to use in place of a file without a signal.
    """

    numbers: dict[str, NDArray[Any]] = field(default_factory=dict)
    scalars: dict[str, float] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    objects: list[str] = field(default_factory=list)
    instead: str = ""

    def add(self, path: str, value: NDArray[Any]) -> None:
        """Keep real numbers as a matrix, or a word; ignore anything else."""
        for part in value.dtype.names or ():
            self.add(f"{path}.{part}" if path else part, value[part].ravel())
        if value.dtype.kind == "M" and value.size:
            value = value - value.ravel()[0]
        if value.dtype.kind == "m":  # durations, also those since the first date
            value = value / np.timedelta64(1, "s")
        if value.ndim > 2:  # samples follow each other along the longest axis
            longest = int(np.argmax(value.shape))
            value = np.moveaxis(value, longest, 0).reshape(value.shape[longest], -1)
        if value.dtype.kind in "iuf" and value.ndim <= 2:
            self.numbers[path] = np.atleast_2d(value)
        elif value.dtype.kind in "OSU":
            words = value.ravel()[: MOST_SCALARS - len(self.texts)].tolist()
            for index, word in enumerate(words):
                text = word.decode("utf-8", "replace") if isinstance(word, bytes) else str(word)
                name = f"{path}{{{index + 1}}}" if len(words) > 1 else path
                self.texts[name] = text[:LONGEST_TEXT].strip()

    def table(self, name: str, kind: str) -> Answer:
        """Return vectors and matrices about as long as the longest as columns; others as facts."""
        parts: dict[str, NDArray[Any]] = {}
        for variable, matrix in self.numbers.items():
            if matrix.size > 1:
                parts[variable] = matrix.T if matrix.shape[0] < matrix.shape[1] else matrix
            elif matrix.size and len(self.scalars) < MOST_SCALARS:
                with np.errstate(invalid="ignore"):  # signalling NaNs in damaged files
                    self.scalars[variable] = float(matrix[0, 0])
        if self.objects and max((len(part) for part in parts.values()), default=0) < FEWEST_SAMPLES:
            wanted = (
                f"one whose signals are arrays; {self.objects[0]} is a table or an object: save "
            )
            raise checks.refuse("file", name, f"{wanted}its columns, as in acc = T.acc, or as CSV")
        if not parts:
            wanted = self.instead or f"a {kind} with a vector or matrix of real numbers"
            raise checks.refuse("file", name, wanted)
        rows = max(len(part) for part in parts.values())
        self._remove_short(parts, rows)
        width = sum(part.shape[1] for part in parts.values())
        check_size(name, rows, width, MOST_NUMBERS, MOST_COLUMNS)
        columns = np.full((rows, width), np.nan, order="F")
        names: list[str] = []
        with np.errstate(invalid="ignore"):
            for variable, part in parts.items():
                columns[: len(part), len(names) : len(names) + part.shape[1]] = part
                several = part.shape[1] > 1
                names += [f"{variable}(:,{i + 1})" if several else variable
                          for i in range(part.shape[1])]  # fmt: skip
        return {"names": names, "scalars": self.scalars, "texts": self.texts}, columns

    def _remove_short(self, parts: dict[str, NDArray[Any]], rows: int) -> None:
        """Remove the parts that are much shorter than the longest, which has so many rows.

        A much shorter part is no signal, or was measured in another way.
        """
        least = max(FEWEST_SAMPLES, rows // 2) if rows >= FEWEST_SAMPLES else rows
        for variable in [variable for variable, part in parts.items() if len(part) < least]:
            part = parts.pop(variable)
            # its facts, such as its rate, do not hold for the signals
            for name in [name for name in self.scalars if name.startswith(f"{variable}.")]:
                del self.scalars[name]
            if is_steady(part) and len(self.scalars) < MOST_SCALARS:
                self.scalars[variable] = float(part.mean())
            elif len(self.texts) < MOST_SCALARS:
                self.texts[variable] = f"not used: {len(part)} × {part.shape[1]} numbers"


def check_size(name: str, rows: int, width: int, most_numbers: int, most_columns: int) -> None:
    """Refuse a table with too many columns or numbers."""
    if width > most_columns:
        most = f"at most {most_columns}: save those of one bearing, or write each signal in a row"
        raise checks.refuse(f"number of columns in {name}", width, most)
    if rows * width > most_numbers:
        most = f"at most {most_numbers}; split it by rows and join the parts"
        raise checks.refuse(f"count of numbers in {name}", f"over {most_numbers}", most)


def check_depth(depth: int) -> None:
    if depth > DEEPEST:
        raise checks.refuse("structs inside one another", "deeper", f"at most {DEEPEST}")
