"""The last ball passes of a motion for the view over time, cut where a ball enters the defect."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore import RACES, Motion, Scene, equilibrium
from bearingcore.common import ResultTable, table_of
from bearingcore.model.statics import Crossing, crossings, drops_at, passing_rate

STATIC_POINTS = 241


@dataclass(frozen=True)
class Event:
    """A ball passing an edge of the defect, `time` [s] on the excerpt's clock."""

    time: float
    ball: int
    enters: bool


@dataclass(frozen=True)
class Excerpt:
    """A short stretch of a motion after its transient.

    time : (n,) [s]
        0 where a ball enters the defect; without a defect, at the start of the stretch.
    motion_time : float
        [s] of the motion at which `time` is 0.
    acceleration : {dof: (n,)} [m/s²]
        of the outer ring with the housing.
    events
        entries and exits within the stretch.
    balls : (k,)
        the balls that enter or leave, counted from 0; if none does, the two that carry most.
    ball_load : (n, k) [N]
        their loads in motion.
    static_time : (p,) [s], static_load : (p, k) [N]
        instants, and the loads of these balls if everything rested there.
    greatest_static_load : float [N]
        greatest static load of any ball.
    static_cage_angle : (p,) [rad], moving_load : (p, N_b) [N], drop : {race: (p, N_b)} [m]
        angle of the cage, load of each ball in motion, and drop of its centre into a defect, at
        the same instants.
    bandwidth : float [Hz]
        up to which the acceleration is known.
    broke_off
        why the motion ended early; empty if it did not.
    """

    time: NDArray[np.float64]
    motion_time: float
    acceleration: dict[str, NDArray[np.float64]]
    events: tuple[Event, ...]
    balls: NDArray[np.int64]
    ball_load: NDArray[np.float64]
    static_time: NDArray[np.float64]
    static_load: NDArray[np.float64]
    greatest_static_load: float
    broke_off: str
    static_cage_angle: NDArray[np.float64]
    moving_load: NDArray[np.float64]
    drop: dict[str, NDArray[np.float64]]
    bandwidth: float

    def table(self) -> ResultTable:
        """Rows in time: acceleration and loads of the motion, and the loads at rest."""
        return table_of(
            ("time", "s", self.time),
            *acceleration_columns("", self.acceleration),
            *self._ball_columns("load", self.ball_load),
            ("static_time", "s", self.static_time),
            *self._ball_columns("static_load", self.static_load),
        )

    def _ball_columns(
        self, name: str, values: NDArray[np.float64]
    ) -> list[tuple[str, str, NDArray[np.float64]]]:
        """Columns of loads (n, k) of the balls."""
        loads = zip(self.balls, values.T, strict=True)
        return [(f"ball_{ball + 1}_{name}", "N", load) for ball, load in loads]


def acceleration_columns(
    prefix: str, acceleration: Mapping[str, NDArray[np.float64]]
) -> Iterator[tuple[str, str, NDArray[np.float64]]]:
    """Columns of accelerations by direction, with `prefix` before their names."""
    for dof, signal in acceleration.items():
        yield f"{prefix}acceleration_{dof}", "rad/s²" if dof.startswith("r") else "m/s²", signal


def why_ended(motion: Motion) -> str:
    """Reason why a motion is not complete, as a clause with the numbers of its status."""
    return motion.status.sentence + motion.detail


def excerpt_of(scene: Scene, motion: Motion, since: float, n_passes: float = 1.5) -> Excerpt:
    """Cut out `n_passes` ball passes, beginning a quarter pass before an entry.

    The motion has settled at `since` [s]; the excerpt lies after that.
    """
    time, cage = motion.time, motion.cage_angle
    start, length, zero = _stretch(scene, motion, since, n_passes)
    first = int(np.searchsorted(time, start))
    last = max(int(np.searchsorted(time, start + length, side="right")), first + 2)
    cut = slice(first, last)
    events = tuple(
        Event(_time_at(scene, motion, event.cage_angle) - zero, event.ball, event.enters)
        for event in crossings(scene, float(cage[cut][0]), float(cage[cut][-1]))
    )
    static_time = np.linspace(time[cut][0], time[cut][-1], STATIC_POINTS)
    static_cage = np.interp(static_time, time, cage)
    static = equilibrium(scene, static_cage).ball_load
    load = motion.ball_loads(first, last)
    balls = np.array(list(dict.fromkeys(event.ball for event in events)), dtype=np.int64)
    if not balls.size:
        balls = np.sort(np.argsort(np.nan_to_num(static).max(axis=0), kind="stable")[-2:])
    return Excerpt(
        time=time[cut] - zero,
        motion_time=zero,
        # copies, because views would keep the whole motion alive
        acceleration={
            dof: motion.outer_acceleration[cut, index].copy()
            for index, dof in enumerate(motion.dofs)
        },
        events=events,
        balls=balls,
        ball_load=load[:, balls],
        static_time=static_time - zero,
        greatest_static_load=float(np.max(np.nan_to_num(static))),
        broke_off="" if motion.completed else why_ended(motion),
        static_load=static[:, balls],
        static_cage_angle=static_cage,
        moving_load=load[np.searchsorted(time[cut], static_time).clip(max=last - first - 1)],
        drop={race: drops_at(scene, static_cage, race) for race in RACES},
        bandwidth=motion.bandwidth,
    )


def _stretch(
    scene: Scene, motion: Motion, since: float, n_passes: float
) -> tuple[float, float, float]:
    """Start, length and zero of the excerpt [s], after `since`."""
    end = float(motion.time[-1])
    settled = end - since
    speed = scene.cage_speed
    if speed == 0.0:
        return since, settled, since
    defects = scene.defects
    rate = abs(passing_rate(scene, defects[0], defects[0].row or 0)) if defects else 1.0
    one_pass = scene.bearing.ball_spacing / (rate * speed)
    length = min(n_passes * one_pass, settled)
    before = 0.25 * min(one_pass, length)
    latest = end - length + before
    entries = [
        event
        for event in crossings(
            scene, float(motion.cage_angle[-1]) - settled * speed, float(motion.cage_angle[-1])
        )
        if event.enters and since + before <= _time_at(scene, motion, event.cage_angle) <= latest
    ]
    if entries:
        entry = _time_at(scene, motion, _most_loaded_entry(scene, entries).cage_angle)
        return entry - before, length, entry
    return end - length, length, end - length


def _most_loaded_entry(scene: Scene, entries: list[Crossing]) -> Crossing:
    """Choose the entry whose ball would carry the most load without the defect.

    A defect of the inner race meets balls all around, most of them without load. Among equals the
    first ball is taken, not the last entry: the last one depends on the duration of the motion,
    and the words of a drawing should not change because a motion was simulated for longer.
    """
    angles = np.array([entry.cage_angle for entry in entries])
    loads = np.nan_to_num(equilibrium(scene.healthy(), angles).ball_load)
    load = loads[np.arange(len(entries)), [entry.ball for entry in entries]]
    most = np.flatnonzero(load >= load.max() * (1.0 - 1e-6))
    return min((entries[int(i)] for i in most), key=lambda entry: (entry.ball, -entry.cage_angle))


def _time_at(scene: Scene, motion: Motion, cage_angle: float) -> float:
    """Time [s] of the motion at which the cage, which turns steadily, passes `cage_angle` [rad]."""
    end_angle, end = float(motion.cage_angle[-1]), float(motion.time[-1])
    if scene.cage_speed == 0.0:
        return math.nan
    return end - (end_angle - cage_angle) / scene.cage_speed
