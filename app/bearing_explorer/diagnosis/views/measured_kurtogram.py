"""The kurtogram of a measured signal as a picture, with the demodulation band."""

from __future__ import annotations

from typing import Any

import numpy as np
from bokeh.models import FixedTicker
from numpy.typing import NDArray

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.heat_map import GridImage, Side, ends
from bearing_explorer.kit.plots.layers import draw, strips
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import stack
from bearingcore import Kurtogram
from bearingcore.measured.signals import BAND_COUNTS

CELLS = 48
"""Cells across the picture: the least common multiple of `BAND_COUNTS`."""
_SIDES = (Side("", "Frequency", "f", "kHz"), Side("", "Bands in the range", "", ""))
_WORDS = "return isNaN(cell) ? 'too narrow for this signal' : `kurtosis ${rounded(cell, 3)}`"
_BAND = strips(
    "kurtogram_band", style.LIGHT, 0.0, line_color=style.LIGHT, line_width=2.0, line_dash="dashed"
)


class MeasuredKurtogram(MeasuredView):
    """Spectral kurtosis over frequency and width of the band."""

    name = "measured-kurtogram"
    title = "Kurtogram"
    about = (
        "Impulsiveness of the signal in bands of many widths. Dashed: the demodulation band. "
        "Each row splits the range into as many equal bands as the number at its left; bright "
        "bands hold knocks. The kurtosis is 0 for noise and -1 for a steady tone. The diagnosis "
        "takes the band whose envelope shows the bearing's lines best, which need not be the most "
        "impulsive one."
    )

    def build(self, packed: PackedSource) -> Any:
        plot = style.make_figure(
            _SIDES[0].quantity,
            _SIDES[1].quantity,
            packed.range("kurtogram_frequency", 0.0, 1.0),
            packed.range("kurtogram_level", -0.5, len(BAND_COUNTS) - 0.5),
            height=260,
            name="kurtogram_drawing",
        )
        plot.yaxis[0].ticker = FixedTicker(ticks=list(range(len(BAND_COUNTS))), minor_ticks=[])
        plot.yaxis[0].major_label_overrides = {k: str(parts) for k, parts in enumerate(BAND_COUNTS)}
        shown = packed.range("kurtogram_kurtosis", 0.0, 1.0)
        self._image = GridImage(plot, packed, "kurtogram_cells", shown, _SIDES, _WORDS, "Kurtosis")
        draw(plot, packed, [_BAND])
        self.hidden = stack(plot, visible=False)
        return self.hidden

    def data_of(self, model: Model, measured: Measured) -> tuple[Sources, Ranges]:
        direction = self.direction_of(measured)
        chart = measured.kurtogram(direction)
        nyquist = 0.5 * measured.recording.sample_rate
        cells = picture(chart, nyquist)
        low, high = self.demodulation(measured, direction).band
        middles = np.asarray((np.arange(CELLS) + 0.5) * (1e-3 * nyquist / CELLS))
        levels = np.arange(len(cells), dtype=float)
        columns = self._image.columns(middles, levels, cells)
        top = max(float(chart.kurtosis.max()), 1.0)
        return {
            "kurtogram_cells": columns,
            "kurtogram_band": {"low": np.array([1e-3 * low]), "high": np.array([1e-3 * high])},
        }, {
            "kurtogram_frequency": (0.0, 1e-3 * nyquist),
            "kurtogram_level": ends(levels),
            "kurtogram_kurtosis": (0.0, top),
        }

    def words_of(self, model: Model, measured: Measured) -> str:
        direction = self.direction_of(measured)
        chart = measured.kurtogram(direction)
        highest = int(chart.kurtosis.argmax())
        band, chosen = chart.bands[highest], self.demodulation(measured, direction)
        words = (
            f"The kurtosis{measured.along(direction)} is highest, "
            f"{style.number(chart.kurtosis[highest], 3)}, from {band.low:.0f} to "
            f"{band.high:.0f} Hz. Envelopes are taken from {chosen.band[0]:.0f} to "
            f"{chosen.band[1]:.0f} Hz, {chosen.reason}"
        )
        if self.diagnosed_envelope() is None or chosen.band == (band.low, band.high):
            return f"{words}."
        return f"{words}: that is chosen by the bearing's lines, not by the kurtosis."

    def columns_of(self, model: Model, measured: Measured) -> dict[str, np.ndarray]:
        return measured.kurtogram(self.direction_of(measured)).table().in_units().named()


def picture(chart: Kurtogram, nyquist: float) -> NDArray[np.float64]:
    """Return the kurtosis (levels, CELLS) up to `nyquist` [Hz]; NaN where there is no band.

    The picture has the levels for which the signal is long enough, but at least two.
    """
    count = max(BAND_COUNTS.index(int(chart.parts.max())) + 1, 2)
    cells = np.full((count, CELLS), np.nan)
    for band, parts, kurtosis in zip(chart.bands, chart.parts, chart.kurtosis, strict=True):
        last = round(band.high / nyquist * CELLS)
        cells[BAND_COUNTS.index(parts), last - CELLS // parts : last] = kurtosis
    return cells
