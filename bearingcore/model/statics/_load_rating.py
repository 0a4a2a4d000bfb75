"""Basic dynamic load rating C_r of a bearing: from its dimensions by ISO 281, or a catalogue's.

C_r is the rating of all i rows together. Of rows alike each counts as C_r/i^0.7 alone (i^(7/9) of
rollers), so that rows that carry equal parts of the load last as C_r says. ISO 16281 goes no
further; here rows that are unlike share C_r in proportion to what ISO 281 rates each of them, so
that rows which carry parts of the load in that proportion last as C_r says: alone, row k counts as
C_r i^0.3 C_k/Σ C, and all rows together have C_r = i^(−0.3) Σ C_k.
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
    "a number [N], as the catalogue has it: this bearing has none, as its number is not known or "
    "its dimensions were changed. dynamic_load_rating(bearing) is that of ISO 281"
)

ROW_POWER = 0.7
"""Power of i, the number of rows of balls, in C_r: rows share a load less than evenly."""

ROWS_OF_RADIAL_CONTACT = 0.90 / 0.95
"""Rating of rows of deep groove balls, which share a load less evenly, over that of other rows."""

MAKERS_RATING = (
    "a number [N], the rating that the maker's catalogue has for this very bearing. It cannot be {}"
)


def rating_and_source(bearing: Bearing, dynamic_load_rating: float | None) -> tuple[float, str]:
    """Return C_r [N], the given one or else the bearing's own, and GIVEN or OF_A_CATALOGUE.

    ValueError where there is neither, or where it is not positive.
    """
    source = GIVEN
    if dynamic_load_rating is None:
        dynamic_load_rating, source = bearing.dynamic_load_rating, OF_A_CATALOGUE
        if dynamic_load_rating is None:
            why = _rating_unknown(bearing)
            wanted = MAKERS_RATING.format(why) if why else NO_RATING
            raise checks.refuse("dynamic_load_rating", None, wanted, "N")
    C = checks.real_number("dynamic_load_rating", dynamic_load_rating, above=0.0, unit="N")
    return C, source


def dynamic_load_rating(bearing: BearingLike) -> float:
    """Basic dynamic load rating C_r [N] of a bearing from its dimensions, by ISO 281.

    Of balls C_r = b_m f_c (i cos α)^0.7 Z^(2/3) D^1.8 (D^1.4 for balls above 25.4 mm), in N and mm,
    for i rows of Z balls, b_m = 1.3. Of several rows of deep groove balls (α = 0) it is 0.90/0.95
    of that (λ of ISO/TR 1281-1). Of rollers of length l C_r = b_m f_c (i l cos α)^(7/9) Z^(3/4)
    D^(29/27), b_m = 1.1; l is the length that touches, without the roller's chamfers. f_c are the
    standard's tables as formulas, 0.2 % from each of their numbers: that of balls holds for grooves
    of 0.52 (inner) and 0.53 (outer) ball diameters and is not raised for closer ones; wider ones
    lower it, and a bearing whose grooves are not known counts as one with those. Catalogues give
    more where a maker vouches for better steel. Of rows that are unlike it is i^(−0.3) Σ C_k: see
    the head of the module.

    ValueError for self-aligning bearings, whose factors the standard tabulates apart, and for
    hybrid ones, which ISO 20056 rates: their rating comes from the catalogue.
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
        each = ratings_alone(bearing)
        return float(uneven * sum(each) * rows ** (ROW_POWER - 1.0))
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
    """Reason why ISO 281 gives no rating from the dimensions; empty where it gives one."""
    hybrid = "computed for balls of another material than the rings (ISO 20056 rates them)"
    return bearing.kind.rating_unknown or (hybrid if bearing.is_hybrid else "")


def ratings_alone(bearing: Bearing) -> list[float]:
    """C_r [N] of each of unlike rows as if it were a bearing; see `dynamic_load_rating`."""
    return [dynamic_load_rating(bearing.of_row(k)) for k in range(len(bearing.rows))]
