"""Vibration in time and in frequency."""

import dataclasses
import math

import numpy as np
import pytest
from bearing_explorer.plots.levels import decibels
from bearing_explorer.results.excerpt import Event
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.frequency_lines import FrequencyLines, of_rows
from bearing_explorer.views.passage_view import EVENT_ROWS, LABEL_WIDTH
from bearing_explorer.views.slow_passage import SlowPassage
from bearing_explorer.views.vibration_spectrum import VibrationSpectra, pass_frequencies, passed
from bearing_explorer.views.vibration_time import VibrationInTime, event_rows
from hypothesis import given
from hypothesis import strategies as st

from bearingcore import Defect, presets
from bearingcore.bearings.designation import read_designation

FAN_RIG = presets["fan-rig"]


@pytest.fixture(scope="module")
def results() -> Results:
    return Results(FAN_RIG)


@given(st.lists(st.floats(0.0, 1.0), max_size=15))
def test_labels_of_events_never_overlap_and_stay_inside(times: list[float]) -> None:
    events = tuple(Event(time, 0, True) for time in sorted(times))
    rows = event_rows(events, 0.0, 1.0, presets["fan-rig"].bearing)
    labelled = np.isfinite(rows["label_at"])
    assert labelled.sum() >= min(len(times), EVENT_ROWS)
    for at in set(rows["label_at"][labelled]):
        left = np.sort(rows["label_from"][rows["label_at"] == at])
        assert np.all(np.diff(left) >= LABEL_WIDTH - 1e-9)
        assert left[-1] + LABEL_WIDTH <= 1.0 + 1e-9


def test_the_picture_holds_the_signal_and_leaves_room_for_the_labels(results: Results) -> None:
    view = VibrationInTime(PackedSource())
    sources, ranges = view.data(results)
    top = np.nanmax(np.abs(results.excerpt.acceleration["y"]))
    drawn = sources["vibration_motion"]["y"]
    assert np.nanmax(np.abs(drawn)) == top
    low, high = ranges["vibration_acceleration"]
    assert low == -high
    rows = sources["vibration_events"]["label_at"]
    lowest = low + (high - low) * np.nanmin(rows)
    assert lowest > top
    assert ranges["vibration_load"][1] >= results.excerpt.ball_load.max()


def test_slow_motion_begins_where_a_ball_enters_and_holds_the_simulated_loads() -> None:
    scene = FAN_RIG.replace(defect=Defect(race="inner", extent=0.2, depth=50e-6, center=-1.4))
    results = Results(scene)
    sources, _ = SlowPassage(PackedSource()).data(results)
    shown = results.excerpt
    entry = next(event for event in shown.events if event.enters)
    n = scene.bearing.n_balls
    frames, loads = sources["slow_frames"], sources["slow_path"]["load"].reshape(-1, n)
    at = int(np.argmin(np.abs(frames["time"])))
    np.testing.assert_allclose(sources["slow_cursor"]["now"], entry.time, atol=1e-4)
    samples = np.searchsorted(shown.time, frames["time"]).clip(max=shown.time.size - 1)
    of_entering = shown.ball_load[samples, list(shown.balls).index(entry.ball)]
    np.testing.assert_array_equal(loads[:, entry.ball], of_entering)
    np.testing.assert_array_equal(sources["slow_balls"]["load"], loads[at])
    # a ball that enters is at the edge of the defect, which turns with the shaft
    angle = sources["slow_start"]["angle"][entry.ball]
    turns = sources["slow_base_defect"]["turns"]
    edges = np.arctan2(sources["slow_base_defect"]["y"], sources["slow_base_defect"]["x"])
    assert np.abs(np.angle(np.exp(1j * (edges[turns == 1.0] - angle)))).min() < 0.01
    ratio = frames["shaft"][-1] / frames["turned"][-1]
    assert ratio == pytest.approx(1.0 / scene.bearing.cage_ratio)
    assert sources["slow_base_rings"]["turns"].min() == 0.0


def test_levels_and_shifts_are_the_published_ones(results: Results) -> None:
    view = VibrationSpectra(PackedSource())
    small, _ = view.data(results)
    large, _ = view.data(Results(FAN_RIG.replace(extent=math.radians(38.6))))
    lines = small["spectrum_lines"]
    heard = (lines["frequency"] >= 300.0) & (lines["frequency"] <= 2100.0)
    assert -60.0 < lines["y"][heard].min() < lines["y"][heard].max() < -18.0
    assert -70.0 < lines["x"][heard].min() < lines["x"][heard].max() < -26.0
    for dof, sign in (("x", 1.0), ("y", -1.0)):
        middle = [
            np.mean([s[f"spectrum_bands_{dof}"]["low"], s[f"spectrum_bands_{dof}"]["high"]])
            for s in (small, large)
        ]
        assert sign * (middle[1] - middle[0]) > 0.0


def test_bands_of_a_direction_stand_in_its_figure(results: Results) -> None:
    sources, _ = VibrationSpectra(PackedSource()).data(results)
    bands = results.bands
    assert sources["spectrum_bands_x"]["low"] == pytest.approx([bands["x1"][0], bands["x2"][0]])
    assert sources["spectrum_bands_y"]["high"] == pytest.approx([bands["y1"][1], bands["y2"][1]])


def test_pass_frequencies_are_all_harmonics_of_the_race_with_the_defect() -> None:
    marks = pass_frequencies(FAN_RIG, 2500.0)["frequency"]
    assert marks[0] == pytest.approx(40.289, abs=1e-3)
    np.testing.assert_allclose(np.diff(marks), marks[0])
    assert 2500.0 - marks[0] < marks[-1] <= 2500.0
    inner = pass_frequencies(FAN_RIG.replace(race="inner"), 2500.0)
    assert inner["frequency"][0] == pytest.approx(14 * (7.0 - 2.8778), abs=1e-2)
    assert inner["inner"].all()
    still = pass_frequencies(FAN_RIG.replace(shaft_speed=0.0), 2500.0)
    assert still["frequency"].size == 0


def test_lines_of_an_estimated_inside_have_their_error() -> None:
    assert not pass_frequencies(FAN_RIG, 2500.0)["spread"].any()
    bearing = read_designation("6208").bearing
    scene = presets["6205"].replace(bearing=bearing)
    spread = pass_frequencies(scene, 2500.0)["spread"]
    assert spread[0] == pytest.approx(bearing.bpfo(scene.shaft_speed) * 0.0140, rel=0.02)
    inner = bearing.bpfi(scene.shaft_speed) * bearing.frequency_spread("bpfi")
    assert of_rows(scene)[0]["bpfi_spread"] == pytest.approx(inner)
    columns = FrequencyLines(PackedSource(), "lines", (), 200.0).columns(
        of_rows(scene), ("bpfi",), 1000.0
    )
    assert columns["lines_bpfi_names"]["spread"][0] == pytest.approx(inner)


def test_rows_that_are_not_alike_have_pass_frequencies_of_their_own() -> None:
    pair = presets["7208-back-to-back"]
    assert len(passed(pair)) == 1
    low, high = pair.bearing.rows
    rows = (low, dataclasses.replace(high, n_balls=11))
    scene = pair.replace(bearing=pair.bearing.replace(rows=rows), row=None)
    rates = [scene.bearing.of_row(k).bpfo(scene.shaft_speed) for k in range(2)]
    assert passed(scene) == [("outer", 1, rates[0]), ("outer", 2, rates[1])]
    assert passed(scene.replace(row=1)) == [("outer", 2, rates[1])]
    marks = pass_frequencies(scene, 2.0 * rates[0])
    assert marks["row"].tolist() == [1.0] * 2 + [2.0] * 2
    sets = of_rows(scene)
    assert [one["bpfo"] for one in sets] == rates
    lines = FrequencyLines(PackedSource(), "own", (), 400.0)
    names = lines.columns(sets, ("bpfo",), 3000.0)["own_bpfo_names"]
    assert set(names["of"]) == {1.0, 2.0}
    assert np.unique(names["row"]).size == 2, "each row has its names at a height of their own"
    assert set(lines.columns(of_rows(pair), ("bpfo",), 3000.0)["own_bpfo_names"]["of"]) == {0.0}


def test_defects_of_both_races_are_both_marked_and_named() -> None:
    both = FAN_RIG.replace(defect=(FAN_RIG.defect, Defect(0.1, 50e-6, 1.0, "inner")))
    results = Results(both)
    sources, _ = VibrationSpectra(PackedSource()).data(results)
    first = sources["spectrum_first_pass"]
    assert first["inner"].tolist() == [0.0, 1.0]
    assert first["frequency"] == pytest.approx([40.289, 57.711], abs=1e-3)
    words = VibrationSpectra(PackedSource()).sentence(results)
    assert "outer race at 40.29 Hz and of the inner race at 57.71 Hz" in words


def test_an_inner_race_defect_is_shown_where_it_meets_load() -> None:
    shown = Results(FAN_RIG.replace(race="inner")).excerpt
    entering = next(event for event in shown.events if event.time == pytest.approx(0.0, abs=1e-9))
    column = list(shown.balls).index(entering.ball)
    before = shown.static_load[shown.static_time < 0.0, column]
    assert before[-1] > 30.0, "the ball that enters carried nothing"


def test_silence_has_a_level() -> None:
    assert decibels(np.array([1.0, 1e-6, 0.0])).tolist() == [0.0, -60.0, -200.0]


def test_balls_that_carry_nothing_are_drawn_on_the_scale_of_those_that_do() -> None:
    up = Results(FAN_RIG.replace(fy=100.0))
    assert up.excerpt.static_load.max() == 0.0
    _, ranges = VibrationInTime(PackedSource()).data(up)
    assert ranges["vibration_load"][1] > 35.0
