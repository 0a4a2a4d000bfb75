"""Limits of the model as rows of the strip of warnings."""

from __future__ import annotations

import math
from typing import Any

from bearingcore import Limit
from bearingcore.common import number, with_prefix
from bearingcore.model.statics import NO_OIL


def rows_of(limits: tuple[Limit, ...]) -> tuple[dict[str, Any], ...]:
    """Limits for the browser, crossed ones first: names, numbers and sentences in words."""
    rows = [
        {
            "name": limit.name,
            "value": _number(limit.value, limit.unit),
            "limit": _number(limit.limit, limit.unit),
            "state": "unknown"
            if math.isnan(limit.value)
            else "crossed"
            if limit.crossed
            else "kept",
            "short": f"{limit.name.capitalize()}: {_number(limit.value, limit.unit)} "
            f"(limit {_number(limit.limit, limit.unit)})",
            "sentence": limit.sentence + _where(limit),
        }
        for limit in limits
    ]
    return tuple(sorted(rows, key=lambda row: row["state"] != "crossed"))


def _where(limit: Limit) -> str:
    """The tab with the fields for a number that is missing."""
    if math.isnan(limit.value) and NO_OIL in limit.sentence:
        return " Enter them on the Machine tab, under Life."
    return ""


def _number(value: float, unit: str) -> str:
    if math.isnan(value):
        return "not known"
    if unit == "rad":
        return f"{number(math.degrees(value))}°"
    if unit:
        return with_prefix(value, unit)
    return number(value) if value >= 1e-4 or value == 0.0 else "below 0.0001"
