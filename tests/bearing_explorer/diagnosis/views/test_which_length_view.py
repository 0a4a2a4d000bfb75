"""Which of several lengths a spall has, on the Diagnosis tab: simulated, drawn, said, reported."""

import asyncio
import dataclasses
import math
from datetime import datetime
from functools import cache

import numpy as np
import pytest
from bearing_explorer.diagnosis.diagnoses import Question, diagnosis_of, extent_of
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.report import measured_report
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.simulated import simulated
from bearing_explorer.diagnosis.sized_defect import (
    BY_FREQUENCIES,
    WITHOUT_DEFECT,
    WITHOUT_UNIT,
    likelier,
    machine_of,
)
from bearing_explorer.diagnosis.views.diagnosis import PartDiagnosis
from bearing_explorer.diagnosis.views.extent import SpallExtent
from bearing_explorer.diagnosis.views.signal_figure import figure_of
from bearing_explorer.diagnosis.views.which_length import KNOWN, NOT_COMPARED, WhichLength
from bearing_explorer.kit.compute.jobs import SIZING, Work
from bearing_explorer.kit.report_page import About
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import Defect, MeasuredExtent, Scene, presets
from bearingcore.sizing import ExtentStatus, Sizing, SizingStatus
from tests.helpers.loops import run
from tests.helpers.measuring import measuring

TRUE = 38.6
SCENE = presets["fan-rig"].replace(extent=math.radians(TRUE))
OTHER = SCENE.replace(extent=math.radians(5.0))
"""The same machine: the length on the slider must not matter."""
MODEL = Model(OTHER)


@cache
def of_scene() -> Measured:
    return simulated(SCENE, 20.0, 1)


@cache
def of_file() -> Measured:
    """The same signal as of a file: nothing is known but bearing and speed."""
    unknown = dict.fromkeys(("true_extent", "true_load", "true_edge", "true_scene"))
    return dataclasses.replace(of_scene(), true_part="", **unknown)


def diagnosed(measured: Measured, scene: Scene = OTHER) -> Measurement:
    """A measurement whose part, and length from entry to exit, are known."""
    made = measuring(measured, lambda: scene)
    about = Question.about(measured)
    made.diagnoses.keep(about, diagnosis(about))
    extent = SpallExtent(PackedSource())
    extent.measure(made)
    question = extent.question()
    assert question is not None
    made.extents.keep(question, measured_extent(question))
    return made


diagnosis, measured_extent = cache(diagnosis_of), cache(extent_of)


def view_of(made: Measurement, support: str) -> WhichLength:
    """The view with the result of its job."""
    view = WhichLength(PackedSource())
    view.measure(made)
    view.choose({"support": support}, MODEL)
    view._draw = lambda: None
    assert view.job_result is not None
    view._take(view.job_result)
    view.say(MODEL, view.sentence(MODEL))
    return view


@pytest.fixture(scope="module")
def view() -> WhichLength:
    return view_of(diagnosed(of_scene()), KNOWN)


def test_entry_and_exit_leave_it_open_and_the_simulation_says_it(view: WhichLength) -> None:
    extent = view.measurement.extent()
    assert extent is not None
    assert min(abs(math.degrees(one) - TRUE) for one, _, _ in extent.alternatives) > 20.0
    assert view.job_result is not None
    best = view.job_result.sizing.best
    assert best is not None
    assert math.degrees(best.extent) == pytest.approx(TRUE, abs=0.3)
    said = view.sentence(MODEL)
    assert said.startswith(f"{math.degrees(best.extent):.1f}°")
    assert said.endswith(f"the true length is {TRUE}°.")
    assert "mode y₁ falls to" in said or "mode x₁ falls to" in said


def test_measured_and_simulated_spectra_are_drawn_with_the_bands_of_each(view: WhichLength) -> None:
    sources, ranges = view.all_data(MODEL)
    for dof in ("x", "y"):
        measured = sources[f"length_measured_{dof}"]["y1"]
        best, second = (sources[f"length_candidate_{dof}_{k}"]["amplitude"] for k in (0, 1))
        assert np.abs(best - measured).max() < 0.1 * measured.max()
        assert np.abs(second - measured).max() > 0.2 * measured.max()
        assert max(measured.max(), best.max()) < ranges[f"length_size_{dof}"][1]
        bands = sources[f"length_bands_{dof}_0"]
        peak = sources[f"length_measured_{dof}"]["x0"][measured.argmax()]
        assert (bands["low"][0] - 25.0 < peak) & (peak < bands["high"][0] + 25.0)
    assert f"━</span> {TRUE}°" in str(view._candidates.object)
    assert view.csv().startswith("extent_deg,low_deg,high_deg,misfit")


def test_verdict_summary_and_report_carry_the_length(view: WhichLength) -> None:
    extent = SpallExtent(PackedSource())
    extent.measure(view.measurement)
    edges = extent.all_data(MODEL)[0]["extent_edges"]
    assert edges["exit"].tolist() == [0.0, 1.0], "12.9° and a ball spacing: the exit is second"
    part = PartDiagnosis(PackedSource())
    part.measure(view.measurement)
    part.say(MODEL, part.sentence(MODEL))
    assert f"{TRUE}° (" in part.part.state["extent"]
    assert f"Its spall is {TRUE}° (" in part.part.state["work_order"]
    about = About("", "", datetime(2026, 11, 29))
    page = measured_report(MODEL, view.measurement.snapshot(), {view.name: view.job_result}, about)
    assert f"{TRUE}° (" in page["html"]
    assert "Which length" in page["html"]


@pytest.mark.proof
def test_of_a_file_it_needs_a_machine_that_is_said_to_be_known() -> None:
    made = diagnosed(of_file())
    view = view_of(made, "")
    assert not view.drawn
    assert "the stiffness of its support" in view.sentence(MODEL)
    assert "true" not in view.sentence(MODEL)
    view = view_of(made, KNOWN)
    assert view.sentence(MODEL).startswith(f"{TRUE}° (")
    assert made.sizing() is view.job_result.sizing
    made._scene_now = lambda: OTHER.replace(extent=0.1)
    assert made.sizing() is not None, "the length on the slider does not count"
    made._scene_now = lambda: OTHER.replace(fy=-150.0)
    assert made.sizing() is None
    assert "The scene has changed since" in view.sentence(MODEL)
    drawn = figure_of(WhichLength, OTHER, recording=of_file().recording, choices={"support": KNOWN})
    assert drawn.sentence.startswith(f"{TRUE}° (")


def test_what_is_not_known_well_enough_is_refused_in_words() -> None:
    measured = of_file()
    machine = dataclasses.replace(measured.machine, by_frequencies=True)
    two = OTHER.replace(defect=(Defect(0.1, 5e-5, 4.6), Defect(0.1, 5e-5, 4.8)))
    for changed, scene, why in (
        (dataclasses.replace(measured, machine=machine), OTHER, BY_FREQUENCIES),
        (dataclasses.replace(measured, in_si=False), OTHER, WITHOUT_UNIT),
        (measured, OTHER.healthy(), WITHOUT_DEFECT),
    ):
        with pytest.raises(ValueError, match="^" + why[:40]):
            machine_of(changed, scene, "outer", None)
    assert machine_of(measured, OTHER, "inner", 40.0).defects[0].race == "inner"
    assert machine_of(measured, two, "outer", None).defects == two.defects


def test_it_begins_by_itself_once_entry_and_exit_are_known_and_can_be_cancelled() -> None:
    async def go() -> tuple[bool, bool, WhichLength]:
        made = diagnosed(of_scene())
        view = WhichLength(PackedSource())
        view.measure(made)
        assert view.sentence(MODEL) == NOT_COMPARED
        view._jobs, view._editor, view._draw = made._jobs, MODEL, lambda: None
        view.say(MODEL, "")
        began = made._jobs.busy(SIZING)
        view.cancel_job()
        view.say(MODEL, "")
        while made._jobs.busy(SIZING):
            await asyncio.sleep(0.01)
        return began, view.job_result is None, view

    began, without, view = run(go())
    assert began
    assert without
    assert view.job.state.mood == "stopped"
    work = Work()
    work.stop()
    assert view.prepare({"support": KNOWN}, MODEL)(work) == ""
    assert not work.take_results()


@pytest.mark.parametrize(
    ("extents", "misfits", "says"),
    [
        ((8.0, 34.0), (0.6, 0.2), "34° is likelier: its misfit is 0.20, that of the other 0.60"),
        ((48.0, 34.0), (0.1, 0.5), "8° is likelier: its misfit is 0.10, that of the other 0.50"),
        ((8.0, 34.0), (0.3, 0.32), "8° and 34° explain the signal about equally well"),
        ((), (), "do not say whether 8° or 34° is likelier"),
    ],
)
def test_of_two_lengths_the_likelier_is_named_where_the_misfit_says_it(
    extents: tuple[float, ...], misfits: tuple[float, ...], says: str
) -> None:
    spacing, offset = math.radians(40.0), math.radians(1.0)
    extent = MeasuredExtent(
        "outer", separation=math.radians(7.0), deviation=0.01, offset=offset, offset_low=offset,
        offset_high=offset, ball_spacing=spacing, status=ExtentStatus.EITHER,
    )  # fmt: skip
    tried = Sizing(SizingStatus.UNEXPLAINED, extents=np.radians(extents), misfits=np.array(misfits))
    assert says in likelier(tried, extent)
    measured = dataclasses.replace(extent, status=ExtentStatus.MEASURED)
    assert likelier(tried, measured) == ""
