"""Spectra of the housing over shaft speed: a run-up, one steady speed after another."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks
from bearingcore.common.progress import Cancelled, Progress, in_turn
from bearingcore.common.table import ResultTable, table_of
from bearingcore.dynamics.modes import modes
from bearingcore.dynamics.motion import MOST_STEPS, TOO_MANY_STEPS, simulate
from bearingcore.dynamics.orbit import Orbit, orbit
from bearingcore.model.scene import MASSLESS, Scene
from bearingcore.signals.spectrum import spectrum

SETTLING = 0.5
"""Part of a marched motion that is left out of its spectrum as transient."""


@dataclass(frozen=True)
class SpeedRun:
    """Spectra of the housing's acceleration at n shaft speeds.

    Attributes
    ----------
    scene, dofs
        what runs up, and the directions of `density`'s last axis.
    shaft_speed : (n,) [rad/s]
    frequency : (m,) [Hz]
    density : (n, m, len(dofs)) [(m/s²)²/Hz, (rad/s²)²/Hz]
        NaN where a speed was not computed.
    ball_pass_frequency : (n,) [Hz]
        of the race the first defect is in; its multiples are the lines.
    from_orbit : (n,)
        True where the spectrum is that of a proven stable orbit, False where it was marched.
    bands
        least and greatest natural frequency [Hz] of each mode, which speed does not move.
    completed
        False where it was cancelled.
    refusals
        why there is no such motion, by the index of the speeds that are refused.
    """

    scene: Scene
    dofs: tuple[str, ...]
    shaft_speed: NDArray[np.float64]
    frequency: NDArray[np.float64]
    density: NDArray[np.float64]
    ball_pass_frequency: NDArray[np.float64]
    from_orbit: NDArray[np.bool_]
    bands: dict[str, tuple[float, float]]
    completed: bool
    refusals: dict[int, str] = field(default_factory=dict)

    def table(self) -> ResultTable:
        """A row a speed and frequency: the density of each direction."""
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
    progress: Progress | None = None,
    cancelled: Cancelled | None = None,
) -> SpeedRun:
    """Steady spectra at each shaft speed [rad/s]: of the orbit where it is stable, else marched.

    Balls with mass are marched always: only massless ones have orbits that can be looked for.

    Parameters
    ----------
    scene
        all but the speed.
    shaft_speeds : (n,)
        [rad/s], above 0.
    sample_rate, resolution [Hz], duration [s]
        of the spectra, as in `simulate` and `spectrum`; a marched motion runs twice as long, and
        its first half is left out.
    most_steps
        steps that may be taken for the orbit of a speed, and for its marched motion. Where there
        would be more, `refusals` says how many.
    progress, cancelled
        called and asked before each speed.

    Raises
    ------
    ValueError
        for speeds that are not above zero, or where `simulate` refuses every speed. One that is
        refused among others is told in `refusals`.
    """
    speeds = np.asarray(shaft_speeds, dtype=float).ravel()
    if not 1 <= speeds.size <= 1000:
        raise checks.refuse("number of shaft_speeds", int(speeds.size), "1 to 1000")
    for speed in speeds:
        checks.number("shaft_speeds", speed, above=0.0, unit="rad/s")
    dofs = scene.active_dofs
    segment = round(sample_rate / resolution)
    frequency = np.asarray(np.fft.rfftfreq(segment, 1.0 / sample_rate), dtype=float)
    density = np.full((speeds.size, frequency.size, len(dofs)), math.nan)
    proven = np.zeros(speeds.size, dtype=bool)
    inner = any(defect.race == "inner" for defect in scene.defects)
    bearing = scene.bearing
    nearby: Orbit | None = None
    refusals: dict[int, str] = {}
    done = 0
    for i in in_turn(
        range(speeds.size),
        lambda i: f"{speeds[i] / (2 * math.pi):.1f} Hz",
        progress,
        cancelled,
    ):
        done += 1
        try:
            at = scene.replace(shaft_speed=float(speeds[i]))
            found = None
            if at.balls == MASSLESS:
                found = orbit(at, start=nearby, most_steps=most_steps)
            if found is not None and found.stable:
                density[i] = found.spectrum(sample_rate, resolution, duration).density
                proven[i] = True
                nearby = found
                continue
            motion = simulate(at, duration / (1.0 - SETTLING), sample_rate, most_steps=most_steps)
            if motion.status.startswith(TOO_MANY_STEPS):
                raise ValueError(motion.status)
        except ValueError as error:
            refusals[i] = str(error)
            continue
        late = motion.outer_acceleration[round(SETTLING * len(motion.time)) :]
        if np.all(np.isfinite(late)):
            density[i] = spectrum(late, sample_rate, resolution).density
    if len(refusals) == speeds.size:
        raise ValueError(refusals[0])
    passing = bearing.bpfi if inner else bearing.bpfo
    return SpeedRun(
        scene=scene,
        dofs=dofs,
        shaft_speed=speeds,
        frequency=frequency,
        density=density,
        ball_pass_frequency=np.array([passing(float(speed)) for speed in speeds]),
        from_orbit=proven,
        bands=modes(scene).bands(),
        completed=done == speeds.size,
        refusals=refusals,
    )
