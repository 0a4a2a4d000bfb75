"""Inside dimensions of a bearing from its catalogue: the balls that give its load ratings.

Makers print outside dimensions and load ratings, but no balls. Ratings are computed from the balls,
C_r as Z^(2/3) D^1.8 (ISO 281) and C_0r as Z D² (ISO 76), and balls come in standard sizes: only a
few pairs of number and size give both ratings to the printed digits. The rule here takes the pair
that fits them best, on a pitch circle in the middle of the cross-section.

Rollers are known better. The diameters of both raceways are standard (DIN 5412-1), which gives
diameter and pitch circle. C_0r then gives the number of rollers times the length that touches. This
length is a whole number of millimetres, which decides the number.

Tapered rollers have no standard raceways, and their lengths are no whole numbers. C_r and C_0r
still give the diameter: C_r^(9/7)/C_0r is proportional to D^(8/21) and hardly depends on the number
of rollers. This leaves the product of number and length; the number is the one with which rollers
fill nine tenths of their circle.

No constant of the rule was fitted to a bearing whose inside is published. Its errors for those
bearings are `FREQUENCY_SPREAD` and `RATIO_SPREAD`, which a test measures again. Too few tapered
rollers are published: `TAPERED_SPREAD` compares ratings of two makers.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from bearingcore.bearings import _ratings as ratings
from bearingcore.bearings._drawing import USUAL_GROOVES
from bearingcore.bearings._kind import Kind
from bearingcore.common import percent
from bearingcore.units import INCH

BALL_SIZES: tuple[float, ...] = tuple(
    sorted(
        [k / 64 * INCH for k in (*range(3, 11), *range(12, 34, 2), 15, 17, 29, 31)]
        + [k / 32 * INCH for k in range(17, 33)]
        + [k / 16 * INCH for k in range(17, 40)]
        + [k * 1e-3 for k in (3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 10.0, 11.5)]
    )
)
"""Ball diameters [m] used in bearings, out of the sizes of ISO 3290."""

BALL_SHARE = (0.14, 0.36)
"""Least and greatest ball diameter of the search, over outside diameter less bore."""

MOST_BALLS = 45

TIGHTEST = 1.02
"""Least chord between neighbouring balls over the ball diameter: the cage needs room."""

ROLLER_FILL = (0.72, 0.90, 0.815, 0.03)
"""Number of rollers in a row over that of a full circle: least, most, usual, and the spread."""

TAPERED_FILL = 0.90
"""Usual fill of tapered rollers, assumed for a cage of pressed steel."""

ROLLER_SHARE = (0.25, 0.75)
"""Least and greatest diameter of tapered rollers in the search, over the height of the section."""


class Spread(NamedTuple):
    """Standard deviation of catalogue numbers from those computed for the right balls.

    It is relative for C_0r and C_r, and absolute for f_0.
    """

    static: float
    dynamic: float
    factor: float = 0.15


GROOVE_SPREAD, SPHERE_SPREAD = Spread(0.005, 0.008), Spread(0.015, 0.010)


class Inside(NamedTuple):
    """Rolling elements of a row.

    Attributes
    ----------
    n_balls
        balls or rollers of a row.
    ball_diameter, pitch_diameter
        [m].
    roller_length
        [m] that touches; None for balls.
    """

    n_balls: int
    ball_diameter: float
    pitch_diameter: float
    roller_length: float | None = None


PUBLISHED_BEARINGS, RIGHT_NUMBER = 57, 52
"""Number of bearings whose inside is published; how many of them get the right number of balls."""

FREQUENCY_SPREAD, RATIO_SPREAD = 0.0176, 0.0590
"""Relative errors that 19 of 20 of these stay below: of BPFO where the number is right, and of ball
over pitch diameter."""

TAPERED_BEARINGS, SAME_ROLLERS, TAPERED_SPREAD = 78, 57, 0.0347
"""Number of tapered bearings with ratings of two makers; how many get the same number of rollers
from both (the others differ by one); and the relative difference of roller over pitch diameter that
19 of 20 stay below."""

SPINDLE_BEARINGS, SAME_BALLS, ONE_OFF = 59, 16, 28
"""Number of spindle bearings at 15° (SNFA); how many have the number of balls that is estimated for
a 70, 72 or 719 of the same size; and how many have one more or less."""


def accuracy(kind: Kind, contact_angle: float) -> str:
    """Return sentences on the accuracy of the estimated inside of a kind at an angle [rad]."""
    if kind.estimate_spread is not None:
        return (
            "The error is not known, as no insides of such bearings are published. The ratings of "
            "another maker give a ratio of roller and pitch diameter within "
            f"{percent(TAPERED_SPREAD, 2)} for 19 of 20, and one roller more or less for "
            f"{TAPERED_BEARINGS - SAME_ROLLERS} of {TAPERED_BEARINGS}: count them."
        )
    words = (
        f"The estimate gives the right number of balls for {RIGHT_NUMBER} of {PUBLISHED_BEARINGS} "
        "bearings whose inside is published, and a BPFO within "
        f"{percent(FREQUENCY_SPREAD, 2)} for 19 of 20 of those. Makers differ: the number may be "
        "one more or less."
    )
    if not contact_angle or not kind.has_drawing:
        return words
    return (
        f"{words} Spindle bearings differ most: of SNFA's {SPINDLE_BEARINGS}, {SAME_BALLS} have "
        f"the number estimated here and {ONE_OFF} one more or less. Count the balls."
    )


@lru_cache(maxsize=512)
def balls_from_ratings(
    bore: float,
    outside_diameter: float,
    dynamic_rating: float,
    static_rating: float,
    contact_angle: float = 0.0,
    factor: float | None = None,
    self_aligning: bool = False,
) -> Inside:
    """Return the balls whose ratings are nearest to those of a catalogue.

    Parameters
    ----------
    bore, outside_diameter
        [m].
    dynamic_rating, static_rating
        C_r and C_0r [N].
    contact_angle
        α [rad] of both ratings.
    factor
        f_0 where the catalogue prints it; it depends on γ alone.
    self_aligning
        True for two rows on a spherical outer race, False for one row in grooves.
    """
    pitch, height = 0.5 * (bore + outside_diameter), outside_diameter - bore
    sizes = np.array([D for D in BALL_SIZES if BALL_SHARE[0] <= D / height <= BALL_SHARE[1]])
    D, Z = np.meshgrid(sizes, np.arange(5, MOST_BALLS + 1), indexing="ij")
    cosine = math.cos(contact_angle)
    gamma = D * cosine / pitch
    rows, spread = (2, SPHERE_SPREAD) if self_aligning else (1, GROOVE_SPREAD)
    f_0 = ratings.static_factor(gamma, self_aligning)
    f_c = (
        ratings.self_aligning_capacity_factor(gamma)
        if self_aligning
        else ratings.capacity_factor(gamma, USUAL_GROOVES["inner"], USUAL_GROOVES["inner"])
    )
    C_0 = ratings.static_rating(f_0, Z, D, cosine, rows)
    C = ratings.dynamic_rating(f_c, Z, D, cosine, rows)
    # distance from the catalogue's numbers, in standard deviations
    misfit = np.log(C_0 / static_rating) / spread.static
    misfit = np.hypot(misfit, np.log(C / dynamic_rating) / spread.dynamic)
    if factor is not None:
        misfit = np.hypot(misfit, (f_0 - factor) / spread.factor)
    misfit = np.where(pitch * np.sin(math.pi / Z) < TIGHTEST * D, np.inf, misfit)
    best = np.unravel_index(int(np.argmin(misfit)), misfit.shape)
    return Inside(int(Z[best]), float(D[best]), pitch)


@lru_cache(maxsize=512)
def rollers_from_raceways(
    inner_raceway: float, outer_raceway: float, static_ratings: tuple[float, ...]
) -> Inside:
    """Return the cylindrical rollers between raceways of two diameters [m].

    C_0r = 44 (1 − γ) Z L D (ISO 76, N and mm). `static_ratings` are C_0r [N] of the bearing and of
    wider or narrower ones with the same raceways, which have as many rollers of other lengths.
    """
    D, pitch = 0.5 * (outer_raceway - inner_raceway), 0.5 * (outer_raceway + inner_raceway)
    full = math.pi * pitch / D
    least, most, usual, spread = ROLLER_FILL
    Z = np.arange(math.ceil(least * full), math.floor(most * full) + 1)
    per_length = 1e-3 * ratings.roller_static_rating_per_length(Z, D, pitch)  # [N/mm]
    lengths = np.array(static_ratings)[:, None] / per_length  # [mm]
    fractions = np.abs(lengths - np.round(lengths)) / (0.05 + 0.003 * lengths)
    fractions = np.minimum(fractions, 2.0)  # so that a single odd length does not decide
    misfit = np.sqrt(np.mean(fractions**2, axis=0) + ((Z / full - usual) / spread) ** 2)
    k = int(np.argmin(misfit))
    return Inside(int(Z[k]), D, pitch, 1e-3 * float(lengths[0, k]))


@lru_cache(maxsize=512)
def tapered_rollers_from_ratings(
    bore: float,
    outside_diameter: float,
    dynamic_rating: float,
    static_rating: float,
    contact_angle: float,
) -> Inside:
    """Return the tapered rollers with both ratings of a catalogue, in the middle of the section.

    Parameters
    ----------
    bore, outside_diameter
        [m].
    dynamic_rating, static_rating
        C_r and C_0r [N].
    contact_angle
        α [rad] of the outer race.
    """
    pitch, cosine = 0.5 * (bore + outside_diameter), math.cos(contact_angle)
    known = (0.5 * (outside_diameter - bore), pitch, cosine, dynamic_rating, static_rating)
    insides = [_tapered_rollers(count, *known) for count in range(8, MOST_BALLS + 1)]
    fill = math.pi * TAPERED_FILL
    return min(
        insides, key=lambda inside: abs(inside.n_balls * inside.ball_diameter / pitch - fill)
    )


def _tapered_rollers(
    count: int, height: float, pitch: float, cosine: float, dynamic: float, static: float
) -> Inside:
    """Return `count` rollers with both ratings [N], in a cross-section of a height [m].

    At a fixed static rating the dynamic one grows with their diameter, which is bisected.
    """
    low, high = (share * height for share in ROLLER_SHARE)
    for _ in range(50):
        D = 0.5 * (low + high)
        length = static / float(ratings.roller_static_rating_per_length(count, D, pitch, cosine))
        C = ratings.roller_dynamic_rating(count, D, length, pitch, cosine)
        low, high = (D, high) if dynamic > C else (low, D)
    return Inside(count, D, pitch, length)
