"""Fatigue life of a bearing from the loads of its balls, by ISO 16281.

Quantity                                      | Symbol | Name                 | Unit
--------------------------------------------- | ------ | -------------------- | ---------------
dynamic load rating                           | C_r    | dynamic_load_rating  | N
load of a ball under which a race lasts 10⁶ turns | Q_ci, Q_ce | rating of a race | N
load that tires a race as all it carries does | Q_ei, Q_ee | load of a race   | N
life that 9 of 10 bearings reach              | L_10r  | million_revolutions  | 10⁶ turns
the same at the scene's speed                 | L_10h  | hours                | h
load of the same life by ISO 281, P_ref       | P      | equivalent_load      | N
exponent of load against life                 | p      | load_exponent        |
exponent of the scatter of lives              | e      | scatter              |
D_b cos α0 / D_p                              | γ      |                      |

    L_10r = ((Q_ci/Q_ei)^(−p e) + (Q_ce/Q_ee)^(−p e))^(−1/e),

p = 3, e = 10/9 for balls, p = 4, e = 9/8 for rollers. Rollers are cut into laminae, whose loads and
stresses differ along the roller (`_laminae`); Q_ei, Q_ee are the loads, spread
evenly, that tire the races as much. Their ratings are larger by 1/(λν) = 1/0.83 than C_r says, as
C_r allows for uneven loads by that factor, and ISO 281 by a smaller exponent too:

    P = C_r/L_10r^(1/3) of balls, P = C_r/L_10r^(3/10) of rollers.

An NU 208 without clearance under a radial load of C_r/4 lives three times as long by ISO 16281 as
by ISO 281, under C_r/20 three and a half times, under C_r/2 twice as long.

Of several rows the sum is over all their races, each row with its own ratings Q_ci, Q_ce, as all of
them have to live.

C_r is the rating of all i rows together. Of rows alike each counts as C_r/i^0.7 alone (i^(7/9) of
rollers), so that rows that carry equal parts of the load last as C_r says. The standard goes no
further; here rows that are unlike share C_r in proportion to what ISO 281 rates each of them, so
that rows which carry parts of the load in that proportion last as C_r says: alone, row k counts as
C_r i^0.3 C_k/Σ C, and all rows together have C_r = i^(−0.3) Σ C_k.

Which loads are averaged, and how: `_race_loads`. Those of balls with mass hold
their centrifugal load.

What the standard leaves out, and a damaged race has: it rates fatigue that begins below smooth
races. Pressure on the edges of a defect is several times that of the smooth race, each passing ball
strikes the far edge, and debris dents the rest. All of that shortens the life, so the life here
for a damaged bearing is the effect of the changed load distribution alone: an upper bound, no
forecast and no promise. Lubrication, cleanliness and the fatigue limit (a_ISO) are left out too.

Source: ISO 16281 (before: ISO/TS 16281); Lundberg and Palmgren for the exponents; ISO 281 for the
rating of a bearing from its dimensions.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.bearings import USUAL_GROOVES, Bearing, BearingLike, bearing_of
from bearingcore.bearings._drawing import WIDEST_CONFORMITY
from bearingcore.bearings._ratings import (
    capacity_factor,
    dynamic_rating,
    groove_ratio,
    roller_dynamic_rating,
)
from bearingcore.common import ResultTable, number, percent, shown_as_table, table_of, thousands
from bearingcore.common import _checks as checks
from bearingcore.model.scene import Scene
from bearingcore.model.statics._race_loads import RaceLoads, race_loads, snapshot_loads, together

POSITIONS = ("load line", "all")
"""Over which places of the balls loads are averaged: one of them on the line of the radial load, as
the standard's examples do, or everywhere, as it is."""

TURNING = ("inner", "outer")

GIVEN, OF_A_CATALOGUE = "given", "of a catalogue, by the bearing's number"
"""Origins of a rating."""

NO_RATING = (
    "a number [N], as the catalogue has it: this bearing has none, as its number is not known or "
    "its dimensions were changed. dynamic_load_rating(bearing) is that of ISO 281"
)

ROWS_OF_RADIAL_CONTACT = 0.90 / 0.95
"""Rating of rows of deep groove balls, which share a load less evenly, over that of other rows."""

MAKERS_RATING = (
    "a number [N], the rating that the maker's catalogue has for this very bearing. It is not {}"
)

HEAVIEST_SHARE = 0.5
"""Of the rating, up to which ISO 281 vouches for its life (P ≤ 0.5 C_r)."""


class ContactLife(NamedTuple):
    """Constants of ISO 16281 for a kind of contact.

    Load against life p and scatter of lives e, load against life in ISO 281, and what of the rating
    is left to bear an uneven load (λν); then, for the rating of each race, what part of
    C_r/(Z cos α) each takes, what rows count together, and how races share: a factor, and powers of
    (1 − γ)/(1 + γ) and of what the grooves are to each other.
    """

    load_exponent: float
    scatter: float
    rating_exponent: float
    evenness: float
    inner_part: float
    outer_part: float
    row_power: float
    race_factor: float
    gamma_power: float
    groove_power: float


POINT_CONTACT = ContactLife(3.0, 10.0 / 9.0, 3.0, 1.0, 0.407, 0.389, 0.7, 1.044, 1.72, 0.41)

LINE_CONTACT = ContactLife(
    4.0, 9.0 / 8.0, 10.0 / 3.0, 0.83, 0.378, 0.364, 7.0 / 9.0, 1.038, 143.0 / 108.0, 0.0
)


@shown_as_table
@dataclass(frozen=True)
class Life:
    """Reference rating life of a scene's bearing (ISO 16281). NaN where it is not known.

    Attributes
    ----------
    scene, dynamic_load_rating [N], positions, turning_race
        arguments of `life`.
    inner_rating, outer_rating [N]
        Q_ci, Q_ce: the ball load under which each race of the first row lasts 10⁶ turns; of a
        roller one that is spread evenly along it.
    inner_load, outer_load [N]
        Q_ei, Q_ee: the load of a ball that tires each race as all loads of all rows do, theirs as
        much larger as their ratings are smaller than those of the first row.
    rows
        L_10r [10⁶ turns] of each row on its own, under what it carries in the bearing.
    heaviest_load [N]
        greatest load of a ball.
    million_revolutions
        L_10r [10⁶ turns]; infinite where no ball carries anything.
    hours
        L_10h [h]; NaN where the shaft stands still, as a standing bearing has no hours.
    equivalent_load [N]
        P, under which ISO 281 gives the same life: C_r/L_10r^(1/3) of balls, C_r/L_10r^(3/10) of
        rollers (P_ref of ISO 16281).
    healthy_million_revolutions
        L_10r [10⁶ turns] of the same bearing without its defects, averaged in the same way.
    status
        code of `kernels` of the first cage angle whose loads are not known, else CONVERGED.
    sentence
        the result in words, with what it leaves out.
    rating_source
        GIVEN or OF_A_CATALOGUE.
    """

    scene: Scene
    dynamic_load_rating: float
    positions: str
    turning_race: str
    inner_rating: float
    outer_rating: float
    inner_load: float
    outer_load: float
    heaviest_load: float
    million_revolutions: float
    hours: float
    equivalent_load: float
    healthy_million_revolutions: float
    status: int
    sentence: str
    rows: tuple[float, ...] = ()
    rating_source: str = GIVEN

    @property
    def known(self) -> bool:
        """True where there is a life."""
        return not math.isnan(self.million_revolutions)

    @property
    def share_of_healthy(self) -> float:
        """Life over that of the healthy bearing: what the changed load distribution alone does."""
        if math.isinf(self.healthy_million_revolutions):
            return 1.0 if math.isinf(self.million_revolutions) else 0.0
        return self.million_revolutions / self.healthy_million_revolutions

    def table(self) -> ResultTable:
        """One row: life, loads, ratings, in words what they say."""
        element = self.scene.bearing.kind.element
        of_ball = f"load of a {element} under which the {{}} race lasts 10⁶ turns"
        as_tiring = f"equivalent load of a {element} on the {{}} race"
        return table_of(
            ("million_revolutions", "", self.million_revolutions, "L_10r, in 10⁶ turns"),
            ("life", "h", self.hours, "L_10h"),
            (
                "healthy_million_revolutions",
                "",
                self.healthy_million_revolutions,
                "L_10r without the defects, in 10⁶ turns",
            ),
            ("share_of_healthy", "1", self.share_of_healthy, "life over the healthy bearing's"),
            ("dynamic_load_rating", "N", self.dynamic_load_rating, f"C_r, {self.rating_source}"),
            ("equivalent_load", "N", self.equivalent_load, "P, for which ISO 281 gives L_10r"),
            ("heaviest_load", "N", self.heaviest_load, f"greatest load of a {element}"),
            ("inner_rating", "N", self.inner_rating, of_ball.format("inner")),
            ("outer_rating", "N", self.outer_rating, of_ball.format("outer")),
            ("inner_load", "N", self.inner_load, as_tiring.format("inner")),
            ("outer_load", "N", self.outer_load, as_tiring.format("outer")),
            *(
                (f"million_revolutions_of_row_{k + 1}", "", L, "L_10r of that row alone")
                for k, L in enumerate(self.rows if len(self.rows) > 1 else ())
            ),
            ("sentence", "", [self.sentence]),
        )


def life(
    scene: Scene,
    dynamic_load_rating: float | None = None,
    *,
    positions: str = "all",
    turning_race: str = "inner",
) -> Life:
    """Reference rating life L_10r of the scene's bearing, with the loads its defects leave it.

    Parameters
    ----------
    scene
        bearing, defects, load, speed. A ball bearing needs its groove radii.
    dynamic_load_rating
        C_r [N] of the whole bearing, with all its rows, from the catalogue;
        `dynamic_load_rating(bearing)` gives that of ISO 281. None: the bearing's own, which
        bearings have that are known by their designation.
    positions
        "all": loads averaged over all cage angles, and over all shaft angles where a defect turns
        with the shaft: a cage that turns comes to all of them, and a healthy bearing has the life
        that a damaged one is compared with. "load line": with a ball on the line of the radial load
        (cage angle 0 without one), as the standard's examples and commercial codes take them; for
        a healthy bearing of rows alike only. The two differ by up to some 3 % with seven balls.
    turning_race
        the race that turns against the load: "inner", as in a scene with a defect; "outer" for a
        healthy bearing whose load turns with the shaft (an imbalance), or whose hub turns.

    Returns
    -------
    Life
        NaN, with a sentence, where some cage angle has no static equilibrium. For a damaged race
        it is an upper bound: see the head of the module.

    Raises
    ------
    ValueError
        for a rating that is not positive, or neither given nor known of the bearing; a bearing
        without groove radii, for "load line" with
        rows that are not alike, for that or a turning outer race with a damaged bearing, and for a
        damaged inner race of rows that are not alike.

    Examples
    --------
    >>> from bearingcore import presets
    >>> found = life(presets["seven-ball"].healthy(), 23_400.0)
    >>> round(found.million_revolutions), round(found.hours)
    (10797, 119961)
    """
    checks.instance("scene", scene, Scene)
    rating_source = GIVEN if dynamic_load_rating is not None else OF_A_CATALOGUE
    if dynamic_load_rating is None:
        dynamic_load_rating = scene.bearing.dynamic_load_rating
        if dynamic_load_rating is None:
            why = _rating_unknown(scene.bearing)
            wanted = MAKERS_RATING.format(why) if why else NO_RATING
            raise checks.refuse("dynamic_load_rating", None, wanted, "N")
    C = checks.real_number("dynamic_load_rating", dynamic_load_rating, above=0.0, unit="N")
    damaged = bool(scene.defects)
    alike = scene.bearing.rows_are_alike
    checks.choice("positions", positions, POSITIONS)
    checks.choice("turning_race", turning_race, TURNING)
    if damaged and positions != "all":
        raise checks.refuse("positions", positions, '"all" for a damaged bearing')
    if not alike and positions != "all":
        raise checks.refuse("positions", positions, '"all" for rows that are not alike')
    if damaged and turning_race != "inner":
        raise checks.refuse(
            "turning_race", turning_race, '"inner" for a damaged bearing: its load stands still'
        )
    contact = LINE_CONTACT if scene.bearing.kind.line_contact else POINT_CONTACT
    rows = range(len(scene.bearing.all_rows))
    rated = np.array([race_ratings(scene.bearing, C, k) for k in rows])
    healthy_scene = dataclasses.replace(scene, defect=()) if damaged else scene
    healthy = _loads(healthy_scene, positions, turning_race)
    loads = _loads(scene, positions, turning_race) if damaged else healthy
    L_healthy = million_revolutions(contact, rated, healthy.of_rows)
    carried = loads.of_rows
    L = million_revolutions(contact, rated, carried)
    Q_ci, Q_ce = rated[0].tolist()
    # what all rows together do to a race, as a load on that of the first row
    chain = contact.load_exponent * contact.scatter
    parts = (carried / rated).T.tolist()
    Q_ei, Q_ee = Q_ci * together(parts[0], chain), Q_ce * together(parts[1], chain)
    turns_an_hour = scene.shaft_speed / (2.0 * math.pi) * 3600.0
    hours = 1e6 * L / turns_an_hour if turns_an_hour else math.nan
    P = 0.0 if math.isinf(L) else C * L ** (-1.0 / contact.rating_exponent)
    return Life(
        scene=scene,
        dynamic_load_rating=C,
        positions=positions,
        turning_race=turning_race,
        inner_rating=Q_ci,
        outer_rating=Q_ce,
        inner_load=Q_ei,
        outer_load=Q_ee,
        heaviest_load=loads.heaviest,
        million_revolutions=L,
        hours=hours,
        equivalent_load=P,
        healthy_million_revolutions=L_healthy,
        status=loads.status,
        sentence=_sentence(scene, loads.reason, L, hours, L_healthy, P / C)
        + (f" Rating {long_number(C)} N, {rating_source}." if rating_source != GIVEN else ""),
        rows=tuple(million_revolutions(contact, rated[k], carried[k]) for k in rows),
        rating_source=rating_source,
    )


def race_ratings(bearing: Bearing, dynamic_load_rating: float, row: int = 0) -> tuple[float, float]:
    """Q_ci, Q_ce [N]: the loads of a ball under which inner and outer race last 10⁶ turns.

    Of one row, from the rating of all rows (ISO 16281). ValueError where a ball bearing does not
    carry its groove radii.
    """
    row_bearing = bearing.of_row(row)
    cosine = math.cos(row_bearing.contact_angle)
    each = [1.0] if bearing.rows_are_alike else _ratings_alone(bearing)
    part = each[row % len(each)] * len(each) / sum(each)  # over the mean of all rows
    return ratings_of_races(
        LINE_CONTACT if bearing.kind.line_contact else POINT_CONTACT,
        dynamic_load_rating * part / (row_bearing.n_balls * cosine),
        row_bearing.ball_diameter * cosine / row_bearing.pitch_diameter,
        1.0 if bearing.kind.line_contact else groove_ratio(*_conformities(row_bearing)),
        len(bearing.all_rows),
    )


def _ratings_alone(bearing: Bearing) -> list[float]:
    """C_r [N] of each of unlike rows as if it were a bearing; see `dynamic_load_rating`."""
    return [dynamic_load_rating(bearing.of_row(k)) for k in range(len(bearing.rows))]


def _conformities(bearing: Bearing) -> tuple[float, float]:
    """Groove radii of the inner and outer race over the ball diameter."""
    inner, outer = bearing.groove_radius("inner"), bearing.groove_radius("outer")
    if inner is None or outer is None:
        name = f"{'inner' if inner is None else 'outer'}_groove_radius"
        raise checks.refuse(name, None, "a number, where life is computed")
    return inner / bearing.ball_diameter, outer / bearing.ball_diameter


def ratings_of_races(
    contact: ContactLife, share: float, gamma: float, groove_ratio: float = 1.0, rows: int = 1
) -> tuple[float, float]:
    """Q_ci, Q_ce [N] of a kind of contact (ISO 16281).

    Parameters
    ----------
    contact
        POINT_CONTACT or LINE_CONTACT.
    share
        C_r/(Z cos α) [N], Z the rolling elements of a row: a load on half of them presses each by
        some such part.
    gamma
        γ.
    groove_ratio
        (r_i/r_e) (2 r_e − D)/(2 r_i − D) of balls.
    rows
        that C_r is the rating of.
    """
    power = contact.load_exponent * contact.scatter
    B = (
        contact.race_factor
        * ((1.0 - gamma) / (1.0 + gamma)) ** contact.gamma_power
        * groove_ratio**contact.groove_power
    )
    of_a_row = share / rows**contact.row_power / contact.evenness
    Q_ci = of_a_row / contact.inner_part * (1.0 + B**power) ** (1.0 / power)
    Q_ce = of_a_row / contact.outer_part * (1.0 + B**-power) ** (1.0 / power)
    return Q_ci, Q_ce


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
        raise checks.refuse("dynamic_load_rating", words, "that of the catalogue")
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
        each = _ratings_alone(bearing)
        return float(uneven * sum(each) * rows ** (POINT_CONTACT.row_power - 1.0))
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
    hybrid = "to be computed for balls of another material than the rings (ISO 20056)"
    return bearing.kind.rating_unknown or (hybrid if bearing.is_hybrid else "")


@lru_cache(maxsize=256)
def _loads(scene: Scene, positions: str, turning_race: str) -> RaceLoads:
    contact = LINE_CONTACT if scene.bearing.kind.line_contact else POINT_CONTACT
    law = contact.load_exponent, contact.scatter
    if positions == "all":
        return race_loads(scene, *law, turning_race)
    load = scene.load
    line = math.atan2(load.fy, load.fx) if load.fx or load.fy else 0.0
    return snapshot_loads(scene, line % scene.bearing.ball_spacing, *law, turning_race)


def million_revolutions(contact: ContactLife, ratings: ArrayLike, loads: ArrayLike) -> float:
    """L_10r [10⁶ turns] from Q_ci, Q_ce and Q_ei, Q_ee [N] (ISO 16281); infinite under no load.

    Of several rows those of all of them. L_10r = ((Q_ci/Q_ei)^(−p e) + (Q_ce/Q_ee)^(−p e))^(−1/e).
    """
    p, e = contact.load_exponent, contact.scatter
    parts = np.ravel(np.asarray(loads) / np.asarray(ratings)).tolist()
    failing = sum(part ** (p * e) for part in parts)
    return math.inf if failing == 0.0 else float(failing ** (-1.0 / e))


LEFT_OUT = (
    "This counts the changed load distribution only. The standard rates smooth races: pressure on "
    "the edges of a defect, the impact of each ball and debris are left out, so that a damaged "
    "bearing fails sooner. Treat it as an upper limit."
)


A_CENTURY = 876_600.0
"""[h] of a life beyond which its number means nothing."""


def long_number(value: float) -> str:
    """To three digits, in groups of three where it is long: of lives no more is known."""
    return number(value, 3) if value < 1e4 else thousands(float(f"{value:.3g}"))


def turns_in_words(L: float) -> str:
    """A life [10⁶ turns], up to a million of millions; "unlimited" where it is infinite."""
    if math.isinf(L):
        return "unlimited"
    return (
        f"{long_number(L)} million turns" if L < 1e6 else "practically unlimited (over 10¹² turns)"
    )


def hours_in_words(hours: float) -> str:
    """Hours of a life [h], up to a century."""
    return f"{long_number(hours)} hours" if hours < A_CENTURY else "more than 100 years"


def _sentence(
    scene: Scene, reason: str, L: float, hours: float, L_healthy: float, share: float
) -> str:
    if reason:
        return f"Life is not known: not every cage angle has a static equilibrium ({reason})."
    if math.isinf(L):
        return f"No {scene.bearing.kind.element} carries load, so there is no fatigue."
    words = f"Nine of ten bearings reach {turns_in_words(L)}"
    if math.isnan(hours):
        words += "; the shaft is at rest, so there are no hours."
    else:
        rpm = scene.shaft_speed / (2.0 * math.pi) * 60.0
        words += f", {hours_in_words(hours)} at {number(rpm, 4)} rpm."
    if share > HEAVIEST_SHARE:
        words += (
            f" The equivalent load is {100.0 * share:.0f} % of the rating: above "
            f"{100.0 * HEAVIEST_SHARE:.0f} % the standard does not vouch for its formula."
        )
    words = f"{words} {scene.tilt_words()}".rstrip()
    if scene.defects:
        words += f" That is {percent(L / L_healthy)} of the healthy bearing's life. {LEFT_OUT}"
    return words
