"""The strip with warnings where a scene leaves the limits of the model."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import param

from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.serve.panel_internals import LiveComponent
from bearingcore import Limit
from bearingcore.common import number, with_prefix
from bearingcore.model.statics import NO_OIL


class LimitsStrip(LiveComponent):
    """Warnings for limits that are exceeded, and a table of all limits on demand."""

    #: rows of `rows_of`
    rows = param.List(default=[])
    #: all limits in a line
    summary = param.String()

    _esm = scripts("element.js", "limits.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("footer.css"),
        asset_text("limits.css"),
    ]


def rows_of(limits: tuple[Limit, ...]) -> list[dict[str, Any]]:
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
    return sorted(rows, key=lambda row: row["state"] != "crossed")


def judged(status: Mapping[str, Any], rows: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """A status line, which is a warning where all is computed and a limit of `rows` exceeded."""
    crossed = any(row["state"] == "crossed" for row in rows)
    if not crossed or status["mood"] != "good":
        return dict(status)
    words = status["words"].removesuffix(" without problems")
    return {**status, "mood": "warn", "words": f"{words}, limits exceeded"}


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
