"""The periodic steady state by shooting, and its stability by Floquet multipliers.

Quantity                                              | Symbol | Name            | Unit
----------------------------------------------------- | ------ | --------------- | ----
state: displacements and velocities of both rings     | y      |                 | m, m/s
state one period later                                | P(y)   |                 | m, m/s
derivative of P at the orbit                          | Φ      | tangent         |
eigenvalues of Φ                                      | μ      | multipliers     |
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import (
    Array,
    Progress,
    ResultTable,
    _checks as checks,
    shown_as_table,
    table_of,
    thousands,
)
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.dynamics._low_pass import PASSED, PASSED_OF_ORBITS, acceleration_lines
from bearingcore.model.dynamics._modes import highest_frequency_of
from bearingcore.model.dynamics._motion import MOST_SAMPLES, MOST_STEPS, moving_system, static_start
from bearingcore.model.dynamics._status import OrbitStatus
from bearingcore.model.dynamics._step_rate import step_rate_of
from bearingcore.model.scene import CONTACT_LAWS, PackedMotion, Scene, _packing as packing
from bearingcore.model.statics._equilibrium import equilibrium_of
from bearingcore.recordings import Spectrum

MOST_BALL_PASSES = 400
"""Longest common period that is considered, in ball passes."""

WINDOW_REACH = 6
"""Number of bins over which the Hann window spreads a line: beyond, side lobes are 60 dB down."""

MOST_ITERATIONS = 25
"""Greatest number of Newton steps."""

MARCHED_BEFORE = (2, 20, 60)
"""Numbers of periods marched before Newton's method begins, and before each new beginning."""

CLOSED = 1e-7
"""Greatest distance between end and beginning of a closed orbit, over the size of the orbit."""

STILL = 1e-12
"""Motion [m], a hundredth of an atom, below which rings stand still: when all balls of a pressed
row carry load, their passing moves the rings by rounding only."""

LOSSES = {"-1": "period doubling", "pair": "Neimark-Sacker", "+1": "fold"}
"""Losses of stability by the place at which the largest multiplier leaves the unit circle."""


@shown_as_table
@dataclass(frozen=True)
class Orbit:
    """A periodic motion of a scene, and the growth of small disturbances of it.

    Attributes
    ----------
    scene, dofs
        the scene, and the directions in which it moves.
    status
        outcome of the search; without a common period there is no orbit.
    through
        for an unstable orbit, how its largest multiplier leaves the unit circle: "+1" (the motion
        drifts off to another orbit), "-1" (every second period alike: period-doubling) or "pair"
        (a slow beat is added). Empty otherwise.
    period
        [s], `ball_passes` ball passes long.
    multipliers : (4 len(dofs),)
        Floquet multipliers, the largest first: growth factors of disturbances over a period.
    residual
        distance between end and beginning of the period, relative to the size of the orbit.
    iterations, right_hand_side_calls
        numbers of Newton steps and of evaluations of the accelerations, with or without tangent.
    history : (steps + 1, 6, len(dofs))
        displacement, velocity, acceleration of the inner, then of the outer ring over the period,
        tilts times r_d.
    cost
        for "too many steps" their number in words; for "no static state" the reason. Empty
        otherwise.
    """

    scene: Scene
    dofs: tuple[str, ...]
    status: OrbitStatus
    through: str
    period: float
    ball_passes: int
    multipliers: NDArray[np.complex128]
    residual: float
    iterations: int
    right_hand_side_calls: int
    history: Array = field(repr=False)
    cost: str = ""

    @property
    def stable(self) -> bool:
        """True if there is an orbit and disturbances of it decay."""
        return self.status == OrbitStatus.STABLE

    @property
    def largest_multiplier(self) -> float:
        """|μ| of the largest multiplier; NaN if there is no orbit."""
        return float(np.abs(self.multipliers[0])) if self.multipliers.size else math.nan

    def table(self) -> ResultTable:
        """Floquet multipliers: a row for each, with real part, imaginary part and magnitude."""
        return table_of(
            ("multiplier_real", "1", self.multipliers.real),
            ("multiplier_imaginary", "1", self.multipliers.imag),
            ("multiplier_size", "1", np.abs(self.multipliers), "above 1 a disturbance grows"),
        )

    def spectrum(
        self,
        sample_rate: float = 65536.0,
        resolution: float = 32.0,
        duration: float = 1.4,
        since: float = 0.0,
    ) -> Spectrum:
        """Compute `bearingcore.spectrum` of the housing's acceleration while the period repeats.

        It ends where its error exceeds 0.1 dB: at 0.4 of the sample rate, or at 0.15 of the step
        rate of the orbit if that is less.

        The density (m, len(dofs)) [(m/s²)²/Hz, (rad/s²)²/Hz] is that of a record of `duration` [s]
        that begins `since` [s] after the period. The record itself is not made: each Fourier line
        of the orbit is spread by the Hann window, and lines beat with each other from segment to
        segment.

        Raises ValueError if the record or a segment of 1/resolution has more than MOST_SAMPLES
        samples.
        """
        sample_rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
        least, most = sample_rate / MOST_SAMPLES, MOST_SAMPLES / sample_rate
        resolution = checks.real_number(
            "resolution", resolution, at_least=least, at_most=0.5 * sample_rate, unit="Hz"
        )
        duration = checks.real_number("duration", duration, above=0.0, at_most=most, unit="s")
        segment = round(sample_rate / resolution)
        hop = segment - segment // 2
        segments = max((round(duration * sample_rate) - segment // 2) // hop, 1)
        frequency = np.asarray(np.fft.rfftfreq(segment, 1.0 / sample_rate), dtype=float)
        steps = len(self.history) - 1
        top = min(PASSED * sample_rate, PASSED_OF_ORBITS * steps / self.period)
        frequency = frequency[frequency <= top]
        count = math.ceil((top + WINDOW_REACH * resolution) * self.period) + 1
        lines = acceleration_lines(self.history, 3, self.period / steps, count)
        lines /= packing.length_units(self.scene, self.dofs)
        lines *= np.exp(2j * math.pi * since / self.period * np.arange(len(lines)))[:, None]
        # A segment's middle turns line k by exp(iπk/(period·resolution)). The other factor of the
        # Hann window's transform at x bins is real: half of sinc(x)/(1 − x²) per sample.
        spacing = 1.0 / (self.period * resolution)
        lines *= np.exp(1j * math.pi * spacing * np.arange(len(lines)))[:, None]
        # each frequency of a segment gets the lines within WINDOW_REACH bins
        reach = max(math.ceil(WINDOW_REACH / spacing), 2)
        k = np.rint(frequency * self.period).astype(int)[:, None] + np.arange(-reach, reach + 1)
        known = (k > 0) & (k < count)
        x = k * spacing - frequency[:, None] / resolution
        edge = np.abs(np.abs(x) - 1.0) < 1e-9
        seen = np.where(edge, 0.25, 0.5 * np.sinc(x) / np.where(edge, 1.0, 1.0 - x * x)) * known
        density = np.zeros((len(frequency), lines.shape[1]))
        # phase between neighbouring lines from one segment to the next, and its mean over segments
        turn = 2.0 * math.pi * hop / (sample_rate * self.period)
        beats = np.exp(1j * turn * np.outer(np.arange(2 * reach + 1), np.arange(segments)))
        beats = beats.mean(axis=1)
        for axis in range(lines.shape[1]):
            part = lines[np.where(known, k, 0), axis] * seen
            density[:, axis] = np.einsum("fk,fk->f", part, part.conj()).real
            for offset in range(1, 2 * reach + 1):
                cross = np.einsum("fk,fk->f", part[:, offset:], part[:, :-offset].conj())
                density[:, axis] += 2.0 * (beats[offset] * cross).real
        scale = 2.0 * segment / (0.375 * sample_rate)  # Σ w² = 0.375 segment
        return Spectrum(frequency, np.maximum(scale * density, 0.0))


def orbit(
    scene: Scene,
    *,
    start: Orbit | None = None,
    step_rate: float | None = None,
    most_steps: int = MOST_STEPS,
    progress: Progress | None = None,
) -> Orbit:
    """Find the periodic motion of `scene` by Newton's method on P(y) = y (shooting).

    Its period is the shortest time after which all forces on the rings repeat. This is one ball
    pass for healthy bearings and outer-race defects. For an inner-race defect a period exists only
    if shaft and cage return together (`common_ball_passes`).

    The variational equations are integrated with the motion. Newton's method finds unstable orbits
    too, but a machine settles to a stable orbit only: the multipliers distinguish them.

    Parameters
    ----------
    scene
        the scene, of massless balls under the published law; it moves along its active directions.
    start
        an orbit of a similar scene to start from; None starts at the static state.
    step_rate
        least step rate [Hz]; the period has a whole number of steps. None takes that of `simulate`.
    most_steps
        limit on all steps of integration. They are counted before each period; beyond the limit the
        search ends and the status says so.
    progress
        called after every period, and at least ten times a second, with the used part of
        `most_steps` and words; an exception from it ends the search.

    Raises
    ------
    ValueError
        for a shaft that stands still, a support that lacks a number, balls with mass, or a law
        without tension.
    """
    checks.instance("scene", scene, Scene)
    checks.real_number("shaft_speed", scene.shaft_speed, above=0.0, unit="rad/s")
    if scene.contact_law != CONTACT_LAWS[0]:
        words = f"{CONTACT_LAWS[0]} for an orbit: a motion without tension has no tangent"
        raise checks.refuse("contact_law", scene.contact_law, words)
    dofs = scene.active_dofs
    ball_passes = common_ball_passes(scene) or 0
    nothing = Orbit(
        scene, dofs, OrbitStatus.NO_PERIOD, "", math.nan, ball_passes, np.zeros(0, complex),
        math.nan, 0, 0, np.full((2, 6, len(dofs)), math.nan),
    )  # fmt: skip
    if ball_passes == 0:
        return nothing
    period = ball_passes * scene.bearing.ball_spacing / scene.cage_speed
    most_steps = checks.whole_number("most_steps", most_steps, at_least=1, at_most=10**12)
    packed = packed_motion(scene)
    rate = step_rate or step_rate_of(packed, 65536.0)
    steps = max(math.ceil(period * rate), 8)
    # an orbit needs at least two periods: one to see whether it closes, one after a Newton step
    if 2 * steps > most_steps:
        most = thousands(most_steps)
        cost = f"{thousands(steps)} steps a period, the limit is most_steps = {most} in all"
        return replace(nothing, status=OrbitStatus.TOO_MANY_STEPS, period=period, cost=cost)
    shooting = _Shooting(packed, period, steps, most_steps, progress)
    rest = equilibrium_of(packed, [0.0])
    y = static_start(packed, rest) if start is None else _state_at_start(start, dofs)
    if y is None:
        reason = rest.reason(0)
        return replace(nothing, status=OrbitStatus.NO_START, period=period, cost=reason)
    y = shooting.smooth_state(y)
    if start is not None:
        answer = _newton(nothing, shooting, y, period)
        if answer.status != OrbitStatus.NOT_CONVERGED or shooting.too_many:
            return shooting.reported(answer)
    # if Newton's method fails, it begins again after some periods of the motion itself
    for periods in MARCHED_BEFORE:
        y = shooting.march(y, periods)
        answer = _newton(nothing, shooting, y, period)
        if answer.status != OrbitStatus.NOT_CONVERGED or shooting.too_many:
            break
    return shooting.reported(answer)


def common_ball_passes(scene: Scene) -> int | None:
    """Return the number of ball passes after which all forces on the rings repeat; None if never.

    A row repeats after a pass of its own balls. If it has another number of balls or another cage
    speed, it makes another number of passes in each pass of the bearing's balls. The period must
    hold whole passes of each row. It must also hold whole turns of the shaft if an inner-race
    defect or a force turns with it: the shaft turns by (2π/N_b)·ω_s/ω_c in each pass.
    """
    bearing = scene.bearing
    rounds = {
        bearing.pace(k) * bearing.of_row(k).n_balls / bearing.n_balls
        for k in range(len(bearing.all_rows))
    }
    if scene.turning_force > 0.0 or scene.defect_turns:
        rounds.add(1.0 / (bearing.cage_ratio * bearing.n_balls))
    passes = 1
    for passed in rounds:
        fraction = Fraction(passed).limit_denominator(MOST_BALL_PASSES)
        # the remainder after the longest period must be below any step: 1e-9 of a turn
        if abs(float(fraction) - passed) * fraction.denominator > 1e-9:
            return None
        passes = math.lcm(passes, fraction.denominator)
    return passes if passes <= MOST_BALL_PASSES else None


class _Shooting:
    """Map of a state over one period, with and without the tangent.

    States are in the variables of `kernels.march`.
    """

    def __init__(
        self,
        packed: PackedMotion,
        period: float,
        steps: int,
        most_steps: int = MOST_STEPS,
        progress: Progress | None = None,
    ) -> None:
        self._progress = progress
        self.steps = steps
        self._most_steps = most_steps
        self.calls = 0
        self._system = moving_system(packed)
        self._step = period / steps
        self.history = np.empty((steps + 1, 6, len(packed.dofs)))
        # velocities are divided by the highest natural frequency, so that all of y are lengths
        omega = 2.0 * math.pi * highest_frequency_of(packed)
        self.scale = np.repeat([1.0, 1.0 / omega, 1.0, 1.0 / omega], len(packed.dofs))

    def smooth_state(self, y: Array) -> Array:
        """Turn displacements and velocities into the marched variables."""
        periodic = y.copy()
        kernels.turn_smooth(periodic, 1.0, 0.0, self._system)
        return periodic

    def march(self, y: Array, periods: int = 1) -> Array:
        """Return P(y), or the state after several periods."""
        end = y.copy()
        for _ in range(periods):
            if self.too_many:
                break
            kernels.march(end, self._step, 0.0, self._system, self.history, self._watch)
            self.calls += 4 * self.steps
        return end

    def march_with_tangent(self, y: Array) -> tuple[Array, Array]:
        """Return P(y) and its derivative."""
        state = np.concatenate([y, np.eye(y.size).ravel()])
        kernels.march(state, self._step, 0.0, self._system, self.history, self._watch)
        self.calls += 4 * self.steps
        return state[: y.size], state[y.size :].reshape(y.size, y.size)

    def _watch(self, part: float) -> None:
        """Report the steps so far and a part of a period."""
        if self._progress is not None:
            steps = self.calls // 4 + round(part * self.steps)
            self._progress(min(steps / self._most_steps, 1.0), f"{thousands(steps)} steps")

    @property
    def too_many(self) -> bool:
        """True if another period would exceed the limit on steps."""
        return self.calls // 4 + self.steps > self._most_steps

    def reported(self, answer: Orbit) -> Orbit:
        """Return the result of the search, with "too many steps" as its status if that ended it."""
        if answer.status != OrbitStatus.NOT_CONVERGED or not self.too_many:
            return answer
        cost = (
            f"no orbit after {self.calls // 4} steps, {self.steps} a period; the limit is "
            f"most_steps = {self._most_steps}"
        )
        return replace(answer, status=OrbitStatus.TOO_MANY_STEPS, cost=cost)

    def miss(self, y: Array, end: Array) -> float:
        """Return |P(y) − y| over the size of the motion, which is at least STILL."""
        size = np.ptp(self.history[:, 0], axis=0).max() + np.ptp(self.history[:, 3], axis=0).max()
        if not (np.all(np.isfinite(end)) and math.isfinite(size)):
            return math.inf
        return float(np.linalg.norm((end - y) * self.scale) / max(size, STILL))


def _newton(nothing: Orbit, shooting: _Shooting, y: Array, period: float) -> Orbit:
    """Solve P(y) = y by Newton's method from y; a step is shortened until it helps.

    The Jacobian of P(y) − y is the tangent less the unit matrix.
    """
    end, tangent = shooting.march_with_tangent(y)
    miss = shooting.miss(y, end)
    iterations = 0
    while CLOSED < miss < math.inf and iterations < MOST_ITERATIONS and not shooting.too_many:
        iterations += 1
        try:
            step = np.linalg.solve(tangent - np.eye(y.size), y - end)
        except np.linalg.LinAlgError:
            break
        # shorten the step until the orbit closes better
        part = 1.0
        while part > 0.02:
            trial = y + part * step
            trial_end, trial_tangent = shooting.march_with_tangent(trial)
            trial_miss = shooting.miss(trial, trial_end)
            if trial_miss < miss or shooting.too_many:
                break
            part *= 0.4
        else:
            # no part of the step helps: continue at the end of the period
            trial = end
            trial_end, trial_tangent = shooting.march_with_tangent(trial)
            trial_miss = shooting.miss(trial, trial_end)
        y, end, tangent, miss = trial, trial_end, trial_tangent, trial_miss
    answer = replace(
        nothing,
        status=OrbitStatus.NOT_CONVERGED,
        period=period,
        residual=miss,
        iterations=iterations,
        right_hand_side_calls=shooting.calls,
    )
    if not miss <= CLOSED:
        return answer
    # a closed orbit is stable if all multipliers are inside the unit circle
    multipliers = np.linalg.eigvals(tangent)
    multipliers = multipliers[np.argsort(-np.abs(multipliers))]
    largest = multipliers[0]
    through = ""
    if abs(largest) >= 1.0:
        through = "pair" if abs(largest.imag) > 1e-9 else ("+1" if largest.real > 0.0 else "-1")
    return replace(
        answer,
        status=OrbitStatus.STABLE if abs(largest) < 1.0 else OrbitStatus.UNSTABLE,
        through=through,
        multipliers=multipliers.astype(complex),
        history=shooting.history,
    )


def _state_at_start(start: Orbit, dofs: tuple[str, ...]) -> Array | None:
    """Return the first state of another orbit; None if it has other directions or no state.

    If there is no orbit, its static state is taken.
    """
    first = start.history[0]
    if start.dofs != dofs:
        return None
    if not np.all(np.isfinite(first)):
        packed = packed_motion(start.scene, dofs)
        return static_start(packed, equilibrium_of(packed, [0.0]))
    return np.concatenate([first[0], first[1], first[3], first[4]])
