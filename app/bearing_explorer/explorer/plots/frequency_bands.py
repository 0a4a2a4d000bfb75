"""Bands of natural frequencies over spectra: their columns, names and places of the names."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.kit.plots import style

LABEL_WIDTH = 0.17  # of a name, as a share of the width of a spectrum

BAND_NAME = """
const name = ['x', 'y', 'z', 'θx', 'θy'][row.direction] + '₀₁₂₃₄₅₆₇₈₉'[row.number]
"""
BAND_SPAN = """
const low = row.low.toFixed(0), high = row.high.toFixed(0)
return low == high ? `${name} ${low} Hz` : `${name} ${low}–${high} Hz`
"""
SHORT_BAND_WORDS = f"{BAND_NAME}\nif (narrow) return name\n{BAND_SPAN}"
"""JavaScript of `layers.Words`: name and span of a band; only the name in a narrow frame."""


def band_rows(bands: Mapping[str, tuple[float, float]]) -> dict[str, np.ndarray]:
    """Bands as columns: low and high [Hz], index of the direction, number of the mode."""
    rows = [
        (low, high, style.DIRECTIONS.index(label[:-1]), int(label[-1]))
        for label, (low, high) in bands.items()
        if np.isfinite(low)
    ]
    low, high, direction, number = np.array(rows, dtype=float).reshape(-1, 4).T
    return {"low": low, "high": high, "direction": direction, "number": number}


def highest(bands: Mapping[str, tuple[float, float]]) -> float:
    """The upper end [Hz] of the highest band; 0 without one."""
    return float(np.max(band_rows(bands)["high"], initial=0.0))


def bands_along(
    bands: Mapping[str, tuple[float, float]], dof: str, top: float
) -> dict[str, np.ndarray]:
    """`band_rows` of one direction, with the places of their names up to `top` [Hz]."""
    rows = band_rows({label: ends for label, ends in bands.items() if label[:-1] == dof})
    middle = 0.5 * (rows["low"] + rows["high"])
    return {**rows, "label_at": spread(middle, LABEL_WIDTH * top, 0.0, top)}


def spread(
    places: NDArray[np.float64], apart: float, lowest: float, highest: float
) -> NDArray[np.float64]:
    """Move `places` as little as possible: at least `apart` from each other, within the limits.

    Neighbours that are too close become a group around the mean of their places; groups that meet
    are joined. If the room is too small for all, they keep their distance and overrun the limit.
    """
    order = np.argsort(places, kind="stable")
    groups: list[list[float]] = []  # of the places as given, lowest first
    for place in places[order]:
        groups.append([float(place)])
        while len(groups) > 1 and _bottom(groups[-1], apart, lowest, highest) < (
            _bottom(groups[-2], apart, lowest, highest) + apart * len(groups[-2])
        ):
            last = groups.pop()
            groups[-1] += last
    moved = [
        _bottom(group, apart, lowest, highest) + apart * i
        for group in groups
        for i in range(len(group))
    ]
    result = np.empty(places.size)
    result[order] = moved
    return result


def _bottom(group: list[float], apart: float, lowest: float, highest: float) -> float:
    """Moved place of the lowest member of a group, whose members are `apart`."""
    height = apart * (len(group) - 1)
    wanted = float(np.mean(group)) - 0.5 * height
    return max(min(wanted, highest - 0.5 * apart - height), lowest + 0.5 * apart)
