"""One scene from the loads of its balls to the vibration of its housing, a few numbers a link."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from bearingcore import Equilibrium, Scene, Spectrum
from bearingcore.common import ResultTable, table_of
from bearingcore.model.statics import BALL_LOAD, TERM_UNITS, StaticRanges

LOWEST_PEAK = 100.0
"""[Hz] from which on the loudest line of a spectrum is looked for, as far as it is known."""
ALIKE = 1.05
"""Ratio of two natural frequencies up to which it makes no difference which is which."""
LEVEL_FLOOR = 1e-20
"""[(m/s²)²/Hz] below which a housing does not move at all."""


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
    return Chain(
        answered=1.0 - float(state.shares[bad].sum()),
        reason=state.reason(int(bad[0])) if bad.size else "",
        off_line=mean_angle_off_line(state, scene),
        direction=direction(scene),
        greatest_load=ranges.greatest[BALL_LOAD],
        loaded_balls=ranges.mean(np.where(state.converged, state.loaded_balls, math.nan)),
        stiffness={term: ranges.mean(state.term(term)) for term in terms},
        bands={label: band for label, band in bands.items() if math.isfinite(band[0])},
        peaks=peaks,
        silent=silent,
        upright=upright(state),
    )


def upright(state: Equilibrium) -> float:
    """Mean cos²α of loaded balls, each by what it carries; NaN where none does."""
    carried = np.where(state.converged[:, None], state.ball_load, 0.0) * state.shares[:, None]
    total = carried.sum()
    if not total > 0.0:
        return math.nan
    radial = np.where(carried > 0.0, np.cos(state.contact_angle) ** 2, 0.0)
    return float((carried * radial).sum() / total)


def mean_angle_off_line(state: Equilibrium, scene: Scene) -> float:
    """Mean angle [rad] between the loaded balls and the radial load, each by what it carries."""
    load = scene.load
    carried = np.where(state.converged[:, None], state.ball_load, 0.0) * state.shares[:, None]
    total = carried.sum()
    if not (math.hypot(load.fx, load.fy) > 0.0 and total > 0.0):
        return math.nan
    apart = state.ball_angle - math.atan2(load.fy, load.fx)
    apart = np.abs((apart + math.pi) % (2.0 * math.pi) - math.pi)
    return float((carried * apart).sum() / total)


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
    pairs = [(sum(own[label]), sum(own[other])) for own in bands if label in own and other in own]
    return len({a > b for a, b in pairs if max(a, b) > ALIKE * min(a, b)}) <= 1


def loudest(spectrum: Spectrum) -> Peak:
    """The highest line of one direction from `LOWEST_PEAK` on."""
    frequency, density = spectrum
    first = int(np.searchsorted(frequency, LOWEST_PEAK))
    most = first + int(np.argmax(density[first:]))
    level = 10.0 * math.log10(max(float(density[most]), LEVEL_FLOOR))
    return Peak(float(frequency[most]), level, float(frequency[1] - frequency[0]))
