"""Maps over any two quantities: what they say, how they are refined, what is too much."""

import math
import time
from collections.abc import Callable

import numpy as np
import pytest
from bearing_explorer.explorer.results import explore
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
from bearing_explorer.explorer.views.explore import ExplorePlane
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import equilibrium, modes, presets
from bearingcore.model.sweeps import sweep as core_sweep

RIG = presets["fan-rig"].replace(extent=math.radians(20.0))
LIMITS = limits_of(RIG)


def question(
    output: str,
    x: tuple[str, str, str] = ("extent_deg", "2", "62"),
    y: tuple[str, str, str] = ("fy_n", "-240", "240"),
    scene=RIG,
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
            scene = RIG.replace(
                **{asked.x.field.name: plane.x.in_si[1][i]},
                **{asked.y.field.name: plane.y.in_si[1][j]},
            )
            assert plane.values[j, i] == pytest.approx(of_scene(scene), rel=1e-9)


def test_a_band_of_a_mode_is_that_of_the_core() -> None:
    band = Survey(question("band_greatest:y1", ("shaft_speed_hz", "10", "20"), shape=(2, 2)))
    assert band.compute(1)
    vibration = modes(RIG.replace(shaft_speed=2.0 * math.pi * 20.0, fy=240.0))  # lifted
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
    fast = Question(RIG.replace(shaft_speed=600.0), short.x, short.y, short.output)
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
    results = Results(RIG)
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
    swept = core_sweep(RIG, places, ["k_yy_mean"])["k_yy_mean"].transpose("fy", "extent").values
    order = np.lexsort((table["extent_deg"], table["fy_n"]))
    np.testing.assert_allclose(table["k_yy_mean_n_per_m"][order], swept.ravel(), rtol=1e-9)
    # an output that takes a while: what is drawn is faint until its map is there
    view._request = view.request_of({**FORM, "output": "acceleration_rms_y"}, editor)
    view.say(results, "")
    assert image.glyph.global_alpha == 0.35
    assert view.sentence(results).startswith("Faint: an earlier map.")


def test_the_share_of_mass_says_its_band() -> None:
    assert MAP_OUTPUTS["mass_share"].label.endswith(" kHz")
