"""Power spectral density of a signal, and of its envelope."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common import Array, ResultTable, _checks as checks, shown_as_table, table_of


@shown_as_table
class Spectrum(NamedTuple):
    """One-sided power spectral density.

    Attributes
    ----------
    frequency : (m,) [Hz]
    density : (m,) or (m, k) [(unit of the signal)²/Hz]
    """

    frequency: Array
    density: Array

    def up_to(self, frequency: float) -> Spectrum:
        """Return the spectrum up to a frequency [Hz]."""
        end = int(np.searchsorted(self.frequency, frequency, side="right"))
        return Spectrum(self.frequency[:end], self.density[:end])

    def powers(self, edges: ArrayLike) -> Array:
        """Return the power (n,) or (n, k) [(unit of the signal)²] between n + 1 edges [Hz]."""
        ends = np.searchsorted(self.frequency, edges)
        sums = [self.density[low:high].sum(axis=0) for low, high in pairwise(ends)]
        return np.array(sums) * (self.frequency[1] - self.frequency[0])

    def table(self, directions: Sequence[str] = (), unit: str = "(m/s²)²/Hz") -> ResultTable:
        """Return a row for each frequency, with densities named by `directions` or by numbers."""
        columns = self.density.reshape(len(self.frequency), -1).T
        suffixes = directions or [str(k + 1) for k in range(len(columns))]
        names = [f"density_{suffix}" for suffix in suffixes]
        if not directions and len(columns) == 1:
            names = ["density"]
        if len(names) != len(columns):
            raise checks.refuse("directions", tuple(directions), f"{len(columns)} names")
        return table_of(
            ("frequency", "Hz", self.frequency),
            *((name, unit, values) for name, values in zip(names, columns, strict=True)),
        )


def spectrum(
    signal: ArrayLike,
    sample_rate: float,
    resolution: float = 32.0,
) -> Spectrum:
    """Compute a spectrum by Welch's method: Hann window, segments of 1/resolution s, half overlap.

    Parameters
    ----------
    signal : (n,) or (n, k)
        k signals side by side.
    sample_rate
        [Hz].
    resolution
        [Hz] spacing of the frequencies, rounded so that a segment is a whole number of samples.

    Raises
    ------
    ValueError
        if a sample is not finite, or the signal is shorter than one segment.
    """
    from scipy.signal import welch  # imported late: it would double the time to import this package

    rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
    step = checks.real_number("resolution", resolution, above=0.0, at_most=0.5 * rate, unit="Hz")
    segment = round(rate / step)
    samples = checks.samples_of(signal, segment, "one segment")
    # contiguous signals are a third faster than signals along the first axis
    rows = np.ascontiguousarray(samples.T)
    frequency, density = welch(rows, fs=rate, nperseg=segment)
    return Spectrum(frequency, density.T)


def envelope_spectrum(
    signal: ArrayLike,
    sample_rate: float,
    band: tuple[float, float],
    resolution: float | None = None,
) -> Spectrum:
    """Compute the spectrum of the envelope of a signal inside a band.

    The signal is filtered to the band without delay (Butterworth, forwards and backwards); its
    envelope is the magnitude of the analytic signal. Repeated knocks show as lines at their
    repetition frequency and its multiples, independent of the resonance that they excite.

    Parameters
    ----------
    signal : (n,) or (n, k)
        k signals side by side.
    sample_rate
        [Hz].
    band
        (from, to) [Hz], between 0 and half the sample rate.
    resolution
        [Hz]; None takes the whole signal as one segment, which is the finest resolution.

    Raises
    ------
    ValueError
        if a sample is not finite, the signal is too short, or the band does not fit.
    """
    from scipy.fft import next_fast_len  # imported late, as above
    from scipy.signal import butter, hilbert, sosfiltfilt

    rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
    try:
        low, high = band
    except (TypeError, ValueError):
        raise checks.refuse("band", band, "two frequencies [Hz]") from None
    low = checks.real_number("lower end of the band", low, above=0.0, below=0.5 * rate, unit="Hz")
    high = checks.real_number("upper end of the band", high, above=low, below=0.5 * rate, unit="Hz")
    samples = checks.samples_of(signal, 64, "a filter's length")
    sections = butter(4, (low, high), "bandpass", fs=rate, output="sos")
    inside = sosfiltfilt(sections, samples, axis=0)
    size = next_fast_len(len(inside))  # a length with a large prime factor would take far longer
    envelope = np.abs(hilbert(inside, size, axis=0))[: len(inside)]
    if resolution is None:
        resolution = rate / len(samples)
    return spectrum(envelope - envelope.mean(axis=0), rate, resolution)
