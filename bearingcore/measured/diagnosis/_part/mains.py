"""Signals of the mains: lines at multiples of 50 or 60 Hz, and noise of the motor.

The magnetic pull of a motor, and its noise, is greatest twice a period of the mains. The modulation
of that noise is like that of a damaged part whose impacts come at 100 or 120 Hz.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.measured.signals._line_levels import LineLevels

MAINS = (50.0, 60.0)
"""Frequencies [Hz] of the mains."""

MAINS_DEVIATION = 0.002
"""Largest relative deviation of the mains during a signal. Large grids exceed half of that only for
minutes (standard range 50 mHz of 50 Hz, EU 2017/1485); the clock of a recorder adds to it."""


def mains_lines(levels: LineLevels, mains: float, resolution: float) -> NDArray[np.bool_]:
    """Mask of the frequencies (m,) that harmonics of the mains [Hz] can explain.

    With a Hann window a tone has 1/(π d (d² − 1)) of its height at a distance of d resolutions. It
    disappears in the noise where this share is 1/height.
    """
    hidden = np.zeros(len(levels.level), dtype=bool)
    frequency = levels.step * np.arange(len(hidden))
    for middle in np.arange(mains, frequency[-1] + mains, mains).tolist():
        reach = 1.5 * resolution + MAINS_DEVIATION * middle
        first, last = np.searchsorted(frequency, (middle - reach, middle + reach)).tolist()
        height = 10.0 ** (0.05 * float(levels.level[first:last].max(initial=0.0)))
        reach = MAINS_DEVIATION * middle + resolution * max(
            1.5, 0.5 + (height / math.pi) ** (1.0 / 3.0)
        )
        first, last = np.searchsorted(frequency, (middle - reach, middle + reach)).tolist()
        hidden[first:last] = True
    return hidden


WITHIN = 0.01
"""Largest relative deviation of twice the mains frequency: EN 50160 allows 1 %, except in half a
per cent of a year."""

SCALE = WITHIN / math.log(1.0 / 0.005)
"""Deviation over which the probability density falls by a factor e: 0.5 % lie beyond `WITHIN`."""


def twice_mains(frequency: float) -> float | None:
    """Return 100 or 120 Hz if a frequency [Hz] may be that of magnetic noise; else None."""
    for mains in MAINS:
        if abs(frequency / (2.0 * mains) - 1.0) <= WITHIN:
            return 2.0 * mains
    return None


def magnetic_share(frequency: float, uncertainty: float, slip: float) -> float:
    """Return the probability that lines at a frequency [Hz] are magnetic noise, if they are there.

    Bayes' rule, with equal prior odds of magnetic noise and damage. Lines of damage are equally
    likely anywhere within the slip. Lines of magnetic noise are less likely the farther they are
    from twice the mains frequency, beyond the `uncertainty` [Hz]. The result is 0 beyond 1 %.
    """
    middle = twice_mains(frequency)
    if middle is None:
        return 0.0
    deviation = max(0.0, abs(frequency - middle) - uncertainty) / middle
    magnetic = math.exp(-deviation / SCALE) / (2.0 * SCALE)
    return magnetic / (magnetic + 1.0 / max(2.0 * slip, WITHIN))
