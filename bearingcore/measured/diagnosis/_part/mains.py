"""Signals of the mains: lines at multiples of 50 or 60 Hz, and noise of the motor.

The magnetic pull of a motor, and the noise that it makes, is greatest twice a period of the mains:
it modulates as a damaged part does whose impacts come at 100 or 120 Hz.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.measured.signals._line_levels import LineLevels

MAINS = (50.0, 60.0)
"""Frequencies [Hz] of the mains."""

MAINS_DEVIATION = 0.002
"""Fraction by which the mains' frequency may be off while a signal lasts. Large grids stay
within half of that but for minutes (standard range 50 mHz of 50 Hz, EU 2017/1485); a recorder's
clock adds to it."""


def mains_lines(levels: LineLevels, mains: float, resolution: float) -> NDArray[np.bool_]:
    """Mask of the frequencies (m,) that harmonics of the mains [Hz] can explain.

    Hann's window lets a tone show at d times the resolution with 1/(π d (d² − 1)) of its height,
    at which it is hidden in the noise when that is 1/height.
    """
    hidden = np.zeros(len(levels.level), dtype=bool)
    at = levels.step * np.arange(len(hidden))
    for middle in np.arange(mains, at[-1] + mains, mains).tolist():
        reach = 1.5 * resolution + MAINS_DEVIATION * middle
        first, last = np.searchsorted(at, (middle - reach, middle + reach)).tolist()
        height = 10.0 ** (0.05 * float(levels.level[first:last].max(initial=0.0)))
        reach = MAINS_DEVIATION * middle + resolution * max(
            1.5, 0.5 + (height / math.pi) ** (1.0 / 3.0)
        )
        first, last = np.searchsorted(at, (middle - reach, middle + reach)).tolist()
        hidden[first:last] = True
    return hidden


WITHIN = 0.01
"""Fraction by which twice the mains' frequency may be off: EN 50160 allows 1 % in all but half
a per cent of a year."""

SCALE = WITHIN / math.log(1.0 / 0.005)
"""Scale of odds that fall exponentially with the deviation: half a per cent lie beyond."""


def twice_mains(frequency: float) -> float | None:
    """100 or 120 Hz, where a frequency [Hz] is that of magnetic noise; else None."""
    for mains in MAINS:
        if abs(frequency / (2.0 * mains) - 1.0) <= WITHIN:
            return 2.0 * mains
    return None


def magnetic_share(frequency: float, uncertainty: float, slip: float) -> float:
    """Probability that lines at a frequency [Hz] are magnetic noise, if they are there.

    Bayes' rule: before the frequency is known magnetic noise is as probable as damage. The lines of
    damage are anywhere within the slip, those of noise the rarer the farther they are from twice
    the mains' frequency, beyond what is uncertain [Hz]. 0 where that is more than 1 %.
    """
    middle = twice_mains(frequency)
    if middle is None:
        return 0.0
    away = max(0.0, abs(frequency - middle) - uncertainty) / middle
    magnetic = math.exp(-away / SCALE) / (2.0 * SCALE)
    return magnetic / (magnetic + 1.0 / max(2.0 * slip, WITHIN))
