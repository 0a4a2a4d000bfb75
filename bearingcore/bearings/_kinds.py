"""All kinds of bearing. An old file gets the first kind that recognizes its numbers."""

from __future__ import annotations

from bearingcore.bearings._ball import BALL
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._kind import Kind
from bearingcore.bearings._roller import ROLLER
from bearingcore.bearings._rows import ROWS
from bearingcore.bearings._self_aligning import SELF_ALIGNING
from bearingcore.bearings._tapered import TAPERED
from bearingcore.common import _checks as checks

KINDS: dict[str, Kind] = {kind.name: kind for kind in (BALL, SELF_ALIGNING, ROWS, ROLLER, TAPERED)}
"""Kinds of bearing by name."""


def kind_of(bearing: InRows) -> Kind:
    """Return the kind of a bearing; ValueError if its `kind` is not the name of one."""
    if isinstance(bearing.kind, Kind):
        return bearing.kind
    if not bearing.kind:
        return recognize_kind(bearing)
    return KINDS[checks.choice("kind", bearing.kind, tuple(KINDS))]


def recognize_kind(bearing: InRows) -> Kind:
    """Return the kind that recognizes the numbers of a bearing, for files that do not name it."""
    return next(kind for kind in KINDS.values() if kind.recognizes(bearing))
