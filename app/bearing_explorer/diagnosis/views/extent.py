"""The extent of a spall from entry to exit, and the mean ball pass that shows both."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from bokeh.plotting import figure

from bearing_explorer.diagnosis.diagnoses import BUSY, ExtentQuestion, Question, extent_of
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.sized_defect import nearest_way_round, size_in_words
from bearing_explorer.diagnosis.views.measured_view import MEASURED, WITHOUT_BEARING, MeasuredView
from bearing_explorer.diagnosis.views.measurement import fit_with_head
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import Layer, curve, draw, names_over, uprights
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.views.look_view import LookView
from bearing_explorer.kit.widgets.form import AS_HIGH_AS_SHOWN, FieldSpec, stack
from bearingcore import Diagnosis, MeasuredExtent

HEIGHT = 236
BANDS = 3
"""Mean passes that are drawn: of the best bands."""
BEFORE = 0.14
"""Share of a ball pass that is drawn before the entry."""

FIELDS: list[FieldSpec] = [
    {
        "name": "race",
        "label": "Damaged is",
        "options": [
            ["", "the part of step 2"],
            ["outer", "the outer race, as is known"],
            ["inner", "the inner race, as is known"],
        ],
    }
]

EDGE_WORDS = """
const short = ['ball enters', 'ball leaves', 'enters or leaves'][row.exit]
const long = ['ball enters: low frequency', 'ball leaves: high frequency', short][row.exit]
return narrow || row.shift < 0 ? short : long
"""


def layers() -> list[Layer]:
    """Return the layers from the lowest up: edges, and mean passes, of which the best is strong."""
    names = names_over(
        "extent_edges", EDGE_WORDS, "angle", "row", style.INK, ("exit",), x_offset="shift"
    )
    faint = [
        curve(f"extent_pass_{number}", "angle", "envelope", MEASURED, 1.0, alpha=0.35)
        for number in reversed(range(1, BANDS))
    ]
    best = curve("extent_pass_0", "angle", "envelope", MEASURED, 1.6)
    return [uprights("extent_edges", "angle", style.DEFECT, 1.4, 1.0), names, *faint, best]


class SpallExtent(LookView, MeasuredView):
    """The answer of `bearingcore.measure_extent`, measured once the damaged race is named."""

    name = "extent"
    title = "3  How long"
    about = (
        "Length of a spall, from entry to exit. Drawn is the mean envelope of a ball pass. A ball "
        "that enters a spall and one that leaves it each give a peak. The distance of the peaks "
        "and the angle at the edges over which the ball carries nothing make the extent. Strong: "
        "the frequency band that shows both best. Faint: other bands. A ball that enters is "
        "released gradually, which shows at low frequency; one that leaves strikes the edge, which "
        "shows at high frequency. The card below simulates the lengths that remain."
    )
    finds_speed = True
    computes = True
    look_fields = FIELDS
    first_look: ClassVar[dict[str, Any]] = {"race": ""}

    def build(self, packed: PackedSource) -> Any:
        self._stored: MeasuredExtent | None = None
        self._size = StickyRange(0.0, 1.0)
        self.plot = self._plot(packed)
        self._seen = stack(self.plot, visible=False, stylesheets=[AS_HIGH_AS_SHOWN])
        self.hidden = stack(self.panel_of_look, self._seen, visible=False)
        return self.hidden

    def _plot(self, packed: PackedSource) -> figure:
        plot = style.make_figure(
            style.AxisQuantity("Angle of the race", "", "°"),
            style.AxisQuantity("Envelope, of its mean", "", ""),
            packed.range("extent_angle", 0.0, 40.0),
            packed.range("extent_size", 0.0, 1.0),
            height=HEIGHT,
            title="Mean ball pass",
        )
        draw(plot, packed, layers())
        return plot

    # What it is about

    def question(self) -> ExtentQuestion | None:
        """Return the question; None before the damaged part of the bearing is diagnosed."""
        measurement = self.measurement
        about = measurement.question()
        if about is None or measurement.diagnoses.of(about) is None:
            return None
        return self._question(about, measurement.state.load, measurement.diagnosis())

    def _question(
        self, about: Question, load: float | None = None, diagnosis: Diagnosis | None = None
    ) -> ExtentQuestion:
        return ExtentQuestion.about(
            about.measured,
            whole=about.bearing,
            race=self.look["race"],
            load=load,
            diagnosis=diagnosis,
        )

    def answer(self) -> MeasuredExtent | str | None:
        """Return the extent, a sentence why there is none, or None: not yet."""
        if self._stored is not None:
            return self._stored
        question = self.question()
        return None if question is None else self.measurement.extents.of(question)

    @property
    def job_result(self) -> MeasuredExtent | None:
        """The extent that is known, for reports."""
        answer = self.answer()
        return answer if isinstance(answer, MeasuredExtent) else None

    @job_result.setter
    def job_result(self, extent: MeasuredExtent) -> None:
        self._stored = extent

    def choose(self, choices: Mapping[str, Any], model: Model) -> None:
        super().choose(choices, model)
        about = self.measurement.question()
        if about is not None:
            answer = extent_of(self._question(about))
            self._stored = answer if isinstance(answer, MeasuredExtent) else None

    # The picture

    @property
    def drawn(self) -> bool:
        return self._seen.visible

    def data(self, model: Model) -> tuple[Sources, Ranges]:
        extent = self.answer()
        if not isinstance(extent, MeasuredExtent) or not extent.passes:
            return {}, {}
        spacing = math.degrees(extent.ball_spacing)
        best = extent.passes[0].envelope
        # angle 0 is the entry, or the highest peak
        start = extent.entry if math.isfinite(extent.entry) else int(best.argmax()) / len(best)
        first = round((start - BEFORE) * len(best)) % len(best)
        angle = spacing * (np.arange(len(best)) / len(best) - BEFORE)
        drawn = [np.roll(mean.envelope, -first) for mean in extent.passes[:BANDS]]
        sources: Sources = {
            f"extent_pass_{number}": {"angle": angle, "envelope": envelope}
            for number, envelope in enumerate(drawn)
        }
        if math.isfinite(extent.entry):
            sources["extent_edges"] = _edges(extent, spacing, self._way_round(extent))
        return sources, {
            "extent_angle": (-BEFORE * spacing, (1.0 - BEFORE) * spacing),
            "extent_size": fit_with_head(self._size, drawn, 0.3),
        }

    def _way_round(self, extent: MeasuredExtent) -> int | None:
        """Return 0 where the first peak is the entry, 1 where it is the exit, None if unknown."""
        sizing = self.measurement.sizing()
        if sizing is None or not sizing.conclusive or sizing.best is None:
            return 0 if extent.measured else None
        return nearest_way_round(sizing.best.extent, extent)

    def say(self, model: Model | None, sentence: str) -> None:
        self._show()
        super().say(model, sentence)

    def _show(self) -> None:
        question, answer = self.question(), self.answer()
        if question is not None and answer is None:
            self.measurement.extents.want(question)
        self._seen.visible = isinstance(answer, MeasuredExtent)
        if isinstance(answer, MeasuredExtent):
            self.plot.visible = bool(answer.passes)

    def sentence(self, model: Model) -> str:
        answer = self.answer()
        if answer is None:
            if self.measured is None:
                return ""
            return BUSY if self.measured.bearing is not None else WITHOUT_BEARING
        if isinstance(answer, str):
            return answer
        truth = None if self.measured is None else self.measured.true_extent
        known = "" if truth is None else (
            f" The signal is simulated: the true extent is {math.degrees(truth):.1f}°."
        )  # fmt: skip
        sizing = self.measurement.sizing()
        if sizing is not None and (size := size_in_words(sizing)):
            decided = f" The natural frequencies decide, see below: {size}."
            return _by_entry_and_exit(answer) + decided + known + grounds(answer)
        return answer.sentence + known + grounds(answer)

    def table(self, model: Model) -> dict[str, np.ndarray]:
        answer = self.answer()
        return answer.table().in_units().named() if isinstance(answer, MeasuredExtent) else {}


def _by_entry_and_exit(extent: MeasuredExtent) -> str:
    """Lengths that entry and exit leave open, in a sentence."""
    if not extent.alternatives:
        allowed = f"only say: {extent.size}" if extent.size else "do not give a length"
        return f"Entry and exit alone {allowed}."
    first, other = (math.degrees(length) for length, _, _ in extent.alternatives)
    return (
        f"Entry and exit alone allow about {first:.0f}° or {other:.0f}°, or whole ball spacings of "
        f"{math.degrees(extent.ball_spacing):.1f}° more."
    )


def grounds(extent: MeasuredExtent) -> str:
    """Say in a sentence from which angles and ball passes an extent was measured."""
    if not extent.n_passes:
        return ""
    words = f" Mean of {extent.n_passes} ball passes"
    if math.isfinite(extent.separation):
        apart, offset = math.degrees(extent.separation), math.degrees(extent.offset)
        words += f", with {apart:.1f}° between the peaks and {offset:.1f}° at the edges"
    return f"{words}."


def _edges(extent: MeasuredExtent, spacing: float, way: int | None) -> dict[str, np.ndarray]:
    """Angles [deg] of entry and exit, the first peak at 0, and places of their names."""
    apart = spacing * ((extent.exit - extent.entry + BEFORE) % 1.0 - BEFORE)
    angle = np.array([0.0, apart])
    return {
        "angle": angle,
        "exit": np.array([2.0, 2.0] if way is None else [float(way), 1.0 - way]),
        "row": np.array([0.93, 0.82]),
        "shift": np.where(angle > (0.8 - BEFORE) * spacing, -66.0, 4.0),
    }
