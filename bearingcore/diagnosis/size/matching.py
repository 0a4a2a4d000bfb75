"""Match of simulated ball passes with a measured one.

Both are compared as averages over ball passes: the mean pass, whatever its place in time, and the
smoothed spectrum, direction by direction.

Quantity                                       | Symbol | Name             | Unit
---------------------------------------------- | ------ | ---------------- | ----
part of the mean pass left unexplained         | w      | waveform_misfit  |
mean squared log ratio of the smoothed spectra | s      | spectrum_misfit  |
shift of the simulated pass that fits best     | τ      | lag              | rad
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.fft import irfft
from numpy.typing import NDArray

from bearingcore.common.arrays import Array, summit
from bearingcore.diagnosis.size.simulation import Band
from bearingcore.signals.averaging import BallPasses

WAVEFORM_FLOOR = 0.05
SPECTRUM_FLOOR = 0.05
"""Misfits below these count little: no model is right to the last per cent."""

WAVEFORM_WEIGHT = 12.0
SPECTRUM_WEIGHT = 12.0
"""Weight of a factor e in a misfit, before the temperature: chosen by hand on scenes other than
those that the method is judged by."""

GREATEST_MISFIT = 2.0

DYNAMIC_RANGE = 1e-4
"""Spectra this far below a direction's strongest band are not compared (40 dB): there the end of a
filter, a neighbour's leakage or the last of a transient speaks."""

PHASES = 2048
"""Places in time at which a simulated pass is laid over the measured one, before refinement."""


@dataclass(frozen=True)
class Match:
    """Match of simulated ball passes with measured ones.

    Attributes
    ----------
    waveform_misfit : (d,)
        share of the mean pass's power that is left after the simulated one is taken off.
    waveform_cost : (d,)
        how much speaks against it: logarithm of what is left, each harmonic weighted by its noise.
    spectrum_misfit : (d,)
        mean squared natural logarithm of the ratio of smoothed spectra.
    level
        natural logarithm of simulated over measured power, all directions.
    """

    waveform_misfit: Array
    waveform_cost: Array
    spectrum_misfit: Array
    level: float

    @property
    def score(self) -> float:
        """Evidence of the misfits for their cause."""
        spectrum = np.log(SPECTRUM_FLOOR + self.spectrum_misfit)
        return float(
            -WAVEFORM_WEIGHT * self.waveform_cost.mean() - SPECTRUM_WEIGHT * spectrum.mean()
        )


@dataclass(frozen=True)
class PassQuality:
    """Composition of a mean ball pass, in the band that is compared: whether it is evidence.

    Attributes
    ----------
    noise_share
        part of its power that is noise, mean over directions.
    strongest
        part of its power that the strongest harmonic carries.
    harmonics
        how many harmonics carry it: 1/Σ p², p the parts of the power.
    """

    noise_share: float
    strongest: float
    harmonics: float


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
        scatter = measured.scatter[self.kept]
        self.noise_share = np.minimum(scatter.sum(axis=0) / self.energy, 1.0)
        # what a simulation may be off by, and noise, of a pass of power 1
        self.noise = WAVEFORM_FLOOR / max(len(self.kept), 1) + scatter / self.energy
        self.weight = 1.0 / self.noise / max(len(self.kept), 1)
        self.noise_power = measured.noise_power[self.kept]
        self.window = _smoothing(frequency[self.kept], band)
        power = self.window @ measured.power[self.kept]
        self.floor = DYNAMIC_RANGE * power.max(axis=0) + 1e-300
        self.log_power = np.log(power + self.floor)

    @property
    def quality(self) -> PassQuality:
        """Noise and number of harmonics of the measured mean ball pass."""
        part = (np.abs(self.harmonics) ** 2 / self.energy).mean(axis=1)
        part = part / max(float(part.sum()), 1e-300)
        return PassQuality(
            noise_share=float(self.noise_share.mean()),
            strongest=float(part.max(initial=0.0)),
            harmonics=1.0 / max(float((part**2).sum()), 1e-300),
        )

    def match(self, harmonics: NDArray[np.complex128], power: Array) -> Match:
        """Compare with simulated `harmonics` and `power`, each (N, d)."""
        simulated = harmonics[self.kept]
        if not np.isfinite(simulated).all():
            worst = np.full(simulated.shape[1], GREATEST_MISFIT)
            return Match(worst, np.log1p(worst / WAVEFORM_FLOOR), worst**2, 0.0)
        # of a pass of power 1 in each direction: the weaker one, which distinguishes sizes, counts
        scale = 1.0 / np.sqrt(self.energy)
        relative, measured = simulated * scale, self.harmonics * scale
        # lag [rad] and gain that fit best; harmonics count by their noise
        lag = self._best_lag((relative.conj() * self.weight * measured).sum(axis=1))
        relative = np.exp(1j * lag * self.order)[:, None] * relative
        agree = float((relative.conj() * self.weight * measured).real.sum())
        energy = float((self.weight * np.abs(relative) ** 2).sum())
        left = np.abs(measured - max(agree, 0.0) / max(energy, 1e-300) * relative) ** 2
        clean = power[self.kept] + self.noise_power
        difference = np.log(self.window @ clean + self.floor) - self.log_power
        return Match(
            np.minimum(left.sum(axis=0), GREATEST_MISFIT),
            np.log1p((self.weight * left).sum(axis=0)),
            (difference**2).mean(axis=0),
            math.log(float(clean.sum() / self.measured.power[self.kept].sum())),
        )

    def _best_lag(self, cross: NDArray[np.complex128]) -> float:
        """Lag [rad] at which a cross spectrum (n,) agrees most, refined by a parabola."""
        phases = PHASES
        while phases < 4 * self.order[-1]:
            phases *= 2
        padded = np.zeros(phases // 2 + 1, dtype=complex)
        padded[self.order] = cross.conj()
        likeness = irfft(padded, phases)
        best = int(likeness.argmax())
        shift = summit(*(likeness[(best + k) % phases] for k in (-1, 0, 1)))
        return 2.0 * math.pi * (best + float(shift)) / phases


def _smoothing(frequency: Array, band: Band) -> Array:
    """Weights (bands, N) that smooth a spectrum over 6 % of frequency, or over two lines."""
    centers = np.exp(np.arange(math.log(band.lowest), math.log(band.highest), 0.12))
    spacing = frequency[1] - frequency[0] if len(frequency) > 1 else frequency[0]
    width = np.maximum(0.06 * centers, 0.5 * spacing)
    window = np.exp(-0.5 * ((frequency - centers[:, None]) / width[:, None]) ** 2)
    return window / window.sum(axis=1, keepdims=True)
