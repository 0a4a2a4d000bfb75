"""The nearest bearing of the table to a designation that is not in it, in a sentence.

Of a known series it is the one with the nearest bore; of others one of the same bore that is most
like them (ISO 15, ISO 355), with what it is instead.
"""

from __future__ import annotations

import re

from bearingcore.bearings.designation_tables import boundaries, series_of
from bearingcore.bearings.suffix import BEFORE
from bearingcore.common.numbers import number

_LIKE = {
    "718": ("719", "a heavier series of angular-contact ball bearings"),
    "QJ2": ("72", "one half of its contacts"),
    "QJ3": ("73", "one half of its contacts"),
    **dict.fromkeys(("329", "330", "331", "332"), ("320", "another series of such rollers")),
    "313": ("303", "the same dimensions with a flatter cone"),
    "213": ("NU3", "cylindrical rollers of the same dimensions"),
    "222": ("NU22", "cylindrical rollers of the same dimensions"),
    "223": ("NU23", "cylindrical rollers of the same dimensions"),
    **dict.fromkeys(("230", "231", "232", "239", "240", "241"), ("NU22", "cylindrical rollers")),
    "UC2": ("62", "the same inside in usual rings"),
    "UC3": ("63", "the same inside in usual rings"),
    "622": ("62", "a narrower one, with the same balls"),
    "623": ("63", "a narrower one, with the same balls"),
    "630": ("60", "a narrower one, with the same balls"),
    "32": ("72", "one row: two of them are written 7208 DB"),
    "33": ("73", "one row: two of them are written 7308 DB"),
}
"""Series of the table that stand in for others, and what they are instead."""

_FORM = re.compile(BEFORE + r"(?:.*[ -])??(?P<letters>[A-Z]{0,3}?)[ -]?(?P<number>\d{3,5})(?!\d)")
_SMALL_BORES = {0: 10.0, 1: 12.0, 2: 15.0, 3: 17.0}
_SHORT = {"68": "618", "69": "619"}
_SMALL = {"63": "62"}
"""Series of bores below 10 mm with another one that has them."""


def nearest_known(name: str) -> str:
    """Words on the nearest bearing of the table to one in capitals; empty where none is near."""
    form = _FORM.match(name)
    if form is None:
        return ""
    letters, digits = form["letters"], form["number"]
    letters = "UC" if letters.startswith("UC") else letters
    letters = "NU" if letters in ("N", "NJ", "NUP", "NF") else letters
    for key in dict.fromkeys((letters + digits, digits)):
        if len(letters) > 1 and key == digits:
            break  # another kind, of which the number says nothing
        if key[-3:].isdigit() and len(digits) == 3 and key == digits:  # bores below 10 mm: 608
            series, bore = _SMALL.get(digits[:2], digits[:2]), float(digits[2])
        else:
            series, code = key[:-2], int(key[-2:])
            bore = _SMALL_BORES.get(code, 5.0 * code)
        like, instead = _LIKE.get(series, (_SHORT.get(series, series), ""))
        known = {basic: size for basic, size in boundaries().items() if series_of(basic) == like}
        if known:
            basic = min(known, key=lambda one: abs(1e3 * known[one].bore - bore))
            size = known[basic]
            sides = (size.bore, size.outside_diameter, size.width)
            words = " × ".join(number(1e3 * side, 4) for side in sides)
            return f"the nearest known is {basic} ({words} mm{', ' * bool(instead)}{instead})"
    return ""
