"""Two spectra over each other as far as they are known, on a logarithmic frequency axis."""

from __future__ import annotations

import numpy as np
from bokeh.plotting import figure

from bearing_explorer.explorer.plots.compared_levels import levels_of_compared
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.kit.plots import compared_curves, style
from bearing_explorer.kit.plots.layers import (
    ON_PAPER,
    Layer,
    Words,
    add_all,
    curve,
    sources_of,
    strips,
)
from bearing_explorer.kit.plots.levels import (
    SHOWN,
    density_axis,
    drawn_levels,
    seen_levels,
)
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore import Spectrum

FREQUENCY = style.AxisQuantity("Frequency", "f", "")
TICKS = [m * 10.0**e for e in range(1, 6) for m in (1, 3)]  # [Hz]
LOWEST = 100.0  # [Hz]
DEPTH_OF_VIEW = 90.0  # [dB] below the loudest line
HEIGHT = 286  # [px]: the label of the axis is whole in large type too

_BAND_WORDS = (
    "return `contact resonance ${si(row.low, 'Hz')}${row.above ? ', above this range' : ''}`"
)


class WideSpectra:
    """A figure along x and one along y: one spectrum as a colored line, another beneath it.

    Parameters
    ----------
    packed
        sends the numbers.
    name
        of the sources and ranges.
    """

    def __init__(self, packed: PackedSource, name: str) -> None:
        self._name = name
        self._levels = StickyRange(-120.0, -20.0, least_span=60.0)
        frequency = packed.range(f"{name}_frequency", LOWEST, 32768.0)
        level = packed.range(f"{name}_level", -120.0, -20.0)
        layers = {dof: self._layers(dof) for dof in SHOWN}
        sources = sources_of(packed, [layer for own in layers.values() for layer in own])
        #: along x and along y
        self.plots: list[figure] = []
        for dof in SHOWN:
            plot = style.make_figure(
                FREQUENCY,
                density_axis(f"S{dof}"),
                frequency,
                level,
                height=HEIGHT,
                x_axis_type="log",
                name=f"{name}_{dof}",
            )
            in_hertz(plot)
            add_all(plot, sources, layers[dof])
            self.plots.append(plot)

    def _layers(self, dof: str) -> list[Layer]:
        """Along a direction, from the lowest to the highest."""
        name = self._name
        color = style.color_along(dof)
        return [
            strips(f"{name}_resonance", style.DEFECT, 0.22, reads=("above",)),
            curve(f"{name}_others", "frequency", dof, style.HEALTHY, 1.5),
            *compared_curves.curves(name, "frequency", dof, width=1.3),
            curve(f"{name}_lines", "frequency", dof, color, 1.4),
            Words(
                f"{name}_resonance",
                "label_at",
                0.06,
                _BAND_WORDS,
                y_share=True,
                in_view="x",
                look={"text_align": "right", "level": "annotation", **ON_PAPER},
            ),
        ]

    def data(
        self,
        results: Results,
        spectra: dict[str, Spectrum],
        others: dict[str, Spectrum],
        resonances: tuple[float, float],
        top: float,
    ) -> tuple[Sources, Ranges]:
        """Sources and ranges: spectra by direction, and the band of the contact resonances [Hz].

        top [Hz]: up to where they are known.

        The compared scenes are those of `results`.
        """
        name = self._name
        drawn = [drawn_levels(one, top, LOWEST) for one in (spectra, others)]
        compared = levels_of_compared(name, results, top, LOWEST)
        sources: Sources = {**compared, f"{name}_lines": drawn[0], f"{name}_others": drawn[1]}
        low, high = resonances
        if high > 0.0:
            above = low >= top
            sources[f"{name}_resonance"] = {
                "low": np.array([low]),
                "high": np.array([high]),
                "above": np.array([float(above)]),
                "label_at": np.array([0.97 * min(low, top)]),
            }
        fitted = self._levels.fit(
            *seen_levels(6.0, *drawn, *compared.values(), depth=DEPTH_OF_VIEW)
        )
        return sources, {f"{name}_frequency": (LOWEST, top), f"{name}_level": fitted}


def in_hertz(plot: figure) -> None:
    """Write frequencies along a logarithmic axis, each with its unit."""
    plot.xaxis[0].formatter = style.logarithmic_ticks("Hz")
    style.fixed_ticks(plot.xaxis[0], TICKS)
    plot.xgrid[0].ticker = plot.xaxis[0].ticker
