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
    """Outcome of a solver. A member equals its text, which files and tables contain.

    A member is defined by a text, or by a text and a sentence. `sentence` is the text by default.
    """

    sentence: str

    def __new__(cls, text: str, sentence: str = "") -> Self:
        """Make a member that equals its text."""
        member = str.__new__(cls, text)
        member._value_, member.sentence = text, sentence or text
        return member


@dataclass(frozen=True)
class Interval:
    """Interval of finite numbers.

    Attributes
    ----------
    at_least, at_most
        bounds that belong to the interval.
    above, below
        bounds that do not.
    note
        reason for the bounds, or the bounds in other words; may be empty.
    """

    at_least: float = -math.inf
    at_most: float = math.inf
    above: float = -math.inf
    below: float = math.inf
    note: str = ""

    def words(self, amount: Callable[[float], str], unit: str = "") -> str:
        """Return the interval in words; `amount` makes the text of a bound, `unit` follows them."""
        bounds = (
            ("at least", self.at_least),
            ("above", self.above),
            ("at most", self.at_most),
            ("below", self.below),
        )
        limits = [f"{word} {amount(bound)}" for word, bound in bounds if math.isfinite(bound)]
        words = " ".join(["a finite number", " and ".join(limits)]).rstrip()
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
        SI unit of the value and of the bounds of an interval; empty if it is not stated.
    numbers
        numbers in the words, by name, in the unit given there.
    where
        the parts that contain the field, outermost first: ("row 2",), ("line 7",).
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
        # all arguments, so that an error can be pickled on its way from another process
        super().__init__(field, value, allowed, unit, dict(numbers), where)
        self.field, self.value, self.allowed, self.unit = field, value, allowed, unit
        self.numbers, self.where = dict(numbers), where

    def inside(self, where: str) -> Self:
        """Return the same error for a part: ``error.inside("row 2")``."""
        return type(self)(
            self.field, self.value, self.allowed, self.unit, self.numbers, (where, *self.where)
        )

    def allowed_words(self, name: Callable[[str], str], amount: Callable[[float, str], str]) -> str:
        """Return the allowed values, in words.

        Parameters
        ----------
        name
            function that returns the label of a field from its name.
        amount
            function that returns a number with its SI unit as text.
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
        """Return the field, its value and the allowed values, in SI units."""
        return "".join(f"{part}: " for part in self.where) + (
            f"{self.field} is {self.value_text}; allowed: {self.allowed_text}"
        )


class FieldTypeError(FieldError, TypeError):
    """A value of a type that a field cannot have; `allowed` names the types that it can have."""


class MissingError(FieldError):
    """A missing argument, which does not follow from the others."""

    def __str__(self) -> str:
        """Return the field and the value to pass, in SI units."""
        return f"{self.field} is missing: pass {self.field}=..., {self.allowed_text}"


@dataclass(frozen=True)
class _InWords:
    """A number inside words: its format is the label without a unit, and the amount with one."""

    name: str
    number: float
    name_of: Callable[[str], str]
    amount_of: Callable[[float, str], str]

    def __format__(self, unit: str) -> str:
        return self.amount_of(self.number, unit) if unit else self.name_of(self.name)
