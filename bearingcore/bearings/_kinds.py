"""All kinds of bearing. The first that recognizes the numbers of an old file has it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bearingcore.bearings._ball import BALL
from bearingcore.bearings._kind import Kind
from bearingcore.bearings._roller import ROLLER
from bearingcore.bearings._rows import ROWS
from bearingcore.bearings._self_aligning import SELF_ALIGNING
from bearingcore.bearings._tapered import TAPERED
from bearingcore.common import _checks as checks

if TYPE_CHECKING:
    from bearingcore.bearings._bearing import Bearing

KINDS: dict[str, Kind] = {kind.name: kind for kind in (BALL, SELF_ALIGNING, ROWS, ROLLER, TAPERED)}
"""By name."""


def kind_named(name: str) -> Kind:
    """The kind of a name; ValueError where there is none."""
    return KINDS[checks.choice("kind", name, tuple(KINDS))]


def kind_of(bearing: Bearing) -> Kind:
    """The kind that a bearing is made with, by itself, by its name, or by its numbers."""
    name: object = bearing.kind
    if isinstance(name, Kind):
        return name
    return kind_named(bearing.kind) if name else recognized(bearing)  # type: ignore[arg-type]


def recognized(bearing: Bearing) -> Kind:
    """The kind that recognizes the numbers of a bearing, as of files that do not name it."""
    return next(kind for kind in KINDS.values() if kind.recognizes(bearing))
