"""A machine over time: numbers of several files, compared with a baseline file."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import panel as pn
from bokeh.models import Scatter
from bokeh.plotting import figure

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.series import ComputedTrend, Series
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.frequency_lines import FAMILIES
from bearing_explorer.diagnosis.views.measured_view import (
    NOTHING,
    MeasuredView,
    named_columns,
    recording_lines,
    shown_unit,
)
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import Glyph, Layer, add_all, curve, segments, sources_of
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.sentences import sentence_of
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.views.job_view import Editor, JobView
from bearing_explorer.kit.views.python_lines import code_of, scene_code, short
from bearing_explorer.kit.widgets.form import AS_HIGH_AS_SHOWN, stack
from bearingcore import Trend, trend
from bearingcore.errors import FieldError
from bearingcore.measured.diagnosis import CANNOT_TELL, NONE_SEEN, PARTS
from bearingcore.sizing import LINES

HEIGHT = 210
COLORS = {
    line: next(family.color for family in FAMILIES if line.startswith(family.name))
    for line in LINES
}
LABELS = {"bpfo": "BPFO", "bpfi": "BPFI", "bsf_2": "2 BSF", "ftf": "FTF"}
NUMBER = style.AxisQuantity("File", "", "number")
HOURS = style.AxisQuantity("Time since the first", "t", "h")
DAYS = style.AxisQuantity("Time since the first", "t", "d")
MOST_HOURS = 72.0
"""Length of a trend above which its time is in days."""
RMS = style.AxisQuantity("RMS", "", "")
AMPLITUDE = style.AxisQuantity("Envelope", "", "")
AXES = {
    "rms": RMS,
    "kurtosis": style.AxisQuantity("Kurtosis", "", ""),
    "lines": AMPLITUDE,
    "extent": style.AxisQuantity("Length of the defect", "Δφ", "°"),
}
MOST_NAMED = 3
"""Largest number of left-out files that a sentence names."""


def _layers(name: str) -> list[Layer]:
    """Return the layers of the figure with this name."""
    if name == "lines":
        names = {f"{line}_line": color for line, color in COLORS.items()}
    else:
        names = {name: style.color_along("y")}
    drawn: list[Layer] = []
    if name == "rms":
        drawn.append(curve("trend_baseline", "x", "y", style.FAINT_INK, 1.2, (5, 4)))
    if name == "extent":
        drawn.append(segments("trend_interval", style.color_along("y"), 2.0))
    else:
        drawn += [curve("trend", "x", y, color, 1.4) for y, color in names.items()]
    dots = {"size": 6}
    return [
        *drawn,
        *(Glyph(Scatter, "trend", ("x", y), {**dots, "color": c}) for y, c in names.items()),
    ]


class TrendOfFiles(JobView[Model, ComputedTrend, Editor], MeasuredView):
    """Root mean square, kurtosis, lines and extent of several files, in their order."""

    name = "trend"
    title = "Trend of several files"
    about = (
        "Several files of one machine, or a folder of them. They are chosen in step 1. Dashed: the "
        "first file. Bars: 95 % intervals; a bar without a dot is an upper bound. The rest of this "
        "tab shows the last file. Lines of the parts are drawn where they are above noise, all in "
        "the band of the last file; such a line need not come from the bearing. The length of the "
        "defect is drawn for files whose diagnosis names a damaged race."
    )
    finds_speed = True
    start = "Compute the trend"
    bounds = "Takes up to a few seconds per file."

    def build(self, packed: PackedSource) -> Any:
        #: series and signal of the job that began by itself
        self._began: tuple[Series, Measured] | None = None
        self._heights = {name: StickyRange(0.0, 1.0, anchor="zero", room=0.05) for name in AXES}
        number = packed.range("trend_x", 0.5, 2.5)
        self._plots: dict[str, figure] = {}
        for name, quantity in AXES.items():
            self._plots[name] = style.make_figure(
                NUMBER, quantity, number, packed.range(f"trend_{name}", 0.0, 1.0), height=HEIGHT
            )
        sources = sources_of(packed, [layer for name in AXES for layer in _layers(name)])
        for name, plot in self._plots.items():
            add_all(plot, sources, _layers(name))
        key = style.legend((COLORS[line], "━", LABELS[line]) for line in LINES)
        plots = list(self._plots.values())
        self._key_of_lines = pn.pane.HTML(key, margin=0)
        self._results_part = stack(
            *plots[:2], self._key_of_lines, *plots[2:], stylesheets=[AS_HIGH_AS_SHOWN]
        )
        self.hidden = stack(self.job, self._results_part, visible=False)
        return self.hidden

    # The job

    def prepare(self, given: Mapping[str, str], editor: Editor) -> Callable[[Work], str]:
        measured, measurement = self.measured, self.measurement
        if measured is None:
            raise ValueError(NOTHING)
        series, machine = measurement.series, measured.machine
        direction = self.direction_of(measured)
        band = self.demodulation(measured, direction).band

        def work(job: Work) -> str:
            gathered = measurement.recordings(measured, direction)

            def goes_on(so_far: Trend, count: int) -> bool:
                job.progress(len(so_far.points) / count)
                job.show(ComputedTrend(so_far, gathered, series, measured))
                return not job.cancelled()

            try:
                done = trend(
                    gathered.recordings, machine.bearing, machine.speed_range, direction=direction,
                    band=band, goes_on=goes_on,
                )  # fmt: skip
            except FieldError as error:
                raise ValueError(sentence_of(error)) from error
            return f"{len(done.points)} of {len(gathered.recordings)} files are in the trend."

        return work

    def _take(self, result: ComputedTrend) -> None:
        self.measurement.trend = result
        super()._take(result)

    def say(self, model: Model | None, sentence: str) -> None:
        super().say(model, sentence)
        measured, measurement = self.measured, self.measurement
        if measured is None:
            return
        several = len(measurement.series.tables) > 1 and measured.origin is not None
        self.hidden.visible = several or self.drawn
        self._results_part.visible = self.drawn
        self._write_axes()
        if several and measurement.series.together and self._jobs is not None:
            self._begin_once(model, (measurement.series, measured))

    def _begin_once(self, model: Model | None, now: tuple[Series, Measured]) -> None:
        """Begin without a click once the last file of a series is diagnosed."""
        if model is None or self._began == now:
            return
        question = self.measurement.question()
        if question is None or self.measurement.diagnoses.of(question) is not None:
            self._began = now
            self.start_job(self.job.values)

    # The picture

    @property
    def drawn(self) -> bool:
        newest, measurement = self.job_result, self.measurement
        if newest is None or self.measured is None:
            return False
        return newest.series is measurement.series and self.measured.in_si == newest.measured.in_si

    def _write_axes(self) -> None:
        if self.job_result is None:
            return
        unit, _ = shown_unit(self.job_result.measured)
        shown = self.job_result.trend
        across, _ = time_axis(shown)
        in_si = self.job_result.measured.in_si
        self._plots["rms"].visible = in_si
        self._plots["lines"].visible = self._key_of_lines.visible = in_si and bool(
            np.isfinite(shown.clear_lines).any()
        )
        self._plots["extent"].visible = any(
            math.isfinite(point.extent.high) for point in shown.points
        )
        for name, plot in self._plots.items():
            plot.xaxis[0].axis_label = across.label()
            plot.xaxis[0].ticker.min_interval = float(across is NUMBER)
            if name in ("rms", "lines"):
                plot.yaxis[0].axis_label = dataclasses.replace(AXES[name], unit=unit).label()

    def data(self, model: Model) -> tuple[Sources, Ranges]:
        newest = self.job_result
        if newest is None or not self.drawn:
            return {}, {}
        shown, size = newest.trend, 1.0 / shown_unit(newest.measured)[1]
        _, x = time_axis(shown)
        comparable = 1.0 if newest.measured.in_si else np.nan
        size *= comparable  # levels in unknown units are not compared
        rms = shown.column("rms") * size
        extent, low, high = (
            np.degrees([getattr(point.extent, name) for point in shown.points])
            for name in ("extent", "low", "high")
        )
        lines = {f"{name}_line": shown.clear_lines[:, k] * size for k, name in enumerate(LINES)}
        columns = {"x": x, "rms": rms, "kurtosis": shown.column("kurtosis"), "extent": extent}
        sources: Sources = {
            "trend": columns | lines,
            "trend_interval": {"x0": x, "x1": x, "y0": low, "y1": high},
            "trend_baseline": {"x": x, "y": np.full(x.size, rms[shown.baseline])},
        }
        heights = {
            "rms": rms,
            "kurtosis": columns["kurtosis"],
            "lines": np.concatenate(list(lines.values())),
            "extent": high,
        }
        room = 0.05 * max(float(np.ptp(x)), 1.0)
        ranges: Ranges = {"trend_x": (float(x.min()) - room, float(x.max()) + room)}
        for name, values in heights.items():
            ranges[f"trend_{name}"] = self._heights[name].fit(np.append(values, 0.0))
        return sources, ranges

    def sentence(self, model: Model) -> str:
        measured, newest = self.measured, self.job_result
        if measured is None:
            return ""
        if newest is None or not self.drawn:
            several = len(self.measurement.series.tables) > 1
            return "Nothing is computed yet." if several else "One file is no trend yet."
        along = newest.measured.along(newest.trend.direction)
        words = trend_words(newest.trend, newest.measured.in_si, along)
        if out := newest.recordings.left_out:
            more = f" And {len(out) - MOST_NAMED} more." if len(out) > MOST_NAMED else ""
            words += f" Left out: {' '.join(out[:MOST_NAMED])}{more}"
        if newest.measured is not measured:
            words += " Your answers have changed since: compute it again."
        return words

    def table(self, model: Model) -> dict[str, np.ndarray]:
        newest = self.job_result
        if newest is None or not self.drawn:
            return {}
        columns = named_columns(newest.trend.table(), newest.measured.in_si)
        return {name: column for name, column in columns.items()
                if newest.measured.in_si or "rms_change" not in name}  # fmt: skip

    def python(self) -> str:
        """Lines of Python that read the files and compute the trend without the page."""
        newest, model = self.job_result, self._results
        origins = () if newest is None else newest.recordings.origins
        if newest is None or model is None or None in origins:
            return super().python()
        return python_lines(newest, model)


def time_axis(shown: Trend) -> tuple[style.AxisQuantity, np.ndarray]:
    """Quantity and values (k,) across: the time of each recording, or its number without dates."""
    hours = shown.hours
    if not np.isfinite(hours).all():
        return NUMBER, np.arange(1.0, len(hours) + 1.0)
    return (DAYS, hours / 24.0) if np.ptp(hours) > MOST_HOURS else (HOURS, hours)


NO_LEVELS = "Their units are not known, so their levels are not compared: state the unit."


def trend_words(shown: Trend, in_si: bool, along: str = "") -> str:
    """Put a trend into words: growth, kurtosis, and the last recording.

    Levels are compared in SI units only.
    """
    first, last = shown.points[0], shown.points[-1]
    if len(shown.points) == 1:
        return f"One recording{along}: {last_words(shown)}"
    kurtosis = [style.number(point.kurtosis, 3) for point in (first, last)]
    return (
        f"{len(shown.points)} recordings{along}. {growth(shown) if in_si else NO_LEVELS} Kurtosis "
        f"{kurtosis[0]} in the first, {kurtosis[1]} in the last. {last_words(shown)}"
    )


def growth(shown: Trend) -> str:
    """Return words on the growth of the named part's line, its start, and the level's growth."""
    most, change = int(shown.rms_change.argmax()), shown.rms_change
    level = (
        f"Root mean square of the last is {style.number(float(change[-1]), 3)} times that of the "
        f"baseline, {shown.points[shown.baseline].name}"
    )
    if most != len(shown.points) - 1:
        top = style.number(float(change[most]), 3)
        level += f"; {top} times at most, in {shown.points[most].name}"
    return " ".join(filter(None, (line_growth(shown), since_when(shown), f"{level}.")))


def line_growth(shown: Trend) -> str:
    """Return words on the growth of the line of the part that the last recording names, if any."""
    part = shown.points[-1].fault
    change = float(shown.line_change(part)[-1]) if part in PARTS else math.nan
    if not math.isfinite(change):
        return ""
    seen = np.isfinite(shown.line_change(part)[shown.baseline])
    least = "" if seen else "at least "
    reference = "that of the baseline" if seen else "the most that noise hides in the baseline"
    return f"The line of the {part} grew to {least}{style.number(change, 2)} times {reference}."


def since_when(shown: Trend) -> str:
    """Say since which recording, and for how many days, that line stands out of noise."""
    part = shown.points[-1].fault
    first = shown.seen_since(part) if part in PARTS else None
    if first is None:
        return ""
    days = float(shown.hours[-1] - shown.hours[first]) / 24.0
    before = f", {style.number(days, 2)} days before the last" if days > 0.0 else ""
    if first == 0:
        return f"It has stood out since the first{before}."
    recorded = shown.points[first].recorded
    date = "" if recorded is None else f" of {recorded:%d %B %Y}"
    return f"It has stood out since {shown.points[first].name}{date}{before}."


def last_words(shown: Trend) -> str:
    """Return words on the part that the last recording names, and on the lines above noise."""
    last = shown.points[-1]
    clear = [
        LABELS[line] for k, line in enumerate(LINES) if np.isfinite(shown.clear_lines[:, k]).any()
    ]
    seen = f"Lines above noise: {style.list_words(clear)}." if clear else "No line is above noise."
    if not np.isfinite(shown.column("shaft_speed")).any():
        seen = "The part's lines are not searched for: no shaft speed is known."
    if last.extent.race and math.isfinite(last.extent.high):
        return f"{seen} In the last: {last.extent.sentence}"
    named = last.fault if last.fault not in (CANNOT_TELL, NONE_SEEN) else ""
    if not math.isfinite(last.probability):
        return "The damaged part is not known before the bearing is."
    if not named:
        return f"{seen} No part is named in the last ({last.fault})."
    return f"{seen} In the last: {named}, {100.0 * last.probability:.0f} % probable."


def python_lines(newest: ComputedTrend, model: Model) -> str:
    """Write Python that reads the files of a trend and computes it."""
    scene, shown = newest.measured.scene(model.scene), newest.trend
    machine, lines = newest.measured.machine, []
    bearing = "None" if machine.bearing is None else "scene.bearing"
    speed = "None" if machine.speed_range is None else code_of(machine.speed_range)
    read = newest.recordings
    for recording, origin in zip(read.recordings, read.origins, strict=True):
        turning = "None" if recording.shaft_speed is None else short(recording.shaft_speed)
        lines += [
            *recording_lines(
                dataclasses.replace(newest.measured, recording=recording, origin=origin)
            ),
            f"recordings.append(replace(recording, shaft_speed={turning}))",
        ]
    return "\n".join([
        "from dataclasses import replace",
        "from pathlib import Path\n",
        "from bearingcore import Scene, presets, read_table, trend",
        "from bearingcore.measured.files import Column\n",
        f"scene = {scene_code(scene)}",
        "recordings = []",
        *lines,
        "measured = trend(",
        f"    recordings, {bearing}, {speed}, direction={code_of(shown.direction)},",
        f"    band=({short(shown.band[0])}, {short(shown.band[1])}), baseline={shown.baseline},",
        ")",
        "columns = measured.table().in_units().named()",
        "print(measured.rms_change)\n",
    ])  # fmt: skip
