"""Length of a spall of the outer race: each candidate is simulated and compared with the signal.

Entry and exit give the length up to whole ball spacings. The frequencies at which the machine rings
say which of these it is (Petersen, Howard & Prime 2014, Section 4). Signal and simulation are
averaged over ball passes. D and S are the complex Fourier lines of both mean passes, in all
directions, each divided by its measured size. They are compared under the delay τ that fits best:

    misfit = 1 − max_τ Re Σ conj(D_n) S_n exp(inτ) / (|D| |S|)
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import (
    Array,
    Progress,
    ResultTable,
    _checks as checks,
    runs,
    shown_as_table,
    summit,
    table_of,
)
from bearingcore.errors import Status
from bearingcore.measured.diagnosis import SLIP, resample_to_steady_speed
from bearingcore.measured.signals import BallPasses, average_passes, coefficients, least_passes
from bearingcore.model.dynamics import SETTLING, modes, simulate
from bearingcore.model.scene import MASSLESS, Scene
from bearingcore.recordings import Recording

BAND, FEWEST_LINES = (0.25, 1.35), 6.0
"""Ends of the compared band, relative to the lowest and highest natural frequency without defect;
fewest lines of the mean ball pass up to the upper end."""

STEP = math.radians(0.5)
SHORTEST, LONGEST = math.radians(0.5), math.radians(90.0)
"""Step [rad] between simulated extents (small: the misfit is steep); first and last extent."""

APART = 0.16
"""Extents closer than this share of a ball spacing are one candidate."""

EXPLAINED, AHEAD = 0.25, 1.5
"""Misfit below which an extent explains the pass, and least ratio of the next misfit to it."""

NEARLY = 0.1
"""Excess of the misfit up to which lengths are in the interval of the best. The interval contains
the true length if the scene is that of the machine."""

AVERAGED, STEPS_A_CYCLE, MOST_STEPS = 0.12, 10.0, 200_000
"""Time [s] of a simulation that is averaged; steps in a cycle of the highest frequency, and in a
spall, for an error near 0.2 dB; most steps of one simulation."""

FINEST = math.radians(0.02)
"""Step [rad] to which an extent is refined."""

DELAYS = 4096
"""Number of delays in a ball pass under which simulated and measured pass are compared."""


class SizingStatus(Status):
    """The outcome of a sizing."""

    SIZED = "sized", "One length explains the mean ball pass, and no other does."
    NOT_APART = "not distinguished", "Several lengths explain the mean ball pass nearly as well."
    UNEXPLAINED = "unexplained", "No length explains the mean ball pass in this machine."
    TOO_SHORT = "too short", "The recording holds too few ball passes for a mean."
    TOO_COARSE = "too coarse", "The sample rate is too low for the frequencies at which it rings."
    TOO_FAST = "too fast", "Balls pass too often: the machine rings at too few of their harmonics."
    NOT_SIMULATED = "not simulated", "The scene's motion cannot be simulated in so many steps."
    SEVERAL_DEFECTS = "several defects", "The scene has several defects; only one can be sized."
    SUPPORT_UNKNOWN = (
        "support unknown",
        "The frequencies at which the machine rings decide between whole ball spacings: this needs "
        "the mass and the stiffness of its support.",
    )
    INNER_RACE = (
        "inner race",
        "An inner-race defect turns through the load zone, so ball passes differ.",
    )


@dataclass(frozen=True)
class Candidate:
    """A possible length of the spall, with its simulation.

    Attributes
    ----------
    extent, low, high
        [rad], with the interval of lengths that explain the signal nearly as well.
    misfit
        difference between measured and simulated lines, from 0 (equal) to 1 (unrelated).
    ratio
        its misfit over the least misfit; 1 for the best candidate.
    lines : (N, d) complex [m/s²]
        Fourier lines of its mean ball pass at `Sizing.frequency`, aligned with the measured ones;
        the amplitude is twice their magnitude.
    bands
        least and greatest natural frequency [Hz] of each mode as balls pass, by label.
    scene
        the scene with this extent.
    """

    extent: float
    low: float
    high: float
    misfit: float
    ratio: float
    lines: NDArray[np.complex128] = field(repr=False)
    bands: dict[str, tuple[float, float]] = field(repr=False)
    scene: Scene = field(repr=False)


@shown_as_table
@dataclass(frozen=True)
class Sizing:
    """Result of sizing a spall by a signal.

    Attributes
    ----------
    status
        the outcome.
    candidates
        possible lengths, the best first: the best two, and those a ball spacing from the best,
        which have the same entry and exit. Empty if none was simulated.
    frequency : (N,) [Hz]
        frequencies of the compared lines of the mean ball pass.
    lines : (N, d) complex [m/s²]
        measured lines, a column for each direction of the recording.
    extents, misfits : (n,) [rad], (n,)
        all simulated extents, in rising order, and their misfits.
    """

    status: SizingStatus
    candidates: tuple[Candidate, ...] = ()
    frequency: Array = field(default_factory=lambda: np.zeros(0), repr=False)
    lines: NDArray[np.complex128] = field(default_factory=lambda: np.zeros((0, 1), complex))
    extents: Array = field(default_factory=lambda: np.zeros(0), repr=False)
    misfits: Array = field(default_factory=lambda: np.zeros(0), repr=False)

    @property
    def best(self) -> Candidate | None:
        """The candidate with the least misfit; None without candidates."""
        return self.candidates[0] if self.candidates else None

    @property
    def conclusive(self) -> bool:
        """True if exactly one length explains the signal."""
        return self.status == SizingStatus.SIZED

    @property
    def sentence(self) -> str:
        """The answer with the difference between the lengths, or the reason why there is none."""
        if not self.candidates:
            return self.status.sentence
        best, *others = self.candidates
        low, extent, high = (math.degrees(end) for end in (best.low, best.extent, best.high))
        words = f"{extent:.1f}° ({low:.1f} to {high:.1f}°)"
        if self.status == SizingStatus.UNEXPLAINED:
            return f"{self.status.sentence} The nearest is {words}, misfit {best.misfit:.2f}."
        if not self.conclusive:
            near = [f"{math.degrees(c.extent):.1f}°" for c in others if c.ratio < AHEAD]
            return f"{words} or {' or '.join(near)}. {self.status.sentence}"
        spacing = best.scene.bearing.ball_spacing
        beside = [c for c in others if abs(abs(c.extent - best.extent) - spacing) < APART * spacing]
        other = (beside or others)[0]  # a ball spacing away, where entry and exit are the same
        lowest = {mode: (band[0], other.bands[mode][0]) for mode, band in best.bands.items()}
        mode = max(lowest, key=lambda name: np.nan_to_num(abs(np.subtract(*lowest[name]))))
        frequency, other_frequency = lowest[mode]
        return (
            f"{words}. As balls pass, mode {mode} falls to {frequency:.0f} Hz; with "
            f"{math.degrees(other.extent):.1f}° it would fall to {other_frequency:.0f} Hz. Misfit "
            f"{best.misfit:.2f}; the next, {math.degrees(others[0].extent):.1f}°, has "
            f"{others[0].misfit:.2f}."
        )

    def table(self) -> ResultTable:
        """Return a row for each candidate, the best first."""
        return table_of(
            ("extent", "rad", "extent"),
            ("low", "rad", "low", "of the interval"),
            ("high", "rad", "high", "of the interval"),
            ("misfit", "1", "misfit"),
            ("ratio", "1", "ratio", "of the misfit to the least"),
            of=self.candidates,
        )


def size_defect(
    recording: Recording,
    scene: Scene,
    *,
    support_known: bool = False,
    progress: Progress | None = None,
) -> Sizing:
    """Find the length of an outer-race spall by simulating every possible length.

    The damaged race is assumed to be known: call `diagnose` first. All lengths are simulated, not
    only those that entry and exit allow (`measure_extent`), because these can be misread. A
    changing speed that was measured with the signal is followed as in `diagnose`. If it was not
    measured, ball passes differ, and there is usually no single answer.

    Parameters
    ----------
    recording
        acceleration of the housing along y, or better along x and y.
    scene
        bearing, load, support and shaft speed of the machine, and a defect with the true centre,
        depth and edges; its extent is ignored. Balls are assumed to be massless, because the
        compared frequencies are far below their resonances.
    support_known
        True if mass and stiffness of the support were measured, or the signal was simulated with
        the scene. Otherwise there is no length, and the status says why.
    progress
        called before and during each simulation with the part done and words; an exception from
        it ends the search.

    Raises
    ------
    ValueError
        for a shaft that stands still, directions in which the scene does not move, and unlike rows.
    """
    checks.instance("recording", recording, Recording)
    checks.instance("scene", scene, Scene)
    checks.real_number("shaft_speed", scene.shaft_speed, above=0.0, unit="rad/s")
    turns = scene.shaft_speed / (2.0 * math.pi)
    steady, turns, _, _ = resample_to_steady_speed(recording, turns, turns, "")
    if steady is not recording:
        recording, scene = steady, scene.replace(shaft_speed=2.0 * math.pi * turns)
    if not set(recording.directions) <= set(scene.active_dofs):
        raise checks.refuse("dofs", scene.active_dofs, f"with {', '.join(recording.directions)}")
    if not scene.bearing.rows_are_alike:
        raise ValueError("rows are not alike, so ball passes differ; allowed: rows that are alike")
    nominal = scene.bearing.bpfo(scene.shaft_speed)
    if len(scene.defects) > 1:
        return Sizing(SizingStatus.SEVERAL_DEFECTS)
    if scene.defects[0].race == "inner":
        return Sizing(SizingStatus.INNER_RACE)
    if not support_known:
        return Sizing(SizingStatus.SUPPORT_UNKNOWN)
    natural = list(modes(scene.healthy()).bands().values())
    lowest, highest = BAND[0] * np.min(natural), BAND[1] * np.max(natural)
    if not math.isfinite(highest):
        raise checks.refuse("load", "one without a static state", "one that the bearing carries")
    if highest < FEWEST_LINES * nominal:
        return Sizing(SizingStatus.TOO_FAST)
    if 0.4 * recording.sample_rate < highest:
        return Sizing(SizingStatus.TOO_COARSE)
    if recording.duration * nominal * (1.0 - SLIP) < least_passes(nominal, lowest):
        return Sizing(SizingStatus.TOO_SHORT)
    passes = average_passes(
        recording.acceleration, recording.sample_rate, nominal, SLIP, lowest, highest,
        min(2.4 * highest, 0.4 * recording.sample_rate), follow=True,
    )  # fmt: skip
    search = _Search(scene, recording, passes, (lowest, highest), progress)
    for extent in np.arange(SHORTEST, LONGEST, STEP).tolist():
        search.misfit(extent)
    if not math.isfinite(min(search.misfits.values())):
        return Sizing(SizingStatus.NOT_SIMULATED)
    candidates = search.candidates()
    status = SizingStatus.SIZED
    if candidates[0].misfit > EXPLAINED:
        status = SizingStatus.UNEXPLAINED
    elif any(other.ratio < AHEAD for other in candidates[1:]):
        status = SizingStatus.NOT_APART
    tried = np.array(sorted(search.misfits.items()))
    return Sizing(status, candidates, search.frequency, search.measured, tried[:, 0], tried[:, 1])


class _Search:
    """Search over extents: mean ball passes of a scene, compared with the measured one in a band.

    `band` in Hz. `misfits` has the misfit of each extent [rad] that was simulated.
    """

    def __init__(
        self,
        scene: Scene,
        recording: Recording,
        passes: BallPasses,
        band: tuple[float, float],
        progress: Progress | None,
    ) -> None:
        self.progress = progress
        self.passing = passes.frequency
        slip = self.passing / scene.bearing.bpfo(scene.shaft_speed)
        self.scene = scene.replace(shaft_speed=slip * scene.shaft_speed, balls=MASSLESS)
        self.columns = [scene.active_dofs.index(name) for name in recording.directions]
        frequency = passes.harmonic_frequency
        kept = np.flatnonzero((frequency >= band[0]) & (frequency <= band[1]))
        self.order, self.frequency = kept + 1, frequency[kept]
        self.measured = passes.harmonics[kept]
        # power 1 in each direction, because the weaker one distinguishes lengths equally well
        self.scale = 1.0 / np.maximum(np.linalg.norm(self.measured, axis=0), 1e-300)
        self.steps = max(STEPS_A_CYCLE * band[1] / self.passing, 4.0 * len(frequency))
        self.misfits: dict[float, float] = {}

    def simulate_lines(self, extent: float) -> NDArray[np.complex128]:
        """Return the lines (N, d) of the mean ball pass with an extent [rad]; NaN if it failed."""
        spacing = self.scene.bearing.ball_spacing
        steps = math.ceil(max(self.steps, STEPS_A_CYCLE * spacing / extent))
        averaged = math.ceil(max(AVERAGED * self.passing, 4.0))
        duration = math.ceil(SETTLING * self.passing + averaged) / self.passing
        rate = steps * self.passing
        self._report(extent)
        motion = simulate(
            self.scene.replace(extent=extent), duration, rate, step_rate=rate,
            most_steps=MOST_STEPS, progress=lambda *_: self._report(extent),
        )  # fmt: skip
        last = motion.instant_acceleration("outer")[-averaged * steps :, self.columns]
        each = coefficients(last.reshape(averaged, steps, -1), int(self.order[-1]))
        return np.asarray(each.mean(axis=0)[self.order - 1])

    def _report(self, extent: float) -> None:
        """Report the part of the lengths that were tried; 0.95 while the best are refined."""
        if self.progress is not None:
            part = min(len(self.misfits) * STEP / (LONGEST - SHORTEST), 0.95)
            self.progress(part, f"{math.degrees(extent):.1f}°")

    def compare(self, extent: float) -> tuple[float, NDArray[np.complex128]]:
        """Return the misfit of an extent, and its lines under the delay that fits best."""
        lines, measured = self.simulate_lines(extent), self.measured * self.scale**2
        sizes = float(np.linalg.norm(lines * self.scale)) * math.sqrt(measured.shape[1])
        if not sizes > 0.0:
            return math.inf, lines
        # the correlation at all delays at once is the inverse transform of conj(D_n) S_n
        products = np.zeros(DELAYS // 2 + 1, dtype=complex)
        products[self.order] = (measured.conj() * lines).sum(axis=1)
        correlation = np.fft.irfft(products, DELAYS)
        place = int(correlation.argmax())
        delay = place + float(summit(*(correlation[(place + k) % DELAYS] for k in (-1, 0, 1))))
        lines = np.exp(2j * math.pi * delay / DELAYS * self.order)[:, None] * lines
        return 1.0 - float(np.vdot(measured, lines).real) / sizes, lines

    def misfit(self, extent: float) -> float:
        """Return the misfit of an extent [rad], which is simulated once."""
        if extent not in self.misfits:
            self.misfits[extent] = self.compare(extent)[0]
        return self.misfits[extent]

    def candidates(self) -> tuple[Candidate, ...]:
        """Return the best extent, the next, and those a ball spacing from the best, all refined."""
        from scipy.optimize import minimize_scalar  # imported late: slow to import

        spacing = self.scene.bearing.ball_spacing
        ranked = sorted(self.misfits, key=self.misfit)
        first, starts = ranked[0], ranked[:1]
        for away, room in ((0.0, LONGEST), (-spacing, 2.0 * STEP), (spacing, 2.0 * STEP)):
            near = [e for e in ranked if abs(e - first - away) <= room]
            separate = [e for e in near if min(abs(e - s) for s in starts) > APART * spacing]
            starts += separate[:1]
        for extent in starts:
            ends = (max(extent - STEP, 0.5 * SHORTEST), extent + STEP)
            minimize_scalar(
                self.misfit, bounds=ends, method="bounded", options={"xatol": FINEST, "maxiter": 10}
            )
        tried = np.array(sorted(self.misfits))
        misfits = np.array([self.misfits[extent] for extent in tried.tolist()])
        groups = [np.flatnonzero(np.abs(tried - extent) <= STEP) for extent in starts]
        places = sorted((int(n[misfits[n].argmin()]) for n in groups), key=misfits.__getitem__)
        return tuple(self._candidate(place, misfits[places[0]], tried, misfits) for place in places)

    def _candidate(self, place: int, least: float, tried: Array, misfits: Array) -> Candidate:
        extent, misfit = float(tried[place]), float(misfits[place])
        begins, ends = runs(misfits <= max(AHEAD * misfit, misfit + NEARLY))
        run = int(np.searchsorted(begins, place, "right")) - 1
        low, high = tried[max(begins[run] - 1, 0)], tried[min(ends[run], len(tried) - 1)]
        scene, ratio = self.scene.replace(extent=extent), misfit / max(float(least), 1e-12)
        lines, bands = self.compare(extent)[1], modes(scene).bands()
        return Candidate(extent, float(low), float(high), misfit, ratio, lines, bands, scene)
