"""Bearings: a file a kind, presets and the catalogue by designation, what a drawing says.

A kind is listed below. The first that recognizes the numbers of an old file has it.
"""

from bearingcore.bearings.ball import BALL
from bearingcore.bearings.kind import Kind
from bearingcore.bearings.roller import ROLLER
from bearingcore.bearings.rows import ROWS
from bearingcore.bearings.self_aligning import SELF_ALIGNING
from bearingcore.bearings.tapered import TAPERED

KINDS: dict[str, Kind] = {kind.name: kind for kind in (BALL, SELF_ALIGNING, ROWS, ROLLER, TAPERED)}
"""All kinds of bearing, by name."""
