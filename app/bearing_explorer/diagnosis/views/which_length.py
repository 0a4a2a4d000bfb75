"""Choice between several lengths of a spall: the frequencies at which the machine rings decide."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from bokeh import models
from bokeh.models import Range1d
from bokeh.plotting import figure

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.sized_defect import SizedDefect, likelier, machine_of
from bearing_explorer.diagnosis.views.measured_view import (
    MEASURED,
    NOTHING,
    WITHOUT_BEARING,
    MeasuredView,
)
from bearing_explorer.diagnosis.views.measurement import fit_with_head
from bearing_explorer.kit.compute.compiling import MOTION, need
from bearing_explorer.kit.compute.jobs import SIZING, Work
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import (
    Glyph,
    Layer,
    curve,
    draw,
    names_over,
    segments,
    strips,
)
from bearing_explorer.kit.plots.levels import FREQUENCY, SHOWN
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.views.job_view import Editor, JobView
from bearing_explorer.kit.widgets.facts import facts_pane, html_table
from bearing_explorer.kit.widgets.form import AS_HIGH_AS_SHOWN, FieldSpec, row, stack
from bearingcore import Scene, Sizing, size_defect
from bearingcore.sizing import Candidate

HEIGHT = 300
ACCELERATION = style.AxisQuantity("Amplitude", "A", "m/s²")
COLORS = ("#0072B2", "#D55E00", "#009E73", "#AA3377")
"""Colours of the candidates, the best first: there are four at most."""
BAND_ROW = 0.075
"""Share of the frame's height that a candidate's bands take at its top."""
KNOWN = "scene"
"""The answer that the support of the machine is that of the scene."""

NOT_COMPARED = "The possible lengths have not been compared with this signal yet."
SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
BAND_WORDS = "return row.extent > 0 ? row.extent.toFixed(1) + '°' : ''"


class Cancelled(Exception):  # noqa: N818
    """A person cancelled the search."""


class WhichLength(JobView[Model, SizedDefect, Editor], MeasuredView):
    """The answer of `bearingcore.size_defect`: each length is simulated and compared."""

    name = "which-length"
    title = "Which of these lengths?"
    about = (
        "Spectra: measured, and simulated for each length. Shaded: natural "
        "frequencies of the best length as balls pass. Vertical lines: harmonics of the measured "
        "mean ball pass. Curves: the same for the best lengths, scaled to the same size. Bars at "
        "the top: natural frequencies of each length. Entry and exit give the length up to whole "
        "ball spacings; a longer spall leaves fewer balls to carry the load, so that the "
        "machine rings at other frequencies (Petersen, Howard and Prime 2014, Section 4). For that "
        "the machine has to be known, with load, clearance, mass and stiffness of rotor and "
        "support, and with place, depth and edges of the defect. A simulated signal has all of "
        "these. For a file say that the support is known only if the scene's rotor and support "
        "were measured on this machine: with another support a wrong length may fit. The misfit is "
        "0 where measured and simulated ball pass are alike and 1 where they are not."
    )
    start = "Compare the lengths"
    bounds = "Takes a few seconds."
    at_once = True
    kind = SIZING

    def build(self, packed: PackedSource) -> Any:
        #: signal and race for which a job has started by itself
        self._began: tuple[Measured, str] | None = None
        self._answer_of = -1  # arrival of the file to which the form's answer belongs
        self._heights = {dof: StickyRange(0.0, 1.0, anchor="zero") for dof in SHOWN}
        frequency = packed.range("length_frequency", 0.0, 2500.0)
        self._plots = {dof: _plot(packed, dof, frequency) for dof in reversed(SHOWN)}
        self._candidates = facts_pane(sizing_mode="stretch_width")
        self._spectra = row(*self._plots.values(), stylesheets=[style.WRAPPED])
        self.hidden = stack(
            self.job, self._spectra, self._candidates, visible=False,
            stylesheets=[AS_HIGH_AS_SHOWN],
        )  # fmt: skip
        return self.hidden

    is_empty = MeasuredView.is_empty  # a result without candidates has no figure

    # The job

    @property
    def race(self) -> str:
        """The damaged race that the diagnosis names; empty without one."""
        extent = self.measurement.extent()
        return "" if extent is None else extent.race

    def fields(self) -> list[FieldSpec]:
        options = [["", "not known"], [KNOWN, "known: it is the scene's"]]
        return [{"name": "support", "label": "The machine's support is", "options": options}]

    def form(self, editor: Editor) -> tuple[dict[str, str], dict[str, Any]]:
        return {"support": ""}, {}

    def prepare(self, given: Mapping[str, str], editor: Editor) -> Callable[[Work], str]:
        measured, scene = self.measured, editor.scene
        if measured is None:
            raise ValueError(NOTHING)
        machine = machine_of(measured, scene, self.race, self.measurement.shaft_speed)
        known = given["support"] == KNOWN

        def work(job: Work) -> str:
            def progress(share: float, words: str) -> None:
                job.progress(share, words)
                if job.cancelled():
                    raise Cancelled

            if known:
                need(MOTION, machine)
            try:
                sizing = size_defect(
                    measured.recording, machine, support_known=known, progress=progress
                )
            except Cancelled:
                return ""
            job.show(SizedDefect(sizing, measured, machine, scene))
            return ""

        return work

    def _take(self, sized: SizedDefect) -> None:
        self.measurement.sized = sized
        super()._take(sized)

    def say(self, model: Model | None, sentence: str) -> None:
        super().say(model, sentence)
        measured, race = self.measured, self.race
        if measured is None:
            return
        # without the explorer no scene can be that of the machine
        self.panel.visible = self.measurement.can_simulate
        self.hidden.visible = bool(race) or self.drawn
        self._spectra.visible = self._candidates.visible = self.drawn
        if self.drawn and self.job_result is not None:
            self._candidates.object = candidates_html(self.job_result.sizing)
            for dof, plot in self._plots.items():
                plot.visible = dof in measured.directions
        if self._answer_of != self.measurement.state.arrival:
            # the answer on the support belongs to the previous file
            self._answer_of = self.measurement.state.arrival
            self.job.fill({"support": "" if measured.true_scene is None else KNOWN}, {})
        if race and model is not None and self._began != (measured, race):
            self._began = measured, race
            self.start_job(self.job.values)

    # The picture

    @property
    def _sizing(self) -> Sizing | None:
        """The answer on the signal that is drawn."""
        result = self.job_result
        return result.sizing if result is not None and result.measured is self.measured else None

    @property
    def drawn(self) -> bool:
        return self._sizing is not None and bool(self._sizing.candidates)

    def scene_drawn(self, model: Model) -> Scene:
        if self.job_result is None:
            return MeasuredView.scene_drawn(self, model)
        return self.job_result.machine

    def data(self, model: Model) -> tuple[Sources, Ranges]:
        sizing, measured = self._sizing, self.measured
        if sizing is None or measured is None or not sizing.candidates:
            return {}, {}
        step = float(np.diff(sizing.frequency).min(initial=np.inf))
        low, high = sizing.frequency[0] - step, sizing.frequency[-1] + step
        ranges: Ranges = {"length_frequency": (low, high)}
        sources: Sources = {}
        head = BAND_ROW * (len(sizing.candidates) + 0.5)
        for column, dof in enumerate(measured.directions):
            amplitude = 2.0 * np.abs(sizing.lines[:, column])
            drawn = [amplitude]
            sources[f"length_measured_{dof}"] = {
                "x0": sizing.frequency, "x1": sizing.frequency,
                "y0": np.zeros_like(amplitude), "y1": amplitude,
            }  # fmt: skip
            for number, candidate in enumerate(sizing.candidates):
                scale = np.linalg.norm(sizing.lines) / np.linalg.norm(candidate.lines)
                drawn.append(2.0 * scale * np.abs(candidate.lines[:, column]))
                sources[f"length_candidate_{dof}_{number}"] = {
                    "frequency": sizing.frequency, "amplitude": drawn[-1],
                }  # fmt: skip
                sources[f"length_bands_{dof}_{number}"] = _bands(candidate, dof, number, high)
            ranges[f"length_size_{dof}"] = fit_with_head(
                self._heights[dof], drawn, head / (1.0 - head)
            )
        return sources, ranges

    def sentence(self, model: Model) -> str:
        measured, extent, sizing = self.measured, self.measurement.extent(), self._sizing
        if measured is None:
            return ""
        if measured.bearing is None:
            return WITHOUT_BEARING
        if sizing is None:
            return NOT_COMPARED if extent is None or extent.race else extent.status.sentence
        words = [re.sub(r"\bmode \w+", lambda mode: mode[0].translate(SUBSCRIPTS), sizing.sentence)]
        if extent is not None and not sizing.conclusive:
            words.append(likelier(sizing, extent))
        if self.measurement.sized is self.job_result and self.measurement.sizing() is None:
            words.append("The scene has changed since: compare the lengths again.")
        if measured.true_extent is not None:
            true = math.degrees(measured.true_extent)
            words.append(f"The signal is simulated: the true length is {true:.1f}°.")
        return " ".join(filter(None, words))

    def table(self, model: Model) -> dict[str, np.ndarray]:
        sizing = self._sizing
        if sizing is None or not sizing.candidates:
            return {}
        return sizing.table().in_units().named()


def _plot(packed: PackedSource, dof: str, frequency: Range1d) -> figure:
    plot = style.make_figure(
        FREQUENCY,
        ACCELERATION,
        frequency,
        packed.range(f"length_size_{dof}", 0.0, 1.0),
        height=HEIGHT,
        sizing_mode="stretch_width",
        title=f"Mean ball pass along {dof}",
    )
    draw(plot, packed, _layers(dof))
    return plot


def _layers(dof: str) -> list[Layer]:
    """Return the bands of the candidates, and over them the spectra, the best one on top."""
    below: list[Layer] = [strips(f"length_bands_{dof}_0", COLORS[0], 0.10)]
    above: list[Layer] = []
    for number, color in reversed(list(enumerate(COLORS))):
        bands, spectrum = f"length_bands_{dof}_{number}", f"length_candidate_{dof}_{number}"
        bar = {"line_color": color, "line_width": 9, "line_alpha": 0.6, "y_range_name": "shares"}
        below += [
            names_over(bands, BAND_WORDS, "high", "row", color, ("extent",), x_offset=4),
            Glyph(models.Segment, bands, ("low", "row", "high", "row"), bar),
        ]
        look = (1.4, (5, 3)) if number else (2.2, ())
        above.append(curve(spectrum, "frequency", "amplitude", color, *look))
    return [*below, segments(f"length_measured_{dof}", MEASURED, 2.0), *above]


def _bands(candidate: Candidate, dof: str, number: int, top: float) -> dict[str, np.ndarray]:
    """The natural frequencies of a candidate along a direction; the lowest has its label."""
    ends = [span for label, span in candidate.bands.items() if label[:-1] == dof and span[0] < top]
    low, high = np.array(ends).reshape(-1, 2).T
    place = np.full_like(low, 1.0 - BAND_ROW * (number + 0.6))
    extent = np.where(low == low.min(initial=np.inf), math.degrees(candidate.extent), np.nan)
    return {"low": low, "high": np.minimum(high, top), "row": place, "extent": extent}


def candidates_html(sizing: Sizing) -> str:
    """The candidates with their misfits and the bands that distinguish them, as a table."""
    modes = [mode for mode in ("x1", "y1") if mode in sizing.candidates[0].bands]
    heads = ["Length", "Misfit", *(f"Mode {mode.translate(SUBSCRIPTS)}" for mode in modes)]
    rows = []
    for candidate, color in zip(sizing.candidates, COLORS, strict=False):
        swatch = f'<span style="color: {style.css_color(color)}">━</span>'
        spans = (
            f"{low:.0f} to {high:.0f} Hz" if math.isfinite(low) else "–"
            for low, high in (candidate.bands[mode] for mode in modes)
        )  # fmt: skip
        extent = f"{swatch} {math.degrees(candidate.extent):.1f}°"
        rows.append([extent, f"{candidate.misfit:.2f}", *spans])
    return html_table(heads, rows, named=True)
