"""Contact ellipse and pressure of the heaviest loaded ball on each race (Hertz).

Quantity                                    | Symbol | Name              | Unit
------------------------------------------- | ------ | ----------------- | ----
load of the ball                            | Q      | load              | N
semi-axes, across and along the rolling     | a, b   | semi_axis_across, semi_axis_along | m
greatest pressure, in the middle            | p      | greatest_pressure | Pa

The contact is that of `bearings._hertz`. On the edge of a defect the pressure is higher, as a
corner has no contact ellipse.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from bearingcore.bearings import Bearing
from bearingcore.common import ResultTable, _checks as checks, shown_as_table, table_of
from bearingcore.model.scene import Scene
from bearingcore.model.statics._ball_positions import static_state
from bearingcore.model.statics._equilibrium import Equilibrium
from bearingcore.model.statics._positions import state_of

RACES = ("inner", "outer")


@dataclass(frozen=True)
class HeaviestBall:
    """The most heavily loaded ball of some positions. NaN if no load is known.

    Attributes
    ----------
    load, inner_load [N]
        Q, and the load at the inner race, which balls with mass press less than the outer one.
    cage_angle, ball_angle [rad]
        φ_c and the angle φ_j of the ball at that moment.
    row
        row of the ball, counted from 0.
    """

    load: float
    cage_angle: float
    ball_angle: float
    row: int = 0
    inner_load: float = math.nan

    def load_on(self, race: str) -> float:
        """Return the load [N] on a race; that on the inner race may belong to another ball."""
        return self.inner_load if race == "inner" else self.load


def heaviest_balls(state: Equilibrium) -> tuple[HeaviestBall, ...]:
    """Return the heaviest loaded ball of each unlike row, or a single one if all rows are alike.

    All positions with known loads count.
    """
    return tuple(_heaviest(state, balls) for _, balls in state.scene.bearing.unlike_rows)


def _heaviest(state: Equilibrium, balls: slice) -> HeaviestBall:
    loads = np.where(np.isfinite(state.ball_load), state.ball_load, -math.inf)[:, balls]
    if not loads.size or np.isneginf(loads).all():
        return HeaviestBall(math.nan, math.nan, math.nan)
    i, j = np.unravel_index(int(np.argmax(loads)), loads.shape)
    ball = balls.start + int(j)
    return HeaviestBall(
        float(loads[i, j]),
        float(state.cage_angles[i]),
        float(state.ball_angle[i, ball]),
        state.scene.bearing.row_of_ball(ball)[0],
        float(np.nanmax(state.inner_load[:, balls])),
    )


@dataclass(frozen=True)
class RacePressure:
    """Contact of the heaviest loaded ball with one race. NaN if the load is unknown.

    Attributes
    ----------
    race
        "inner" or "outer".
    load [N]
        Q.
    semi_axis_across, semi_axis_along [m]
        a and b of the ellipse, across the rolling and along it; 0 without load.
    greatest_pressure [Pa]
        p, in the middle.
    """

    race: str
    load: float
    semi_axis_across: float
    semi_axis_along: float
    greatest_pressure: float


@shown_as_table
@dataclass(frozen=True)
class ContactPressures:
    """Contact ellipses and pressures of a scene's heaviest loaded ball.

    Attributes
    ----------
    ball
        the ball, its position and the cage angle.
    inner, outer
        its contact with each race.
    reason
        the reason why no load is known; empty if one is.
    """

    ball: HeaviestBall
    inner: RacePressure
    outer: RacePressure
    reason: str = ""

    def table(self) -> ResultTable:
        """A row for each race: load and place of the ball, semi-axes, pressure."""
        return table_of(
            ("race", "", "race"),
            ("ball_load", "N", "load", "of the heaviest loaded ball"),
            ("ball_angle", "rad", [self.ball.ball_angle] * 2, "angle of that ball"),
            ("semi_axis_across", "m", "semi_axis_across", "of the ellipse, across the rolling"),
            ("semi_axis_along", "m", "semi_axis_along", "of the ellipse, along the rolling"),
            ("greatest_pressure", "Pa", "greatest_pressure", "in the middle of the ellipse"),
            ("status", "", [self.reason or "known"] * 2),
            of=(self.inner, self.outer),
        )


def contact_pressures(scene: Scene, state: Equilibrium | None = None) -> ContactPressures:
    """Compute ellipse and pressure at each race for the heaviest ball of all positions.

    The positions are all cage angles, and all shaft angles if a defect turns with the shaft. In a
    bearing with unlike rows the row with the highest pressure counts.

    Parameters
    ----------
    scene
        the scene; its bearing needs its groove radii.
    state
        the static equilibrium of the scene, if it is known; None computes it at all positions, for
        balls with mass under their centrifugal load (`static_state`).

    Raises
    ------
    ValueError
        for a bearing without groove radii, or the equilibrium of another scene.
    """
    checks.instance("scene", scene, Scene)
    state = state_of(scene, state, static_state)
    answers = [_pressures(scene.bearing.of_row(ball.row), ball) for ball in heaviest_balls(state)]
    worst = max(answers, key=lambda a: max(a.inner.greatest_pressure, a.outer.greatest_pressure))
    unknown = math.isnan(worst.ball.load) and state.cage_angles.size
    return dataclasses.replace(worst, reason=state.reason(0)) if unknown else worst


def _pressures(bearing: Bearing, ball: HeaviestBall) -> ContactPressures:
    races = {}
    for race in RACES:
        contact, load = bearing.race_contact(race), ball.load_on(race)
        a, b = contact.semi_axes(load)
        p = contact.greatest_pressure(load)
        races[race] = RacePressure(race, load, float(a), float(b), float(p))
    return ContactPressures(ball, races["inner"], races["outer"])
