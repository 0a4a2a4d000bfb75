"""Balls with mass in a motion: start, resonances, step rate, loads, free flights, strikes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from bearingcore.bearings import Bearing
from bearingcore.common import Array, runs
from bearingcore.common._byte_cache import lru_cache_by_bytes
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics._force import peak_force
from bearingcore.model.scene import DOF_NAMES, PackedMotion, PackedScene, Scene
from bearingcore.model.scene._defect import floor_bytes
from bearingcore.model.scene._packing import pack
from bearingcore.model.statics import Equilibrium
from bearingcore.model.statics._positions import equilibrium_over_all
from bearingcore.model.statics._status import StaticStatus

STEPS_A_CONTACT_CYCLE, LEAST_STEPS_A_CYCLE = 5.0, 2.2
"""Steps in a period of the contact resonance: the default, and the least with which Runge-Kutta
steps of order 4 are stable."""

STABLE_DECAY, GREATEST_DECAY = 2.6, 2.785
"""Decay rate of a ball's motion in its contacts times the step: the value in use, and the limit of
stability."""

RACES_OF_LOADS = ("inner", "outer")
"""Races, in the order of the loads."""

LEAST_SHARE = 0.1
"""Share of the heaviest load above which a ball counts for the band of contact resonances."""


def place_parts(scene: Scene, dofs: tuple[str, ...]) -> int:
    """Return the number of a ball's coordinates: 1 if it moves only radially, 2 if also axially."""
    flat = scene.bearing.is_flat and set(dofs) <= set(DOF_NAMES[:2])
    return 1 if flat else 2


def _balls(packed: PackedScene) -> kernels.StaticBalls:
    """Return the balls of a scene that was packed with their mass."""
    assert packed.balls is not None
    return packed.balls


def ball_system(packed: PackedMotion) -> kernels.BallSystem:
    """Return the system of a scene with balls with mass, for the kernels."""
    flat = place_parts(packed.scene, packed.dofs) == 1
    variables = kernels.PLANAR if flat else kernels.SMOOTH
    return kernels.BallSystem(packed.rotor._replace(variables=variables), *_balls(packed))


def ball_start(packed: PackedMotion, massless: Equilibrium) -> Array | None:
    """Return the state of rings and balls at rest at cage angle 0, at the scene's speed.

    It holds displacements and velocities of both rings, then positions and velocities of the balls.
    None if there is no static state. `massless` is the static state of massless balls.
    """
    dofs = packed.dofs
    if massless.status[0] >= StaticStatus.NOT_CARRIED:
        return None
    system = _balls(packed)
    q, _, _, place, _, status, _, _ = kernels.ball_positions(
        massless.cage_angles, massless.leads, massless.state, system, packed.load
    )
    if status[0] not in (StaticStatus.CONVERGED, StaticStatus.FREE_DIRECTION):
        return None
    rotor, number = packed.rotor, packed.load.active
    angle = system.contacts.angle
    c, s = np.cos(angle), np.sin(angle)
    radial = system.races.centrifugal - system.races.weight * s
    # the balls' own load on the outer ring, with its moments divided by r_d
    arm = system.contacts.arm
    carried = np.array([radial @ c, radial @ s, 0.0, -(radial * arm) @ s, (radial * arm) @ c])
    outer = np.zeros(5)  # the housing sinks into its support, under the load of the balls too
    outer[number] = (rotor.force + carried[number]) / rotor.stiffness
    rings = np.zeros((4, len(dofs)))
    rings[0], rings[2] = outer[number] + q[0, number], outer[number]
    # positions were relative to the outer ring: add its displacement (Eqs. 11 and 12)
    reach = system.contacts.reach
    balls = place[0]
    balls[0] += (outer[0] + arm * outer[4]) * c + (outer[1] - arm * outer[3]) * s
    balls[1] += outer[2] + reach * (outer[3] * s - outer[4] * c)
    moved = balls[: place_parts(packed.scene, dofs)]
    return np.concatenate([rings.ravel(), moved.ravel(), np.zeros(moved.size)])


def contact_stiffness(bearing: Bearing, load: float) -> tuple[float, float]:
    """Return k_i, k_e [N/m] of a ball's contacts with inner and outer race at a load [N]."""
    n = bearing.kind.exponent
    inner, outer = (
        n * factor ** (1.0 / n) * load ** (1.0 - 1.0 / n) for factor in bearing.race_factors
    )
    return inner, outer


def resonances(scene: Scene, load: float) -> list[float]:
    """Return sqrt((k_i + k_e)/m_b)/2π [Hz] of a ball under a load [N], for each unlike row."""
    return [
        math.sqrt(sum(contact_stiffness(row, load)) / row.ball_mass) / (2.0 * math.pi)
        for row, _ in scene.bearing.unlike_rows
    ]


@lru_cache_by_bytes(
    32_000_000,
    lambda _, packed: floor_bytes(packed.scene.defects),
    lambda packed: (packed.scene, packed.dofs),
)
def heaviest_load(packed: PackedScene) -> float:
    """Return the greatest static load [N] of a ball over all positions; 0 if none is known."""
    load = equilibrium_over_all(packed, 31).ball_load
    known = load[np.isfinite(load)]
    return float(known.max()) if known.size else 0.0


@lru_cache(maxsize=512)
def contact_resonance_band(scene: Scene) -> tuple[float, float]:
    """Return the band of contact resonances [Hz] for LEAST_SHARE to all of the heaviest load.

    The resonance of a ball goes with the sixth root of its load (Hertz), so the band is narrow even
    if loads differ much. Both ends are 0 if no ball is known to carry load.
    """
    heaviest = heaviest_load(pack(scene))
    return min(resonances(scene, LEAST_SHARE * heaviest)), max(resonances(scene, heaviest))


def ball_step_rate(packed: PackedMotion, sample_rate: float) -> float:
    """Return the step rate [Hz] for balls with mass, a multiple of the sample rate.

    It follows from the contact resonance of the most heavily loaded ball, and from its decay.
    """
    needed = _steps_needed(packed, STEPS_A_CONTACT_CYCLE, STABLE_DECAY)
    return sample_rate * max(math.ceil(needed / sample_rate - 1e-9), 1)


def least_step_rate(packed: PackedMotion) -> float:
    """Return the step rate [Hz] below which a ball jumps between its contacts faster and faster.

    Contacts that open keep this finite. A motion with fewer steps may therefore end and look right,
    with ten or ten thousand times the true vibration.
    """
    return _steps_needed(packed, LEAST_STEPS_A_CYCLE, GREATEST_DECAY)


def _steps_needed(packed: PackedMotion, a_cycle: float, decay: float) -> float:
    """Return a step rate [Hz] with `a_cycle` steps a period and at most `decay` in each step."""
    races = _balls(packed).races
    fastest = float((races.damping.sum(axis=0) / races.mass).max())  # [1/s]
    resonance = max(resonances(packed.scene, heaviest_load(packed) + peak_force(packed)))
    return max(a_cycle * resonance, fastest / decay)


def loads_of_races(
    packed: PackedScene, history: Array, place: Array, turning: tuple[float, float]
) -> Array:
    """Return elastic loads (2, n, N_b) [N] at inner and outer race for n rows of a history.

    Loads of rows that are NaN are NaN. `turning`: cage angle [rad] of the first row, and the step
    from row to row.
    """
    contacts, races, *paths = _balls(packed)
    start, turn = turning
    cage: Array = start + turn * np.arange(len(history), dtype=np.float64)
    angle = contacts.angles_at(cage)
    c, s = np.cos(angle), np.sin(angle)
    axial = place[:, 1] if place.shape[1] > 1 else 0.0
    loads = np.zeros((2, *angle.shape))
    for race, name in enumerate(("inner", "outer")):
        x = np.zeros((5, len(history), 1))
        x[packed.load.active, :, 0] = history[:, 3 * race].T
        # Equations (11) and (12) for the contact between a ball and this race
        r = (x[0] + contacts.arm * x[4]) * c + (x[1] - contacts.arm * x[3]) * s - place[:, 0]
        z = x[2] + contacts.reach * (x[3] * s - x[4] * c) - axial
        if name == "inner":
            r, z = r - contacts.clearance, z + contacts.offset
        else:
            r, z = -r, -z
        drop = kernels.drops_of(contacts, paths[race], cage, cage)
        # Equations (7) to (10), in the notation of `contact.compression`
        m = r * contacts.line_r + z * contacts.line_z - drop
        w = z * contacts.line_r - r * contacts.line_z
        A = races.distance[race]
        rise = m * (2.0 * A + m) + w * w
        length = np.maximum(np.hypot(A + m, w) + A, 1e-300)
        reached = np.where(A + m > 0.0, rise / length, np.abs(w) - A)
        reached = np.where(contacts.fixed, m, reached)
        loads[race] = races.factor[race] * np.maximum(reached, 0.0) ** contacts.exponent
    loads[:, ~np.isfinite(history[:, 0, 0])] = math.nan
    return loads


@dataclass(frozen=True)
class Flight:
    """A time from `begin` to `end` [s] in which a ball touches neither race; balls count from 0."""

    ball: int
    begin: float
    end: float


@dataclass(frozen=True)
class Strike:
    """A strike of a ball on a race that it did not touch before.

    `time` [s] is the first touch, `load` [N] the first peak of the contact's load, at `peak` [s];
    later loads do not belong to the strike.
    """

    ball: int
    race: str
    time: float
    load: float
    peak: float


def flights(time: Array, loads: Array) -> tuple[Flight, ...]:
    """Return the free flights of balls with loads (2, n, N_b) [N] at times (n,) [s].

    The loads, of inner and outer race, are those of `Motion.race_loads`. A flight at the beginning
    or at the end of these times is cut there.
    """
    free = np.asarray((loads <= 0.0).all(axis=0))
    return tuple(
        Flight(ball, float(time[first]), float(time[end - 1]))
        for ball in range(free.shape[1])
        for first, end in zip(*runs(free[:, ball]), strict=True)
    )


def ball_strikes(time: Array, loads: Array) -> tuple[Strike, ...]:
    """Return all strikes of balls with loads as in `flights`, in the order of time.

    A contact that is closed at the first time is no strike.
    """
    strikes = []
    for index, race in enumerate(RACES_OF_LOADS):
        for ball in range(loads.shape[2]):
            load = loads[index, :, ball]
            for first, end in zip(*runs(load > 0.0), strict=True):
                if first == 0:
                    continue
                falls = np.flatnonzero(np.diff(load[first:end]) <= 0.0)
                peak = first + int(falls[0]) if falls.size else end - 1
                strikes.append(
                    Strike(ball, race, float(time[first]), float(load[peak]), float(time[peak]))
                )
    return tuple(sorted(strikes, key=lambda strike: (strike.time, strike.ball)))
