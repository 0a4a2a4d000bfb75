"""Shapes in which public collections of bearing signals come, and what is known of them.

Their files leave out what their documents say. What follows from a shape is a guess with its
reason, never more.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from bearingcore.files.facts import Finding, Named
from bearingcore.files.units import FORCES


@dataclass(frozen=True)
class Known:
    """Properties of files of a known shape.

    Unit, sample rate [Hz], load [N], the places of all columns, the directions of the last ones.
    """

    unit: Finding[str] | None = None
    sample_rate: Finding[float] | None = None
    load: Finding[float] | None = None
    places: tuple[str, ...] | None = None
    directions: tuple[str, ...] = ()
    why: str = ""


def known_shape(
    names: Sequence[str], rows: int, clock: int, named: Sequence[Named], headed: bool
) -> Known:
    """Guess from the shape of a file.

    Parameters
    ----------
    names
        of all columns.
    rows
        of the table.
    clock
        how many of the first columns are hours, minutes, seconds and their parts.
    named
        the single numbers of the file.
    headed
        whether the file itself names its columns.
    """
    for shape in (_case_western, _mfpt):
        found = shape(names, named)
        if found is not None:
            return found
    if clock == 4 and len(names) - clock == 2 and not headed:
        why = "columns as in the FEMTO-ST collection, which is in g"
        return Known(Finding("g", why, False), directions=("x", "y"), why=why.partition(",")[0])
    if rows == 20_480 and len(names) in (4, 8) and not headed:
        return _ims(len(names))
    if rows == 32_768 and {name.lower() for name in names} == {
        "horizontal_vibration_signals",
        "vertical_vibration_signals",
    }:
        why = "headings as in the XJTU-SY collection"
        rate = Finding(25_600.0, f"{why}, which was sampled so", False)
        return Known(Finding("g", f"{why}, which is in g", False), rate)
    return Known()


def _case_western(names: Sequence[str], named: Sequence[Named]) -> Known | None:
    ends = {match[1] for name in names if (match := re.fullmatch(r"X\d{3}_(DE|FE|BA)_time", name))}
    if not ends:
        return None
    why = "variables named as in the Case Western Reserve collection"
    unit = Finding("g", f"{why}, which is in g", False)
    if "BA" in ends:
        rate = Finding(12_000.0, f"{why}: with a sensor on the base it was sampled so", False)
    elif "FE" in ends:
        rate = Finding(48_000.0, f"{why}: without a sensor on the base it was mostly so", False)
    else:
        rate = Finding(12_000.0, f"{why}, of which most was sampled so (some at 48 kHz)", False)
    return Known(unit, rate)


def _mfpt(names: Sequence[str], named: Sequence[Named]) -> Known | None:
    ends = {name.rpartition(".")[2] for name in [*names, *(one.name for one in named)]}
    if not {"gs", "sr", "rate"} <= ends:
        return None
    load = next((one for one in named if one.name.rpartition(".")[2] == "load"), None)
    if load is None:
        return Known()
    why = f"“{load.name}”, fields as in the MFPT collection, which gives pounds"
    return Known(load=Finding(load.value * FORCES["lb"], why, False))


def _ims(columns: int) -> Known:
    why = "20 480 rows as in the IMS collection"
    each = columns // 4
    return Known(
        Finding("g", f"{why}, which is in g", False),
        Finding(20_480.0, f"{why}, each a second long", False),
        places=tuple(f"bearing {index // each + 1}" for index in range(columns)),
        directions=("x", "y") * 4 if each == 2 else (),
        why=why,
    )
