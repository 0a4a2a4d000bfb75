"""Basic dynamic load rating C_r of a bearing: from its dimensions by ISO 281, or from a catalogue.

C_r is the rating of all i rows together. Alone, each of i identical rows has the rating C_r/i^0.7
(i^(7/9) for rollers); if they carry equal parts of the load, the bearing has the life by C_r.
ISO 16281 does not treat unlike rows. Here they share C_r in proportion to C_k, the ISO 281 rating
of each row: alone, row k has the rating C_r i^0.3 C_k/Σ C, and all rows together have
C_r = i^(−0.3) Σ C_k. If they carry parts of the load in that proportion, the life is that by C_r.
"""

from __future__ import annotations

import math

from bearingcore.bearings import USUAL_GROOVES, Bearing, BearingLike, bearing_of
from bearingcore.bearings._ratings import capacity_factor, dynamic_rating, roller_dynamic_rating
from bearingcore.common import _checks as checks
from bearingcore.fields import WIDEST_CONFORMITY

GIVEN, OF_A_CATALOGUE = "given", "of a catalogue, by the bearing's number"
"""Origins of a rating."""

NO_RATING = (
    "a number [N] from the catalogue: this bearing has none, as its number is not known or its "
    "dimensions were changed. dynamic_load_rating(bearing) computes it by ISO 281"
)

ROW_POWER = 0.7
"""Power of the number of rows of balls, i, in C_r; below 1, as rows share a load unevenly."""

ROWS_OF_RADIAL_CONTACT = 0.90 / 0.95
"""Rating of rows of deep groove balls, which share a load less evenly, over that of other rows."""

MAKERS_RATING = (
    "a number [N], the rating that the maker's catalogue has for this very bearing. It cannot be {}"
)


def rating_and_source(bearing: Bearing, dynamic_load_rating: float | None) -> tuple[float, str]:
    """Return C_r [N], that of the argument or else of the bearing, and GIVEN or OF_A_CATALOGUE.

    Raises ValueError if both are missing, or if the rating is not positive.
    """
    source = GIVEN
    if dynamic_load_rating is None:
        dynamic_load_rating, source = bearing.dynamic_load_rating, OF_A_CATALOGUE
        if dynamic_load_rating is None:
            cause = _rating_unknown(bearing)
            allowed = MAKERS_RATING.format(cause) if cause else NO_RATING
            raise checks.refuse("dynamic_load_rating", None, allowed, "N")
    C = checks.real_number("dynamic_load_rating", dynamic_load_rating, above=0.0, unit="N")
    return C, source


def dynamic_load_rating(bearing: BearingLike) -> float:
    """Compute the basic dynamic load rating C_r [N] of a bearing from its dimensions, by ISO 281.

    For i rows of Z balls, C_r = b_m f_c (i cos α)^0.7 Z^(2/3) D^1.8 (D^1.4 for balls above
    25.4 mm), in N and mm, with b_m = 1.3. Several rows of deep groove balls (α = 0) have 0.90/0.95
    of that (λ of ISO/TR 1281-1). For rollers, C_r = b_m f_c (i l cos α)^(7/9) Z^(3/4) D^(29/27)
    with b_m = 1.1; l is the length of contact, without the roller's chamfers.

    f_c is a formula that meets the standard's tables within 0.2 %. For balls it holds for grooves
    of 0.52 (inner) and 0.53 (outer) ball diameters. Wider grooves lower it, closer grooves do not
    raise it, and unknown grooves count as these. Ratings in catalogues are higher if the maker
    guarantees better steel. Unlike rows have i^(−0.3) Σ C_k: see the head of the module.

    Raises ValueError for self-aligning bearings, which have other tables in the standard, and for
    hybrid bearings, which ISO 20056 rates: their rating comes from the catalogue.
    """
    bearing = bearing_of(bearing)
    if words := _rating_unknown(bearing):
        raise checks.refuse("dynamic_load_rating", None, MAKERS_RATING.format(words), "N")
    if bearing.roller_length is not None:
        return float(
            roller_dynamic_rating(
                bearing.n_balls,
                bearing.ball_diameter,
                bearing.roller_length,
                bearing.pitch_diameter,
                math.cos(bearing.contact_angle),
                len(bearing.all_rows),
            )
        )
    rows = len(bearing.all_rows)
    radial = all(bearing.of_row(k).contact_angle == 0.0 for k in range(rows))
    uneven = ROWS_OF_RADIAL_CONTACT if rows > 1 and radial else 1.0
    if not bearing.rows_are_alike:
        ratings = ratings_alone(bearing)
        return float(uneven * sum(ratings) * rows ** (ROW_POWER - 1.0))
    # f_c of the usual grooves, reduced by the ratio of its values for wider and for usual grooves
    cosine = math.cos(bearing.contact_angle)
    gamma = bearing.ball_diameter * cosine / bearing.pitch_diameter
    full = capacity_factor(gamma, USUAL_GROOVES["inner"], USUAL_GROOVES["inner"])
    widths = {}
    for race, usual in USUAL_GROOVES.items():
        radius = getattr(bearing, f"{race}_groove_radius")
        conformity = usual if radius is None else radius / bearing.ball_diameter
        widths[race] = min(max(conformity, usual), WIDEST_CONFORMITY)
    wider = capacity_factor(gamma, widths["inner"], widths["outer"]) / capacity_factor(
        gamma, USUAL_GROOVES["inner"], USUAL_GROOVES["outer"]
    )
    C = dynamic_rating(
        full * min(float(wider), 1.0), bearing.n_balls, bearing.ball_diameter, cosine, rows
    )
    return float(uneven * C)


def _rating_unknown(bearing: Bearing) -> str:
    """Return the reason why ISO 281 has no rating for the dimensions; empty if it has one."""
    hybrid = "computed for balls of another material than the rings (ISO 20056 rates them)"
    return bearing.kind.rating_unknown or (hybrid if bearing.is_hybrid else "")


def ratings_alone(bearing: Bearing) -> list[float]:
    """Return C_k [N] of each row, rated as a bearing of its own; see `dynamic_load_rating`."""
    return [dynamic_load_rating(bearing.of_row(k)) for k in range(len(bearing.rows))]
