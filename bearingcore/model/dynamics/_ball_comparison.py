"""Comparison of balls with and without mass: the frequency up to which massless balls suffice."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bearingcore.common import (
    Array,
    Progress,
    ResultTable,
    _checks as checks,
    level_difference,
    number,
    shown_as_table,
    table_of,
    with_prefix,
)
from bearingcore.model.dynamics._motion import SETTLING, Motion, simulate
from bearingcore.model.dynamics._step_rate import fine_step_rate
from bearingcore.model.scene import MASSLESS, WITH_MASS, Scene
from bearingcore.recordings import spectrum

BUDGET = 0.1
"""Difference [dB] up to which massless balls suffice."""

LOWEST_COMPARED = 300.0
"""Lowest third octave [Hz] that is compared, the lower end of the paper's band."""

QUIETEST_COMPARED = 1e-4
"""Share of the greatest power of all bands and directions below which a band does not count."""


@shown_as_table
@dataclass(frozen=True)
class BallComparison:
    """A scene with massless balls compared with the same scene of balls with mass.

    Attributes
    ----------
    scene, budget [dB]
        compared scene, and the allowed difference.
    edges : (m + 1,) [Hz]
        edges of the compared third octaves.
    added : (m, d) [dB]
        effect of mass on the power of the housing's acceleration in each band, along x and y.
    massless_up_to
        [Hz] frequency up to which massless balls are within the budget in all bands that have more
        than QUIETEST_COMPARED of the greatest power; NaN if they exceed it in the lowest band.
    """

    scene: Scene
    budget: float
    edges: Array
    added: Array
    massless_up_to: float

    @property
    def sentence(self) -> str:
        """Sentence with the frequency up to which massless balls suffice."""
        if math.isnan(self.massless_up_to):
            lowest = with_prefix(LOWEST_COMPARED, "Hz")
            return f"massless: off by more than {number(self.budget)} dB from {lowest} on"
        up_to = with_prefix(self.massless_up_to, "Hz", 2)
        return f"massless: within {number(self.budget)} dB up to {up_to}"

    def table(self) -> ResultTable:
        """A row for each third octave: its ends, and the effect of mass along each direction."""
        return table_of(
            ("lowest_frequency", "Hz", self.edges[:-1]),
            ("highest_frequency", "Hz", self.edges[1:]),
            *(
                (f"added_{dof}", "dB", values, f"what the balls' mass adds along {dof}")
                for dof, values in zip(self.directions, self.added.T, strict=True)
            ),
        )

    @property
    def directions(self) -> tuple[str, ...]:
        """Those of the directions x and y in which the housing moves."""
        return compared_directions(self.scene.active_dofs)


def compare_motions(massless: Motion, with_mass: Motion, budget: float = BUDGET) -> BallComparison:
    """Compare two motions of one scene over the same time.

    Powers of third octaves are compared, which are means over lines and ball passes, because balls
    in free flight make single lines sensitive to the smallest change.

    Parameters
    ----------
    massless, with_mass
        the motions.
    budget
        allowed difference [dB].

    Raises
    ------
    ValueError
        if a motion did not reach its end.
    """
    highest = min(massless.bandwidth, with_mass.bandwidth)
    count = math.floor(3.0 * math.log2(highest / LOWEST_COMPARED) + 1e-9)
    edges = LOWEST_COMPARED * 2.0 ** (np.arange(max(count, 1) + 1) / 3.0)
    powers = []
    for motion in (massless, with_mass):
        if not motion.completed:
            balls = motion.scene.balls
            raise checks.refuse("scene", motion.reason, f"one that moves with balls={balls!r}")
        powers.append(band_powers(motion, edges))
    added = level_difference(powers[1], powers[0])
    loudest = max(float(power.max(initial=0.0)) for power in powers)
    counts = np.maximum(*powers) > QUIETEST_COMPARED * loudest
    within = np.asarray((~counts | (np.abs(added) <= budget)).all(axis=1))
    good = len(within) if within.all() else int(np.argmin(within))
    up_to = float(edges[good]) if good else math.nan
    return BallComparison(with_mass.scene, budget, edges, added, up_to)


def compared_directions(dofs: tuple[str, ...]) -> tuple[str, ...]:
    """Return the directions of the housing that are compared: x and y, as sensors measure them."""
    return tuple(name for name in ("x", "y") if name in dofs)


def band_powers(motion: Motion, edges: Array) -> Array:
    """Return the power (m, d) [(m/s²)²] of the housing's settled acceleration between edges."""
    columns = [motion.dofs.index(name) for name in compared_directions(motion.dofs)]
    first = min(round(SETTLING * motion.sample_rate), len(motion.time) // 2)
    signal = motion.outer_acceleration[first:, columns]
    return spectrum(signal, motion.sample_rate, 0.1 * LOWEST_COMPARED).powers(edges)


def mass_share(
    scene: Scene,
    low: float,
    high: float,
    duration: float,
    sample_rate: float,
    progress: Progress | None = None,
) -> float:
    """Return the share of the housing's power between two frequencies [Hz] due to the balls' mass.

    It is 1 − P(massless)/P(with mass), x and y together: 0 if mass changes nothing, near 1 if
    almost all power comes from it, negative if mass takes power away.
    """
    edges, powers = np.array([low, high]), []
    for variant in (scene.replace(balls=balls) for balls in (MASSLESS, WITH_MASS)):
        rate = fine_step_rate(variant, sample_rate)
        motion = simulate(variant, duration, sample_rate, step_rate=rate, progress=progress)
        powers.append(float(band_powers(motion, edges).sum()))
    massless, heavy = powers
    return 1.0 - massless / heavy if heavy > 0.0 else math.nan
