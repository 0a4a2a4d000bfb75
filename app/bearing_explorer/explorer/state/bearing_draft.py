"""Dimensions that wait: those of a bearing that cannot be built yet are kept until they fit.

Numbers of a bearing depend on each other: a new ball may not fit before the new pitch diameter is
there too. What was entered is kept as a draft with each field's fault, and applied as a whole.
"""

from __future__ import annotations

from collections.abc import Mapping

from bearing_explorer.explorer.state.field_values import BEARING_GROUPS, FIELD_BY_KEY, Values, in_si
from bearing_explorer.kit.sentences import field_of, sentence_of
from bearingcore import Bearing
from bearingcore.bearings import faults
from bearingcore.common import number
from bearingcore.errors import FieldError

OF_BEARING = frozenset(key for key, field in FIELD_BY_KEY.items() if field.group in BEARING_GROUPS)
"""Quantities that are checked together."""

Faults = dict[str, str]
"""A sentence a field, by the names of the controls."""


def faults_of(bearing: Bearing, draft: Values, error: ValueError) -> Faults:
    """Faults of a draft, field by field, in the units of the page.

    `bearing` is the one that the draft would change, `error` what the core said of it. Faults
    stand at fields of the draft, where there is one among those concerned.
    """
    refused: Faults = {}
    for fault in faults(_dimensions(bearing, draft)):
        concerned = [_CONTROL[name] for name in (fault.field, *fault.numbers)]
        at = next((name for name in concerned if name in draft), concerned[0])
        refused.setdefault(at, _sentence(fault))
    if not refused:
        field = field_of(error)
        known = field is not None and field.key in OF_BEARING
        key = field.key if field is not None and known else next(reversed(draft))
        refused[key] = sentence_of(error)
    return refused


_CONTROL = {FIELD_BY_KEY[key].full_name: key for key in OF_BEARING}
"""The control of each field of a bearing."""


def _dimensions(bearing: Bearing, draft: Mapping[str, float]) -> dict[str, float | None]:
    """The fields that a bearing is given by [SI]: those of the draft, else its own.

    Grooves that are not in the draft go with their ball.
    """
    given = bearing.kind.inputs(bearing)
    own: dict[str, float | None] = {
        name: getattr(bearing, name) for name in given if hasattr(bearing, name)
    }
    new = {FIELD_BY_KEY[name].full_name: in_si(FIELD_BY_KEY[name], draft[name]) for name in draft}
    wider = (new.get("ball_diameter") or bearing.ball_diameter) / bearing.ball_diameter
    for race in ("outer", "inner"):
        name, radius = f"{race}_groove_radius", bearing.groove_radius(race)
        if name in given and radius is not None:
            own[name] = wider * radius
    return own | {name: value for name, value in new.items() if name in given}


def _sentence(fault: FieldError) -> str:
    """A fault in the words and units of the page."""

    def name(field: str) -> str:
        return FIELD_BY_KEY[_CONTROL[field]].label.lower()

    def amount(value: float, unit: str) -> str:
        return f"{number(1e3 * value, 6)} mm" if unit == "m" else number(value, 6)

    value = amount(float(fault.value), fault.unit)  # type: ignore[arg-type]  # a number here
    allowed = fault.allowed_words(name, amount)
    return f"The {name(fault.field)} is {value}; allowed: {allowed}."


def words_of(draft: Values) -> str:
    """The sentence above the fields while a draft waits."""
    if not draft:
        return ""
    labels = [FIELD_BY_KEY[name].label.lower() for name in draft]
    listed = " and ".join(filter(None, (", ".join(labels[:-1]), labels[-1])))
    waits = "waits" if len(labels) == 1 else "wait"
    return (
        f"Not applied yet: {listed} {waits} until all dimensions fit together. The figures show "
        "the bearing as it was."
    )
