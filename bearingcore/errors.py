"""Refusals and statuses as data: field, value and allowed values; a name and its sentence.

No code reads a message to find the reason: `FieldError` has it as attributes, and the outcome of a
solver is a member of a `Status`.
"""

from __future__ import annotations

import enum
import math
import reprlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Self

_short = reprlib.Repr()
_short.maxstring = _short.maxother = _short.maxlong = 80  # a value may be a whole file


class Status(enum.StrEnum):
    """Outcome of a solver. A member equals its text, which files and tables hold.

    A member is a text, or a text and a sentence; `sentence` is the latter, or else the text.
    """

    sentence: str

    def __new__(cls, text: str, sentence: str = "") -> Self:
        """A member that is its text."""
        member = str.__new__(cls, text)
        member._value_, member.sentence = text, sentence or text
        return member


@dataclass(frozen=True)
class Interval:
    """Finite numbers between two bounds, each of which belongs to it or does not.

    Attributes
    ----------
    at_least, at_most
        bounds that belong to it.
    above, below
        bounds that do not.
    note
        why, or the bounds in other words; may be empty.
    """

    at_least: float = -math.inf
    at_most: float = math.inf
    above: float = -math.inf
    below: float = math.inf
    note: str = ""

    def words(self, amount: Callable[[float], str], unit: str = "") -> str:
        """The interval in words, its bounds written by `amount`; `unit` stands behind them."""
        bounds = (
            ("at least", self.at_least),
            ("above", self.above),
            ("at most", self.at_most),
            ("below", self.below),
        )
        said = [f"{word} {amount(bound)}" for word, bound in bounds if math.isfinite(bound)]
        words = " ".join(["a finite number", " and ".join(said)]).rstrip()
        return words + (f" [{unit}]" if unit else "") + (f": {self.note}" if self.note else "")


class FieldError(ValueError):
    """A value that a field cannot have.

    Parameters
    ----------
    field
        name of the field, as in `Scene.replace` or the function that refused it.
    value
        the refused value [unit].
    allowed
        the values that are allowed: an `Interval` [unit], or words. In words ``{name}`` stands for
        a field and ``{name:unit}`` for its number, both out of `numbers`.
    unit
        SI unit of the value and of the bounds of an interval; empty where it is not said.
    numbers
        numbers in the words, by name, in the unit given there.
    where
        the parts that the field is in, outermost first: ("row 2",), ("line 7",).
    """

    def __init__(
        self,
        field: str,
        value: object,
        allowed: str | Interval,
        unit: str = "",
        numbers: Mapping[str, float] = MappingProxyType({}),
        where: tuple[str, ...] = (),
    ) -> None:
        # the arguments in full, so that an error comes out of another process as it went in
        super().__init__(field, value, allowed, unit, dict(numbers), where)
        self.field, self.value, self.allowed, self.unit = field, value, allowed, unit
        self.numbers, self.where = dict(numbers), where

    def inside(self, where: str) -> Self:
        """Return the same error for a part: ``error.inside("row 2")``."""
        return type(self)(
            self.field, self.value, self.allowed, self.unit, self.numbers, (where, *self.where)
        )

    def allowed_words(self, name: Callable[[str], str], amount: Callable[[float, str], str]) -> str:
        """The allowed values, in words.

        Parameters
        ----------
        name
            called with the name of a field: returns its label.
        amount
            called with a number and its SI unit: returns both as text.
        """
        if isinstance(self.allowed, Interval):
            return self.allowed.words(lambda bound: amount(bound, self.unit))
        if not self.numbers:
            return self.allowed
        return self.allowed.format(
            **{key: _InWords(key, number, name, amount) for key, number in self.numbers.items()}
        )

    @property
    def allowed_text(self) -> str:
        """The allowed values, in SI units."""
        if isinstance(self.allowed, Interval):
            return self.allowed.words("{:g}".format, self.unit)
        return self.allowed_words(str, lambda number, unit: f"{number:g} {unit}".rstrip())

    @property
    def value_text(self) -> str:
        """The value as text of bounded length."""
        return f"{self.value:g}" if isinstance(self.value, float) else _short.repr(self.value)

    def __str__(self) -> str:
        """Field, value and what is allowed, in SI units."""
        return "".join(f"{part}: " for part in self.where) + (
            f"{self.field} is {self.value_text}; allowed: {self.allowed_text}"
        )


class FieldTypeError(FieldError, TypeError):
    """A value of another type than a field can have: its words say which are wanted."""


class MissingError(FieldError):
    """An argument that has to be given, as it does not follow from the others."""

    def __str__(self) -> str:
        """Field, and what to pass, in SI units."""
        return f"{self.field} is missing: pass {self.field}=..., {self.allowed_text}"


@dataclass(frozen=True)
class _InWords:
    """A number inside words: formatted without a unit it is its name, else the amount."""

    name: str
    number: float
    name_of: Callable[[str], str]
    amount_of: Callable[[float, str], str]

    def __format__(self, unit: str) -> str:
        return self.amount_of(self.number, unit) if unit else self.name_of(self.name)
