"""The chain from ball loads to vibration of the housing: a few numbers for each link."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore import Equilibrium, Scene, Spectrum
from bearingcore.common import ResultTable, table_of
from bearingcore.model.statics import BALL_LOAD, TERM_UNITS, StaticRanges

LOWEST_PEAK = 100.0
"""Frequency [Hz] above which the loudest line of a spectrum is sought."""
ALIKE = 1.05
"""Ratio of two natural frequencies up to which their order does not matter."""
LEVEL_FLOOR = 1e-20
"""Density [(m/s²)²/Hz] below which a housing counts as still."""


@dataclass(frozen=True)
class Peak:
    """The highest line from `LOWEST_PEAK` on.

    Attributes
    ----------
    frequency, resolution : [Hz]
    level : [dB re 1 (m/s²)²/Hz]
    """

    frequency: float
    level: float
    resolution: float


@dataclass(frozen=True)
class Chain:
    """Results of a scene at each link of the chain, over all positions of the bearing.

    Attributes
    ----------
    answered
        share of the positions that have an equilibrium; `reason` says why the first of the others
        has none.
    off_line : [rad]
        mean angle between the balls and the direction of the radial load, each ball weighted by
        its load. NaN without a radial load.
    direction : [rad]
        direction of the radial load; NaN without one.
    greatest_load : [N], loaded_balls
        greatest load of a ball, and mean number of loaded balls.
    stiffness
        mean diagonal term of each free direction, by the term's name [N/m or N·m/rad].
    bands
        least and greatest natural frequency of each mode [Hz], by its label; empty where the
        support is not known well enough.
    peaks
        loudest line of the housing's acceleration along x and y, if they are free; empty
        without a motion, and `silent` then says why.
    radial_share
        mean cos²α of the contact angles, weighted by ball load: the radial share of a contact's
        stiffness.
    """

    answered: float
    reason: str
    off_line: float
    direction: float
    greatest_load: float
    loaded_balls: float
    stiffness: dict[str, float]
    bands: dict[str, tuple[float, float]]
    peaks: dict[str, Peak]
    silent: str
    radial_share: float = 1.0

    @property
    def loudest(self) -> str:
        """The direction with the highest peak; empty without peaks."""
        return max(self.peaks, key=lambda dof: self.peaks[dof].level, default="")

    def table(self) -> ResultTable:
        """All numbers in one row."""
        return table_of(
            ("off_line", "rad", [self.off_line], "mean angle of the loads off their line"),
            ("greatest_load", "N", [self.greatest_load], "greatest load of a ball"),
            ("loaded_balls", "1", [self.loaded_balls], "mean number of balls with a load"),
            *(
                (term, TERM_UNITS[term], [value], "mean over all positions")
                for term, value in self.stiffness.items()
            ),
            *(
                (f"{label}_{end}", "Hz", [band[i]], f"natural frequency of mode {label}")
                for label, band in self.bands.items()
                for i, end in enumerate(("least", "most"))
            ),
            *(
                (f"peak_{dof}", "Hz", [peak.frequency], f"loudest line along {dof}")
                for dof, peak in self.peaks.items()
            ),
            *(
                (f"peak_level_{dof}", "dB", [peak.level], "re 1 (m/s²)²/Hz")
                for dof, peak in self.peaks.items()
            ),
        )


def chain_of(
    ranges: StaticRanges,
    scene: Scene,
    bands: Mapping[str, tuple[float, float]],
    peaks: dict[str, Peak],
    silent: str,
) -> Chain:
    """Make the chain of a scene; bands that are NaN are left out."""
    state = ranges.state
    bad = np.flatnonzero(~state.converged)
    terms = [f"k_{dof}{dof}" for dof in state.dofs]
    off_line = (state.ball_angle - direction(scene) + math.pi) % (2.0 * math.pi) - math.pi
    return Chain(
        answered=1.0 - float(state.shares[bad].sum()),
        reason=state.reason(int(bad[0])) if bad.size else "",
        off_line=mean_by_load(state, np.abs(off_line)),
        direction=direction(scene),
        greatest_load=ranges.greatest[BALL_LOAD],
        loaded_balls=ranges.mean(np.where(state.converged, state.loaded_balls, math.nan)),
        stiffness={term: ranges.mean(state.term(term)) for term in terms},
        bands={label: band for label, band in bands.items() if math.isfinite(band[0])},
        peaks=peaks,
        silent=silent,
        radial_share=mean_by_load(state, np.cos(state.contact_angle) ** 2),
    )


def mean_by_load(state: Equilibrium, values: NDArray[np.float64]) -> float:
    """Mean of the balls' values (n, N_b), weighted by load; NaN without load."""
    carried = np.where(state.converged[:, None], state.ball_load, 0.0) * state.shares[:, None]
    total = float(carried.sum())
    loaded = carried > 0.0
    return float((carried[loaded] * values[loaded]).sum() / total) if total > 0.0 else math.nan


def direction(scene: Scene) -> float:
    """Direction of the radial load [rad]; NaN without one."""
    load = scene.load
    return math.atan2(load.fy, load.fx) if math.hypot(load.fx, load.fy) > 0.0 else math.nan


def have_same_order(label: str, *bands: Mapping[str, tuple[float, float]]) -> bool:
    """True if a mode is on the same side of the mode of the other direction in all scenes.

    Modes that move along both x and y may swap names between scenes. The order of modes within
    `ALIKE` of each other does not count.
    """
    other = {"x": "y", "y": "x"}.get(label[:-1], "") + label[-1]
    pairs = [
        (sum(band[label]), sum(band[other])) for band in bands if label in band and other in band
    ]
    return len({a > b for a, b in pairs if max(a, b) > ALIKE * min(a, b)}) <= 1


def loudest(spectrum: Spectrum) -> Peak:
    """The highest line of one direction from `LOWEST_PEAK` on."""
    frequency, density = spectrum
    first = int(np.searchsorted(frequency, LOWEST_PEAK))
    most = first + int(np.argmax(density[first:]))
    level = 10.0 * math.log10(max(float(density[most]), LEVEL_FLOOR))
    return Peak(float(frequency[most]), level, float(frequency[1] - frequency[0]))
