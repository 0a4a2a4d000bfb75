"""Simpler models of the scene: their errors and run times."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from bokeh.core.properties import value
from bokeh.models import BoxAnnotation, Range1d

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views import work_precision
from bearing_explorer.explorer.views.scene_job_view import SceneJobView
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import by_number
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearingcore.common import decibels, percent
from bearingcore.model.experiments import SPECTRUM, Alternative, Alternatives, alternatives

LEAST_HEIGHT = 60
"""Height [px] of the chart without a model."""
_DOTS = ("error", "row", "slot", "marker", "words", "side", "right")
GOOD_ENOUGH = {True: work_precision.ALLOWED["dB"], False: work_precision.ALLOWED["1"]}
"""Greatest errors of a model that is good enough: of spectra [dB], of curves over their swing."""


class OtherModels(SceneJobView[Alternatives]):
    """Errors and run times with fewer directions, other edges, balls, orbits, steps and angles.

    Each model is a dot at its error over the allowed error.
    """

    name = "alternatives"
    title = "Simpler models of this scene"
    about = (
        "Errors against the scene's own model. In the green part they are small enough. Each model "
        "is computed. Allowed are 0.1 dB of spectra and 1 % of the swing of curves. Errors of "
        "stiffness hold at 99 % of the cage angles; those of spectra up to 1.25 times the highest "
        "natural frequency."
    )
    start = "Compare simpler models"
    bounds = "A quarter of a second of motion in several models; it takes about a second."

    def build(self, packed: PackedSource) -> Any:
        self.plot = self._figure()
        return [self.plot, self.job]

    def _figure(self) -> Any:
        """Make the chart with a row for each model, from the top; `_fill` writes their names."""
        sides = [style.AxisQuantity(name, "", "") for name in ("Error over what is allowed", " ")]
        ranges = [Range1d(*ends, syncable=False) for ends in ((0.1, 10.0), (0.0, 1.0))]
        plot = style.make_figure(
            *sides, *ranges, height=LEAST_HEIGHT, x_axis_type="log", sizing_mode="stretch_width"
        )
        plot.visible = False
        plot.xaxis.formatter = style.logarithmic_ticks()
        near = {"fill_color": "#E6F3EE", "fill_alpha": 1.0, "line_color": None, "level": "image"}
        plot.add_layout(BoxAnnotation(right=1.0, **near))
        self._dots = work_precision.column_source(*_DOTS)
        color = by_number("slot", (style.INK, "#00704F", "#D55E00"))
        plot.scatter("error", "row", source=self._dots, marker="marker", size=9,
                     fill_color=color, line_color=color)  # fmt: skip
        plot.text("error", "row", text="words", source=self._dots, text_color=style.INK,
                  text_font=value(style.FONT), text_font_size=style.SMALL_TEXT_SIZE,
                  text_baseline="middle", text_align="side", x_offset="right")  # fmt: skip
        return plot

    def _fill(self, rows: Sequence[Alternative]) -> None:
        """Draw the models; one without an error is a cross on the right edge."""
        shares = [row.error / GOOD_ENOUGH[row.quantity == SPECTRUM] for row in rows]
        known = [share for share in shares if math.isfinite(share)]
        left, right = max(min([*known, 0.1]), 1e-4) / 2.0, 4.0 * max([*known, 10.0])
        dots = []
        for i, (row, share) in enumerate(zip(rows, shares, strict=True)):
            finite = math.isfinite(share)
            place = min(max(share, 1.5 * left), right / 1.5) if finite else right / 1.5
            # words of a dot in the right part of the chart are written to its left
            to_left = math.log(place / left) > 0.6 * math.log(right / left)
            error = decibels(row.error) if row.quantity == SPECTRUM else percent(row.error, 2)
            words = error if finite else row.note
            if finite and math.isfinite(row.saved):
                saving = "saves" if row.saved >= 0.0 else "costs more:"
                words += f", {saving} {style.with_prefix(abs(row.saved), 's')}"
            dots.append((place, -i, 0 if not finite else 1 if share <= 1.0 else 2,
                         "circle" if finite else "x", words,
                         "right" if to_left else "left", -9 if to_left else 9))  # fmt: skip
        self._dots.data = work_precision.columns_of(_DOTS, dots)
        names = {-i: row.name for i, row in enumerate(rows)}
        self.plot.min_border_left = 26 + round(6.6 * max(map(len, names.values()), default=0))
        style.fixed_ticks(self.plot.yaxis[0], list(names))
        self.plot.yaxis.major_label_overrides = names
        work_precision.set_range(self.plot.x_range, left, right)
        work_precision.set_range(self.plot.y_range, 0.4 - len(rows), 0.6)
        self.plot.update(height=LEAST_HEIGHT + 22 * len(rows), visible=bool(rows))

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        scene = editor.scene

        def compute(job: Work) -> str:
            compiling.need(compiling.BALLS_WITH_MASS)
            began = time.perf_counter()
            models = alternatives(scene, job.cancelled)
            job.show(models)
            return f"{len(models.rows)} models after {time.perf_counter() - began:.1f} s."

        return compute

    def sentence(self, results: Results) -> str:
        if self.job_result is None:
            return "No model is compared yet."
        enough = [
            row.name
            for row in self.job_result.rows
            if row.error <= GOOD_ENOUGH[row.quantity == SPECTRUM] and row.saved > 0.0
        ]
        words = "No faster model is within 0.1 dB or 1 % of the swing"
        if enough:
            words = f"Faster, and within 0.1 dB or 1 % of the swing: {style.list_words(enough)}"
        if self.job_result.scene != results.scene:
            words += ". Computed for an earlier scene"
        return f"{words}."

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if self.job_result is not None:
            self._fill(self.job_result.rows)

    def columns(self, models: Alternatives) -> dict[str, np.ndarray]:
        return models.table().named()
