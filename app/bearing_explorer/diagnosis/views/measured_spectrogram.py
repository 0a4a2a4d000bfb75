"""Spectrogram of a measured signal: it shows changes of the speed and of the lines."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.heat_map import GridImage, Side, ends
from bearing_explorer.kit.plots.levels import decibels
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import stack
from bearingcore.measured.signals import spectrogram

Array = NDArray[np.float64]

MOST_COLUMNS, MOST_ROWS = 220, 320
"""Largest size of the picture in points."""
DEPTH_OF_VIEW = 50.0  # [dB]
SEGMENTS = 60.0
"""Number of segments of a spectrogram, counted without their overlap."""
SEGMENT_LENGTHS = (64, 8192)
_SIDES = (Side("", "Time", "t", "s"), Side("", "Frequency", "f", "Hz"))
_WORDS = "return `${rounded(cell, 3)} dB`"


class MeasuredSpectrogram(MeasuredView):
    """Spectra over time."""

    name = "measured-spectrogram"
    title = "Spectrogram"
    about = (
        "Spectra over time. Horizontal lines belong to a steady speed. Lines that slope together "
        "follow a changing speed; `order_map` in Python draws them over turns of the shaft instead."
    )

    def build(self, packed: PackedSource) -> Any:
        plot = style.make_figure(
            _SIDES[0].quantity,
            _SIDES[1].quantity,
            packed.range("spectrogram_x", 0.0, 1.0),
            packed.range("spectrogram_y", 0.0, 1.0),
            height=320,
            name="spectrogram_drawing",
        )
        level = packed.range("spectrogram_level", -DEPTH_OF_VIEW, 0.0)
        title = "dB below the highest"
        self._image = GridImage(plot, packed, "spectrogram_cells", level, _SIDES, _WORDS, title)
        self.hidden = stack(plot, visible=False)
        return self.hidden

    def shown(self, measured: Measured) -> tuple[Array, Array, Array]:
        """Return times [s], frequencies [Hz], and levels (times, frequencies) [dB, highest 0]."""
        direction = self.direction_of(measured)

        def compute() -> tuple[Array, Array, Array]:
            signal, rate = measured.column(direction), measured.recording.sample_rate
            least, most = SEGMENT_LENGTHS
            length = 2 ** round(math.log2(min(max(len(signal) / SEGMENTS, least), most)))
            levels = spectrogram(signal, rate, rate / length)
            level = thin_to_peaks(decibels(levels.density))
            time, frequency = (
                np.linspace(values[0], values[-1], count)
                for values, count in zip((levels.time, levels.frequency), level.shape, strict=True)
            )
            return time, frequency, level - level.max()

        return measured.once(("spectrogram", direction), compute)

    def data_of(self, model: Model, measured: Measured) -> tuple[Sources, Ranges]:
        time, frequency, level = self.shown(measured)
        cells = self._image.columns(time, frequency, level.T)
        return {"spectrogram_cells": cells}, {
            "spectrogram_x": ends(time),
            "spectrogram_y": (0.0, 0.5 * measured.recording.sample_rate),
            "spectrogram_level": (-DEPTH_OF_VIEW, 0.0),
        }

    def words_of(self, model: Model, measured: Measured) -> str:
        time, frequency, level = self.shown(measured)
        above = min(2, level.shape[1] - 1)  # an offset of the sensor is no vibration
        column, row = np.unravel_index(int(level[:, above:].argmax()), level[:, above:].shape)
        row += above
        place = f"at {frequency[row]:.0f} Hz, {style.with_prefix(float(time[column]), 's')} in"
        return f"It is loudest{measured.along(self.direction_of(measured))} {place}."

    def columns_of(self, model: Model, measured: Measured) -> dict[str, np.ndarray]:
        time, frequency, level = self.shown(measured)
        x, y = np.meshgrid(time, frequency, indexing="ij")
        return {"time_s": x.ravel(), "frequency_hz": y.ravel(), "level_db": level.ravel()}


def thin_to_peaks(level: Array) -> Array:
    """Reduce levels (columns, rows) to the points that can be seen; each peak stays."""
    for axis, most in enumerate((MOST_COLUMNS, MOST_ROWS)):
        size = math.ceil(level.shape[axis] / most)
        level = np.maximum.reduceat(level, np.arange(0, level.shape[axis], size), axis=axis)
    return level
