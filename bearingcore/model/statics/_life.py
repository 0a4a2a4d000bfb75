"""Fatigue life of a bearing from the loads of its balls, by ISO 16281.

Quantity                                      | Symbol | Name                 | Unit
--------------------------------------------- | ------ | -------------------- | ---------------
dynamic load rating                           | C_r    | dynamic_load_rating  | N
load of a ball under which a race lasts 10⁶ turns | Q_ci, Q_ce | rating of a race | N
constant load of a ball with the same life of a race | Q_ei, Q_ee | load of a race | N
life that 9 of 10 bearings reach              | L_10r  | million_revolutions  | 10⁶ turns
this life at the scene's speed                | L_10h  | hours                | h
load of the same life by ISO 281, P_ref       | P      | equivalent_load      | N
exponent of load against life                 | p      | load_exponent        |
exponent of the scatter of lives              | e      | scatter              |
D_b cos α0 / D_p                              | γ      |                      |

    L_10r = ((Q_ci/Q_ei)^(−p e) + (Q_ce/Q_ee)^(−p e))^(−1/e),

with p = 3, e = 10/9 for balls and p = 4, e = 9/8 for rollers. Rollers are cut into laminae, because
load and stress differ along a roller (`_laminae`); Q_ei, Q_ee are then evenly spread loads with the
same life of the races. Ratings of rollers are divided by λν = 0.83, as C_r contains this factor for
uneven loads. ISO 281 also allows for uneven loads by a smaller exponent:

    P = C_r/L_10r^(1/3) for balls, P = C_r/L_10r^(3/10) for rollers.

An NU 208 without clearance under a radial load of C_r/4 lives three times as long by ISO 16281 as
by ISO 281, under C_r/20 three and a half times, under C_r/2 twice as long.

For several rows the sum is over all their races, each with its Q_ci, Q_ce, as the bearing fails
with the first of them. `_load_rating` divides C_r among the rows, and `_race_loads` averages the
loads, which include the centrifugal load of balls with mass.

The standard rates fatigue that begins below smooth races. On a damaged race the pressure at the
edges of the defect is several times higher, each passing ball strikes the far edge, and debris
dents the rest. All of this shortens the life. The life of a damaged bearing here is therefore the
effect of the changed load distribution alone: an upper bound, no forecast and no promise.
Lubrication, cleanliness and the fatigue limit (a_ISO) are left out too.

Source: ISO 16281 (before: ISO/TS 16281); Lundberg and Palmgren for the exponents.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.bearings import Bearing
from bearingcore.bearings._ratings import groove_ratio
from bearingcore.common import ResultTable, _checks as checks, shown_as_table, table_of
from bearingcore.model.scene import Scene
from bearingcore.model.statics._life_words import life_sentence, long_number
from bearingcore.model.statics._load_rating import (
    GIVEN,
    ROW_POWER,
    rating_and_source,
    ratings_alone,
)
from bearingcore.model.statics._race_loads import (
    RaceLoads,
    combined_load,
    race_loads,
    snapshot_loads,
)

POSITIONS = ("load line", "all")
"""Positions of the balls over which loads are averaged: a ball on the line of the radial load, as
in the examples of the standard, or all positions, as in the machine."""


class ContactLife(NamedTuple):
    """Constants of ISO 16281 for a kind of contact.

    First the exponents of load against life p and of the scatter of lives e, the exponent of load
    against life in ISO 281, and the factor λν for uneven loads. Then, for the rating of each race,
    the parts of C_r/(Z cos α) for both races, the power of the number of rows, and the ratio of the
    races: a factor, and the powers of (1 − γ)/(1 + γ) and of the ratio of the grooves.
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


POINT_CONTACT = ContactLife(3.0, 10.0 / 9.0, 3.0, 1.0, 0.407, 0.389, ROW_POWER, 1.044, 1.72, 0.41)

LINE_CONTACT = ContactLife(
    4.0, 9.0 / 8.0, 10.0 / 3.0, 0.83, 0.378, 0.364, 7.0 / 9.0, 1.038, 143.0 / 108.0, 0.0
)


@shown_as_table
@dataclass(frozen=True)
class Life:
    """Reference rating life of a scene's bearing (ISO 16281). Unknown numbers are NaN.

    Attributes
    ----------
    scene, dynamic_load_rating [N], positions
        arguments of `life`.
    inner_rating, outer_rating [N]
        Q_ci, Q_ce: the ball load under which each race of the first row lasts 10⁶ turns; for
        rollers a load that is spread evenly along them.
    inner_load, outer_load [N]
        Q_ei, Q_ee: equivalent load of each race, the constant load of a ball with the same life as
        all loads of all rows. Loads of other rows are scaled by the ratio of the ratings.
    rows
        L_10r [10⁶ turns] of each row alone, under the loads that it carries in the bearing.
    heaviest_load [N]
        greatest load of a ball.
    million_revolutions
        L_10r [10⁶ turns]; infinite if no ball carries a load.
    hours
        L_10h [h]; NaN if the shaft stands still.
    equivalent_load [N]
        P, the load with the same life by ISO 281: C_r/L_10r^(1/3) for balls, C_r/L_10r^(3/10) for
        rollers (P_ref of ISO 16281).
    healthy_million_revolutions
        L_10r [10⁶ turns] of the same bearing without its defects, averaged in the same way.
    status
        code of the first cage angle with unknown loads; CONVERGED without any.
    sentence
        the result in words, with its limitations.
    rating_source
        GIVEN or OF_A_CATALOGUE.
    """

    scene: Scene
    dynamic_load_rating: float
    positions: str
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
        """True if the life is known."""
        return not math.isnan(self.million_revolutions)

    @property
    def share_of_healthy(self) -> float:
        """Life over that of the healthy bearing: the effect of the changed loads alone."""
        if math.isinf(self.healthy_million_revolutions):
            return 1.0 if math.isinf(self.million_revolutions) else 0.0
        return self.million_revolutions / self.healthy_million_revolutions

    def table(self) -> ResultTable:
        """One row: life, loads, ratings, and the result in words."""
        element, healthy = self.scene.bearing.kind.element, self.healthy_million_revolutions
        of_ball = f"load of a {element} under which the {{}} race lasts 10⁶ turns"
        equivalent = f"equivalent load of a {element} on the {{}} race"
        return table_of(
            ("million_revolutions", "", self.million_revolutions, "L_10r, in 10⁶ turns"),
            ("life", "h", self.hours, "L_10h"),
            ("healthy_million_revolutions", "", healthy, "L_10r without the defects, in 10⁶ turns"),
            ("share_of_healthy", "1", self.share_of_healthy, "life over the healthy bearing's"),
            ("dynamic_load_rating", "N", self.dynamic_load_rating, f"C_r, {self.rating_source}"),
            ("equivalent_load", "N", self.equivalent_load, "P, for which ISO 281 gives L_10r"),
            ("heaviest_load", "N", self.heaviest_load, f"greatest load of a {element}"),
            ("inner_rating", "N", self.inner_rating, of_ball.format("inner")),
            ("outer_rating", "N", self.outer_rating, of_ball.format("outer")),
            ("inner_load", "N", self.inner_load, equivalent.format("inner")),
            ("outer_load", "N", self.outer_load, equivalent.format("outer")),
            *(
                (f"million_revolutions_of_row_{k + 1}", "", L, "L_10r of that row alone")
                for k, L in enumerate(self.rows if len(self.rows) > 1 else ())
            ),
            ("sentence", "", [self.sentence]),
        )


def life(scene: Scene, dynamic_load_rating: float | None = None, *, positions: str = "all") -> Life:
    """Compute the reference rating life L_10r of a bearing under the loads that its defects leave.

    Parameters
    ----------
    scene
        bearing, defects, load, speed. A ball bearing needs its groove radii.
    dynamic_load_rating
        C_r [N] of the whole bearing with all its rows, from the catalogue;
        `dynamic_load_rating(bearing)` computes it by ISO 281. None takes the rating in the bearing,
        which bearings by designation have.
    positions
        "all": loads averaged over all cage angles, and over all shaft angles if a defect turns with
        the shaft, because a turning cage reaches all of them. "load line": one cage angle, with a
        ball on the line of the radial load (angle 0 without one), as in the standard's examples
        and commercial codes; only for a healthy bearing with identical rows. The two differ by up
        to some 3 % with seven balls.

    Returns
    -------
    Life
        with NaN and a sentence if some cage angle has no static equilibrium. For a damaged race the
        life is an upper bound: see the head of the module.

    Raises
    ------
    ValueError
        for a rating that is missing or not positive; for a ball bearing without groove radii; for
        "load line" with unlike rows or a damaged bearing; and for a damaged inner race of unlike
        rows.

    Examples
    --------
    >>> from bearingcore import presets
    >>> lives = life(presets["seven-ball"].healthy(), 23_400.0)
    >>> round(lives.million_revolutions), round(lives.hours)
    (10797, 119961)
    """
    checks.instance("scene", scene, Scene)
    C, rating_source = rating_and_source(scene.bearing, dynamic_load_rating)
    damaged = bool(scene.defects)
    alike = scene.bearing.rows_are_alike
    checks.choice("positions", positions, POSITIONS)
    if damaged and positions != "all":
        raise checks.refuse("positions", positions, '"all" for a damaged bearing')
    if not alike and positions != "all":
        raise checks.refuse("positions", positions, '"all" for rows that are not alike')
    contact = contact_life(scene.bearing)
    rows = range(len(scene.bearing.all_rows))
    rated = np.array([race_ratings(scene.bearing, C, k) for k in rows])
    healthy_scene = dataclasses.replace(scene, defect=()) if damaged else scene
    healthy = _loads(healthy_scene, positions)
    loads = _loads(scene, positions) if damaged else healthy
    L_healthy = million_revolutions(contact, rated, healthy.load_of_rows)
    carried = loads.load_of_rows
    L = million_revolutions(contact, rated, carried)
    Q_ci, Q_ce = rated[0].tolist()
    # equivalent load of all rows together, as a load on the races of the first row
    chain = contact.load_exponent * contact.scatter
    parts = (carried / rated).T.tolist()
    Q_ei, Q_ee = Q_ci * combined_load(parts[0], chain), Q_ce * combined_load(parts[1], chain)
    turns_an_hour = scene.shaft_speed / (2.0 * math.pi) * 3600.0
    hours = 1e6 * L / turns_an_hour if turns_an_hour else math.nan
    P = 0.0 if math.isinf(L) else C * L ** (-1.0 / contact.rating_exponent)
    return Life(
        scene=scene,
        dynamic_load_rating=C,
        positions=positions,
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
        sentence=life_sentence(scene, loads.reason, L, hours, L_healthy, P / C)
        + (f" Rating {long_number(C)} N, {rating_source}." if rating_source != GIVEN else ""),
        rows=tuple(million_revolutions(contact, rated[k], carried[k]) for k in rows),
        rating_source=rating_source,
    )


def contact_life(bearing: Bearing) -> ContactLife:
    """Return the constants of ISO 16281 for the contacts of a bearing."""
    return LINE_CONTACT if bearing.kind.line_contact else POINT_CONTACT


def race_ratings(bearing: Bearing, dynamic_load_rating: float, row: int = 0) -> tuple[float, float]:
    """Return Q_ci, Q_ce [N], the loads of a ball under which both races last 10⁶ turns.

    They belong to one row and follow from the rating of all rows (ISO 16281). Raises ValueError for
    a ball bearing without groove radii.
    """
    row_bearing, contact = bearing.of_row(row), contact_life(bearing)
    cosine, ball = math.cos(row_bearing.contact_angle), row_bearing.ball_diameter
    grooves = 1.0
    if not bearing.kind.line_contact:
        inner, outer = row_bearing.groove_radius("inner"), row_bearing.groove_radius("outer")
        if inner is None or outer is None:
            name = f"{'inner' if inner is None else 'outer'}_groove_radius"
            raise checks.refuse(name, None, "a number, where life is computed")
        grooves = groove_ratio(inner / ball, outer / ball)
    ratings = [1.0] if bearing.rows_are_alike else ratings_alone(bearing)
    part = ratings[row % len(ratings)] * len(ratings) / sum(ratings)  # over the mean of all rows
    gamma = ball * cosine / row_bearing.pitch_diameter
    power = contact.load_exponent * contact.scatter
    B = (
        contact.race_factor
        * ((1.0 - gamma) / (1.0 + gamma)) ** contact.gamma_power
        * grooves**contact.groove_power
    )
    # C_r/(Z cos α) i^(-0.7 or -7/9)/λν, of which Q_ci and Q_ce (ISO 16281) are multiples
    share = dynamic_load_rating * part / (row_bearing.n_balls * cosine)
    row_share = share / len(bearing.all_rows) ** contact.row_power / contact.evenness
    Q_ci = row_share / contact.inner_part * (1.0 + B**power) ** (1.0 / power)
    Q_ce = row_share / contact.outer_part * (1.0 + B**-power) ** (1.0 / power)
    return Q_ci, Q_ce


@lru_cache(maxsize=256)
def _loads(scene: Scene, positions: str) -> RaceLoads:
    contact = contact_life(scene.bearing)
    law = contact.load_exponent, contact.scatter
    if positions == "all":
        return race_loads(scene, *law)
    load = scene.load
    line = math.atan2(load.fy, load.fx) if load.fx or load.fy else 0.0
    return snapshot_loads(scene, line % scene.bearing.ball_spacing, *law)


def million_revolutions(contact: ContactLife, ratings: ArrayLike, loads: ArrayLike) -> float:
    """Return L_10r [10⁶ turns] from Q_ci, Q_ce and Q_ei, Q_ee [N] of all rows (ISO 16281).

    L_10r = ((Q_ci/Q_ei)^(−p e) + (Q_ce/Q_ee)^(−p e))^(−1/e); it is infinite without load.
    """
    p, e = contact.load_exponent, contact.scatter
    parts = np.ravel(np.asarray(loads) / np.asarray(ratings)).tolist()
    damage = sum(part ** (p * e) for part in parts)
    return math.inf if damage == 0.0 else float(damage ** (-1.0 / e))
