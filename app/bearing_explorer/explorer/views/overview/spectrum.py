"""A small spectrum of the housing's vibration, with the bands of the natural frequencies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.explorer.plots import compared_curves, frequency_bands
from bearing_explorer.explorer.plots.spectra import levels_of_compared
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views import vibration_spectrum
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import levels, style
from bearing_explorer.kit.plots.layers import ON_PAPER, Layer, Words, by_number, curve, draw, strips
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources

LEFT = 68
"""Room [px] left of the frame for the widest numbers, so that the frame never moves."""
TOP_ROOM = 16.0
"""Room [dB] above the loudest line for the names of the bands."""
NAME_ROOM = 0.06
"""Share of the frame's height that the name of a curve needs."""
BAND_NAME_WIDTH = 0.05
"""Share of the frame's width that the short name of a band needs."""
END = 0.8
"""Share of the frequencies beyond which a curve must not cross its name."""

_BAND_WORDS = f"""
const name = (() => {{ {frequency_bands.BAND_NAME} return name }})()
const whole = (() => {{ {frequency_bands.BAND_SPAN} }})()
let pixels = 0  // of a hertz
try {{ pixels = plot.inner_width/(plot.x_range.end - plot.x_range.start) }} catch {{}}
const room = row.room*pixels/(6.5*larger)
return whole.length < room ? whole : name.length < room ? name : ''
"""
_CURVE_WORDS = "return ['horizontal', 'vertical', 'without defect'][row.which]"
_OF_CURVES = (*style.DIRECTION_COLORS[:2], style.FAINT_INK)


def layers() -> list[Layer]:
    """Layers, the lowest first: bands, grey, curves, names."""
    blue, orange = style.DIRECTION_COLORS[:2]
    of_band = by_number("direction", style.DIRECTION_COLORS)
    of_curve = by_number("which", _OF_CURVES)
    return [
        strips("overview_bands", of_band, 0.13, reads=("direction",)),
        *(
            curve("overview_healthy_lines", "frequency", dof, style.HEALTHY, 1.2)
            for dof in levels.SHOWN
        ),
        *compared_curves.curves(
            "overview_spectrum", "frequency", *levels.SHOWN[::-1], width=1.6, thin="x"
        ),
        curve("overview_lines", "frequency", "x", blue),
        curve("overview_lines", "frequency", "y", orange),
        Words(
            "overview_bands",
            "name_at",
            1.0,
            _BAND_WORDS,
            ("direction", "number", "low", "high", "room", "line"),
            y_share=True,
            fitting=style.NARROW,
            look={"text_color": of_band, "y_offset": style.text_offset("line")},
        ),
        Words(
            "overview_names",
            "x",
            "y",
            _CURVE_WORDS,
            ("which",),
            look={"text_color": of_curve, "text_align": "right", **ON_PAPER},
        ),
    ]


class OverviewSpectrum(ComparingView):
    """Spectra along x and y in one figure, with the bands of the natural frequencies."""

    name = "overview-spectrum"
    title = "Vibration"
    about = (
        "Spectrum of the housing's acceleration, blue x, orange y. Power spectral density in dB "
        "re 1 (m/s²)²/Hz once the start has died away. Grey: {grey}. Shaded: the bands "
        "of the natural frequencies."
    )
    needs = vibration_spectrum.VibrationSpectra.needs | {"bands"}
    compact = True
    leads_to = "vibration"

    def build(self, packed: PackedSource) -> Any:
        self._frequency = StickyRange(0.0, levels.HIGHEST, anchor="zero")
        self._levels = StickyRange(-80.0, -20.0, least_span=40.0)
        plot = style.make_figure(
            levels.FREQUENCY,
            style.AxisQuantity("Vibration level", "", "dB"),
            packed.range("overview_frequency", 0.0, levels.HIGHEST),
            packed.range("overview_level", -80.0, -20.0),
            height=120,
        )
        plot.min_border_left = LEFT
        plot.tags = [compared_curves.THIN]
        plot.xaxis[0].axis_label = f"{levels.FREQUENCY.label()}, shaded: natural frequencies"
        draw(plot, packed, layers())
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        top = self._frequency.fit(levels.HIGHEST, results.picture_top)[1]
        drawn = levels.drawn_levels(results.late_spectra, top)
        healthy = levels.drawn_levels(results.reference.late_spectra, top)
        compared = levels_of_compared("overview_spectrum", results, top)
        shown = self._levels.fit(*levels.seen_levels(TOP_ROOM, drawn, *compared.values()))
        named = [(drawn["frequency"], drawn[dof]) for dof in levels.SHOWN]
        if results.grey.label:
            named.append((healthy["frequency"], np.fmin(healthy["x"], healthy["y"])))
        return {
            **compared,
            "overview_lines": drawn,
            "overview_healthy_lines": healthy,
            "overview_bands": named_bands(results, top),
            "overview_names": end_names(named, shown, top),
        }, {"overview_frequency": (0.0, top), "overview_level": shown}

    def sentence(self, results: Results) -> str:
        return vibration_spectrum.why_words(
            results, briefly=True
        ) or vibration_spectrum.loudest_words(results)

    table = vibration_spectrum.VibrationSpectra.table


def named_bands(results: Results, top: float) -> dict[str, NDArray[np.float64]]:
    """Bands in order of frequency, their names in two lines, with the room [Hz] of each name."""
    bands = frequency_bands.band_rows(results.bands)
    order = np.argsort(bands["low"], kind="stable")
    named = {name: column[order] for name, column in bands.items()}
    line = np.arange(order.size) % 2
    name_at, room = np.empty(order.size), np.empty(order.size)
    half = 0.5 * BAND_NAME_WIDTH * top
    for chosen in (line == 0, line == 1):
        middle = frequency_bands.spread(named["low"][chosen] + half, 2.0 * half, 0.0, top)
        name_at[chosen] = middle - half
        room[chosen] = np.diff(name_at[chosen], append=top)
    return {**named, "name_at": name_at, "room": room, "line": 8.0 + 17.0 * line}


def end_names(
    named: Sequence[tuple[NDArray[np.float64], NDArray[np.float64]]],
    shown: tuple[float, float],
    top: float,
) -> dict[str, NDArray[np.float64]]:
    """Places of the names of curves (frequency, level) at their right ends, separate and in view.

    The name of the upper curve is above it; the other names are below their curves.
    """
    ends = [level[frequency > END * top] for frequency, level in named]
    known = [k for k, end in enumerate(ends) if end.size and np.isfinite(end).all()]
    room = NAME_ROOM * (shown[1] - shown[0])
    upper = max(known, key=lambda k: float(ends[k].mean()), default=-1)
    wanted = [ends[k].max() + room if k == upper else ends[k].min() - room for k in known]
    y = frequency_bands.spread(np.array(wanted), 2.0 * room, shown[0], shown[1] - 3.0 * room)
    return {"x": np.full(len(known), top), "y": y, "which": np.array(known, dtype=float)}
