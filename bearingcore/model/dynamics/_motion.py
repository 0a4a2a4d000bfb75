"""Simulated motion of the rotor in its bearing and of the housing (Eqs. 18-23)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from bearingcore.common import (
    Array,
    Progress,
    ResultTable,
    _checks as checks,
    cached_property,
    decibels,
    number,
    shown_as_table,
    table_of,
    thousands,
    with_prefix,
)
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics._ball_motion import (
    ball_start,
    ball_system,
    least_step_rate,
    loads_of_races,
    place_parts,
)
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.dynamics._force import ForceSamples, with_force
from bearingcore.model.dynamics._low_pass import bandwidth, hermite_weights, low_passed, rows_needed
from bearingcore.model.dynamics._modes import highest_frequency_of
from bearingcore.model.dynamics._status import MotionStatus
from bearingcore.model.dynamics._step_rate import step_rate_of
from bearingcore.model.scene import (
    CONTACT_LAWS,
    MASSLESS,
    WITH_MASS,
    PackedMotion,
    Scene,
    _packing as packing,
)
from bearingcore.model.statics import Equilibrium
from bearingcore.model.statics._equilibrium import equilibrium_of
from bearingcore.model.statics._status import StaticStatus
from bearingcore.recordings import Spectrum, spectrum

SETTLING = 0.12
"""Time [s] after which a motion counts as steady: several times the decay of the slowest mode."""

MOST_STEPS = 1_000_000
"""Default limit on the steps of a motion, or of all periods of an orbit. In five directions they
take up to 15 s of computing, 40 s with the tangent."""

MOST_SAMPLES = 10_000_000
"""Greatest number of samples of a motion."""

SAME_BANDS = 1.0
"""Difference [dB] up to which two motions have the same spectrum in third octaves."""

MOST_DOUBLINGS, SAME_LEVEL, QUIET = 4, 0.1, 1e-7
"""Limits for contacts without tension: most doublings of the step rate; relative difference of the
levels of two motions that are alike; and the level [m/s] below which a motion counts as rest."""

KEPT = 4
"""Greatest number of rows per sample that the filter takes for a motion of balls with mass."""


@shown_as_table
@dataclass(frozen=True)
class Motion:
    """Motion of inner and outer ring, n samples along the directions `dofs`.

    Attributes
    ----------
    scene, dofs, sample_rate [Hz], step_rate [Hz]
        the scene, its directions and rates.
    status
        the outcome. A motion that is not completed is NaN from the time at which it broke off.
    detail
        numbers of the status, in words that follow it. For a completed motion without tension it
        gives the accuracy of bands of the spectrum if that is worse than 1 dB.
    right_hand_side_calls
        number of evaluations of the accelerations.
    time : (n,) [s]
    cage_angle : (n,) [rad]
    inner_displacement, outer_displacement : (n, len(dofs)) [m, rad]
    inner_velocity, outer_velocity : (n, len(dofs)) [m/s, rad/s]
    inner_acceleration, outer_acceleration : (n, len(dofs)) [m/s², rad/s²]
        a sensor on the housing measures the outer acceleration. Both are filtered as in a recorder
        before they are sampled (`low_pass`): they are right within 0.1 dB up to `bandwidth`, and
        zero from half the sample rate on. Peaks therefore depend on the sample rate, as strikes of
        balls with mass are shorter than a sample.
    bandwidth [Hz]
        frequency up to which accelerations are complete: 0.4 of the lower of sample and step rate.
    ball_place : (n, 1 or 2, N_b) [m] or None
        radial position of balls with mass, and axial position if they move along the shaft, both
        from that of an unloaded ball that touches the outer race of concentric rings.
    """

    scene: Scene
    dofs: tuple[str, ...]
    sample_rate: float
    step_rate: float
    status: MotionStatus
    right_hand_side_calls: int
    time: Array
    history: Array = field(repr=False)
    ball_place: Array | None = field(default=None, repr=False)
    detail: str = ""
    filtered: Array | None = field(default=None, repr=False)

    @property
    def completed(self) -> bool:
        """True if the motion stayed finite to its end."""
        return self.status is MotionStatus.COMPLETED

    @property
    def reason(self) -> str:
        """Status and detail in words: "diverged after 0.2 s: 4096 steps a second are too few"."""
        return f"{self.status}{self.detail}"

    @cached_property
    def cage_angle(self) -> Array:
        """(n,) [rad], 0 at the start."""
        return self.scene.cage_speed * self.time

    @cached_property
    def inner_displacement(self) -> Array:
        """(n, len(dofs)) [m, rad]"""
        return self._sampled("inner", 0)

    @cached_property
    def outer_displacement(self) -> Array:
        """(n, len(dofs)) [m, rad]"""
        return self._sampled("outer", 0)

    @cached_property
    def inner_velocity(self) -> Array:
        """(n, len(dofs)) [m/s, rad/s]"""
        return self._sampled("inner", 1)

    @cached_property
    def outer_velocity(self) -> Array:
        """(n, len(dofs)) [m/s, rad/s]"""
        return self._sampled("outer", 1)

    @cached_property
    def inner_acceleration(self) -> Array:
        """(n, len(dofs)) [m/s², rad/s²], filtered to half the sample rate."""
        return self._accelerations("inner")

    @cached_property
    def outer_acceleration(self) -> Array:
        """(n, len(dofs)) [m/s², rad/s²], filtered to half the sample rate."""
        return self._accelerations("outer")

    def instant_acceleration(self, body: str) -> Array:
        """Return the unfiltered acceleration (n, len(dofs)) of the "inner" or "outer" ring.

        Units are [m/s², rad/s²]. It follows from the forces at each sample time: use it for
        balances of forces, not for spectra.
        """
        return self._sampled(body, 2)

    @property
    def bandwidth(self) -> float:
        """Frequency [Hz] up to which sampled accelerations are complete."""
        return bandwidth(self.sample_rate, self.step_rate)

    def spectrum(self, resolution: float = 32.0, since: float = 0.0) -> Spectrum:
        """Compute `bearingcore.spectrum` of the housing's acceleration up to `bandwidth`.

        Density (m, len(dofs)) [(m/s²)²/Hz, (rad/s²)²/Hz] from `since` [s] on. Raises ValueError
        if the motion did not stay finite, or the rest is shorter than 1/resolution.
        """
        first = max(math.ceil(since * self.sample_rate - 1e-6), 0)
        signal = self.outer_acceleration[first:]
        return spectrum(signal, self.sample_rate, resolution).up_to(self.bandwidth)

    def ball_loads(self, start: int = 0, stop: int | None = None) -> Array:
        """Return elastic loads (stop − start, N_b) [N] of samples from start to stop (Eq. 13).

        For balls with mass they are those at the outer race. Fewer samples cost less.
        """
        return self.race_loads(start, stop)[1]

    def race_loads(self, start: int = 0, stop: int | None = None) -> Array:
        """Return elastic loads (2, stop − start, N_b) [N] at inner and outer race, as `ball_loads`.

        For massless balls both are the same.
        """
        place, speed, rate = self.ball_place, self.scene.cage_speed, self.sample_rate
        packed = packing.pack(self.scene, self.dofs, balls=place is not None)
        first, last = slice(start, stop).indices(len(self.time))[:2]
        begin, turned = float(first * speed / rate), speed / rate
        if place is not None:
            rows = self.history[first:last], place[first:last]
            return loads_of_races(packed, *rows, (begin, turned))
        if not self.right_hand_side_calls:
            return np.full((2, last - first, packed.contacts.angle.size), math.nan)
        inner, outer = (self._scaled(body, 0, first, last) for body in ("inner", "outer"))
        loads = np.asarray(
            kernels.elastic_loads(
                inner - outer, packed.load.active, begin, turned, packed.contacts, packed.path
            )
        )
        loads[~np.isfinite(inner[:, 0])] = math.nan
        return np.broadcast_to(loads, (2, *loads.shape))

    def table(self) -> ResultTable:
        """A row for each sample: motion of both rings."""
        units = {"displacement": ("m", "rad"), "velocity": ("m/s", "rad/s")}
        units["acceleration"] = ("m/s²", "rad/s²")
        return table_of(
            ("time", "s", self.time),
            *(
                (f"{body}_{name}_{dof}", unit[dof.startswith("r")], values)
                for body in ("inner", "outer")
                for name, unit in units.items()
                for dof, values in zip(self.dofs, getattr(self, f"{body}_{name}").T, strict=True)
            ),
        )

    def _accelerations(self, body: str) -> Array:
        n, first = len(self.time), 0 if body == "inner" else 3
        if self.filtered is not None:  # with mass: the history does not have every step
            scaled = self.filtered[first // 3]
        elif not self.right_hand_side_calls:
            scaled = np.full((n, len(self.dofs)), math.nan)
        else:
            scaled = low_passed(self.history, first, n, self.sample_rate, self.step_rate)
        return scaled / packing.length_units(self.scene, self.dofs)

    def _sampled(self, body: str, derivative: int) -> Array:
        """Return a derivative of one body's displacement at the sample times."""
        scaled = self._scaled(body, derivative, 0, len(self.time))
        return scaled / packing.length_units(self.scene, self.dofs)

    def _scaled(self, body: str, derivative: int, start: int, stop: int) -> Array:
        """Return displacement (0), velocity (1) or acceleration (2), tilts times r_d.

        Samples are those from start to stop; between steps they are interpolated by quintics.
        """
        # the history has a row for each step, or with mass for each sample
        history, rate = self.history, self.step_rate
        if self.ball_place is not None:
            rate = self.sample_rate
        per_step, per_sample = _ratio(self.sample_rate, rate)
        first = 0 if body == "inner" else 3
        n = max(stop - start, 0)
        if per_step == 1:
            begin = start * per_sample
            rows = slice(begin, begin + max(n * per_sample - per_sample + 1, 0))
            return np.ascontiguousarray(history[rows, first + derivative][::per_sample])
        out = np.empty((n, history.shape[2]))
        weights = hermite_weights(np.arange(per_step) / per_step, derivative, 1.0 / rate)
        kernels.interpolate_steps(history, first, weights, start, out)
        return out


def simulate(
    scene: Scene,
    duration: float = 1.4,
    sample_rate: float = 65536.0,
    *,
    force: ForceSamples | None = None,
    step_rate: float | None = None,
    most_steps: int = MOST_STEPS,
    progress: Progress | None = None,
) -> Motion:
    """Simulate the motion of `scene` from its static state at cage angle 0 (Runge-Kutta, order 4).

    Parameters
    ----------
    scene
        the scene; support and inertia must be known along its active directions.
    duration
        [s]
    sample_rate
        [Hz] of the returned samples.
    force
        a varying force on the inner ring, in addition to the scene's load. The static state at the
        start does not include it. Its sample rate is at most twice the step rate, as each step
        takes the force at its start, middle and end. The filter looks REACH samples ahead: a force
        that is not zero at the end of the motion should last that much longer, or accelerations
        include its fall to zero.
    step_rate
        [Hz], a multiple or a whole fraction of the sample rate; for balls with mass a multiple. If
        a step is too long for the contacts of balls with mass, no motion is computed and the status
        gives the necessary rate. None takes `default_step_rate`; under the law without tension it
        is doubled until half as many steps make no difference, or the status says that no rate was
        enough. Samples between steps come from quintic interpolation.
    most_steps
        limit on the number of steps. Beyond it no motion is computed, and the status gives the
        number. A light body on a stiff support needs hundreds of millions of steps a second. Steps
        for the REACH further samples that the filter needs (`low_pass`) are not counted.
    progress
        called about ten times a second with the part done, 0 to 1, and words; an exception from it
        ends the work. Under the law without tension each step rate begins at 0 again.

    Returns
    -------
    Motion
        with a status, also for a motion that diverges, one with too many steps, or a scene without
        a static state to start from.

    Raises
    ------
    ValueError
        for a sample rate below twice the highest natural frequency, a step rate that does not fit
        the sample rate, a shaft that stands still, a support that lacks a number, or a force along
        a direction in which the scene does not move.
    """
    checks.instance("scene", scene, Scene)
    duration = checks.real_number("duration", duration, above=0.0, unit="s")
    sample_rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
    checks.real_number("shaft_speed", scene.shaft_speed, above=0.0, unit="rad/s")
    packed = packed_motion(scene)  # refuses a support that lacks a number
    highest = highest_frequency_of(packed)
    if sample_rate < 2.0 * highest:
        raise checks.refuse(
            "sample_rate",
            sample_rate,
            f"at least {2.0 * highest:.0f} Hz, twice the highest natural frequency "
            f"of {highest:.0f} Hz",
        )
    most_steps = checks.whole_number("most_steps", most_steps, at_least=1, at_most=10**12)
    if duration * sample_rate > MOST_SAMPLES:
        raise checks.refuse(
            "duration",
            duration,
            f"at most {MOST_SAMPLES / sample_rate:.3g} s at a sample_rate of {sample_rate:g} Hz",
        )
    rest = equilibrium_of(packed, [0.0])
    if force is not None:
        packed = with_force(packed, force)
    rate = step_rate_of(packed, sample_rate) if step_rate is None else step_rate
    if force is not None:
        most = 2.0 * checks.real_number("step_rate", rate, above=0.0, unit="Hz")
        checks.real_number("sample_rate of the force", force.sample_rate, at_most=most, unit="Hz")

    def march(rate: float) -> Motion:
        words = f"{duration:g} s at {thousands(rate)} steps a second"
        watch = None if progress is None else lambda part: progress(part, words)
        return _marched(packed, rest, duration, sample_rate, rate, most_steps, watch)

    without_tension = scene.balls != WITH_MASS and scene.contact_law != CONTACT_LAWS[0]
    if step_rate is None and without_tension:
        return _double_steps(march, rate, sample_rate)
    return march(rate)


def _marched(
    packed: PackedMotion,
    rest: Equilibrium,
    duration: float,
    sample_rate: float,
    step_rate: float,
    most_steps: int,
    watch: kernels.Watch | None = None,
) -> Motion:
    """Return the motion at one step rate [Hz]; `rest` is the static state at cage angle 0."""
    scene, dofs = packed.scene, packed.dofs
    with_mass = scene.balls == WITH_MASS
    _, per_sample = _ratio(sample_rate, step_rate, with_mass)  # refuses a rate that does not fit
    n = max(round(duration * sample_rate), 1)
    # Balls with mass take many steps per sample, and the filter does not need each of them.
    kept = max(k for k in range(1, KEPT + 1) if per_sample % k == 0) if with_mass else per_sample
    every = per_sample // kept
    rows = rows_needed(n, sample_rate, step_rate / every)  # some follow the last sample
    n_steps = (rows - 1) * every
    shown = math.ceil((n - 1) * step_rate / sample_rate - 1e-9)  # steps up to the last sample
    time = np.arange(n) / sample_rate
    n_balls = packed.contacts.angle.size
    parts = place_parts(scene, dofs)
    least = least_step_rate(packed) if with_mass else 0.0
    if (refusal := _refusal(shown, most_steps, step_rate, least)) is not None:
        # NaN everywhere, without the memory that such arrays would need
        unknown = np.float64(math.nan)
        nothing = np.broadcast_to(unknown, (n if with_mass else shown + 1, 6, len(dofs)))
        nowhere = np.broadcast_to(unknown, (n, parts, n_balls)) if with_mass else None
        status, detail = refusal
        return Motion(
            scene, dofs, sample_rate, step_rate, status, 0, time, nothing, nowhere, detail
        )
    h = 1.0 / step_rate
    place = filtered = None
    history = np.empty((rows, 6, len(dofs)))
    done, status, detail = 0, MotionStatus.COMPLETED, ""
    y = ball_start(packed, rest) if with_mass else static_start(packed, rest)
    if with_mass:
        place = np.empty((-(-rows // kept), parts, n_balls))
    if y is None:
        status, detail = MotionStatus.NO_START, f": {rest.reason(0)}"
    elif with_mass:
        balls = ball_system(packed)
        done = int(kernels.march_balls(y, h, 0.0, every, balls, history, place, watch))
    else:
        system = moving_system(packed)
        kernels.turn_smooth(y, 1.0, 0.0, system)
        done = int(kernels.march(y, h, 0.0, system, history, watch))
    if y is not None and done < n_steps:
        rate = thousands(step_rate)
        status = MotionStatus.DIVERGED
        detail = f" after {number(done * h)} s: {rate} steps a second are too few"
    if status is not MotionStatus.COMPLETED:
        first = 0 if y is None else 1
        history[done // every + first :] = math.nan
        if place is not None:
            place[done // per_sample + first :] = math.nan
    if place is not None:
        both = [low_passed(history, body, n, sample_rate, kept * sample_rate) for body in (0, 3)]
        filtered, place = np.stack(both), place[:n]
        history = history[::kept][:n].copy()
    return Motion(
        scene=scene,
        dofs=dofs,
        sample_rate=sample_rate,
        step_rate=step_rate,
        status=status,
        right_hand_side_calls=4 * done,
        time=time,
        history=history,
        ball_place=place,
        detail=detail,
        filtered=filtered,
    )


def _refusal(
    shown: int, most_steps: int, step_rate: float, least: float
) -> tuple[MotionStatus, str] | None:
    """Return the reason to refuse a motion: a step rate below `least` [Hz] or too many steps.

    Explicit steps that are too long for the stiffest mode of a ball grow without bound.
    """
    if step_rate < least:
        return MotionStatus.DIVERGED, (
            f": {thousands(step_rate)} steps a second are too few, balls with mass need "
            f"{thousands(math.ceil(least))}"
        )
    if shown > most_steps:
        return MotionStatus.TOO_MANY_STEPS, (
            f": {thousands(shown)} of {with_prefix(1.0 / step_rate, 's')} each, "
            f"the limit is most_steps = {thousands(most_steps)}"
        )
    return None


def _double_steps(march: Callable[[float], Motion], rate: float, sample_rate: float) -> Motion:
    """Return the motion of contacts without tension, with enough steps.

    The load of such a contact jumps as it opens, so errors fall only in proportion to the step.
    Steps are doubled until half as many make no difference.
    """
    per_sample = rate / sample_rate
    before = _level(march(sample_rate * (per_sample // 2) if per_sample >= 2.0 else 0.5 * rate))
    for _ in range(MOST_DOUBLINGS + 1):
        motion = march(rate)
        level = _level(motion)
        alike = abs(level - before) <= SAME_LEVEL * max(level, QUIET)
        if alike and motion.completed and level > QUIET:
            return replace(motion, detail=_bands_apart(motion, march(2.0 * rate)))
        if alike or not motion.completed:
            return motion
        before, rate = level, 2.0 * rate
    return replace(
        motion,
        status=MotionStatus.DIVERGED,
        detail=f": {thousands(motion.step_rate)} steps a second are too few; with half as many "
        "the vibration differs by more than a tenth",
        history=np.full_like(motion.history, math.nan),
    )


def _bands_apart(motion: Motion, finer: Motion) -> str:
    """Return words on the change of a spectrum by twice the steps; "" if it is small.

    Third octaves with at least a ten-thousandth of the power are compared, in the second half of
    the motions. A motion without tension may be chaotic: then no number of steps is enough.
    """
    if not finer.completed:
        return "; its spectrum is not checked with twice the steps, which are too many"
    since = 0.5 * float(motion.time[-1])
    edges = motion.bandwidth * 2.0 ** np.arange(-8.0, 0.1, 1.0 / 3.0)
    power = []
    for compared in (motion, finer):
        lines = compared.spectrum(max(0.25 * edges[0], 4.0 / since), since)
        power.append(np.add.reduceat(lines.density, np.searchsorted(lines.frequency, edges)[:-1]))
    loud = (power[1] > 1e-4 * power[1].sum(axis=0)) & (power[0] > 0.0)
    error = np.abs(10.0 * np.log10(power[0][loud] / power[1][loud])).max(initial=0.0)
    if error <= SAME_BANDS:
        return ""
    return f"; its contacts open, and bands of its spectrum are known to {decibels(error)} only"


def _level(motion: Motion) -> float:
    """Return the root mean square [m/s] of the housing's velocity in a motion's second half."""
    last = motion.time[-1] * motion.step_rate  # later rows are for the filter alone
    late = motion.history[int(0.5 * last) : int(last) + 1, 4]
    return math.sqrt(float(np.mean(late * late)))


def moving_system(packed: PackedMotion, *, velocities: bool = False) -> kernels.System:
    """Return the system of a scene with massless balls for the kernels; see `packing.rotor`.

    Raises
    ------
    ValueError
        for balls with mass, which only `simulate` can march.
    """
    balls = packed.scene.balls
    if balls != MASSLESS:
        raise checks.refuse(
            "balls", balls, f"{MASSLESS} here: only a simulated motion knows their mass"
        )
    rotor = packed.rotor._replace(variables=kernels.VELOCITIES) if velocities else packed.rotor
    return kernels.System(rotor, packed.contacts, packed.path)


def static_start(packed: PackedMotion, rest: Equilibrium) -> Array | None:
    """Return the state (4 len(dofs),) at rest at cage angle 0; None without a static state there.

    `rest` is the static state at cage angle 0.
    """
    if rest.status[0] not in (StaticStatus.CONVERGED, StaticStatus.FREE_DIRECTION):
        return None
    y = np.zeros((4, len(packed.dofs)))
    y[2] = packed.rotor.force / packed.rotor.stiffness  # the housing sinks into its support
    y[0] = y[2] + rest.state[0, packed.load.active]
    return y.ravel()


def _ratio(sample_rate: float, step_rate: float, with_mass: bool = False) -> tuple[int, int]:
    """Return (samples per step, steps per sample), one of them 1; ValueError if neither is whole.

    Balls `with_mass` take a whole number of steps per sample.
    """
    step_rate = checks.real_number("step_rate", step_rate, above=0.0, unit="Hz")
    ratio = max(sample_rate, step_rate) / min(sample_rate, step_rate)
    whole = round(ratio)
    if abs(ratio - whole) > 1e-9 * ratio or (with_mass and sample_rate > step_rate):
        allowed = f"a multiple or a whole fraction of the sample_rate of {sample_rate:g} Hz"
        if with_mass:
            allowed = f"a multiple of the sample_rate of {sample_rate:g} Hz for balls with mass"
        raise checks.refuse("step_rate", step_rate, allowed)
    return (whole, 1) if sample_rate > step_rate else (1, whole)
