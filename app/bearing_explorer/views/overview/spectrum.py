"""The spectrum of the housing with the bands of the natural frequencies in it, small."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from bearing_explorer.plots import style
from bearing_explorer.plots.ranges import StickyRange
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources, View
from bearing_explorer.views.modes import band_rows
from bearing_explorer.views.overview.bands import LEFT, highest_band
from bearing_explorer.views.vibration_spectrum import (
    DEPTH_OF_VIEW,
    FREQUENCY,
    HIGHEST,
    LEVEL_FLOOR,
    SHOWN,
    VibrationSpectra,
    drawn_levels,
)

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results

LEVEL = style.AxisQuantity("Density", "", "dB")


class OverviewSpectrum(View):
    """Along x and y in one figure, over the frequencies of the bands above it."""

    name = "overview-spectrum"
    title = "Vibration of the housing"
    about = (
        "Spectrum of the housing's acceleration, blue x, orange y. Power spectral density in dB "
        "re 1 (m/s²)²/Hz once the start is forgotten. Grey: {grey}. Shaded: the bands "
        "of the natural frequencies."
    )
    needs: ClassVar[frozenset[str]] = VibrationSpectra.needs | {"healthy_bands"}
    compact = True
    sentence_looks = ("unseen",)
    leads_to = "vibration"
    in_report = False

    def build(self, packed: PackedSource) -> Any:
        self._frequency = StickyRange(0.0, HIGHEST, anchor="zero")
        self._levels = StickyRange(-80.0, -20.0, least_span=40.0)
        plot = style.make_figure(
            FREQUENCY,
            LEVEL,
            packed.range("overview_frequency", 0.0, HIGHEST),
            packed.range("overview_level", -80.0, -20.0),
            height=120,
            sizing_mode="stretch_both",
        )
        plot.min_border_left = LEFT
        healthy = packed.source("overview_healthy_lines", "frequency", *SHOWN)
        lines = packed.source("overview_lines", "frequency", *SHOWN)
        colors = dict(zip(style.DIRECTIONS, style.DIRECTION_COLORS, strict=True))
        for dof in SHOWN:
            bands = packed.source(f"overview_bands_{dof}", "low", "high")
            plot.vstrip(
                "low", "high", source=bands, fill_color=colors[dof], fill_alpha=0.13,
                line_color=None,
            )  # fmt: skip
        for dof in SHOWN:
            plot.line("frequency", dof, source=healthy, line_color=style.HEALTHY, line_width=1.2)
        for dof in SHOWN:
            plot.line("frequency", dof, source=lines, line_color=colors[dof], line_width=2.0)
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        bands = band_rows(results.bands)
        top = self._frequency.fit(HIGHEST, highest_band(results))[1]
        drawn = drawn_levels(results.late_spectra, top)
        healthy = drawn_levels(results.healthy_late_spectra, top)
        in_view = np.concatenate([drawn[dof] for dof in SHOWN])
        loudest = np.nanmax(in_view, initial=LEVEL_FLOOR)
        shown = self._levels.fit(np.maximum(in_view, loudest - DEPTH_OF_VIEW), loudest + 6.0)
        of_mode = {dof: bands["direction"] == style.DIRECTIONS.index(dof) for dof in SHOWN}
        return {
            "overview_lines": drawn,
            "overview_healthy_lines": healthy,
            **{
                f"overview_bands_{dof}": {end: bands[end][own] for end in ("low", "high")}
                for dof, own in of_mode.items()
            },
        }, {"overview_frequency": (0.0, top), "overview_level": shown}

    sentence = VibrationSpectra.sentence
    table = VibrationSpectra.table
