"""The spectrum of the housing with the bands of the natural frequencies in it, small."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from bokeh.models import LegendItem
from numpy.typing import NDArray

from bearing_explorer.plots import compared_curves, style
from bearing_explorer.plots.layers import Layer, Words, by_number, curve, draw, strips
from bearing_explorer.plots.levels import (
    FREQUENCY,
    HIGHEST,
    SHOWN,
    density_axis,
    drawn_levels,
    levels_of_compared,
    seen_levels,
)
from bearing_explorer.plots.ranges import StickyRange
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources, View
from bearing_explorer.views.modes import BAND_NAME, BAND_SPAN, band_rows, highest
from bearing_explorer.views.vibration_spectrum import VibrationSpectra, loudest_words
from bearingcore.sweep.outputs import mode_symbol

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results

LEFT = 68
"""[px] left of the frame: the widest numbers fit, so that no drag moves it."""
TOP_ROOM = 16.0
"""[dB] above the loudest line, for the names of the bands."""

_BAND_WORDS = f"""
const name = (() => {{ {BAND_NAME} return name }})()
const whole = (() => {{ {BAND_SPAN} }})()
let room = 0
try {{ room = row.room/(plot.x_range.end - plot.x_range.start)*plot.inner_width/6.5 }} catch {{}}
return whole.length < room ? whole : name.length < room ? name : ''
"""


def layers() -> list[Layer]:
    """From the lowest to the highest: bands, grey, curves, names of the bands."""
    blue, orange = style.DIRECTION_COLORS[:2]
    of_band = by_number("direction", style.DIRECTION_COLORS)
    return [
        strips("overview_bands", of_band, 0.13, reads=("direction",)),
        *(curve("overview_healthy_lines", "frequency", dof, style.HEALTHY, 1.2) for dof in SHOWN),
        *compared_curves.curves("overview_spectrum", "frequency", *SHOWN, width=1.2),
        curve("overview_lines", "frequency", "x", blue),
        curve("overview_lines", "frequency", "y", orange),
        Words(
            "overview_bands",
            "low",
            1.0,
            _BAND_WORDS,
            ("direction", "number", "high", "room", "line"),
            y_share=True,
            fitting=style.NARROW,
            look={"text_color": of_band, "y_offset": style.text_offset("line")},
        ),
    ]


class OverviewSpectrum(View):
    """Along x and y in one figure, with the bands in which the natural frequencies move."""

    name = "overview-spectrum"
    title = "Vibration and natural frequencies"
    about = (
        "Spectrum of the housing's acceleration, blue x, orange y. Power spectral density in dB "
        "re 1 (m/s²)²/Hz once the start is forgotten. Grey: {grey}. Shaded: the bands "
        "of the natural frequencies."
    )
    needs: ClassVar[frozenset[str]] = VibrationSpectra.needs | {"bands"}
    compact = True
    sentence_looks = ("unseen",)
    leads_to = "vibration"
    in_report = False

    def build(self, packed: PackedSource) -> Any:
        self._frequency = StickyRange(0.0, HIGHEST, anchor="zero")
        self._levels = StickyRange(-80.0, -20.0, least_span=40.0)
        plot = style.make_figure(
            FREQUENCY,
            density_axis(""),
            packed.range("overview_frequency", 0.0, HIGHEST),
            packed.range("overview_level", -80.0, -20.0),
            height=120,
        )
        plot.min_border_left = LEFT
        _, grey, *_, x, y, _ = draw(plot, packed, layers())
        named = {"horizontal": x, "vertical": y, "without defect": grey}
        items = [LegendItem(label=name, renderers=[one]) for name, one in named.items()]
        self._grey = items[-1]
        plot.add_layout(compared_curves.key_of(items, ncols=3), "above")
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        top = self._frequency.fit(HIGHEST, 1.05 * highest(results.bands))[1]
        drawn = drawn_levels(results.late_spectra, top)
        healthy = drawn_levels(results.healthy.late_spectra, top)
        compared = levels_of_compared("overview_spectrum", results, top)
        shown = self._levels.fit(*seen_levels(TOP_ROOM, drawn, *compared.values()))
        return {
            **compared,
            "overview_lines": drawn,
            "overview_healthy_lines": healthy,
            "overview_bands": named_bands(results, top),
        }, {"overview_frequency": (0.0, top), "overview_level": shown}

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is not None:
            self._grey.visible = bool(results.reference_label)

    def sentence(self, results: Results) -> str:
        moving = [
            f"{mode_symbol(label)} {low:.0f} to {high:.0f} Hz"
            for label, (low, high) in results.bands.items()
            if low == low
        ]
        words = style.list_words(moving)
        bands = f" The natural frequencies move within: {words}." if words else ""
        return loudest_words(results) + bands

    table = VibrationSpectra.table


def named_bands(results: Results, top: float) -> dict[str, NDArray[np.float64]]:
    """Bands by their frequency, with the room [Hz] up to the next name, in two lines of names."""
    bands = band_rows(results.bands)
    order = np.argsort(bands["low"], kind="stable")
    low = bands["low"][order]
    line = np.arange(low.size) % 2
    room = [
        np.min(low[(line == own) & (low > at)], initial=top) - at
        for own, at in zip(line, low, strict=True)
    ]
    named = {name: column[order] for name, column in bands.items()}
    return {**named, "room": np.array(room, dtype=float), "line": 8.0 + 14.0 * line}
