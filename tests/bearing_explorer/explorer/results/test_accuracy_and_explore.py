"""Maps over any two quantities, and speed against accuracy: what is measured is what is drawn."""

import html
import math
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace

import holoviews as hv
import numpy as np
import pytest
from bearing_explorer import figures
from bearing_explorer.explorer.plots.plane import Field, PlaneFigures, color_limits, section_of
from bearing_explorer.explorer.results import explore
from bearing_explorer.explorer.results.accuracy import SceneMeasurements, compute, shipped
from bearing_explorer.explorer.results.explore import (
    MAP_OUTPUTS,
    Plane,
    Question,
    Survey,
    coarse,
    refine,
)
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.field_values import limits_of
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.value_range import sweep
from bearing_explorer.explorer.views.accuracy import CHARTS, Accuracy
from bearing_explorer.explorer.views.explore import ExplorePlane
from bearing_explorer.explorer.views.stability_charts import (
    orbit_marks,
    orbits_sentence,
    step_marks,
)
from bearing_explorer.explorer.views.work_precision import (
    BEYOND,
    NOT_YET,
    details,
    sentence,
    verdict,
)
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.plots.heat_map import Side
from bearing_explorer.kit.serve.packed_source import PackedSource
from bokeh.models import LayoutDOM

from bearingcore import equilibrium, modes, presets
from bearingcore.model.experiments import (
    Experiment,
    Measurements,
    OrbitAtSpeed,
    Point,
    Reference,
    measurements_from,
)
from bearingcore.model.sweeps import sweep as core_sweep
from tests.benchmarks import charts
from tests.helpers.timing import measure_once

SHORT_RIG = presets["fan-rig"].replace(extent=math.radians(20.0))
LIMITS = limits_of(SHORT_RIG)


def question(
    output: str,
    x: tuple[str, str, str] = ("extent_deg", "2", "62"),
    y: tuple[str, str, str] = ("fy_n", "-240", "240"),
    scene=SHORT_RIG,
    shape: tuple[int, int] = explore.FINEST,
) -> Question:
    sweeps = [
        sweep(name, low, high, n, LIMITS)
        for (name, low, high), n in zip((x, y), shape, strict=True)
    ]
    return Question(scene, *sweeps, MAP_OUTPUTS[output])


class Recorder(Work):
    """A job that remembers what it was shown, and may be cancelled by it."""

    def __init__(self, stop_after: int = 99) -> None:
        super().__init__()
        self.started = time.monotonic()
        self.shown: list[Plane] = []
        self.stop_after = stop_after

    def show(self, plane: Plane) -> None:
        self.shown.append(plane)
        if len(self.shown) >= self.stop_after:
            self.stop()


@pytest.mark.parametrize("turned", [False, True])
def test_a_point_says_what_the_solvers_say(turned: bool) -> None:
    """Whichever side the extents are on, as lines of them are solved together."""
    sides = [("extent_deg", "2", "62"), ("fy_n", "-240", "240")]
    x, y = reversed(sides) if turned else sides
    expected: dict[str, Callable] = {
        "k_yy_least": lambda s: equilibrium(s).term("k_yy").min(),
        "ball_load_greatest": lambda s: equilibrium(s).ball_load.max(),
        "loaded_balls_greatest": lambda s: equilibrium(s).loaded_balls.max(),
    }
    for name, of_scene in expected.items():
        asked = question(name, x, y)
        plane = coarse(asked)
        assert plane.values.shape == (7, 9)
        for j, i in ((0, 0), (1, 7), (6, 3)):
            scene = SHORT_RIG.replace(
                **{asked.x.field.name: plane.x.in_si[1][i]},
                **{asked.y.field.name: plane.y.in_si[1][j]},
            )
            assert plane.values[j, i] == pytest.approx(of_scene(scene), rel=1e-9)


def test_a_band_of_a_mode_is_that_of_the_core() -> None:
    band = Survey(question("band_greatest:y1", ("shaft_speed_hz", "10", "20"), shape=(2, 2)))
    assert band.compute(1)
    vibration = modes(SHORT_RIG.replace(shaft_speed=2.0 * math.pi * 20.0, fy=240.0))  # lifted
    undamped = vibration.undamped_frequency[:, vibration.label.index("y1")].max()
    assert band.plane(1).values[0, 1] == pytest.approx(undamped)
    assert undamped == pytest.approx(vibration.bands()["y1"][1], rel=1e-5)


def test_levels_hold_those_before() -> None:
    job = Recorder()
    asked = question("k_yy_mean")
    start = coarse(asked)
    words = refine(job, asked, 2, start)
    shapes = [plane.values.shape for plane in job.shown]
    assert shapes == [(13, 17), (25, 33)]
    np.testing.assert_array_equal(start.values, job.shown[0].values[::2, ::2])
    np.testing.assert_array_equal(job.shown[0].values, job.shown[1].values[::2, ::2])
    assert words == "33 × 25 points."
    assert job.part == pytest.approx(1.0)


def test_what_has_no_answer_has_a_reason() -> None:
    unloaded = coarse(question("k_yy_mean"))
    row = list(unloaded.y.values).index(0.0)
    assert np.isnan(unloaded.values[row]).all()
    assert set(unloaded.reasons[row]) == {"nothing touches: no load presses a ball"}
    assert unloaded.missing == 9
    # more balls than there is room for: the core's words, with the names of the page
    crowded = coarse(question("k_yy_mean", x=("n_balls", "10", "30")))
    reasons = {str(why) for why in crowded.reasons[0] if why}
    assert any("number of balls" in why or "ball diameter" in why for why in reasons), reasons
    with pytest.raises(ValueError, match="The housing does not move along z in these scenes"):
        coarse(question("acceleration_rms_z"))


def test_motions_that_take_too_many_steps_are_not_begun() -> None:
    short = question("acceleration_rms_y", ("extent_deg", "0.01", "60"), shape=(2, 2))
    fast = Question(SHORT_RIG.replace(shaft_speed=600.0), short.x, short.y, short.output)
    survey = Survey(fast)
    survey.compute(1)
    plane = survey.plane(1)
    assert "too many steps" in plane.reasons[0, 0]
    assert plane.reasons[0, 1] == ""


def test_a_cancelled_refinement_keeps_the_last_whole_picture() -> None:
    job = Recorder(stop_after=1)
    words = refine(job, question("k_yy_mean"), 1)
    assert [plane.values.shape for plane in job.shown] == [(7, 9)]
    assert words == "9 × 7 points."


# The view


FORM = {
    "output": "k_yy_mean", "x": "extent_deg", "x_from": "2", "x_to": "62",
    "y": "fy_n", "y_from": "-240", "y_to": "240", "grid": "4",
}  # fmt: skip


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"grid": "-1"}, "at most"),
        ({"output": "__class__"}, "no such output"),
        ({"y": "extent_deg"}, "two different"),
        ({"x": "nothing"}, "no such quantity"),
        ({"x_from": "70"}, "must be greater"),
    ],
)
def test_what_is_senseless_is_refused_with_a_sentence(change, words) -> None:
    view, editor = ExplorePlane(PackedSource()), SceneEditor("fan-rig")
    with pytest.raises(ValueError, match=words):
        view.request_of({**FORM, **change}, editor)
    assert view.request_of(FORM, editor).stride == 4


def test_the_view_marks_the_scene_and_says_what_is_to_be_seen() -> None:
    view, editor = ExplorePlane(PackedSource()), SceneEditor("fan-rig")
    view._request = view.request_of(FORM, editor)
    results = Results(SHORT_RIG)
    words = view.sentence(results)
    view.say(results, words)
    image, _, ring, _ = (renderer for renderer in view.figures[0].renderers)
    assert ring.data_source.data["x"] == pytest.approx([20.0])
    assert image.glyph.global_alpha == 1.0  # as opaque as can be
    assert words.startswith("k_yy, mean: least")
    assert "9 points have no answer, most often: nothing touches" in words
    view.job_result = coarse(view._request.of(results))
    table = view.table(results)
    fine = {"cage_angles_a_period"}
    assert set(table) == {"extent_deg", "fy_n", "k_yy_mean_n_per_m", "no_answer_because"} | fine
    assert table["k_yy_mean_n_per_m"].shape == (63,)
    assert set(table["cage_angles_a_period"]) == {121.0}
    # exported lines give the numbers of the file, though a finer map was asked for
    again = ExplorePlane(PackedSource())
    again.choose(view.choices(), results)
    for name, column in again.table(results).items():
        np.testing.assert_array_equal(column, table[name])
    # and they are those of a sweep over the same values
    places = {"extent": np.radians(np.unique(table["extent_deg"])), "fy": np.unique(table["fy_n"])}
    swept = (
        core_sweep(SHORT_RIG, places, ["k_yy_mean"])["k_yy_mean"].transpose("fy", "extent").values
    )
    order = np.lexsort((table["extent_deg"], table["fy_n"]))
    np.testing.assert_allclose(table["k_yy_mean_n_per_m"][order], swept.ravel(), rtol=1e-9)
    # an output that takes a while: what is drawn is faint until its map is there
    view._request = view.request_of({**FORM, "output": "acceleration_rms_y"}, editor)
    view.say(results, "")
    assert image.glyph.global_alpha == 0.35
    assert view.sentence(results).startswith("Faint: an earlier map.")


def test_the_share_of_mass_says_its_band() -> None:
    assert MAP_OUTPUTS["mass_share"].label.endswith(" kHz")


RIG = presets["fan-rig"]


def point(method: str, value: float, error: float, seconds: float, **more: object) -> Point:
    calls = 0 if math.isnan(seconds) else round(1e6 * seconds)
    errors = {} if math.isnan(error) else {"spectrum": error}
    return Point(method, f"{value:g}", value, errors, seconds, calls, **more)  # type: ignore[arg-type]


EXPERIMENT = Experiment(
    "motion",
    {"spectrum": "[dB]"},
    "right-hand sides",
    {"": Reference(("LSODA", "DOP853"), {"spectrum": 2e-7}, True)},
    (
        point("RK4", 32768.0, 1e-2, 1e-3, in_use=True),
        point("RK4", 65536.0, 1e-4, 2e-3),
        point("scipy RK45", 65536.0, 1e-1, 2e-2),
        point("scipy RK45", 8192.0, math.nan, math.nan, status="failed: diverged <at once>"),
        point("scipy LSODA", 8192.0, math.inf, 1e-3),
    ),
)


def test_words_name_the_reference_and_what_failed() -> None:
    words = details(EXPERIMENT, "spectrum")
    assert "LSODA and DOP853 agree, 2·10⁻⁷ dB apart" in words
    assert "scipy RK45, 8192, failed: diverged &lt;at once&gt;" in words
    assert f"scipy LSODA: {BEYOND}" in words
    said = sentence(EXPERIMENT, "spectrum")
    assert "Fastest within 0.1 dB, and in use: RK4, 32768 (1 ms, 0.01 dB)" in said
    points = (replace(EXPERIMENT.points[0], errors={"spectrum": 0.11}), *EXPERIMENT.points[1:])
    above = sentence(replace(EXPERIMENT, points=points), "spectrum")
    assert "; in use: RK4, 32768 (1 ms, 0.11 dB). It lies above the line because" in above


def test_the_verdict_compares_the_cheapest_of_two_programs_that_are_near_enough() -> None:
    def of(*points: Point, cost: str = "seconds") -> str:
        return verdict(replace(EXPERIMENT, points=points), "spectrum", cost)

    ours, finer, theirs = point("RK4", 1.0, 0.2, 1e-4), point("RK4", 2.0, 0.1, 2e-3), point(
        "scipy RK45", 3.0, 1e-5, 0.268
    )  # fmt: skip
    assert of(ours, finer, theirs) == (
        "Within 0.1 dB, RK4 with fixed steps is 130 times cheaper than scipy RK45"
    )
    few = replace(theirs, evaluations=100)
    assert of(ours, finer, few, cost="evaluations") == (
        "Within 0.1 dB, scipy RK45 is done with 20 times fewer right-hand sides than RK4"
    )
    assert of(ours, finer) == "Only RK4 is within 0.1 dB"
    assert of(ours) == "No method is within 0.1 dB"


@pytest.mark.parametrize("preset", ["fan-rig", "liew-lim"])
def test_the_tab_opens_with_every_chart_drawn(preset: str) -> None:
    view = Accuracy(PackedSource())
    results = Results(presets[preset])
    base = shipped(preset)
    for subject in CHARTS:
        view._chosen.put({"charts": subject})
        view.say(results, view.sentence(results))
        for chart in view._charts[subject].values():
            words = html.unescape(chart._words.object)
            assert chart.plot.visible or base.refused.get(subject, NOT_YET) in words
    known = {(name, case) for name, cases in CHARTS.items() for case in cases}
    for name, experiment in base.experiments.items():
        assert {(name, case) for case in experiment.references} <= known
    assert len(view.table(results)["method"]) == base.count - len(base.orbits) - len(
        base.stability.trials if base.stability else ()
    )


def test_losses_of_stability_are_named() -> None:
    orbits = (
        OrbitAtSpeed(10.0, "stable orbit", "", ((0.5, 0.0),)),
        OrbitAtSpeed(20.0, "unstable orbit", "period doubling", ((-1.2, 0.0),)),
        OrbitAtSpeed(30.0, "not converged"),
    )
    words = orbits_sentence(orbits)
    assert "Stable at 1.59 Hz, period doubling from 3.18 Hz" in words
    assert "No orbit was found at 1 of 3 speeds" in words
    assert "not measured" in orbits_sentence(())


def test_pictures_of_stability_show_each_measured_number_and_a_cross_for_each_failure() -> None:
    measured = shipped("fan-rig")
    marks, stable, now, _ = orbit_marks(measured.orbits, RIG.shaft_speed)
    assert [mark.y for mark in marks] == [orbit.size for orbit in measured.orbits]
    assert [mark.slot == 1 for mark in marks] == [orbit.size > 1.0 for orbit in measured.orbits]
    assert stable == {"top": 1.0}
    assert now[0] == pytest.approx(7.0)
    (lost,) = orbit_marks((OrbitAtSpeed(30.0, "not converged"),), 1.0)[0]
    assert math.isinf(lost.y)
    assert "not converged" in lost.tooltip
    assert measured.stability is not None
    marks, stable, _, _ = step_marks(measured.stability, 32768.0)
    broken = [mark for mark in marks if math.isinf(mark.y)]
    assert len(marks) == len(measured.stability.trials)
    assert broken
    assert all(mark.x < stable["left"] and "diverged" in mark.tooltip for mark in broken)


def test_an_experiment_is_shown_point_by_point_and_read_from_its_file(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    measure_once(monkeypatch)
    job = Work()
    job.started = time.monotonic()
    shown: list[Measurements] = []
    job.show = lambda measured: shown.append(measured.result)  # type: ignore[method-assign]
    assert "points after" in compute(job, RIG, "statics")
    assert [one.count for one in shown[:3]] == [1, 2, 3]
    measured = shown[-1]
    again = measurements_from(charts.as_json(measured))
    assert again.count == measured.count
    ours, theirs = (results.experiments["statics"].points for results in (measured, again))
    for our, other in zip(ours, theirs, strict=True):
        assert other.errors == pytest.approx(our.errors, rel=1e-3)
        assert other.in_use == our.in_use
    view = Accuracy(PackedSource())
    view.job_result = SceneMeasurements(RIG, measured)
    assert f"Measured on this machine: {measured.count} points" in view.sentence(Results(RIG))
    assert set(view.table(Results(RIG))["experiment"]) == {"statics"}


def test_what_cannot_be_measured_is_refused_and_a_cancelled_job_says_so() -> None:
    job = Work()
    job.started = time.monotonic()
    with pytest.raises(ValueError, match="nothing turns"):
        compute(job, RIG.replace(shaft_speed=0.0), "motion")
    with pytest.raises(ValueError, match="no such"):
        Accuracy(PackedSource()).prepare({"experiment": "../etc"}, SceneEditor("fan-rig"))(job)
    job.stop()
    assert compute(job, RIG, "statics") == "Nothing was measured yet."


X, Y = (
    Side("extent_deg", "Length of the defect", "Δφf", "°"),
    Side("fy_n", "Load, upwards", "Fy", "N"),
)
FIELD = Field(
    (X, np.array([10.0, 20.0, 30.0])),
    (Y, np.array([-200.0, -100.0])),
    "kyy, mean",
    "N/m",
    np.array([[1e6, 2e6, 3e6], [4e6, math.nan, 6e6]]),
    np.array([["", "", ""], ["", "nothing touches", ""]], dtype=object),
)


def test_a_map_has_its_numbers_its_reasons_and_the_scene() -> None:
    plane = PlaneFigures("plane", lambda x, y: None)
    plane.show(FIELD, (12.0, -110.0), 0.35)
    assert {plot.renderers[0].glyph.line_alpha for plot in (plane.up, plane.across)} == {0.35}
    image, missing, *rings = plane.map.renderers
    np.testing.assert_array_equal(image.data_source.data["image"][0], FIELD.values / 1e6)
    assert image.glyph.global_alpha == 0.35
    mapper = image.glyph.color_mapper
    assert (mapper.low, mapper.high) == (1.0, 6.0)
    cell = {name: list(column) for name, column in missing.data_source.data.items()}
    assert cell == {
        "left": [15.0], "right": [25.0], "bottom": [-150.0], "top": [-50.0],
        "reason": ["nothing touches"],
    }  # fmt: skip
    assert [ring.data_source.data for ring in rings] == 2 * [{"x": [12.0], "y": [-110.0]}]
    assert (plane.map.x_range.start, plane.map.x_range.end) == (5.0, 35.0)
    assert (plane.map.y_range.start, plane.map.y_range.end) == (-250.0, -50.0)
    labels = [(p.xaxis[0].axis_label, p.yaxis[0].axis_label) for p in (plane.up, plane.across)]
    assert labels == [
        ("Load, upwards Fy (N)", "(MN/m)"),
        ("Length of the defect Δφf (°)", "(MN/m)"),
    ]


@pytest.mark.parametrize(
    ("place", "up", "across"),
    [
        ((12.0, -110.0), [1.0, 4.0], [4.0, math.nan, 6.0]),
        ((34.9, -249.0), [3.0, 6.0], [1.0, 2.0, 3.0]),
        ((99.0, -110.0), [2.0, math.nan], [4.0, math.nan, 6.0]),  # beside the map: the middle
    ],
)
def test_sections_are_those_through_a_place(place, up, across) -> None:
    plane = PlaneFigures("plane", lambda x, y: None)
    plane.show(FIELD, place)
    for figure, values, way in ((plane.up, up, "up"), (plane.across, across, "across")):
        drawn = figure.renderers[0].data_source.data["value"]
        np.testing.assert_array_equal(drawn, values)
        curve = section_of(FIELD, way, *place)
        np.testing.assert_array_equal(curve.dimension_values("value"), values)


def test_axes_are_linked_and_a_zoomed_map_stays_zoomed() -> None:
    plane = PlaneFigures("plane", lambda x, y: None)
    plane.show(FIELD, (12.0, -110.0))
    assert plane.across.x_range is plane.map.x_range
    assert plane.up.x_range is plane.map.y_range
    plane.map.x_range.update(start=12.0, end=14.0)
    plane.show(FIELD, (12.0, -110.0))
    shown = plane.map.x_range
    assert (shown.start, shown.end, shown.reset_start, shown.reset_end) == (12.0, 14.0, 5.0, 35.0)


def test_an_output_of_a_sweep_is_drawn_in_the_units_of_the_page() -> None:
    xarray = pytest.importorskip("xarray")
    swept = xarray.DataArray(
        np.arange(6.0).reshape(2, 3),
        dims=("fy", "extent"),
        coords={
            "fy": ("fy", [-200.0, -100.0], {"units": "N"}),
            "extent": ("extent", np.radians([10.0, 20.0, 30.0]), {"units": "rad"}),
        },
        attrs={"units": "m/s²"},
        name="acceleration_rms_y",
    )
    field = Field.of_sweep(swept)
    assert field.x[0].label == "Length of the defect (°)"
    assert field.x[1] == pytest.approx([10.0, 20.0, 30.0])
    drawn = figures.of_sweep(xarray.Dataset({"acceleration_rms_y": swept, "status": swept}))
    assert isinstance(hv.render(drawn, backend="bokeh"), LayoutDOM)
    image = drawn.traverse(lambda part: part, [hv.Image])[0]
    assert image[30.0, -100.0] == 5.0
    curve = drawn.DynamicMap.I
    curve.streams[0].event(x=12.0, y=-140.0)
    assert list(curve[()].dimension_values("value")) == [0.0, 3.0]
    assert [d.unit for d in image.dimensions()] == ["°", "N", "m/s²"]
    with pytest.raises(ValueError, match="two"):
        figures.of_sweep(swept.isel(fy=0))
    with pytest.raises(ValueError, match="evenly"):
        figures.of_sweep(swept.assign_coords(extent=[0.1, 0.2, 0.5]))
    with pytest.raises(ValueError, match="outputs are"):
        figures.of_sweep(xarray.Dataset({"a": swept, "b": swept}))


def test_colours_are_light_at_zero_where_numbers_have_both_signs() -> None:
    assert color_limits(np.array([-1.0, np.nan, 3.0])) == (-3.0, 3.0)
    assert color_limits(np.array([2.0, 5.0])) == (2.0, 5.0)
    low, high = color_limits(np.zeros(4))
    assert low < 0.0 < high
    assert color_limits(np.full(3, np.nan)) == (0.0, 1.0)


def test_a_page_starts_without_holoviews() -> None:
    """It takes a quarter of the time to import the page, and Explore alone needs it."""
    code = "import sys, bearing_explorer.page; print('holoviews' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split()[-1] == "False"
