"""Checks of input: each returns the value, or raises a `FieldError`.

A value of a wrong type raises a `FieldTypeError`, which is a `TypeError` too.
"""

from __future__ import annotations

import math
import reprlib
from typing import Any, SupportsFloat, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common._arrays import Array
from bearingcore.errors import FieldError, FieldTypeError, Interval, MissingError

T = TypeVar("T")


def refuse(field: str, value: object, allowed: str, unit: str = "", **numbers: float) -> FieldError:
    """Return the error to raise for `field`; `allowed` may use `numbers` as ``{name:unit}``."""
    return FieldError(field, value, allowed, unit, numbers)


def missing(field: str, wanted: str) -> MissingError:
    """Return the error to raise for a missing argument."""
    return MissingError(field, None, wanted)


def instance(field: str, value: object, kind: type[T], wanted: str = "") -> T:
    """Return `value` if it is of a type, else raise FieldTypeError with the words `wanted`.

    By default the words are `WANTED` of the type, or else its name.
    """
    if isinstance(value, kind):
        return value
    article = "an" if kind.__name__[0] in "AEIOU" else "a"
    wanted = wanted or getattr(kind, "WANTED", f"{article} {kind.__name__}")
    raise FieldTypeError(field, value, wanted)


def _is_number(value: object) -> bool:
    """Return True for a number, but not for text or truth values, which `float` would convert."""
    return isinstance(value, SupportsFloat) and not isinstance(value, bool | np.bool_ | str)


def real_number(
    field: str,
    value: SupportsFloat,
    *,
    at_least: float = -math.inf,
    at_most: float = math.inf,
    above: float = -math.inf,
    below: float = math.inf,
    unit: str = "",
    note: str = "",
) -> float:
    """Return `value` as a finite float within the limits [unit]; `note` gives their reason.

    Raises
    ------
    FieldError
        naming `field`, its value and the allowed range.
    """
    shown: object = value
    try:
        if _is_number(value):
            shown = x = float(value)
            if at_least <= x <= at_most and above < x < below and math.isfinite(x):
                return x
    except (TypeError, ValueError, OverflowError):
        pass
    error = FieldError if _is_number(shown) else FieldTypeError
    raise error(field, shown, Interval(at_least, at_most, above, below, note), unit)


def keep(part: object, **values: object) -> None:
    """Set fields of a frozen dataclass to checked values, in its `__post_init__`."""
    for name, value in values.items():
        object.__setattr__(part, name, value)


def keep_number(
    part: object, name: str, *, optional: bool = False, of: str = "", **limits: Any
) -> None:
    """Check a number of a frozen dataclass with `real_number`, and keep it as a float.

    An `optional` number may be None. An error appends `of` to the name.
    """
    value = getattr(part, name)
    if value is not None or not optional:
        keep(part, **{name: real_number(name + of, value, **limits)})


def choice(field: str, value: object, options: tuple[str, ...]) -> str:
    """Return `value` if it is one of `options`, else raise ValueError."""
    if not (isinstance(value, str) and value in options):
        error = FieldError if isinstance(value, str) else FieldTypeError
        raise error(field, value, ", ".join(options))
    return value


def whole_number(field: str, value: object, *, at_least: int, at_most: int) -> int:
    """Return `value`, such as 14 or 14.0, as an int inside the limits, else raise ValueError."""
    allowed = f"a whole number from {at_least} to {at_most}"
    if not _is_number(value):
        raise FieldTypeError(field, value, allowed)
    try:
        x = float(value)  # type: ignore[arg-type]  # TypeError is a refusal
    except (TypeError, ValueError, OverflowError):
        raise refuse(field, value, allowed) from None
    if not at_least <= x <= at_most or x != round(x):
        raise refuse(field, x, allowed)
    return round(x)


def finite(field: str, values: ArrayLike, unit: str, columns: int | None = None) -> Array:
    """Return a number or array as a copy (n,) of finite floats, else raise ValueError.

    With `columns` the shape is (n, columns), n > 0; for one column it may also be (n,).
    """
    allowed = f"finite numbers [{unit}]"
    try:
        row = np.array(values, dtype=float, ndmin=1)
    except (TypeError, ValueError, OverflowError):
        raise FieldTypeError(field, values, allowed) from None
    if columns == 1 and row.ndim == 1:
        row = row[:, None]
    if row.shape[1:] != (() if columns is None else (columns,)) or (columns and not len(row)):
        form = "in a row, shape (n,)" if columns is None else f"of shape (n, {columns})"
        raise refuse(field, f"an array of shape {row.shape}", f"{allowed} {form}")
    if not np.all(np.isfinite(row)):
        raise refuse(field, reprlib.repr(values), allowed)
    return row


def samples_of(
    signal: ArrayLike, least: int, why: str, dimensions: tuple[int, ...] = (1, 2)
) -> Array:
    """Return a signal of at least `least` samples as floats; ValueError unless all are finite."""
    samples: Array = np.asarray(signal, dtype=float)
    if samples.ndim not in dimensions or len(samples) < least:
        raise refuse("signal", f"of shape {samples.shape}", f"at least {least} samples, {why}")
    if not np.all(np.isfinite(samples)):
        raise refuse("signal", "not finite everywhere", "finite numbers")
    return samples
