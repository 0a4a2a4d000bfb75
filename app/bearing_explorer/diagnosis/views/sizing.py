"""The size of the defect behind a measured signal: candidates, and what each would sound like."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from bokeh.models import Range1d
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.diagnosis.measurement_state import Sized
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.extent import BEFORE, EDGE_WORDS
from bearing_explorer.diagnosis.views.measured_job_view import MeasuredJobView, SceneNow
from bearing_explorer.diagnosis.views.measured_view import (
    MEASURED,
    NOTHING,
    WITHOUT_BEARING,
    WITHOUT_SPEED,
)
from bearing_explorer.diagnosis.views.measurement import with_head
from bearing_explorer.diagnosis.widgets.candidates import (
    CandidateList,
    along_race,
    in_degrees,
    rows,
)
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import (
    Layer,
    add_all,
    curve,
    names_over,
    sources_of,
    uprights,
)
from bearing_explorer.kit.plots.levels import SHOWN
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.sentences import sentence_of
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import AS_HIGH_AS_SHOWN, FieldSpec, stack
from bearing_explorer.kit.widgets.status import StatusLine
from bearingcore import Candidate, Scene, Sizing, size_defect
from bearingcore.common import with_deviation
from bearingcore.signals import BallPasses

if TYPE_CHECKING:
    from bearing_explorer.diagnosis.model import Model

HEIGHT = 236
SAMPLES = 600
"""Of a mean ball pass that is drawn."""
OUTER, INNER = "outer race", "inner race"
FAULTS = [["", "the part of step 2"], [OUTER, "the outer race, as is known"]]
"""Parts that may be chosen as damaged: value and words."""

KNOWN = "known"
SUPPORTS = [
    ["", "not measured: no size"],
    [KNOWN, "measured, as in the scene"],
]
"""Knowledge of the machine's masses and springs: value and words."""


def layers(dof: str) -> list[Layer]:
    """The mean ball pass along a direction: of a candidate, the measured one over it."""
    candidate, measured = (f"sizing_pass_{who}_{dof}" for who in ("candidate", "measured"))
    edges = "sizing_events"
    return [
        uprights(edges, "time", style.INK, 1.0, 0.7),
        names_over(edges, EDGE_WORDS, "time", "row", style.INK, ("exit",), x_offset="shift"),
        curve(candidate, "time", "size", style.color_along(dof), 3.2),
        curve(measured, "time", "size", MEASURED, 1.1),
    ]


class Cancelled(Exception):  # noqa: N818
    """The work is cancelled."""


class DefectSize(MeasuredJobView[Sized]):
    """Candidates for the extent with their probabilities, and their curves over the measured."""

    name = "sizing"
    title = "4  How long, by simulation"
    about = (
        "For machines whose masses and springs are known. Then whole ball spacings can be counted: "
        "every extent on the outer race is simulated and rated by how well it explains the mean "
        "ball pass and the spectrum. Coloured: the candidate that is shown. Thin: measured."
    )
    start = "Find the size"
    bounds = (
        "Takes some seconds. Load, support, depth and centre of the defect are those of the scene, "
        "bearing and speed those of step 2; the scene's extent is not looked at."
    )

    def build(self, packed: PackedSource) -> Any:
        self.status = StatusLine(sizing_mode="stretch_width", margin=0)
        self.status.stylesheets = [".line { padding: 2px 0 6px; font-family: var(--font); }"]
        self.candidates = CandidateList(self.look_at, self._take_extent)
        self._looked: int | None = None
        self._passes = {dof: StickyRange(-1.0, 1.0) for dof in SHOWN}
        seconds = packed.range("sizing_time", 0.0, 0.03)
        sources = sources_of(packed, [layer for dof in SHOWN for layer in layers(dof)])
        self._rows = {}
        for dof in SHOWN:
            plot = self._pass_plot(packed, dof, seconds)
            add_all(plot, sources, layers(dof))
            self._rows[dof] = stack(plot)
        self._answer_part = stack(
            self.status,
            self.candidates,
            *self._rows.values(),
            visible=False,
            stylesheets=[AS_HIGH_AS_SHOWN],
        )
        self.hidden = stack(self.job, self._answer_part, visible=False)
        return self.hidden

    def _pass_plot(self, packed: PackedSource, dof: str, seconds: Range1d) -> figure:
        return style.make_figure(
            style.AxisQuantity("Time in a ball pass", "t", "s", prefixed=True),
            style.AxisQuantity("Acceleration", f"a{dof}", "m/s²", prefixed=True),
            seconds,
            packed.range(f"sizing_pass_size_{dof}", -1.0, 1.0),
            height=HEIGHT,
            title=f"Mean ball pass along {dof}",
        )

    # The job

    def fields(self) -> list[FieldSpec]:
        return [
            {"name": "fault", "label": "Damaged is", "options": FAULTS},
            {"name": "support", "label": "Support is", "options": SUPPORTS},
        ]

    def form(self, editor: SceneNow) -> tuple[dict[str, str], dict[str, Any]]:
        return {"fault": "", "support": ""}, {}

    def prepare(self, given: Mapping[str, str], editor: SceneNow) -> Callable[[Work], str]:
        measured = self.measured
        if measured is None:
            raise ValueError(self.why_nothing or NOTHING)
        if measured.bearing is None:
            raise ValueError(WITHOUT_BEARING)
        if measured.machine.exact_speed is None:
            raise ValueError(WITHOUT_SPEED)
        if measured.machine.by_frequencies:
            raise ValueError("Frequencies do not give the dimensions of the bearing: choose it.")
        scene = measured.scene(editor.scene)
        fault = given.get("fault") or None
        if fault not in (None, OUTER):
            raise ValueError(f"Not possible: damaged is {OUTER!r}, or the diagnosed part.")
        known = given.get("support") == KNOWN

        def work(job: Work) -> str:
            return compute(job, measured, scene, fault, known)

        return work

    def _take(self, found: Sized) -> None:
        if self.measurement is not None:  # events are drawn into the signal where they are known
            self.measurement.sized = found if has_answer(found.sizing) else None
        self._looked = None
        super()._take(found)

    @property
    def sized(self) -> Sized | None:
        """The answer, where it is one about the signal that is drawn."""
        found = self.found
        return found if found is not None and found.measured is self.measured else None

    @property
    def drawn(self) -> bool:
        return self.sized is not None

    def look_at(self, index: int) -> None:
        """Show the curves of a candidate."""
        if self.sized is not None and index < len(self.sized.sizing.candidates):
            self._looked = index
            self._draw()

    def _take_extent(self, extent_deg: float) -> None:
        if self.measurement is not None and self.measurement.change_scene is not None:
            self.measurement.change_scene({"typed": {"extent_deg": f"{extent_deg}"}})

    def candidate(self, sizing: Sizing) -> Candidate:
        """The candidate that is looked at; the most probable one at first."""
        return sizing.best if self._looked is None else sizing.candidates[self._looked]

    # The picture

    def data(self, model: Model) -> tuple[Sources, Ranges]:
        sized = self.sized
        if sized is None or not sized.sizing.candidates:
            return {}, {}
        sizing = sized.sizing
        candidate = self.candidate(sizing)
        measured = alike(sizing.passes, candidate.passes)
        period = 1.0 / sizing.passes.frequency
        entry, _ = sizing.best.phases()  # time 0 for all, so that what was measured stays put
        times, first = pass_times(entry, period)
        curves = {
            "measured": in_order(measured.waveform(SAMPLES, sizing.band.lowest), first),
            "candidate": in_order(candidate.waveform(SAMPLES, sizing.band.lowest), first),
        }
        sources = edges(sizing, candidate, entry, period)
        ranges: Ranges = {"sizing_time": (-BEFORE * period, (1.0 - BEFORE) * period)}
        for column, dof in enumerate(sizing.recording.directions):
            for who in ("measured", "candidate"):
                sources[f"sizing_pass_{who}_{dof}"] = {
                    "time": times,
                    "size": curves[who][:, column],
                }
            ranges[f"sizing_pass_size_{dof}"] = with_head(
                self._passes[dof], [curve[:, column] for curve in curves.values()], 0.3
            )
        return sources, ranges

    def say(self, model: Model | None, sentence: str) -> None:
        super().say(model, sentence)
        sized = self.sized
        answered = sized is not None and bool(sized.sizing.candidates)
        self._answer_part.visible = answered
        if sized is None or not answered:
            return
        self.status.line = status(sized)
        looked = sized.sizing.candidates.index(self.candidate(sized.sizing))
        takes = self.measurement is not None and self.measurement.change_scene is not None
        self.candidates.show(rows(sized), looked, takes=takes)
        for dof, row in self._rows.items():
            row.visible = dof in sized.measured.directions

    def sentence(self, model: Model) -> str:
        if self.measured is None:
            return self.why_nothing
        sized = self.sized
        if sized is None:
            return self._not_yet(model)
        sizing = sized.sizing
        words = sizing.sentence
        if sizing.conclusive:
            words += f" Along the race that is {along_race(sizing.best.extent, sized.scene)}."
        truth = sized.measured.true_extent
        if truth is not None:
            words += f" The signal is simulated: the true extent is {in_degrees(truth)}."
        if not same_machine(sized.scene, sized.measured.scene(model.scene)):
            words += " The scene has changed since; this is the answer for the one before."
        return words

    def _not_yet(self, model: Model) -> str:
        """That nothing was looked for, and whether there is something to look for."""
        words = "The size has not been estimated yet."
        if self.measured is not None and self.measured.bearing is None:
            return f"{words} {WITHOUT_BEARING}"
        measurement = self.measurement
        found = None if measurement is None else measurement.diagnosis()
        if found is None or found.fault == OUTER:
            return words
        if found.fault == INNER:
            return f"{words} That of an inner race cannot be estimated this way: see step 3."
        return f"{words} Choose the outer race here if it is known to be damaged."

    def table(self, model: Model) -> dict[str, np.ndarray]:
        sized = self.sized
        if sized is None:
            return {}
        return sized.sizing.table().in_units().named()


def has_answer(sizing: Sizing) -> bool:
    """True for a sizing with an answer, be it a bound."""
    return bool(sizing.candidates) and (sizing.conclusive or bool(sizing.bound))


def compute(
    job: Work,
    measured: Measured,
    scene: Scene,
    fault: str | None = None,
    support_known: bool = False,
) -> str:
    """Size the defect; `fault` where it is known what is damaged. Runs in a job's thread."""
    started = time.perf_counter()

    def progress(share: float) -> None:
        job.progress(share)
        if job.cancelled():
            raise Cancelled

    try:
        sizing = size_defect(
            measured.recording,
            scene,
            fault=fault,
            support_known=support_known,
            progress=progress,
        )
    except Cancelled:
        return "There is no answer yet."
    except ValueError as error:
        raise ValueError(sentence_of(error)) from error
    job.show(Sized(measured, scene, sizing))
    if not sizing.candidates:
        return "There is no size to look for."
    return f"Every extent from 1° to 110° was tried, in {time.perf_counter() - started:.1f} s."


def status(sized: Sized) -> dict[str, Any]:
    """The certainty of the answer in words and colour, with its grounds."""
    sizing = sized.sizing
    best, passes = sizing.best, sizing.passes
    scene = sized.scene
    nominal = scene.bearing.bpfo(scene.shaft_speed)
    off = 100.0 * (passes.frequency / nominal - 1.0)
    side = "above" if off > 0.0 else "below"
    spacing = math.degrees(scene.bearing.ball_spacing)
    details = [
        f"entry to exit Δt = {style.with_prefix(sizing.time_difference, 's')}",
        f"ball spacing {style.number(spacing, 3)}°",
        f"{passes.n_passes} ball passes at {style.number(passes.frequency, 4)} Hz"
        + (f", {abs(off):.2f} % {side} BPFO" if abs(off) >= 0.01 else ""),
    ]
    if sizing.bound:
        # it is the bound that counts, not where the search ended
        words = f"The defect extends over {in_degrees(sizing.end(sizing.bound))} {sizing.bound}"
        return {"mood": "good", "words": words, "details": details}
    if not sizing.conclusive:
        return {"mood": "bad", "words": "No clear result", "details": details}
    size = with_deviation(math.degrees(best.extent), math.degrees(sizing.extent_uncertainty), "°")
    words = f"The defect extends over {size}, {along_race(best.extent, scene)}"
    return {"mood": "good", "words": words, "details": details}


def same_machine(one: Scene, other: Scene) -> bool:
    """True for scenes that differ in extent and edge alone, which the sizing does not use."""
    try:
        return one.replace(extent=0.5, edge="exact") == other.replace(extent=0.5, edge="exact")
    except ValueError:
        return False


def alike(passes: BallPasses, candidate: BallPasses) -> BallPasses:
    """The measured pass with no more harmonics than the simulated one."""
    count = len(candidate.harmonics)
    return dataclasses.replace(
        passes, harmonics=passes.harmonics[:count], power=passes.power[:count]
    )


def pass_times(entry: float, period: float) -> tuple[NDArray[np.float64], int]:
    """Times [s] of a drawn pass and the sample it begins with; a ball enters at phase `entry`."""
    begin = entry / (2.0 * math.pi) - BEFORE
    first = math.ceil(begin * SAMPLES - 1e-9)
    times = (np.arange(SAMPLES) + first) / SAMPLES - entry / (2.0 * math.pi)
    return times * period, first % SAMPLES


def in_order(values: NDArray[np.float64], first: int) -> NDArray[np.float64]:
    """A pass that begins with another of its samples."""
    return np.roll(values, -first, axis=0)


def edges(sizing: Sizing, candidate: Candidate, entry: float, period: float) -> Sources:
    """Times at which balls enter and leave by the candidate; time 0 is at the phase `entry`."""

    def places(*phases: float) -> NDArray[np.float64]:
        turns = (np.array(phases) - entry) / (2.0 * math.pi)
        # rounding must not send the very phase of the entry around
        return ((turns + BEFORE + 1e-9) % 1.0 - BEFORE - 1e-9) * period

    times = places(*candidate.phases())
    return {
        "sizing_events": {
            "time": times,
            "exit": np.array([0.0, 1.0]),
            "row": np.array([0.93, 0.82]),
            # left of their lines at the right end
            "shift": np.where(times > (0.8 - BEFORE) * period, -66.0, 4.0),
        }
    }
