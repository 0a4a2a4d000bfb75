"""Two rows of a bearing: their distance, the second row's own numbers, and their preload.

A pair is preloaded by pushing its inner grooves along the shaft against each other by u. No load
acts, so each row gives way by its part u_k until both press the shaft with the same force F0:

quantity                             | turning line (balls)       | fixed line (rollers)
------------------------------------ | -------------------------- | -------------------------
axial distance of the groove centres | x = A0 sin α0 + u_k        |
compression of a contact             | δ = √(H² + x²) − A0        | δ = u_k sin α − r_L cos α
force along the shaft, N_b contacts  | F = N_b K δ^n x/√(H² + x²) | F = N_b K δ^n sin α

H = A0 cos α0 − r_L (Petersen, Howard & Prime 2014, Eqs. 9 to 13, without a radial displacement).
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import Any

from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._kind import Kind
from bearingcore.bearings._row import OWN, Row, pair
from bearingcore.common import _checks as checks

_SECOND = {f"second_{name}": name for name in OWN}
ROW_CHANGES = ("row_distance", "preload", "preload_force", *_SECOND)
"""Names of the numbers of two rows that `change_rows` takes."""

MOST_GIVE = 1e-3
"""Displacement [m] of a row that no preload exceeds."""


def change_rows(bearing: InRows, changes: Mapping[str, Any]) -> tuple[Row, ...]:
    """Return the rows of a bearing of two rows with changed numbers out of ROW_CHANGES.

    Raises
    ------
    ValueError
        for a bearing without two rows that form a pair; for a preload of rows in tandem, or of
        contacts at an angle of 0.
    """
    of_second = {_SECOND[name]: value for name, value in changes.items() if name in _SECOND}
    of_pair = {name: value for name, value in changes.items() if name not in _SECOND}
    if len(bearing.rows) == 2:
        low, high = bearing.rows[0], dataclasses.replace(bearing.rows[1], **of_second)
        if not of_pair:
            return low, high
        bearing = bearing.replace(rows=(low, high))
    if not (arrangement := _kind_of(bearing).arrangement(bearing)):
        wanted = f"two rows that form a pair, where {next(iter(changes))} is set"
        raise checks.refuse("rows", len(bearing.all_rows), wanted)
    distance = of_pair.get("row_distance", high.place - low.place)
    preload = of_pair.get("preload", (high.offset - low.offset) * high.facing)
    if "preload_force" in of_pair:
        if "preload" in of_pair or arrangement == "tandem":
            wanted = "nothing where preload is given, and for rows in tandem"
            raise checks.refuse("preload_force", of_pair["preload_force"], wanted)
        preload = _displacement(bearing, of_pair["preload_force"])
    paired = pair(distance, arrangement, preload)
    if preload != 0.0 and bearing.contact_angle == 0.0:
        raise checks.refuse("preload", preload, "0 m at a contact angle of 0")
    return tuple(
        dataclasses.replace(row, place=new.place, offset=new.offset)
        for row, new in zip((low, high), paired, strict=True)
    )


def preload_force(bearing: InRows) -> float | None:
    """Return F0 [N] of a pair; None for any other bearing."""
    if _kind_of(bearing).arrangement(bearing) in ("", "tandem"):
        return None
    low, high = bearing.rows
    half = 0.5 * (high.offset - low.offset) * high.facing
    first, second = (_force_of_row(bearing, row) for row in (0, 1))
    most = abs(half) + MOST_GIVE
    # u_1 + u_2 is the preload, and both forces are equal: the first row moves by `half + more`
    more = _threshold(lambda u: first(half + u) - second(half - u), 0.0, -most, most)
    return first(half + more)


def _displacement(bearing: InRows, force: float) -> float:
    """Return the displacement [m] of a pair's inner grooves at a preload force [N].

    For no force it is the largest displacement at which the rows do not press each other.
    """
    force = checks.real_number("preload_force", force, at_least=0.0, unit="N")
    total = 0.0
    for row in (0, 1):
        force_of_row = _force_of_row(bearing, row)
        if not force < (most := force_of_row(MOST_GIVE)):
            raise checks.refuse("preload_force", force, f"below {most:.4g} N")
        total += _threshold(force_of_row, force, -MOST_GIVE, MOST_GIVE)
    return total


def _force_of_row(bearing: InRows, row: int) -> Callable[[float], float]:
    """Return the axial force [N] of a row as a function of its displacement [m]; at least 0."""
    single = bearing.of_row(row)
    contact = _kind_of(single).contact(single)
    clearance = bearing.radial_clearance + bearing.all_rows[row].clearance
    sine, cosine = math.sin(contact.angle), math.cos(contact.angle)
    factor = single.n_balls * contact.factor

    def force(give: float) -> float:
        if (distance := contact.center_distance) is None:
            return factor * max(give * sine - clearance * cosine, 0.0) ** contact.exponent * sine
        along = max(distance * sine + give, 0.0)
        length = math.hypot(distance * cosine - clearance, along)
        return factor * max(length - distance, 0.0) ** contact.exponent * along / length

    return force


def _threshold(rising: Callable[[float], float], value: float, low: float, high: float) -> float:
    """Bisect for the number above which a rising function exceeds a value."""
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (low, middle) if rising(middle) > value else (middle, high)
    return low


def _kind_of(bearing: InRows) -> Kind:
    assert isinstance(bearing.kind, Kind)  # `InRows` has no type for it
    return bearing.kind
