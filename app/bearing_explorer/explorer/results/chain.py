"""One scene from the loads of its balls to the vibration of its housing, a few numbers a link."""

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
"""Frequency [Hz] from which on the loudest line of a spectrum is looked for."""
ALIKE = 1.05
"""Ratio of two natural frequencies up to which it makes no difference which is which."""
LEVEL_FLOOR = 1e-20
"""Density [(m/s²)²/Hz] below which a housing does not move at all."""


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
        part of the positions that have an equilibrium; `reason` is why the first of the others
        has none.
    off_line : [rad]
        mean angle between the balls and the direction of the radial load, each ball weighted by
        its load. NaN without a radial load.
    direction : [rad]
        of the radial load; NaN without one.
    greatest_load : [N]
        of a ball.
    loaded_balls
        mean number.
    stiffness
        mean of the diagonal term of each free direction, by the term's name [N/m or N·m/rad].
    bands
        least and greatest natural frequency of each mode [Hz], by its label; empty where the
        support is not known well enough.
    peaks
        loudest line of the housing's acceleration along x and y, where they are free; empty
        without a motion, and `silent` then says why.
    upright
        mean cos²α of the contact angles of loaded balls, each by what it carries: the share of the
        stiffness of a contact that is radial.
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
    upright: float = 1.0

    @property
    def loudest(self) -> str:
        """The direction with the highest peak; nothing without peaks."""
        return max(self.peaks, key=lambda dof: self.peaks[dof].level, default="")

    def table(self) -> ResultTable:
        """One row."""
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
    """The chain of a scene; the last three are attributes of it, bands of other modes left out."""
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
        upright=mean_by_load(state, np.cos(state.contact_angle) ** 2),
    )


def mean_by_load(state: Equilibrium, values: NDArray[np.float64]) -> float:
    """Mean of values (n, N_b) of the balls, each by what its ball carries; NaN where none does."""
    carried = np.where(state.converged[:, None], state.ball_load, 0.0) * state.shares[:, None]
    total = float(carried.sum())
    loaded = carried > 0.0
    return float((carried[loaded] * values[loaded]).sum() / total) if total > 0.0 else math.nan


def direction(scene: Scene) -> float:
    """Direction of the radial load [rad]; NaN without one."""
    load = scene.load
    return math.atan2(load.fy, load.fx) if math.hypot(load.fx, load.fy) > 0.0 else math.nan


def have_same_order(label: str, *bands: Mapping[str, tuple[float, float]]) -> bool:
    """True if the mode of a label is in each scene above, or below, that of the other direction.

    Modes that move along x and y alike may have each other's names in another scene. Modes within
    `ALIKE` of each other are in any order.
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
