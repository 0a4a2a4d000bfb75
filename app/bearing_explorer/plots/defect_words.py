"""Sizes of defects for sentences: along the race in degrees and in millimetres."""

from __future__ import annotations

import math

from bearing_explorer.plots import style
from bearingcore import Bearing, Defect


def length_on_race(defect: Defect, bearing: Bearing) -> float:
    """Length [m] of a defect along the bottom of its race."""
    return defect.extent * defect.raceway_radius(bearing)


def extent_words(defect: Defect, bearing: Bearing) -> str:
    """Extent of a defect in degrees and along its race: "12.9° (5.97 mm)"."""
    length = style.with_prefix(length_on_race(defect, bearing), "m")
    return f"{style.number(math.degrees(defect.extent))}° ({length})"
