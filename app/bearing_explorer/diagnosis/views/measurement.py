"""The measured signal over time, from a file or simulated."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.diagnosis.machine import Turning
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.measured_view import MeasuredView, column_name, shown_unit
from bearing_explorer.diagnosis.widgets.measurement_form import MeasurementForm
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import curve, draw, least_and_greatest
from bearing_explorer.kit.plots.levels import SHOWN
from bearing_explorer.kit.plots.ranges import ROOM, StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import row, stack

ACCELERATION = style.AxisQuantity("Acceleration", "a", "")
AS_IN_FILE = style.AxisQuantity("Value", "", "")
HEIGHT = 230
DRAWN_PARTS = 700
"""Number of stretches of a curve; of each, the least and the greatest value are drawn."""
PASSES = 4.0
"""Ball passes of the close view."""
CLOSE = 0.05
"""Length [s] of the close view where ball passes are not known."""

BALL_PASSES = f"{PASSES:.0f} ball passes"


class MeasuredSignal(MeasuredView):
    """The acceleration as it was measured: all of it, and a few ball passes."""

    name = "measurement"
    title = "1  Your measurement"
    about = (
        "The vibration a sensor on the housing measures. Bearing and speed come from the file or "
        "from your answers; step 2 asks for both."
    )
    waits = False

    def build(self, packed: PackedSource) -> Any:
        self.form = MeasurementForm(self._show_or_hide)
        self._all, self._close = (StickyRange(-1.0, 1.0, room=ROOM) for _ in range(2))
        plots = [self._plot(packed, "all"), self._plot(packed, "close")]
        self._axes = [plot.yaxis[0] for plot in plots]
        self._close_title = plots[1].title
        self.hidden = row(*plots, visible=False, stylesheets=[style.WRAPPED])
        return stack(self.form, self.hidden)

    def _plot(self, packed: PackedSource, part: str) -> figure:
        plot = style.make_figure(
            style.TIME,
            ACCELERATION,
            packed.range(f"measurement_{part}_time", 0.0, 1.0),
            packed.range(f"measurement_{part}_size", -1.0, 1.0),
            height=HEIGHT,
            sizing_mode="stretch_width",
            title="All of it" if part == "all" else BALL_PASSES,
        )
        # the weaker direction is drawn over the stronger one
        name = f"measurement_{part}"
        curves = [curve(name, "time", dof, style.color_along(dof), 1.2) for dof in reversed(SHOWN)]
        draw(plot, packed, curves)
        return plot

    def measure(self, measurement: Measurement) -> None:
        super().measure(measurement)
        self.form.attach(measurement)

    # The picture

    def _show_or_hide(self) -> None:
        """Show the figures and the sentence unless the form is folded to a line."""
        self.hidden.visible = self.drawn
        self._sentence.visible = self.drawn or self.measured is None
        self._caption.figures = [plot.id for plot in self.figures] if self.drawn else []

    @property
    def drawn(self) -> bool:
        return self.measured is not None and not self.form.folded

    @property
    def is_empty(self) -> bool:
        return self.measured is None

    def say(self, model: Model | None, sentence: str) -> None:
        super().say(model, sentence)
        self._show_or_hide()
        if (measured := self.measured) is not None:
            quantity = ACCELERATION if measured.in_si else AS_IN_FILE
            label = dataclasses.replace(quantity, unit=shown_unit(measured)[0]).label()
            for axis in self._axes:
                axis.axis_label = label
            close = BALL_PASSES
            if self.turning is None:
                first, last = close_view(measured, None)
                close = style.with_prefix((last - first) / measured.recording.sample_rate, "s", 2)
            self._close_title.text = close

    def data_of(self, model: Model, measured: Measured) -> tuple[Sources, Ranges]:
        first, last = close_view(measured, self.turning)
        rate = measured.recording.sample_rate
        signal = measured.recording.acceleration
        whole = stretch(measured, 0, len(signal))
        part = stretch(measured, first, last)
        return {"measurement_all": whole, "measurement_close": part}, {
            "measurement_all_time": (0.0, measured.recording.duration),
            "measurement_all_size": self._all.fit(*(whole[dof] for dof in SHOWN)),
            "measurement_close_time": (first / rate, last / rate),
            "measurement_close_size": fit_with_head(self._close, [part[dof] for dof in SHOWN]),
        }

    def words_of(self, model: Model, measured: Measured) -> str:
        recording = measured.recording
        name, size = shown_unit(measured)
        unit = f" {name}" if measured.in_si else ""
        sizes = []
        for index, dof in enumerate(recording.directions):
            signal = recording.acceleration[:, index]
            middle = float(signal.mean())
            root = math.sqrt(float(np.mean((signal - middle) ** 2)))
            level, mean = style.number(root / size, 3), style.number(middle / size, 2)
            sizes.append(f"{level}{unit}{measured.along(dof)} about a mean of {mean}{unit}")
        values = "the acceleration" if measured.in_si else "the numbers of the file"
        return f"Root mean square of {values}: {style.list_words(sizes)}."

    def columns_of(self, model: Model, measured: Measured) -> dict[str, np.ndarray]:
        recording = measured.recording
        first, last = close_view(measured, self.turning)
        table = {"time_s": np.arange(first, last) / recording.sample_rate}
        for index, dof in enumerate(recording.directions):
            table[column_name(dof, measured.in_si)] = recording.acceleration[first:last, index]
        return table


def close_view(measured: Measured, turning: Turning | None) -> tuple[int, int]:
    """First and last sample of the close view, which begins at a quarter of the signal.

    It has a few ball passes, or `CLOSE` seconds if bearing or speed are not known.
    """
    recording = measured.recording
    n = len(recording.acceleration)
    length = CLOSE
    if turning is not None:
        passing = turning.bearing.bpfo(turning.shaft_speed)
        length = PASSES / passing if passing > 0.0 else recording.duration
    count = int(min(max(round(length * recording.sample_rate), 16), n))
    first = min(n // 4, n - count)
    return first, first + count


def stretch(measured: Measured, first: int, last: int) -> dict[str, NDArray[np.float64]]:
    """A stretch of the signal in `shown_unit`, reduced to the numbers that can be seen.

    Directions that were not measured are NaN.
    """
    recording = measured.recording
    rows, values = least_and_greatest(recording.acceleration[first:last], DRAWN_PARTS)
    missing = np.full(len(rows), np.nan)
    curves = dict(zip(recording.directions, values.T / shown_unit(measured)[1], strict=True))
    time = (first + rows) / recording.sample_rate
    return {"time": time, **{dof: curves.get(dof, missing) for dof in SHOWN}}


def fit_with_head(
    sticky: StickyRange, values: list[NDArray[np.float64]], head: float = 0.22
) -> tuple[float, float]:
    """Return a range for the values, with room for names above them."""
    finite = np.concatenate([part[np.isfinite(part)] for part in values])
    low, high = float(finite.min(initial=0.0)), float(finite.max(initial=0.0))
    return sticky.fit(np.array([low, high + head * (high - low)]))
