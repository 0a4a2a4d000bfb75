"""All kinds of bearing. The first that recognizes the numbers of an old file has it."""

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
"""By name."""


def kind_named(name: object) -> Kind:
    """The kind of a name; ValueError where there is none."""
    return KINDS[checks.choice("kind", name, tuple(KINDS))]


def kind_of(bearing: InRows) -> Kind:
    """The kind that a bearing is made with, by itself, by its name, or by its numbers."""
    if isinstance(bearing.kind, Kind):
        return bearing.kind
    return kind_named(bearing.kind) if bearing.kind else recognized(bearing)


def recognized(bearing: InRows) -> Kind:
    """The kind that recognizes the numbers of a bearing, as of files that do not name it."""
    return next(kind for kind in KINDS.values() if kind.recognizes(bearing))
