"""Spectra of a scene, of the grey reference and of the compared scenes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from bokeh.plotting import figure

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.kit.plots import levels, style
from bearing_explorer.kit.plots.layers import Layer, add_all, sources_of
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources

TICKS = [m * 10.0**e for e in range(1, 6) for m in (1, 3)]  # [Hz] of logarithmic axes
FREQUENCY_WITH_UNITS = style.AxisQuantity("Frequency", "f", "")
"""Quantity of a logarithmic axis, which writes the unit behind each number."""
HEIGHT = 286  # [px]: enough for the whole label of the axis in large type
ROOM = 6.0  # [dB] free above the loudest line


class SpectrumFigures:
    """A figure along x and one along y: the spectrum of the scene over the others.

    Parameters
    ----------
    name
        prefix of the sources ("_lines": the scene, "_grey": the reference) and ranges.
    layers
        returns the layers of the figure along a direction.
    frequencies
        first range of the axis [Hz]; linear if it begins at 0, else logarithmic.
    level_range
        range of the axis of levels [dB].
    depth
        range of the levels in view below the loudest line [dB].
    """

    def __init__(
        self,
        packed: PackedSource,
        name: str,
        layers: Callable[[str], list[Layer]],
        frequencies: tuple[float, float],
        level_range: StickyRange,
        depth: float = levels.DEPTH_OF_VIEW,
    ) -> None:
        self._name, self._levels, self._depth = name, level_range, depth
        self._lowest, _ = frequencies
        frequency = packed.range(f"{name}_frequency", *frequencies)
        level = packed.range(f"{name}_level", level_range.start, level_range.end)
        sources = sources_of(packed, [layer for dof in levels.SHOWN for layer in layers(dof)])
        logarithmic = self._lowest > 0.0
        #: along x and along y
        self.plots: list[figure] = []
        for dof in levels.SHOWN:
            plot = style.make_figure(
                FREQUENCY_WITH_UNITS if logarithmic else levels.FREQUENCY,
                style.AxisQuantity("Density", f"S{dof}", "dB re 1 (m/s²)²/Hz"),
                frequency,
                level,
                height=HEIGHT,
                x_axis_type="log" if logarithmic else "linear",
            )
            if logarithmic:
                write_hertz(plot)
            add_all(plot, sources, layers(dof))
            self.plots.append(plot)

    def data(self, results: Results, top: float) -> tuple[Sources, Ranges]:
        """Sources and ranges up to `top` [Hz]; on linear axes grey does not widen the levels."""
        name, lowest = self._name, self._lowest
        both = results.late_spectra, results.reference.late_spectra
        drawn, grey = (levels.drawn_levels(spectra, top, lowest) for spectra in both)
        compared = levels_of_compared(name, results, top, lowest)
        seen = [drawn, *compared.values(), *([grey] if lowest else [])]
        return {**compared, f"{name}_lines": drawn, f"{name}_grey": grey}, {
            f"{name}_frequency": (lowest, top),
            f"{name}_level": self._levels.fit(*levels.seen_levels(ROOM, *seen, depth=self._depth)),
        }


def levels_of_compared(
    name: str, results: Results, top: float, lowest: float = 0.0
) -> dict[str, dict[str, np.ndarray]]:
    """Spectra of the compared scenes from `lowest` to `top` [Hz], for `compared_curves`."""
    return compared_curves.sources(
        name,
        ("frequency", *levels.SHOWN),
        results.compared_results,
        lambda other: levels.drawn_levels(other.late_spectra, top, lowest),
    )


def write_hertz(plot: figure) -> None:
    """Write frequencies along a logarithmic axis, each with its unit."""
    plot.xaxis[0].formatter = style.logarithmic_ticks("Hz")
    style.fixed_ticks(plot.xaxis[0], TICKS)
    plot.xgrid[0].ticker = plot.xaxis[0].ticker
