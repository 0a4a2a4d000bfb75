"""Inside dimensions of a bearing from its catalogue: the balls that give its load ratings.

Makers print outside dimensions and load ratings, and no balls. But ratings are computed from the
balls, C_r as Z^(2/3) D^1.8 (ISO 281) and C_0r as Z D² (ISO 76), and balls come in standard sizes:
few numbers of a few sizes give both ratings to the digits that are printed. The rule here takes the
number and the size that meet them best, on a pitch circle in the middle of the cross-section.

Rollers are known better. The diameters of both raceways are standard (DIN 5412-1), and with them
diameter and pitch circle; C_0r then gives the number times the length that touches, which is a
whole number of millimetres: that decides the number.

Tapered rollers have no standard raceways, and their lengths are no whole numbers. C_r and C_0r
together give the diameter all the same: C_r^(9/7)/C_0r goes with D^(8/21), and hardly with their
number. What that leaves open, the number against the length, is taken so that rollers fill nine
tenths of their circle.

The rule has no constant that was fitted to a bearing whose inside is published. Its errors with
those, which say how far to trust it, are `FREQUENCY_SPREAD` and `RATIO_SPREAD`; a test measures
them anew. Too few tapered rollers are published: `TAPERED_SPREAD` compares ratings of two makers.
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
"""Balls [m] that bearings are made with, of the sizes of ISO 3290."""

BALL_SHARE = (0.14, 0.36)
"""Ball diameter over outside diameter less bore, within which balls are looked for."""

MOST_BALLS = 45

TIGHTEST = 1.02
"""Ball spacing on the pitch circle, along the chord, over the ball: the cage needs room."""

ROLLER_FILL = (0.72, 0.90, 0.815, 0.03)
"""Rollers of a row over those that would touch each other: least, most, usual and its spread."""

TAPERED_FILL = 0.90
"""Usual fill of tapered rollers, assumed for a cage of pressed steel."""

ROLLER_SHARE = (0.25, 0.75)
"""Roller diameter over the height of the cross-section, within which tapered ones are looked for.
"""


class Spread(NamedTuple):
    """Distance of catalogue numbers from those of the right balls, one standard deviation.

    Relative of C_0r and of C_r, absolute of f_0.
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
"""Bearings whose inside is published, and of how many of them the number of balls is right."""

FREQUENCY_SPREAD, RATIO_SPREAD = 0.0176, 0.0590
"""Relative errors that 19 of 20 of these stay below: of BPFO where the number is right, and of ball
over pitch diameter."""

TAPERED_BEARINGS, SAME_ROLLERS, TAPERED_SPREAD = 78, 57, 0.0347
"""Tapered bearings with ratings of two makers; how many get the same number of rollers from both,
the others get one more or less; and the relative difference of roller over pitch diameter that 19
of 20 stay below."""

SPINDLE_BEARINGS, SAME_BALLS, ONE_OFF = 59, 16, 28
"""Bearings at 15° of a maker of spindle bearings (SNFA), of how many the number of balls is the
estimated one of 70, 72 or 719 of the same sizes, and of how many one more or less."""


def accuracy(kind: Kind, contact_angle: float) -> str:
    """Accuracy of the estimated inside of a bearing of a kind, its angle in rad, in sentences."""
    if kind.estimate_spread is not None:
        return (
            "No table of the insides of such bearings was found to measure that by. From the "
            "ratings of another maker follows a ratio of roller and pitch diameter within "
            f"{percent(TAPERED_SPREAD, 2)} for 19 of 20, and one roller more or less for "
            f"{TAPERED_BEARINGS - SAME_ROLLERS} of {TAPERED_BEARINGS}: count them."
        )
    words = (
        f"So estimated, {RIGHT_NUMBER} of {PUBLISHED_BEARINGS} bearings whose inside is published "
        f"have the right number of balls, and 19 of 20 of those a BPFO within "
        f"{percent(FREQUENCY_SPREAD, 2)}. Makers differ: the number may be one more or "
        "less."
    )
    if not contact_angle or not kind.has_drawing:
        return words
    return (
        f"{words} Spindle bearings differ most: of {SPINDLE_BEARINGS} of SNFA {SAME_BALLS} have "
        f"the number estimated here, {ONE_OFF} one more or less. Count the balls."
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
    """The balls whose ratings are nearest to a catalogue's.

    Parameters
    ----------
    bore, outside_diameter
        [m].
    dynamic_rating, static_rating
        C_r and C_0r [N].
    contact_angle
        α [rad] for which they hold.
    factor
        f_0 where the catalogue prints it, which depends on γ alone.
    self_aligning
        two rows on a spherical outer race, instead of one in grooves.
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
    off = np.log(C_0 / static_rating) / spread.static
    off = np.hypot(off, np.log(C / dynamic_rating) / spread.dynamic)
    if factor is not None:
        off = np.hypot(off, (f_0 - factor) / spread.factor)
    off = np.where(pitch * np.sin(math.pi / Z) < TIGHTEST * D, np.inf, off)
    best = np.unravel_index(int(np.argmin(off)), off.shape)
    return Inside(int(Z[best]), float(D[best]), pitch)


@lru_cache(maxsize=512)
def rollers_from_raceways(
    inner_raceway: float, outer_raceway: float, static_ratings: tuple[float, ...]
) -> Inside:
    """Cylindrical rollers between raceways of two diameters [m].

    C_0r = 44 (1 − γ) Z L D (ISO 76, N and mm). `static_ratings` are C_0r [N] of the bearing and of
    wider or narrower ones with the same raceways, which have as many rollers of other lengths.
    """
    D, pitch = 0.5 * (outer_raceway - inner_raceway), 0.5 * (outer_raceway + inner_raceway)
    whole = math.pi * pitch / D
    least, most, usual, spread = ROLLER_FILL
    Z = np.arange(math.ceil(least * whole), math.floor(most * whole) + 1)
    per_length = 1e-3 * ratings.roller_static_rating_per_length(Z, D, pitch)  # [N/mm]
    lengths = np.array(static_ratings)[:, None] / per_length
    parts = np.abs(lengths - np.round(lengths)) / (0.05 + 0.003 * lengths)
    parts = np.minimum(parts, 2.0)  # a length that is no whole number says no more than that
    off = np.sqrt(np.mean(parts**2, axis=0) + ((Z / whole - usual) / spread) ** 2)
    k = int(np.argmin(off))
    return Inside(int(Z[k]), D, pitch, 1e-3 * float(lengths[0, k]))


@lru_cache(maxsize=512)
def tapered_rollers_from_ratings(
    bore: float,
    outside_diameter: float,
    dynamic_rating: float,
    static_rating: float,
    contact_angle: float,
) -> Inside:
    """Tapered rollers that have both ratings of a catalogue, on the middle of both diameters.

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
    each = [_tapered(count, *known) for count in range(8, MOST_BALLS + 1)]
    full = math.pi * TAPERED_FILL
    return min(each, key=lambda inside: abs(inside.n_balls * inside.ball_diameter / pitch - full))


def _tapered(
    count: int, height: float, pitch: float, cosine: float, dynamic: float, static: float
) -> Inside:
    """The rollers of a number that have both ratings [N], in a cross-section of a height [m].

    Of those that have the static rating the dynamic one grows with their diameter.
    """
    low, high = (share * height for share in ROLLER_SHARE)
    for _ in range(50):
        D = 0.5 * (low + high)
        length = static / float(ratings.roller_static_rating_per_length(count, D, pitch, cosine))
        C = ratings.roller_dynamic_rating(count, D, length, pitch, cosine)
        low, high = (D, high) if dynamic > C else (low, D)
    return Inside(count, D, pitch, length)
