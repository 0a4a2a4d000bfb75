"""The signal of a diagnosis: its usable directions, their faults, and their envelopes."""

from __future__ import annotations

import copy
from collections.abc import Sequence

import numpy as np

from bearingcore.measured.diagnosis._part import say
from bearingcore.measured.diagnosis._part.combs import HARMONICS
from bearingcore.measured.diagnosis._part.parts import PartLines
from bearingcore.measured.diagnosis._part.shaft import ShaftLines, shaft_lines
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus, Reason
from bearingcore.measured.signals._dropouts import SignalFaults, signal_faults
from bearingcore.measured.signals._filter_bank import Envelope, split, squared_envelopes
from bearingcore.recordings import Recording

FEWEST_PASSES = 12
"""Fewest knocks of a part in a recording that is analysed."""

MOST_DROPPED = 0.5
"""Greatest share of dropped samples in a direction that is analysed."""

NOISE_FLOOR = 1e-4
"""Deviation of the noise that is added to a signal, relative to its own (-80 dB)."""

ABOVE_ROUNDING = 4.0
"""Density that a tenth of all frequencies exceed while a bearing runs, over that of rounding."""

NARROWEST = 16.0
"""Least width of a band, in shaft frequencies."""

NEAR = 0.01
"""Relative half-width of the finer search around a speed from a wide range."""

WHITENING = 3.0
"""Width over which a signal is whitened, in shaft frequencies."""


class ListenedSignal:
    """The usable directions of a recording, with their faults."""

    def __init__(self, recording: Recording) -> None:
        self.rate = recording.sample_rate
        self.duration = recording.duration
        columns = recording.acceleration.T
        faults = [signal_faults(column) for column in columns]
        usable = [index for index, fault in enumerate(faults) if fault.lost_share <= MOST_DROPPED]
        self.names = [recording.directions[index] for index in usable]
        self._measured = [np.asarray(columns[index]) for index in usable]
        self.columns = [_add_noise(samples) for samples in self._measured]
        self.faults: list[SignalFaults] = [faults[index] for index in usable]
        self.whitening: float | None = WHITENING
        self.unusable: Reason | None = None
        if not usable:
            share = min(fault.lost_share for fault in faults)
            self.unusable = DiagnosisStatus.DROPPED_OUT, say.dropout_message(share)

    def unwhitened(self) -> ListenedSignal:
        """Return the same signal without whitening: resonances and tones keep their level."""
        other = copy.copy(self)
        other.whitening = None
        return other

    @property
    def dropped(self) -> float:
        """Share of the samples that dropped out."""
        return max(fault.dropped_share for fault in self.faults)

    @property
    def clipped(self) -> float:
        """Share of the samples that are clipped."""
        return max(fault.clipped_share for fault in self.faults)

    @property
    def only_rounding(self) -> bool:
        """True if all directions hold only tones, rounding, and the noise that was added.

        Rounding to steps Δ has the power Δ²/12, equal at all frequencies.
        """
        from scipy.signal import welch  # imported late: see `spectrum`

        for samples in self._measured:
            step = float(np.median(np.diff(np.unique(samples)))) if np.ptp(samples) else 0.0
            rounding = step**2 / 12.0 + (NOISE_FLOOR * float(samples.std())) ** 2
            density = welch(samples, self.rate, nperseg=min(4096, len(samples)))[1]
            if np.quantile(density, 0.9) > ABOVE_ROUNDING * (rounding / (0.5 * self.rate)):
                return False
        return True

    def envelopes(self, shaft: float, highest: float) -> list[tuple[str, Envelope]]:
        """Return the envelopes in all bands, with their directions."""
        bands = split(self.rate, NARROWEST * shaft)
        return [
            (name, envelope)
            for name, column, faults in zip(self.names, self.columns, self.faults, strict=True)
            for envelope in squared_envelopes(
                column,
                self.rate,
                bands,
                highest,
                faults.dropped,
                None if self.whitening is None else self.whitening * shaft,
            )
        ]

    def shaft(self, low: float, high: float) -> ShaftLines:
        """Find the shaft's own lines between two frequencies [Hz]."""
        return shaft_lines(self.columns, self.rate, low, high)

    def shaft_tones(self, low: float, high: float) -> ShaftLines:
        """Find the shaft's own lines between two frequencies [Hz], in the vibration alone.

        Damaged balls make combs of the cage in the envelope, which do not belong to the shaft.
        """
        wide = shaft_lines(self.columns, self.rate, low, high, envelopes=False)
        near = wide.frequency * (1.0 - NEAR), wide.frequency * (1.0 + NEAR)
        return shaft_lines(self.columns, self.rate, *near, envelopes=False)


def _add_noise(samples: np.ndarray) -> np.ndarray:
    """Return the samples with the noise that any recorder has.

    A computed signal may have none, and would then show rounding and leakage.
    """
    noise = np.random.default_rng(0).standard_normal(len(samples))
    return np.asarray(samples + NOISE_FLOOR * float(samples.std()) * noise)


def unfit(signal: ListenedSignal, parts: Sequence[PartLines], shaft: float) -> Reason | None:
    """Return the reason why a signal cannot be analysed at a shaft speed [Hz], or None."""
    slowest = min(lines.order for lines in parts) * shaft
    top = max(lines.order for lines in parts) * shaft
    if signal.duration * slowest < FEWEST_PASSES:
        words = say.too_short(signal.duration, signal.duration * slowest, FEWEST_PASSES)
        return DiagnosisStatus.TOO_SHORT, words
    if 0.5 * signal.rate < (HARMONICS + 2.0) * top:
        words = say.too_slow(signal.rate, 2.0 * (HARMONICS + 2.0) * top)
        return DiagnosisStatus.TOO_COARSE, words
    return None
