"""Dimensions that wait: those of a bearing that cannot be built yet are kept until they fit.

Numbers of a bearing depend on each other: a new ball may not fit before the new pitch diameter is
there too. What was entered is kept as a draft with each field's fault, and applied as a whole.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from bearing_explorer.state.quantities import QUANTITIES, Values, in_si, refusal
from bearing_explorer.state.quantity_list import BEARING_GROUPS
from bearingcore import Bearing
from bearingcore.bearings.drawing import WIDEST_CONFORMITY
from bearingcore.common.numbers import number

OF_BEARING = frozenset(
    name for name, quantity in QUANTITIES.items() if quantity.group in BEARING_GROUPS
)
"""Quantities that are checked together."""

Faults = dict[str, str]
"""A sentence a field, by the names of the controls."""


def faults_of(bearing: Bearing, draft: Values, error: ValueError) -> Faults:
    """What is wrong with a draft, field by field, in the units of the page.

    `bearing` is the one that the draft would change, `error` what the core said of it. Faults
    stand at fields of the draft, where there is one among those concerned.
    """
    get = _Numbers(bearing, draft)
    ball, pitch, count = get("ball_diameter_mm"), get("pitch_diameter_mm"), get("n_balls")
    found: list[tuple[tuple[str, ...], str]] = []

    def fault(fields: tuple[str, ...], sentence: str) -> None:
        found.append((fields, sentence))

    given = bearing.kind.inputs(bearing)
    if "pitch_diameter" in given:
        if not 0.0 < ball < pitch:
            fault(
                ("ball_diameter_mm", "pitch_diameter_mm"),
                f"The ball diameter is {_mm(ball)}; allowed: above 0 and below the pitch diameter "
                f"of {_mm(pitch)}.",
            )
        elif count > 1 and pitch * math.sin(math.pi / count) < ball:
            apart = pitch * math.sin(math.pi / count)
            fault(
                ("n_balls", "ball_diameter_mm", "pitch_diameter_mm"),
                f"The number of balls is {number(count, 6)}; allowed: so few that balls of "
                f"{_mm(ball)} do not overlap, here {_most_balls(ball, pitch)} (their centres would "
                f"be {_mm(apart)} apart).",
            )
    if count != int(count):
        fault(("n_balls",), f"The number of balls is {number(count, 6)}; allowed: a whole number.")
    for race in ("outer", "inner"):
        name = f"{race}_groove_radius_mm"
        radius = get(name)
        if not math.isnan(radius) and not 0.5 * ball < radius <= WIDEST_CONFORMITY * ball:
            fault(
                (name, "ball_diameter_mm"),
                f"The {race} groove radius is {_mm(radius)}; allowed: above {_mm(0.5 * ball)}, the "
                f"ball's, and at most {_mm(WIDEST_CONFORMITY * ball)}, {WIDEST_CONFORMITY:g} ball "
                "diameters.",
            )
    inner, outer = get("inner_raceway_radius_mm"), get("outer_raceway_radius_mm")
    if "inner_raceway_radius" in given and not inner < outer:
        fault(
            ("inner_raceway_radius_mm", "outer_raceway_radius_mm"),
            f"The inner raceway radius is {_mm(inner)}; allowed: below the outer raceway radius "
            f"of {_mm(outer)}.",
        )
    faults: Faults = {}
    for fields, sentence in found:
        for name in [name for name in fields if name in draft][:1] or fields[:1]:
            faults.setdefault(name, sentence)
    if not faults:
        last = next(reversed(draft))
        faults[_field_of(error, last)] = refusal(error)
    return faults


class _Numbers:
    """Dimensions as the page shows them: those of the draft, else those of the bearing."""

    def __init__(self, bearing: Bearing, draft: Mapping[str, float]) -> None:
        self._bearing, self._draft = bearing, draft

    def __call__(self, name: str) -> float:
        if name in self._draft:
            return self._draft[name]
        quantity = QUANTITIES[name]
        si = getattr(self._bearing, quantity.last_name)
        if quantity.last_name in ("inner_groove_radius", "outer_groove_radius"):
            if quantity.last_name in self._bearing.kind.inputs(self._bearing):
                si = self._bearing.groove_radius(quantity.last_name[:5])
            if si is not None and "ball_diameter_mm" in self._draft:
                # grooves that are not in the draft go with their ball
                ball = in_si(QUANTITIES["ball_diameter_mm"], self._draft["ball_diameter_mm"])
                si *= (ball or 0.0) / self._bearing.ball_diameter
        return math.nan if si is None else float(si) / quantity.unit_si


def _field_of(error: ValueError, otherwise: str) -> str:
    """The control that the core speaks of first."""
    first = str(error).split(" ", 1)[0]
    return next((name for name in OF_BEARING if QUANTITIES[name].last_name == first), otherwise)


def _most_balls(ball: float, pitch: float) -> str:
    return f"at most {math.floor(math.pi / math.asin(ball / pitch) + 1e-9)}"


def _mm(value: float) -> str:
    return f"{number(value, 6)} mm"


def words_of(draft: Values) -> str:
    """What is said above the fields while a draft waits."""
    if not draft:
        return ""
    labels = [QUANTITIES[name].label.lower() for name in draft]
    listed = " and ".join(filter(None, (", ".join(labels[:-1]), labels[-1])))
    waits = "waits" if len(labels) == 1 else "wait"
    return (
        f"Not applied yet: {listed} {waits} until all dimensions fit together. The figures show "
        "the bearing as it was."
    )
