"""Numbers in sentences, with as many digits as are meaningful.

Files, tables and lines of Python have all digits. The page's scripts follow the same rules as this
module (`JS_PREFIX` of its figures), and a test compares the two.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common._arrays import Array

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
"""SI prefixes by their power of ten."""

SMALLEST, LARGEST = 1e-4, 1e7
"""Numbers between these bounds are written out, others with a power of ten."""

NO_VALUE = "no value"
"""Text for NaN and infinity."""

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value: float, digits: int = 3) -> str:
    """Return `value` with `digits` significant digits and a true minus sign.

    Zeros at the end are dropped: 50 and not 50.0. Digits before the point are all kept: 1389 and
    not 1390. Numbers beyond `SMALLEST` and `LARGEST` have a power of ten.
    """
    if not math.isfinite(value):
        return NO_VALUE
    if value == 0.0:
        return "0"
    if not SMALLEST <= abs(value) < LARGEST:
        return scientific(value, digits)
    places = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    text = f"{value:.{places}f}"
    text = text.rstrip("0").rstrip(".") if places else text
    return text.replace("-", "−")


def scientific(value: float, digits: int = 1) -> str:
    """Return `value` with a power of ten: 3·10⁻¹²."""
    if not math.isfinite(value):
        return NO_VALUE
    if value == 0.0:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    power = "10" + str(int(exponent)).translate(_RAISED)
    return f"{mantissa}·{power}".replace("-", "−")


def prefix_power(top: float) -> int:
    """Return the power of ten of the SI prefix for numbers up to `top`."""
    if not (top > 0.0 and math.isfinite(top)):
        return 0
    return max(-12, min(12, 3 * math.floor(math.log10(top * 1.0000001) / 3)))


def with_prefix(value: float, unit: str, digits: int = 3) -> str:
    """Return `value` [unit] with an SI prefix: ``with_prefix(2061.6, "N")`` is "2.06 kN".

    A number that no prefix reaches has a power of ten and the plain unit: 8·10⁻²⁴ N.
    """
    if not math.isfinite(value):
        return NO_VALUE
    power = prefix_power(abs(value))
    scaled = float(f"{value / 10.0**power:.{digits}g}")
    if abs(scaled) >= 1000.0 and power < 12:  # 999.96 N is 1.00 kN
        power, scaled = power + 3, scaled / 1000.0
    if scaled != 0.0 and not SMALLEST <= abs(scaled) < LARGEST:
        return f"{scientific(value, digits)} {unit}"
    return f"{number(scaled, digits)} {PREFIXES[power]}{unit}"


def percent(share: float, digits: int = 3) -> str:
    """Return a share as percent: 0.125 is "12.5 %", 24.8 is "2480 %", 1e-5 is "below 0.01 %"."""
    if not math.isfinite(share):
        return NO_VALUE
    if 0.0 < abs(share) < 1e-4:
        return "below 0.01 %"
    return f"{number(100.0 * share, digits)} %"


def percent_off(share: float) -> str:
    """Return a deviation as percent with its sign, to a tenth: "+0.3 %", "−1.2 %", "0.0 %"."""
    if not math.isfinite(share):
        return NO_VALUE
    text = f"{100.0 * share:+.1f}"
    return "0.0 %" if float(text) == 0.0 else f"{text} %".replace("-", "−")


def probability(chance: float) -> str:
    """Return a probability as percent, from "below 1 %" to "above 99 %"."""
    if not math.isfinite(chance):
        return NO_VALUE
    if chance > 0.99:
        return "above 99 %"
    return f"{100.0 * chance:.0f} %" if chance >= 0.01 else "below 1 %"


def decibels(level: float, digits: int = 2) -> str:
    """Return a level or a difference of levels [dB] in words.

    An infinite one, as over a signal of zeros, is "unlimited" or "none".
    """
    if math.isnan(level):
        return NO_VALUE
    if level == math.inf:
        return "unlimited"
    if level == -math.inf:
        return "none"
    if 0.0 < abs(level) < 0.001:
        return "below 0.001 dB"
    return f"{number(level, digits)} dB"


def level_difference(power: ArrayLike, reference: ArrayLike) -> Array:
    """Return 10 log10(power/reference) [dB]; NaN where one of them is 0, which has no level."""
    both = np.broadcast_arrays(np.asarray(power, dtype=float), np.asarray(reference, dtype=float))
    known = (both[0] > 0.0) & (both[1] > 0.0)
    ratio = np.divide(both[0], both[1], out=np.full(known.shape, math.nan), where=known)
    return np.asarray(10.0 * np.log10(ratio))


def count(n: int, thing: str, plural: str = "") -> str:
    """Return a count with its noun: "1 limit", "2 limits", "no limits"."""
    if n == 1:
        return f"1 {thing}"
    return f"{n or 'no'} {plural or thing + 's'}"


def span(low: float, high: float, unit: str, digits: int = 3) -> str:
    """Return a range in words: "365 to 436 Hz", or "670 Hz" if both ends have the same text."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return NO_VALUE
    low_text, high_text = number(low, digits), number(high, digits)
    return f"{low_text} {unit}" if low_text == high_text else f"{low_text} to {high_text} {unit}"


def prefixed_span(low: float, high: float, unit: str) -> str:
    """Return a range with an SI prefix in words: "11.1 to 20.1 MN/m"."""
    low_text, high_text = with_prefix(low, unit), with_prefix(high, unit)
    low_number, low_unit = low_text.rsplit(" ", 1)
    if low_text == high_text or not (math.isfinite(low) and math.isfinite(high)):
        return high_text
    same_unit = low == 0.0 or high_text.endswith(f" {low_unit}")
    return f"{low_number if same_unit else low_text} to {high_text}"


def with_deviation(value: float, deviation: float, unit: str) -> str:
    """Return a number and its standard deviation, to the first digit of the deviation.

    ``with_deviation(62.19, 0.31, "°")`` is "62.2° ± 0.3°", without a space before the degree sign.
    """
    if not (math.isfinite(value) and math.isfinite(deviation)):
        return NO_VALUE
    first = float(f"{deviation:.1g}")  # rounded as it will be shown: 0.096 is 0.1
    places = min(6, max(0, -math.floor(math.log10(first)))) if first > 0.0 else 1
    space = "" if unit == "°" else " "
    return f"{value:.{places}f}{space}{unit} ± {deviation:.{places}f}{space}{unit}".replace(
        "-", "−"
    )


def thousands(value: float) -> str:
    """Return a whole number with a narrow space between groups of three digits: 65 536."""
    if not math.isfinite(value):
        return NO_VALUE
    return f"{round(value):,}".replace(",", "\u202f").replace("-", "−")
