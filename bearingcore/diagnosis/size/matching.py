"""Match of simulated ball passes with a measured one, for any path between them.

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
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.fft import irfft
from numpy.typing import NDArray

from bearingcore.common.lazy import cached_property
from bearingcore.diagnosis.size.path_fit import DIRECT, Explained, PathFit, PathModel
from bearingcore.diagnosis.size.synthesis import Band
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

PEAKS, FEWER_PEAKS = 4, 2
"""Places at which it is laid over the measured one behind a path, which may delay it; and over one
drawn to see what chance does."""

FINER = ((0.05, 2), (0.02, 2), (0.008, 2))
"""Steps [rad] in which such a place is looked for further, and how many to either side."""


@dataclass(frozen=True)
class Match:
    """Match of m simulated passes with a measured one.

    Attributes
    ----------
    waveform_misfit : (m, d)
        share of the mean pass's power that is left after the simulated one is taken off.
    waveform_cost : (m, d)
        how much speaks against it: logarithm of what is left, each harmonic weighted by its noise,
        and of what the path could explain by chance.
    spectrum_misfit : (m, d)
        mean squared natural logarithm of the ratio of smoothed spectra.
    level : (m,)
        natural logarithm of simulated over measured power, all directions.
    lag : (m,) [rad]
        ball-pass phase of the simulation (2π a pass) at which the measured pass begins.
    waveform_residual : (m, n, d), spectrum_residual : (m, b, d)
        for least squares; exp(waveform_cost) is, but for the path's part of it, 1 and the sum of
        the former's squares, spectrum_misfit the mean of the latter's.
    """

    waveform_misfit: NDArray[np.float64]
    waveform_cost: NDArray[np.float64]
    spectrum_misfit: NDArray[np.float64]
    level: NDArray[np.float64]
    lag: NDArray[np.float64]
    waveform_residual: NDArray[np.complex128]
    spectrum_residual: NDArray[np.float64]
    path_cost: float = 0.0

    @property
    def score(self) -> NDArray[np.float64]:
        """Evidence of the misfits for their cause, (m,)."""
        return np.asarray(
            -WAVEFORM_WEIGHT * self.waveform_cost.mean(axis=1)
            - SPECTRUM_WEIGHT * np.log(SPECTRUM_FLOOR + self.spectrum_misfit).mean(axis=1)
            - self.path_cost
        )


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
        self.noise_power = np.broadcast_to(measured.noise_power, measured.power.shape)[self.kept]
        self.window = _smoothing(frequency[self.kept], band)
        power = self.window @ measured.power[self.kept]
        self.floor = DYNAMIC_RANGE * power.max(axis=0) + 1e-300
        self.log_power = np.log(power + self.floor)
        self._path_fits: dict[PathModel, tuple[PathFit, ...]] = {}

    def path_fits(self, model: PathModel) -> tuple[PathFit, ...]:
        """Fits of a path to the pass of each direction."""
        found = self._path_fits.get(model)
        if found is None:
            found = tuple(
                PathFit(model, self.order, self.measured.frequency, self.noise[:, column])
                for column in range(len(self.energy))
            )
            self._path_fits[model] = found
        return found

    def match(
        self,
        harmonics: NDArray[np.complex128],
        power: NDArray[np.float64],
        model: PathModel = DIRECT,
        exits: NDArray[np.float64] | None = None,
        near: float | None = None,
    ) -> Match:
        """Compare with simulated `harmonics` and `power`, each (m, N, d).

        Behind a path balls leave at the phases `exits` (m,) [rad] of the simulated passes, and the
        lag is looked for `near` one, where one is given.
        """
        return Prepared(self, harmonics, model, exits).match(power, near)


class Prepared:
    """Simulated passes (m, N, d), made ready to be laid over passes of one spectrum."""

    def __init__(
        self,
        target: Target,
        harmonics: NDArray[np.complex128],
        model: PathModel = DIRECT,
        exits: NDArray[np.float64] | None = None,
    ) -> None:
        self.target = target
        self.model = model
        simulated = harmonics[:, target.kept]
        self.bad = np.asarray(~np.isfinite(simulated).all(axis=(1, 2)), dtype=bool)
        self.simulated = np.where(self.bad[:, None, None], 0.0, simulated)
        # of a pass of power 1 in each direction: the weaker one, which distinguishes sizes, counts
        self.scale = 1.0 / np.sqrt(target.energy)
        self.relative = self.simulated * self.scale
        self.explained: list[Explained] = []
        if not model.direct:
            self._behind_a_path(exits)

    def _behind_a_path(self, exits: NDArray[np.float64] | None) -> None:
        target = self.target
        if exits is None:
            exits = np.zeros(len(self.simulated))
        # where a path rings it is far louder than elsewhere: the level is that of most harmonics
        tiny = 1e-12
        size = np.log(np.abs(target.harmonics) * self.scale + tiny)
        gain = np.exp((size - np.log(np.abs(self.relative) + tiny)).mean(axis=1))
        self.relative = self.relative * np.where(self.bad[:, None], 0.0, gain)[:, None, :]
        self.explained = [
            fit.explained(self.relative[:, :, column], exits)
            for column, fit in enumerate(target.path_fits(self.model))
        ]

    def some(self, step: int) -> Prepared:
        """Every so many of the passes."""
        other = copy.copy(self)
        for name in ("_weighed_conj", "_weighed_energy"):
            other.__dict__.pop(name, None)
        other.bad, other.simulated, other.relative = (
            each[::step] for each in (self.bad, self.simulated, self.relative)
        )
        other.explained = [one.some(step) for one in self.explained]
        return other

    def least_cost(self, harmonics: NDArray[np.complex128]) -> NDArray[np.float64]:
        """Cost of explaining a pass (n, d), mean over directions: (m,)."""
        measured = harmonics * self.scale
        if not self.model.direct:
            return self._laid(measured, FINER[:1], FEWER_PEAKS)[1]
        _, gain, agree, energy = self._direct(measured)
        own = (self.target.weight * np.abs(measured) ** 2).sum(axis=0)
        gain = gain[:, None]
        left = own - gain * (2.0 * agree - gain * energy)
        return np.asarray(np.log1p(np.maximum(left, 0.0)).mean(axis=1))

    def match(self, power: NDArray[np.float64], near: float | None = None) -> Match:
        """Compare with the measured pass and spectrum."""
        target = self.target
        measured = target.harmonics * self.scale
        if self.model.direct:
            lag, gain, _, _ = self._direct(measured)
            turn = np.exp(1j * lag[:, None] * target.order)
            residual = measured - (gain[:, None] * turn)[:, :, None] * self.relative
            weighed = residual * np.sqrt(target.weight)
            cost = np.log1p((np.abs(weighed) ** 2).sum(axis=1))
            misfit = (np.abs(residual) ** 2).sum(axis=1)
            transfer = np.zeros(residual.shape)
        else:
            lag, _ = self._laid(measured, near=near)
            left = self._left(measured, lag[:, None])[:, 0]
            columns = range(left.shape[2])
            parts = [(self.explained[k], left[:, :, k]) for k in columns]
            weighed = np.stack([one.whitened(rest) for one, rest in parts], axis=2)
            misfit = np.stack([one.left(rest) for one, rest in parts], axis=1)
            transfer = np.stack([one.transfer(rest) for one, rest in parts], axis=2)
            complexity = np.stack([one.complexity for one, _ in parts], axis=1)
            cost = np.log1p((np.abs(weighed) ** 2).sum(axis=1)) + complexity
        bad = self.bad
        clean = np.where(bad[:, None, None], 1.0, power[:, target.kept])
        clean = clean * np.abs(1.0 + transfer) ** 2 + target.noise_power
        log_power = np.log(np.einsum("bn,mnd->mbd", target.window, clean) + target.floor)
        difference = log_power - target.log_power
        level = np.log(clean.sum(axis=(1, 2)) / target.measured.power[target.kept].sum())
        misfit[bad] = GREATEST_MISFIT
        cost[bad] = math.log1p(GREATEST_MISFIT / WAVEFORM_FLOOR)
        difference[bad] = GREATEST_MISFIT
        return Match(
            np.minimum(misfit, GREATEST_MISFIT),
            cost,
            (difference**2).mean(axis=1),
            level,
            lag,
            weighed,
            difference,
            self.model.cost,
        )

    def _direct(self, measured: NDArray[np.complex128]) -> tuple[NDArray[np.float64], ...]:
        """Lag and gain (m,) that fit best, and by direction (m, d) what agrees, and energies.

        Harmonics count by their noise.
        """
        cross = self._weighed_conj * measured
        lag = self._peaks(cross.sum(axis=2), 1)[:, 0]
        back = np.exp(-1j * lag[:, None] * self.target.order)
        agree = (back[:, None, :] @ cross)[:, 0].real
        energy = self._weighed_energy
        gain = np.maximum(agree.sum(axis=1), 0.0) / np.maximum(energy.sum(axis=1), 1e-300)
        return lag, gain, agree, energy

    @cached_property
    def _weighed_conj(self) -> NDArray[np.complex128]:
        return np.asarray(self.relative.conj() * self.target.weight)

    @cached_property
    def _weighed_energy(self) -> NDArray[np.float64]:
        return np.asarray((self.target.weight * np.abs(self.relative) ** 2).sum(axis=1))

    def _laid(
        self,
        measured: NDArray[np.complex128],
        steps: Sequence[tuple[float, int]] = FINER,
        peaks: int = PEAKS,
        near: float | None = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The lag (m,) that fits best behind a path, and the cost there."""
        if near is None:
            cross = self.relative.conj() * measured
            size = np.abs(cross)
            likeness = [cross.sum(axis=2), (cross / np.maximum(np.sqrt(size), 1e-150)).sum(axis=2)]
            lags = np.concatenate([self._peaks(one, peaks) for one in likeness], axis=1)
        else:
            lags = np.full((len(self.relative), 1), near)
        row = np.arange(len(lags))
        lag = lags[:, 0]
        cost = np.full(len(lags), math.inf)
        for step, reach in ((0.0, 0), *steps):
            if reach:
                lags = lag[:, None] + step * np.arange(-reach, reach + 1)
            left = self._left(measured, lags)
            tried = np.mean(
                [
                    np.log1p(one.misfit(left[:, :, :, k])) + one.complexity[:, None]
                    for k, one in enumerate(self.explained)
                ],
                axis=0,
            )
            best = tried.argmin(axis=1)
            lag, cost = lags[row, best], tried[row, best]
        return lag, cost

    def _left(
        self, measured: NDArray[np.complex128], lags: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        """Residual (m, l, n, d) of a measured pass turned back by lags (m, l)."""
        turn = np.exp(-1j * lags[:, :, None] * self.target.order)
        return np.asarray(measured * turn[:, :, :, None] - self.relative[:, None])

    def _peaks(self, cross: NDArray[np.complex128], count: int) -> NDArray[np.float64]:
        """Lags (m, count) [rad] at which cross spectra (m, n) agree most, refined by parabolas."""
        phases = PHASES if count == 1 else PHASES // 4
        while phases < 4 * self.target.order[-1]:
            phases *= 2
        padded = np.zeros((len(cross), phases // 2 + 1), dtype=complex)
        padded[:, self.target.order] = cross.conj()
        likeness = irfft(padded, phases, axis=1)
        row = np.arange(len(cross))[:, None]
        if count == 1:
            best = likeness.argmax(axis=1)[:, None]
        else:
            peak = (likeness >= np.roll(likeness, 1, axis=1)) & (
                likeness > np.roll(likeness, -1, axis=1)
            )
            heights = np.where(peak, likeness, -math.inf)
            best = np.argpartition(-heights, count, axis=1)[:, :count]
        left, middle, right = (likeness[row, (best + k) % phases] for k in (-1, 0, 1))
        bend = left - 2.0 * middle + right
        shift = np.where(bend < 0.0, 0.5 * (left - right) / np.where(bend < 0.0, bend, 1.0), 0.0)
        return np.asarray(2.0 * math.pi * (best + np.clip(shift, -1.0, 1.0)) / phases)


def _smoothing(frequency: NDArray[np.float64], band: Band) -> NDArray[np.float64]:
    """Weights (bands, N) that smooth a spectrum over 6 % of frequency, or over two lines."""
    centers = np.exp(np.arange(math.log(band.lowest), math.log(band.highest), 0.12))
    spacing = frequency[1] - frequency[0] if len(frequency) > 1 else frequency[0]
    width = np.maximum(0.06 * centers, 0.5 * spacing)
    window = np.exp(-0.5 * ((frequency - centers[:, None]) / width[:, None]) ** 2)
    return window / window.sum(axis=1, keepdims=True)
