"""The frequencies of a bearing drawn into a spectrum: lines with names that do not overlap.

Each family of lines has a row for its names at the top of the frame. Only as many lines are named
as have room.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.diagnosis.machine import Turning
from bearing_explorer.kit.plots.layers import Layer, names_over, uprights
from bearingcore import Scene

NAME_WIDTH = 0.13
"""Width of a family's first name with its frequency, as a share of the frame's width."""
ORDER_WIDTH = 0.042
"""Width of the name of a harmonic, as a share of the frame's width."""
ROW_PIXELS = 17.0
MOST_LINES = 3000
"""Largest number of lines of a spectrum that are drawn."""
NAME_COLUMNS = ("frequency", "order", "first", "row", "of", "spread")
"""Columns of the sources of names; an estimated frequency may be off by `spread` [Hz]."""


@dataclass(frozen=True)
class Family:
    """Lines at multiples of one frequency; `most` of them are drawn."""

    name: str
    title: str
    about: str
    color: str
    ink: str
    most: float = math.inf


FAMILIES = (
    Family("bpfo", "BPFO", "balls pass a point of the outer race", "#E69F00", "#8A5A00"),
    Family("bpfi", "BPFI", "balls pass a point of the inner race", "#AA3377", "#94407A"),
    Family(
        "bsf", "BSF", "a ball spins; a spot on it strikes twice a turn", "#009E73", "#00704F", 6
    ),
    Family("ftf", "FTF", "the cage turns", "#56B4E9", "#1F6F9F", 3),
)
"""Families of lines, in the order of their rows."""

_WORDS = """
if (row.order == 1) {
  const name = '%(title)s' + (row.of ? ` row ${row.of}` : ''), first = rounded(row.first, 4)
  const give = row.spread > 0 ? ` ± ${rounded(row.spread, 1)}` : ''
  let room = Infinity  // letters up to the next name
  try { room = %(room)s*plot.inner_width/(5.8*larger) } catch {}
  const longer = [`${name} ${first}${give} Hz`, `${name} ${first} Hz`]
  return longer.find(text => text.length < room) ?? name
}
return `${row.order}×`
"""


def fundamentals(scene: Scene | Turning, row: int = 0) -> dict[str, float]:
    """First frequency [Hz] of each family, of a row, at the scene's shaft speed."""
    bearing, speed = scene.bearing.of_row(row), scene.shaft_speed
    return {
        "bpfo": bearing.bpfo(speed),
        "bpfi": bearing.bpfi(speed),
        "bsf": bearing.bsf(speed),
        "ftf": bearing.ftf(speed),
    }


def spreads(scene: Scene | Turning, row: int = 0) -> dict[str, float]:
    """Errors [Hz] of each family, by its name and "_spread", if the bearing is an estimate."""
    bearing, first = scene.bearing.of_row(row), fundamentals(scene, row)
    return {
        f"{name}_spread": value * bearing.frequency_spread(name) for name, value in first.items()
    }


def row_frequencies(scene: Scene | Turning) -> list[dict[str, float]]:
    """`fundamentals` and `spreads` of each unlike row; one entry if all rows are alike."""
    rows = range(len(scene.bearing.unlike_rows))
    return [fundamentals(scene, row) | spreads(scene, row) for row in rows]


def orders(family: Family, first: float, top: float) -> NDArray[np.float64]:
    """Multiples of `first` [Hz] that a family has up to `top` [Hz]."""
    if not first > 0.0:
        return np.zeros(0)
    count = int(min(family.most, top / first + 1e-9))
    return 1.0 + np.arange(max(count, 0), dtype=float)


def labelled(multiples: NDArray[np.float64], first: float, top: float) -> NDArray[np.float64]:
    """Return the multiples of a family whose names do not overlap: the first, then every nth."""
    if not multiples.size:
        return multiples
    # the smallest step of 1, 2, 5, 10, ... with room for the names of harmonics
    step = next(
        step * 10**power
        for power in range(9)
        for step in (1, 2, 5)
        if step * 10**power * first >= ORDER_WIDTH * top
    )
    # none is cut off at the right end, or covered by the first name, which is longer
    from_end = multiples * first <= (1.0 - 0.6 * ORDER_WIDTH) * top
    clear = multiples * first >= multiples[0] * first + NAME_WIDTH * top
    kept = ((multiples % step == 0.0) & clear & from_end) | (multiples == 1.0)
    return multiples[kept]


def thin_to_peaks(
    frequency: NDArray[np.float64], height: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a spectrum of at most `MOST_LINES` lines: the highest of each group of neighbours."""
    size = max(math.ceil(frequency.size / MOST_LINES), 1)
    count = frequency.size // size * size
    highest = height[:count].reshape(-1, size).argmax(axis=1) + np.arange(0, count, size)
    return frequency[highest], height[highest]


def layers(prefix: str) -> list[Layer]:
    """Return the lines of all families and their names, from sources with a prefix."""
    drawn: list[Layer] = []
    for family in FAMILIES:
        source = f"{prefix}_{family.name}"
        words = _WORDS % {"title": family.title, "room": NAME_WIDTH}
        drawn += [
            uprights(source, "frequency", family.color, 1.1, 0.6, level="underlay"),
            names_over(f"{source}_names", words, "frequency", "row", family.ink, NAME_COLUMNS,
                       x_offset=3),
        ]  # fmt: skip
    return drawn


def columns(
    prefix: str, sets: Sequence[dict[str, float]], shown: Sequence[str], top: float, height: float
) -> dict[str, dict[str, NDArray[np.float64]]]:
    """Return sources with the lines of the families `shown` up to `top` [Hz], and their names.

    `sets` come from `row_frequencies`; each of several sets has names of its own. `height` is the
    height of the frame [px].
    """
    sources: dict[str, dict[str, NDArray[np.float64]]] = {}
    row = 0
    for family in FAMILIES:
        lines, names = [np.zeros(0)], [np.zeros((len(NAME_COLUMNS), 0))]
        for number, first in enumerate(sets if family.name in shown else ()):
            fundamental = first[family.name]
            multiples = orders(family, fundamental, top)
            row += 1
            labels = labelled(multiples, fundamental, top)
            lines.append(multiples * fundamental)
            place = np.full(labels.size, 1.0 - ROW_PIXELS / height * (row - 0.2))
            set_number = np.full(labels.size, number + 1.0 if len(sets) > 1 else 0.0)
            spread = np.full(labels.size, first.get(f"{family.name}_spread", 0.0))
            frequency = labels * fundamental
            names.append(np.stack([frequency, labels, frequency, place, set_number, spread]))
        sources[f"{prefix}_{family.name}"] = {"frequency": np.concatenate(lines)}
        sources[f"{prefix}_{family.name}_names"] = dict(
            zip(NAME_COLUMNS, np.concatenate(names, axis=1), strict=True)
        )
    return sources
