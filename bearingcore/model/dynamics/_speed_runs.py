"""Spectra of the housing over shaft speed: a run-up by one steady speed after another."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import (
    Array,
    Progress,
    ResultTable,
    _checks as checks,
    shown_as_table,
    table_of,
    thousands,
)
from bearingcore.model.dynamics._low_pass import PASSED
from bearingcore.model.dynamics._modes import frequency_bands
from bearingcore.model.dynamics._motion import MOST_SAMPLES, MOST_STEPS, simulate
from bearingcore.model.dynamics._orbit import Orbit, orbit
from bearingcore.model.dynamics._status import MotionStatus
from bearingcore.model.dynamics._step_rate import default_step_rate, fine_step_rate
from bearingcore.model.scene import CONTACT_LAWS, MASSLESS, Scene

MOST_STEPS_IN_ALL = 1_000_000_000
"""Default limit on the steps of all speeds of a run: some minutes of marching in two directions,
hours in five."""

SETTLING_SHARE = 0.5
"""Share of a marched motion that is left out of its spectrum as transient."""


@shown_as_table
@dataclass(frozen=True)
class SpeedRun:
    """Spectra of the housing's acceleration at n shaft speeds.

    Attributes
    ----------
    scene, dofs
        the scene, and the directions of the last axis of `density`.
    shaft_speed : (n,) [rad/s]
    frequency : (m,) [Hz]
        frequencies up to the highest one at which the spectrum of any speed is known.
    density : (n, m, len(dofs)) [(m/s²)²/Hz, (rad/s²)²/Hz]
        NaN for a speed that was not computed, and above the frequency up to which its motion is
        known.
    ball_pass_frequency : (n,) [Hz]
        of the inner race if it has a defect, otherwise of the outer; lines are at its multiples.
    from_orbit : (n,)
        True for the spectrum of a proven stable orbit, False for that of a marched motion.
    bands
        least and greatest natural frequency [Hz] of each mode; speed does not change them.
    completed
        False if the run was cancelled.
    refusals
        reasons of refused speeds, by their index.
    """

    scene: Scene
    dofs: tuple[str, ...]
    shaft_speed: Array
    frequency: Array
    density: Array
    ball_pass_frequency: Array
    from_orbit: NDArray[np.bool_]
    bands: dict[str, tuple[float, float]]
    completed: bool
    refusals: dict[int, ValueError] = field(default_factory=dict)

    def table(self) -> ResultTable:
        """A row for each speed and frequency: the density of each direction."""
        speed, frequency = np.meshgrid(self.shaft_speed, self.frequency, indexing="ij")
        return table_of(
            ("shaft_speed", "rad/s", speed),
            ("frequency", "Hz", frequency),
            *(
                (
                    f"density_{dof}",
                    "(rad/s²)²/Hz" if dof.startswith("r") else "(m/s²)²/Hz",
                    self.density[..., i],
                )
                for i, dof in enumerate(self.dofs)
            ),
        )


def speed_run(
    scene: Scene,
    shaft_speeds: ArrayLike,
    *,
    sample_rate: float = 65536.0,
    resolution: float = 32.0,
    duration: float = 1.4,
    most_steps: int = MOST_STEPS,
    most_steps_in_all: int = MOST_STEPS_IN_ALL,
    progress: Progress | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> SpeedRun:
    """Compute the steady spectrum at each shaft speed [rad/s].

    It is that of the periodic orbit if this is stable, and otherwise that of a marched motion.
    Balls with mass and contacts without tension are always marched, as they have no orbits here.

    Parameters
    ----------
    scene
        the scene; its own speed is ignored.
    shaft_speeds : (n,)
        [rad/s], above 0.
    sample_rate, resolution [Hz], duration [s]
        of the spectra, as in `simulate` and `spectrum`; a marched motion runs twice as long, and
        its first half is left out.
    most_steps
        limit on the steps of an orbit, and on those of a marched motion. Beyond it the speed is
        refused, and `refusals` gives the number.
    most_steps_in_all
        limit on the steps that marching all speeds would take.
    progress, cancelled
        called before each speed.

    Raises
    ------
    ValueError
        for speeds that are not above zero, or that take more than `most_steps_in_all`, or if
        `simulate` refuses every speed. Single refusals are in `refusals`.
    """
    speeds = np.asarray(shaft_speeds, dtype=float).ravel()
    if not 1 <= speeds.size <= 1000:
        raise checks.refuse("number of shaft_speeds", int(speeds.size), "1 to 1000")
    for speed in speeds:
        checks.real_number("shaft_speeds", speed, above=0.0, unit="rad/s")
    sample_rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
    most = MOST_SAMPLES / sample_rate * (1.0 - SETTLING_SHARE)
    duration = checks.real_number("duration", duration, above=0.0, at_most=most, unit="s")
    resolution = checks.real_number(
        "resolution", resolution, at_least=1.0 / duration, at_most=0.5 * sample_rate, unit="Hz"
    )
    dofs = scene.active_dofs
    segment = round(sample_rate / resolution)
    frequency = np.asarray(np.fft.rfftfreq(segment, 1.0 / sample_rate), dtype=float)
    frequency = frequency[frequency <= PASSED * sample_rate]
    inner = scene.defect_turns
    passing = scene.bearing.bpfi if inner else scene.bearing.bpfo
    lasting = duration / (1.0 - SETTLING_SHARE)
    steps = _steps_of_marching(scene, speeds, lasting, sample_rate, most_steps)
    checks.whole_number("most_steps_in_all", most_steps_in_all, at_least=1, at_most=10**15)
    if steps > most_steps_in_all:
        most_words = f"the limit is most_steps_in_all = {thousands(most_steps_in_all)}"
        words = f"fewer: they take about {thousands(steps)} steps, {most_words}"
        raise checks.refuse("shaft_speeds", f"{speeds.size} speeds", words)
    # each speed: the orbit, starting from that of the last stable speed, or else a march
    density = np.full((speeds.size, frequency.size, len(dofs)), math.nan)
    proven = np.zeros(speeds.size, dtype=bool)
    nearby: Orbit | None = None
    refusals: dict[int, ValueError] = {}
    done = 0
    for i, speed in enumerate(speeds.tolist()):
        if cancelled is not None and cancelled():
            break
        if progress is not None:
            progress(i / speeds.size, f"{speed / (2 * math.pi):.1f} Hz")
        done += 1
        try:
            running = scene.replace(shaft_speed=speed)
            answer = None
            if running.balls == MASSLESS and running.contact_law == CONTACT_LAWS[0]:
                rate = fine_step_rate(running, sample_rate)
                answer = orbit(running, start=nearby, step_rate=rate, most_steps=most_steps)
            if answer is not None and answer.stable:
                lines = answer.spectrum(sample_rate, resolution, duration).density
                density[i, : len(lines)] = lines
                proven[i] = True
                nearby = answer
                continue
            motion = simulate(running, lasting, sample_rate, most_steps=most_steps)
            if motion.status is MotionStatus.TOO_MANY_STEPS:
                raise ValueError(motion.reason)
        except ValueError as error:
            refusals[i] = error
            continue
        if motion.completed:
            lines = motion.spectrum(resolution, SETTLING_SHARE * lasting).density
            density[i, : len(lines)] = lines
    if len(refusals) == speeds.size:
        raise refusals[0]
    known = np.flatnonzero(np.isfinite(density).any(axis=(0, 2)))
    if known.size:
        density = density[:, : known[-1] + 1]
    return SpeedRun(
        scene=scene,
        dofs=dofs,
        shaft_speed=speeds,
        frequency=frequency[: density.shape[1]],
        density=density,
        ball_pass_frequency=np.array([passing(float(speed)) for speed in speeds]),
        from_orbit=proven,
        bands=frequency_bands(scene),
        completed=done == speeds.size,
        refusals=refusals,
    )


def _steps_of_marching(
    scene: Scene, speeds: Array, duration: float, sample_rate: float, most_steps: int
) -> float:
    """Return the steps of all speeds if each is marched for `duration` [s]; 0 if none can be.

    A speed that needs more than `most_steps` does not count, as it will be refused.
    """
    steps = []
    try:
        for speed in speeds.tolist():
            rate = default_step_rate(scene.replace(shaft_speed=speed), sample_rate)
            steps.append(duration * rate)
    except ValueError:  # `simulate` will raise it with its reason
        return 0.0
    return sum(step for step in steps if step <= most_steps)
