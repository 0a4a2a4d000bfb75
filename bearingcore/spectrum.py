"""Power spectral density of a signal."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore import checks


class Spectrum(NamedTuple):
    """One-sided power spectral density.

    Attributes
    ----------
    frequency : (m,) [Hz]
    density : (m,) or (m, k) [(unit of the signal)²/Hz]
    """

    frequency: NDArray[np.float64]
    density: NDArray[np.float64]


def spectrum(signal: ArrayLike, sample_rate: float, resolution: float = 32.0) -> Spectrum:
    """Spectrum by Welch's method: Hann window, segments of 1/resolution seconds, half overlapping.

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
        where a sample is not finite, or the signal is shorter than one segment.
    """
    from scipy.signal import welch  # imported late: it would double the time to import this package

    samples = np.asarray(signal, dtype=float)
    rate = checks.number("sample_rate", sample_rate, above=0.0, unit="Hz")
    step = checks.number("resolution", resolution, above=0.0, at_most=0.5 * rate, unit="Hz")
    segment = round(rate / step)
    if samples.ndim not in (1, 2) or len(samples) < segment:
        raise checks.refuse(
            "signal", f"of shape {samples.shape}", f"at least {segment} samples, one segment"
        )
    if not np.all(np.isfinite(samples)):
        raise checks.refuse("signal", "not finite everywhere", "finite numbers")
    # one signal after another in memory: a third faster than along the first axis
    rows = np.ascontiguousarray(samples.T)
    frequency, density = welch(rows, fs=rate, nperseg=segment)
    return Spectrum(frequency, density.T)
