"""Motions of a scene without and with the mass of its balls, and their difference."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bearingcore as core
from bearing_explorer.explorer.results.excerpt import (
    Event,
    acceleration_columns,
    excerpt_of,
    why_ended,
)
from bearingcore import RACES, Motion, Scene
from bearingcore.common import ResultTable, level_difference, table_of
from bearingcore.model.dynamics import (
    QUIETEST_COMPARED,
    RACES_OF_LOADS,
    SETTLING,
    BallComparison,
    Flight,
    Strike,
    ball_strikes,
    compare_motions as compare_bands,
    compared_directions,
    flights,
)
from bearingcore.model.statics import path_kinks

Array = NDArray[np.float64]

LOWEST_OCTAVE = 250.0
"""Frequency [Hz] at which the lowest octave begins, eight lines of the spectra above zero."""

BEFORE, AFTER = 0.4, 1.1
"""Time shown before a ball enters and after it leaves, relative to its time in the defect."""
SHORTEST_LOOK = 1e-3
"""Shortest time [s] that is shown."""

PARTS = 4
"""Number of parts of the settled motion, for the scatter of the powers in octaves."""
SHORTEST_PART = 4096  # samples

LATE = 1.5
"""Latest strike that a ball's way through the defect causes, relative to its time in the defect."""

HARD, MOST_STRIKES = 0.4, 2
"""Least load of a shown strike relative to the hardest on its race; most strikes of a race. These
loads are elastic: the dashpot of a contact adds most of the force on the housing."""

ENOUGH_PASSES = (3.0, 1.0, 0.6)
"""Ball passes from which the stretch is cut; fewer if the motion is too short for more."""


@dataclass(frozen=True)
class BallMass:
    """Two motions of one scene, massless balls and balls with mass, over the same time.

    Attributes
    ----------
    scene, sample_rate [Hz]
        scene that moves; sample rate of its motions.
    broke_off
        reason why one of the motions ended early; empty if none did.
    time : (n,) [s]
        times around a ball's way through the defect; it enters at 0.
    massless, with_mass : {dof: (n,)} [m/s²]
        acceleration of the housing.
    balls : (k,), loads : (2, n, k) [N]
        the balls that enter or leave, counted from 0, and their loads at the inner and outer race.
    events, flights
        of these balls.
    strikes
        hard strikes of the ball that enters at 0, each on a race that it had left.
    far_edge [s]
        time at which that ball meets the far edge, if it leaves neither race; else NaN.
    octaves : (m + 1,) [Hz], share : (m,), spread : (m,)
        edges, share of the power along x and y that mass adds, 1 − P(massless)/P(with mass), and
        its standard error over parts of the motion, NaN where that is too short for it.
    added : (m,) [dB]
        ratio of the powers with and without mass.
    comparison
        frequency up to which massless balls are accurate; None if the motions are too short.
    quiet : (m,)
        True where the power is negligible beside that of the loudest octave.
    """

    scene: Scene
    sample_rate: float
    broke_off: str
    time: Array
    massless: dict[str, Array]
    with_mass: dict[str, Array]
    balls: NDArray[np.int64]
    loads: Array
    events: tuple[Event, ...]
    flights: tuple[Flight, ...]
    strikes: tuple[Strike, ...]
    far_edge: float
    octaves: Array
    share: Array
    spread: Array
    added: Array
    quiet: NDArray[np.bool_]
    comparison: BallComparison | None

    def table(self) -> ResultTable:
        """One row for each time: acceleration without and with mass, ball loads at both races."""
        loads = [
            (f"ball_{ball + 1}_{race}_race_load", "N", load[:, k])
            for k, ball in enumerate(self.balls)
            for race, load in zip(RACES_OF_LOADS, self.loads, strict=True)
        ]
        return table_of(
            ("time", "s", self.time),
            *acceleration_columns("massless_", self.massless),
            *acceleration_columns("with_mass_", self.with_mass),
            *loads,
        )

    def share_table(self) -> ResultTable:
        """One row for each octave: the share of the power that mass adds."""
        return table_of(
            ("lowest_frequency", "Hz", self.octaves[:-1]),
            ("highest_frequency", "Hz", self.octaves[1:]),
            ("mass_share", "1", self.share),
            ("mass_share_standard_error", "1", self.spread),
            ("added", "dB", self.added),
            ("quiet", "", self.quiet),
        )

    @property
    def free_share(self) -> float:
        """Share of the shown time that the shown balls spend in free flight."""
        return float((self.loads <= 0.0).all(axis=0).mean())


def compare_motions(massless: Motion, heavy: Motion, since: float) -> BallMass:
    """Compare two motions of equal duration and sample rate, which have settled at `since` [s]."""
    scene, rate = heavy.scene, heavy.sample_rate
    for passes in ENOUGH_PASSES:
        whole = excerpt_of(scene, heavy, since, n_passes=passes)
        if entry_of(whole.events) is not None:
            break
    # the stretch shown: one ball's way through the defect, with the time before and after it
    start, end = _shown_time(whole.events, whole.time)
    begin = round((whole.motion_time + start) * rate)
    stop = min(max(round((whole.motion_time + end) * rate), begin + 2), len(heavy.time))
    time = heavy.time[begin:stop] - whole.motion_time
    events = tuple(event for event in whole.events if start <= event.time <= end)
    balls = np.array(list(dict.fromkeys(event.ball for event in events)), dtype=np.int64)
    balls = balls if balls.size else whole.balls
    loads = heavy.race_loads(begin, stop)[:, :, balls]
    strikes = _strikes(time, loads, balls, events)
    dofs = compared_directions(heavy.dofs)
    columns = [heavy.dofs.index(dof) for dof in dofs]
    shown = [
        dict(zip(dofs, motion.outer_acceleration[begin:stop, columns].T, strict=True))
        for motion in (massless, heavy)
    ]
    # power in octaves, from everything after the start-up
    first = math.ceil(since * rate - 1e-6)
    late = [motion.outer_acceleration[first:, columns] for motion in (massless, heavy)]
    finite = all(np.isfinite(signal).all() for signal in late)
    bandwidth = min(massless.bandwidth, heavy.bandwidth)
    octaves = _octaves(bandwidth)
    known = finite and bool(dofs)
    power = [_powers(s, rate, bandwidth, octaves, known) for s in late]
    added = level_difference(power[1], power[0])
    with np.errstate(divide="ignore", invalid="ignore"):
        share = 1.0 - power[0] / power[1]
    return BallMass(
        scene=scene,
        sample_rate=rate,
        broke_off=next((why_ended(m) for m in (massless, heavy) if not m.completed), ""),
        time=time,
        massless=shown[0],
        with_mass=shown[1],
        balls=balls,
        loads=loads,
        events=events,
        flights=tuple(
            Flight(int(balls[flight.ball]), flight.begin, flight.end)
            for flight in flights(time, loads)
        ),
        strikes=strikes,
        far_edge=math.nan if strikes else _far_edge(scene, events, whole.motion_time),
        octaves=octaves,
        share=share,
        spread=_spread(late, rate, octaves) if known else np.full_like(share, math.nan),
        added=added,
        quiet=power[1] < QUIETEST_COMPARED * np.max(power[1], initial=0.0),
        comparison=_comparison(massless, heavy),
    )


def _powers(signal: Array, rate: float, bandwidth: float, octaves: Array, known: bool) -> Array:
    """Power in each octave, summed over the directions; NaN unless `known`."""
    if not known:
        return np.full(len(octaves) - 1, math.nan)
    return core.spectrum(signal, rate).up_to(bandwidth).powers(octaves).sum(axis=1)


def _comparison(massless: Motion, heavy: Motion) -> BallComparison | None:
    """Compare both motions in bands of frequency; None if they are too short."""
    enough = len(heavy.time) > 2.0 * SETTLING * heavy.sample_rate
    if not (enough and massless.completed and heavy.completed):
        return None
    return compare_bands(massless, heavy)


def _shown_time(events: tuple[Event, ...], time: Array) -> tuple[float, float]:
    """First and last time [s] shown around the way of the ball that enters at 0."""
    last = exit_of(events)
    if last is None:
        return float(time[0]), float(time[-1])
    leaves = last.time
    start = max(float(time[0]), -max(BEFORE * leaves, 0.3 * SHORTEST_LOOK))
    end = leaves + max(AFTER * leaves, 0.7 * SHORTEST_LOOK)
    return start, min(float(time[-1]), end)


def entry_of(events: tuple[Event, ...]) -> Event | None:
    """Entry of a ball at time 0; None without one."""
    return next((e for e in events if e.enters and abs(e.time) < 1e-8), None)


def exit_of(events: tuple[Event, ...]) -> Event | None:
    """Exit of the ball that enters at 0; None without one."""
    entry = entry_of(events)
    if entry is None:
        return None
    return next((e for e in events if not e.enters and e.ball == entry.ball and e.time > 0.0), None)


def _strikes(
    time: Array, loads: Array, balls: NDArray[np.int64], events: tuple[Event, ...]
) -> tuple[Strike, ...]:
    """The hardest strikes on each race of the ball that enters at 0, caused by the defect."""
    entry, leaves = entry_of(events), exit_of(events)
    if entry is None:
        return ()
    slot = int(np.flatnonzero(balls == entry.ball)[0])
    until = float(time[-1]) if leaves is None else LATE * leaves.time
    hits = [s for s in ball_strikes(time, loads[:, :, [slot]]) if 0.0 < s.time <= until]
    strikes = []
    for race in RACES:
        hard = sorted((s for s in hits if s.race == race), key=lambda s: -s.load)[:MOST_STRIKES]
        strikes += [
            dataclasses.replace(strike, ball=entry.ball)
            for strike in hard
            if strike.load >= HARD * hard[0].load
        ]
    return tuple(sorted(strikes, key=lambda strike: strike.time))


def _far_edge(scene: Scene, events: tuple[Event, ...], zero: float) -> float:
    """Time [s] at which the ball that enters at 0 meets the far edge; NaN without an edge.

    `zero` [s]: time of the motion at which it enters.
    """
    leaves = exit_of(events)
    if leaves is None:
        return math.nan
    first = scene.cage_speed * zero
    last = first + scene.cage_speed * leaves.time
    margin = 1e-6 * (last - first)
    corners = path_kinks(scene, first + margin, last - margin)
    return float((corners[-1] - first) / scene.cage_speed) if corners.size else math.nan


def _octaves(bandwidth: float) -> Array:
    """Edges [Hz] of octaves; the last band, at least half an octave, ends at the bandwidth."""
    count = math.floor(math.log2(bandwidth / LOWEST_OCTAVE))
    edges = LOWEST_OCTAVE * 2.0 ** np.arange(count + 1, dtype=np.float64)
    return np.append(edges, bandwidth) if bandwidth > math.sqrt(2.0) * edges[-1] else edges


def _spread(late: list[Array], rate: float, edges: Array) -> Array:
    """Standard error (m,) of the share, from its scatter over parts of the motion."""
    length = len(late[0]) // PARTS
    if length < SHORTEST_PART:
        return np.full(len(edges) - 1, math.nan)
    shares = []
    for part in range(PARTS):
        cut = slice(part * length, (part + 1) * length)
        massless, heavy = (core.spectrum(s[cut], rate).powers(edges).sum(axis=1) for s in late)
        with np.errstate(divide="ignore", invalid="ignore"):
            shares.append(1.0 - massless / heavy)
    scatter: Array = np.asarray(np.std(np.stack(shares), axis=0, ddof=1), dtype=np.float64)
    return np.asarray(scatter / math.sqrt(PARTS))
