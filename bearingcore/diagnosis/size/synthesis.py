"""Signals that a scene would give, and how well they explain a measured one.

Both are compared as averages over ball passes: the mean pass, whatever its place in time, and the
smoothed spectrum, direction by direction.

Quantity                                       | Symbol | Name             | Unit
---------------------------------------------- | ------ | ---------------- | ----
part of the mean pass left unexplained         | w      | waveform_misfit  |
mean squared log ratio of the smoothed spectra | s      | spectrum_misfit  |
shift of the simulated pass that fits best     | τ      | lag              | rad
"""

from __future__ import annotations

import copy
import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks
from bearingcore.dynamics.modes import highest_natural_frequency, modes
from bearingcore.dynamics.motion import simulate
from bearingcore.model.scene import Scene
from bearingcore.signals.averaging import BallPasses, coefficients

SETTLING = 0.12
"""[s] of a simulated motion that is thrown away: several times the slowest mode's decay."""

AVERAGED = 0.12
"""[s] of it that are averaged, and never fewer than FEWEST_SIMULATED passes."""

FEWEST_SIMULATED = 4

STEPS_A_CYCLE = 10.0
"""Steps in a cycle of the highest natural frequency: an error near 0.2 dB, far below what a wrong
model does."""

WAVEFORM_FLOOR = 0.05
SPECTRUM_FLOOR = 0.05
"""Misfits below these count little: no model is right to the last per cent."""

GREATEST_MISFIT = 2.0

DYNAMIC_RANGE = 1e-4
"""Spectra this far below a direction's strongest band are not compared (40 dB): there the end of a
filter, a neighbour's leakage or the last of a transient speaks."""

PHASES = 2048
"""Places in time at which a simulated pass is laid over the measured one, before refinement."""


@dataclass(frozen=True)
class Band:
    """Frequencies [Hz] in which signals are compared, around the rigid-body modes."""

    lowest: float
    highest: float


def comparison_band(scene: Scene, sample_rate: float) -> Band:
    """From a quarter of the healthy bearing's lowest natural frequency to 1.35 of its highest.

    Raises
    ------
    ValueError
        where the sample rate leaves less than an octave of it, or no static state is known.
    """
    limits = np.array(list(modes(scene.healthy()).bands().values()))
    if not np.isfinite(limits).all():
        raise checks.refuse("load", "such that the healthy bearing has no modes", "a static state")
    lowest, highest = 0.25 * float(limits.min()), 1.35 * float(limits.max())
    if 0.4 * sample_rate < 8.0 * lowest:
        raise checks.refuse(
            "sample_rate",
            sample_rate,
            f"at least {20.0 * lowest:.0f} Hz, to hear the modes of this scene",
        )
    return Band(lowest, min(highest, 0.4 * sample_rate))


def synthesise(scene: Scene, frequency: float, count: int, columns: Sequence[int]) -> BallPasses:
    """Simulated ball passes of a scene whose balls pass `frequency` [Hz] times a second.

    `count` harmonics, along `columns`, indices into the scene's active directions. Coefficients
    are NaN where the motion diverged or had no static state to start from.
    """
    nominal = scene.bearing.bpfo(scene.shaft_speed)
    scene = dataclasses.replace(scene, shaft_speed=scene.shaft_speed * frequency / nominal)
    fastest = float(np.nan_to_num(highest_natural_frequency(scene)))
    n = max(math.ceil(STEPS_A_CYCLE * fastest / frequency), 4 * count)
    settle = math.ceil(SETTLING * frequency)
    passes = max(FEWEST_SIMULATED, math.ceil(AVERAGED * frequency))
    motion = simulate(scene, (settle + passes) / frequency, n * frequency, step_rate=n * frequency)
    signal = motion.outer_acceleration[settle * n :, list(columns)]
    each = coefficients(signal.reshape(passes, n, len(columns)), count)
    power = (np.abs(each) ** 2).mean(axis=0)
    return BallPasses(frequency, passes, each.mean(axis=0), power, np.zeros(len(columns)))


@dataclass(frozen=True)
class Match:
    """How well m simulated passes explain a measured one.

    Attributes
    ----------
    waveform_misfit : (m, d)
        share of the mean pass's power that is left after the simulated one is taken off.
    spectrum_misfit : (m, d)
        mean squared natural logarithm of the ratio of smoothed spectra.
    level : (m,)
        natural logarithm of simulated over measured power, all directions.
    lag : (m,) [rad]
        ball-pass phase of the simulation (2π a pass) at which the measured pass begins.
    waveform_residual : (m, n, d), spectrum_residual : (m, b, d)
        what the misfits are the mean squares of, for least squares.
    """

    waveform_misfit: NDArray[np.float64]
    spectrum_misfit: NDArray[np.float64]
    level: NDArray[np.float64]
    lag: NDArray[np.float64]
    waveform_residual: NDArray[np.complex128]
    spectrum_residual: NDArray[np.float64]


class Target:
    """A measured average, made ready to be compared with simulated ones.

    Parameters
    ----------
    measured
        the average.
    band
        the frequencies to compare.
    """

    def __init__(self, measured: BallPasses, band: Band) -> None:
        self.measured = measured
        self.band = band
        frequency = measured.harmonic_frequency
        self.kept = np.flatnonzero((frequency >= band.lowest) & (frequency <= band.highest))
        self.order = self.kept + 1
        self.harmonics = measured.harmonics[self.kept]
        self.energy = np.maximum((np.abs(self.harmonics) ** 2).sum(axis=0), 1e-300)
        self.noise_share = np.minimum(measured.scatter[self.kept].sum(axis=0) / self.energy, 1.0)
        self.window = _smoothing(frequency[self.kept], band)
        power = self.window @ measured.power[self.kept]
        self.floor = DYNAMIC_RANGE * power.max(axis=0) + 1e-300
        self.log_power = np.log(power + self.floor)

    def with_harmonics(self, harmonics: NDArray[np.complex128]) -> Target:
        """The same with other coefficients (n, d) of the harmonics that are kept."""
        other = copy.copy(self)
        other.harmonics = harmonics
        return other

    def match(self, harmonics: NDArray[np.complex128], power: NDArray[np.float64]) -> Match:
        """Compare with simulated `harmonics` and `power`, each (m, N, d)."""
        simulated = harmonics[:, self.kept]
        m = len(simulated)
        bad = np.asarray(~np.isfinite(power).all(axis=(1, 2)), dtype=bool)
        simulated = np.where(bad[:, None, None], 0.0, simulated)
        cross = simulated.conj() * self.harmonics
        padded = np.zeros((m, PHASES), dtype=complex)
        padded[:, self.order] = cross.sum(axis=2)
        likeness = np.fft.fft(padded, axis=1).real
        best = likeness.argmax(axis=1)
        row = np.arange(m)
        left, middle, right = (likeness[row, (best + k) % PHASES] for k in (-1, 0, 1))
        bend = left - 2.0 * middle + right
        shift = np.where(bend < 0.0, 0.5 * (left - right) / np.where(bend < 0.0, bend, 1.0), 0.0)
        lag = 2.0 * math.pi * (best + shift) / PHASES
        turned = simulated * np.exp(1j * lag[:, None] * self.order)[:, :, None]
        energy = (np.abs(turned) ** 2).sum(axis=1)
        agree = (turned.conj() * self.harmonics).real.sum(axis=1)
        # directions count alike, so that the weaker one, which tells sizes apart, is heard
        gain = (agree / self.energy).sum(axis=1) / np.maximum(
            (energy / self.energy).sum(axis=1), 1e-300
        )
        residual = (self.harmonics - np.maximum(gain, 0.0)[:, None, None] * turned) / np.sqrt(
            self.energy
        )
        misfit = (np.abs(residual) ** 2).sum(axis=1)
        clean = np.where(bad[:, None, None], 1.0, power[:, self.kept]) + self.measured.noise_power
        log_power = np.log(np.einsum("bn,mnd->mbd", self.window, clean) + self.floor)
        difference = log_power - self.log_power
        level = np.log(clean.sum(axis=(1, 2)) / self.measured.power[self.kept].sum())
        misfit[bad] = GREATEST_MISFIT
        difference[bad] = GREATEST_MISFIT
        return Match(
            np.minimum(misfit, GREATEST_MISFIT),
            (difference**2).mean(axis=1),
            level,
            lag,
            residual,
            difference,
        )


def _smoothing(frequency: NDArray[np.float64], band: Band) -> NDArray[np.float64]:
    """Weights (bands, N) that smooth a spectrum over 6 % of frequency, or over two lines."""
    centers = np.exp(np.arange(math.log(band.lowest), math.log(band.highest), 0.12))
    spacing = frequency[1] - frequency[0] if len(frequency) > 1 else frequency[0]
    width = np.maximum(0.06 * centers, 0.5 * spacing)
    window = np.exp(-0.5 * ((frequency - centers[:, None]) / width[:, None]) ** 2)
    return window / window.sum(axis=1, keepdims=True)
