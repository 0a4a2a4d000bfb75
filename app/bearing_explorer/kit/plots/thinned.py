"""Long lines with no more numbers than can be seen."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray


def least_and_greatest(
    values: NDArray[np.float64], parts: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """At most 2·`parts` numbers that draw the same line as the rows of `values` (n, k).

    Of each of `parts` stretches the least and the greatest number are kept, in the order in which
    they came, so that no peak is lost that a pixel would show. Returns the row numbers at which
    the kept ones stand (the same for all columns) and the kept ones.
    """
    n = len(values)
    if n <= 2 * parts:
        return np.arange(n), values
    size = math.ceil(n / parts)
    count = math.ceil(n / size)
    full = np.concatenate([values, np.repeat(values[-1:], count * size - n, axis=0)])
    blocks = full.reshape(count, size, -1)
    least, greatest = blocks.min(axis=1), blocks.max(axis=1)
    rising = blocks.argmin(axis=1) <= blocks.argmax(axis=1)
    kept = np.empty((count, 2, values.shape[1]))
    kept[:, 0] = np.where(rising, least, greatest)
    kept[:, 1] = np.where(rising, greatest, least)
    starts = np.arange(count) * size
    rows = np.stack([starts, np.minimum(starts + size, n) - 1], axis=1).ravel()
    length = 2 * count - int(rows[-1] == rows[-2])  # a last stretch of one row
    return rows[:length], kept.reshape(2 * count, -1)[:length]
