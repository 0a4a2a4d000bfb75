"""Balls with mass between their races: when they fly free, and when and how hard they strike."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bearingcore.common.arrays import Array, runs


@dataclass(frozen=True)
class Flight:
    """A ball that touches neither race from `begin` to `end` [s], counted from 0."""

    ball: int
    begin: float
    end: float


@dataclass(frozen=True)
class Strike:
    """A ball that comes down onto a race it did not touch.

    `time` [s] is that of the first touch, `load` [N] the first peak of the contact's load, reached
    at `peak` [s]: what comes later is no longer the strike.
    """

    ball: int
    race: str
    time: float
    load: float
    peak: float


def flights(time: Array, loads: Array) -> tuple[Flight, ...]:
    """Free flights of balls with loads (2, n, N_b) [N] at inner and outer race, times (n,) [s].

    As `Motion.race_loads` gives them. A flight that is under way at an end is cut there.
    """
    free = np.asarray((loads <= 0.0).all(axis=0))
    return tuple(
        Flight(ball, float(time[first]), float(time[end - 1]))
        for ball in range(free.shape[1])
        for first, end in zip(*runs(free[:, ball]), strict=True)
    )


def ball_strikes(time: Array, loads: Array) -> tuple[Strike, ...]:
    """All strikes of balls with such loads, in the order of time.

    A contact that is closed at the first time has not been seen to strike.
    """
    found = []
    for index, race in enumerate(RACES_OF_LOADS):
        for ball in range(loads.shape[2]):
            load = loads[index, :, ball]
            for first, end in zip(*runs(load > 0.0), strict=True):
                if first == 0:
                    continue
                falls = np.flatnonzero(np.diff(load[first:end]) <= 0.0)
                peak = first + int(falls[0]) if falls.size else end - 1
                found.append(
                    Strike(ball, race, float(time[first]), float(load[peak]), float(time[peak]))
                )
    return tuple(sorted(found, key=lambda strike: (strike.time, strike.ball)))


RACES_OF_LOADS = ("inner", "outer")
"""In the order of the loads."""
