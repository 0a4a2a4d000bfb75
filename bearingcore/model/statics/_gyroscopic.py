"""Gyroscopic moment of the balls, which the statics leave out, compared with their loads.

Quantity                                              | Symbol | Unit
----------------------------------------------------- | ------ | -----
ball diameter over pitch diameter                     | γ'     |
contact angles of a ball at the inner and outer race  | α_i, α_o | rad
angle of the ball's own axis to the shaft's           | β      | rad
speed of the shaft, the cage, the ball about its axis | ω_s, ω_c, ω_r | rad/s
moment of inertia of a ball, m D²/10                  | J      | kg·m²
load at the outer race                                | Q_o    | N
distances of a ball's centre from its grooves' centres | l_i, l_o | m

A ball rolls about an axis that turns with the cage. This takes the moment

    M_g = J ω_r ω_c sin β,  tan β = sin α_o/(cos α_o + γ'),
    ω_r = ω_s/(γ' cos β) / ((cos α_o + tan β sin α_o)/(1 + γ' cos α_o)
                           + (cos α_i + tan β sin α_i)/(1 − γ' cos α_i)),

    ω_c = ω_s (1 − γ' cos α_i)/(1 + cos(α_o − α_i)),

for a ball that does not spin on the outer race. Friction at that race supplies the moment by a
force T = 2 M_g/D across the groove. T/Q_o is the necessary friction, and the greatest angle by
which the outer contact turns. Under thrust alone it turns less. The ball then rises or sinks
between the grooves, and the inner contact turns the other way, (l_o sin α_o)/(l_i sin α_i) times as
much. The axial load of the ball stays, so its radial load at the inner race changes, and with it
the direction of its load at the outer race:

    dα_o = T/Q_o / (1 + (l_o/l_i) (sin α_o/sin α_i)³).

Under a radial load as large as the thrust, which also moves the ring, the turn is up to twice this.
Far beyond the limit it is more, as the moment grows with the turn: see `GREATEST_ESTIMATE`.

Source: A. B. Jones, J. Basic Engineering 82 (1960) 309-322; Harris, Rolling Bearing Analysis,
chapter "Bearing deflections, preloading": "Race control".
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from bearingcore.bearings import Bearing
from bearingcore.common import number, percent, thousands, with_prefix
from bearingcore.model.scene import Scene
from bearingcore.model.statics._ball_positions import BallPositions, ball_positions
from bearingcore.model.statics._equilibrium import default_cage_angles
from bearingcore.model.statics._limit import Limit, unknown, upper_limit

GYROSCOPIC_MOMENT = "gyroscopic moment"

LIMIT = 0.02
"""Greatest share of the load: friction between ball and race holds so much (Harris), and the
contact turns by a degree at most."""

GREATEST_ESTIMATE = math.radians(3.6)
"""Greatest turn for which the estimate holds: at 4 to 10° contacts turn by up to twice as much."""

HEAVY = 0.5
"""Share of the heaviest load above which a ball counts, as lighter loads matter little."""

_ANGLES, _ROUNDS = 13, 3


class _Gyroscopic(NamedTuple):
    """The ball with the greatest T/Q_o: that ratio, M_g [N·m], Q_o [N]; greatest turn [rad]."""

    share: float
    moment: float
    load: float
    turn: float


def gyroscopic_limit(scene: Scene) -> Limit | None:
    """Return the limit on the gyroscopic moment of the balls; None if that is negligible.

    It is negligible for rollers, at rest, and for contacts at right angles to the shaft.
    """
    if scene.bearing.kind.mass_unknown or not scene.shaft_speed:
        return None
    try:
        worst = _greatest(scene)
    except ValueError as error:
        return unknown(GYROSCOPIC_MOMENT, LIMIT, "", str(error))
    if worst is None:
        why = "no cage angle has a static state with centrifugal load"
        return unknown(GYROSCOPIC_MOMENT, LIMIT, "", why)
    if worst.share < 1e-9:
        return None
    fact = (
        "The gyroscopic moment of a heavily loaded ball, "
        f"{with_prefix(worst.moment, 'N·m')}, takes a force across the groove of "
        f"{percent(worst.share, 3)} of its load of {with_prefix(worst.load, 'N')}; if the model "
        f"had it, the outer contact would turn by {_turn_words(worst)}"
    )
    speed = _speed_of_limit(scene, worst.share)
    if worst.share <= LIMIT and math.isfinite(speed):
        fact += f", and from about {thousands(speed * 30.0 / math.pi)} rpm on by a degree"
    beyond = ", more than the degree up to which it may be left out."
    return upper_limit(GYROSCOPIC_MOMENT, worst.share, LIMIT, "", fact, beyond, ".")


def _turn_words(worst: _Gyroscopic) -> str:
    """Return words on the turn of the outer contact, or on the end of its estimate."""
    turn, most = math.degrees(worst.turn), math.degrees(worst.share)
    if worst.turn > GREATEST_ESTIMATE:
        return f"more than {number(turn, 2)}°"
    return f"{number(turn, 3)}° under thrust alone, at most by {number(most, 2)}°"


def _speed_of_limit(scene: Scene, share: float) -> float:
    """Return the shaft speed [rad/s] at which T/Q_o reaches the limit; NaN if none is nearby."""
    speed = scene.shaft_speed
    for _ in range(_ROUNDS):
        speed *= math.sqrt(LIMIT / share)
        try:
            worst = _greatest(scene.replace(shaft_speed=speed))
        except ValueError:
            return math.nan
        if worst is None or not worst.share > 0.0:
            return math.nan
        share = worst.share
    return speed if abs(share / LIMIT - 1.0) < 0.2 else math.nan


def _greatest(scene: Scene) -> _Gyroscopic | None:
    """Return the worst ball of all rows at some cage angles; None if no state is known."""
    state = ball_positions(scene, default_cage_angles(scene, _ANGLES))
    if not state.converged.any():
        return None
    rows = enumerate(scene.bearing.balls_of_rows)
    return max(_worst_of_row(scene.bearing.of_row(k), state, balls) for k, balls in rows)


def _worst_of_row(bearing: Bearing, state: BallPositions, balls: slice) -> _Gyroscopic:
    """Return the worst ball of a row."""
    load = state.load[1][state.converged, balls]
    carries = load > HEAVY * state.load[1][state.converged].max()
    carries &= state.load[0][state.converged, balls] > 0.0
    if not carries.any():
        return _Gyroscopic(0.0, 0.0, 0.0, 0.0)
    inner, outer = (np.abs(state.contact_angle[i][state.converged, balls][carries]) for i in (0, 1))
    g, D = bearing.ball_diameter / bearing.pitch_diameter, bearing.ball_diameter
    tan = np.sin(outer) / (np.cos(outer) + g)
    bracket = (np.cos(outer) + tan * np.sin(outer)) / (1.0 + g * np.cos(outer))
    bracket += (np.cos(inner) + tan * np.sin(inner)) / (1.0 - g * np.cos(inner))
    # ω_r sin β = ω_s tan β/(γ' Σ), where Σ is the bracket in the head of the module
    spin = state.scene.shaft_speed * tan / (g * bracket)
    cage = state.scene.shaft_speed * (1.0 - g * np.cos(inner)) / (1.0 + np.cos(outer - inner))
    moment = 0.1 * bearing.ball_mass * D**2 * spin * cage
    share = 2.0 * moment / (D * load[carries])
    l_i, l_o = bearing.kind.race_distances(bearing)
    part_i, part_o = l_i * np.sin(inner) ** 3, l_o * np.sin(outer) ** 3
    ratio = np.divide(part_o, part_i, out=np.zeros_like(part_i), where=part_i > 0.0)
    worst = int(np.argmax(share))
    return _Gyroscopic(
        float(share[worst]),
        float(moment[worst]),
        float(load[carries][worst]),
        float((share / (1.0 + ratio)).max()),
    )
