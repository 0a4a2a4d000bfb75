"""Two rows of a bearing: their distance, what the second has of its own, and their preload.

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
"""Names of numbers of two rows, as `change_rows` takes them."""

MOST_GIVE = 1e-3
"""Displacement [m] of a row that no preload exceeds."""


def change_rows(bearing: InRows, changes: Mapping[str, Any]) -> tuple[Row, ...]:
    """Return the rows of a bearing of two rows with changed numbers out of ROW_CHANGES.

    Raises
    ------
    ValueError
        for a bearing that has not two rows, or whose rows form no pair; for a preload of rows in
        tandem, or of contacts at an angle of 0.
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
            wanted = "left out, as it is with preload, and of rows in tandem"
            raise checks.refuse("preload_force", of_pair["preload_force"], wanted)
        preload = _displacement(bearing, of_pair["preload_force"])
    made = pair(distance, arrangement, preload)
    if preload != 0.0 and bearing.contact_angle == 0.0:
        raise checks.refuse("preload", preload, "0 m at a contact angle of 0")
    return tuple(
        dataclasses.replace(row, place=new.place, offset=new.offset)
        for row, new in zip((low, high), made, strict=True)
    )


def preload_force(bearing: InRows) -> float | None:
    """Return F0 [N] of a pair; None of any other bearing."""
    if _kind_of(bearing).arrangement(bearing) in ("", "tandem"):
        return None
    low, high = bearing.rows
    half = 0.5 * (high.offset - low.offset) * high.facing
    first, second = (_force_of_row(bearing, row) for row in (0, 1))
    most = abs(half) + MOST_GIVE
    # the softer row gives way more
    more = _threshold(lambda u: first(half + u) - second(half - u), 0.0, -most, most)
    return first(half + more)


def _displacement(bearing: InRows, force: float) -> float:
    """Displacement [m] of a pair's inner grooves by which its rows press each other with a force.

    Of no force it is the largest at which they do not.
    """
    force = checks.real_number("preload_force", force, at_least=0.0, unit="N")
    total = 0.0
    for row in (0, 1):
        of_row = _force_of_row(bearing, row)
        if not force < (most := of_row(MOST_GIVE)):
            raise checks.refuse("preload_force", force, f"below {most:.4g} N")
        total += _threshold(of_row, force, -MOST_GIVE, MOST_GIVE)
    return total


def _force_of_row(bearing: InRows, row: int) -> Callable[[float], float]:
    """The axial force [N] of a row over its displacement [m]; never below 0."""
    own = bearing.of_row(row)
    contact = _kind_of(own).contact(own)
    clearance = bearing.radial_clearance + bearing.all_rows[row].clearance
    sine, cosine = math.sin(contact.angle), math.cos(contact.angle)
    stiffness = own.n_balls * contact.factor

    def force(give: float) -> float:
        if (apart := contact.center_distance) is None:
            return stiffness * max(give * sine - clearance * cosine, 0.0) ** contact.exponent * sine
        along = max(apart * sine + give, 0.0)
        length = math.hypot(apart * cosine - clearance, along)
        return stiffness * max(length - apart, 0.0) ** contact.exponent * along / length

    return force


def _threshold(of: Callable[[float], float], value: float, low: float, high: float) -> float:
    """The number between two bounds from which on a rising function exceeds a value."""
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (low, middle) if of(middle) > value else (middle, high)
    return low


def _kind_of(bearing: InRows) -> Kind:
    assert isinstance(bearing.kind, Kind)  # rows do not know what a kind is
    return bearing.kind
