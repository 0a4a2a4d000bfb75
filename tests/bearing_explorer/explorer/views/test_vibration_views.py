"""Vibration in time and in frequency."""

import numpy as np
import pytest
from bearing_explorer.explorer.results.excerpt import Event
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.mass_time import MassInTime
from bearing_explorer.explorer.views.passage_view import EVENT_ROWS, LABEL_WIDTH, PassageView
from bearing_explorer.explorer.views.slow_passage import SlowPassage
from bearing_explorer.explorer.views.vibration_spectrum import (
    VibrationSpectra,
    pass_frequencies,
)
from bearing_explorer.explorer.views.vibration_time import VibrationInTime, event_rows
from bearing_explorer.kit.serve.packed_source import PackedSource
from hypothesis import given, strategies as st

from bearingcore import Defect, presets

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
    for down in set(rows["label_down"][labelled]):
        left = np.sort(rows["label_from"][labelled & (rows["label_down"] == down)])
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
    down = sources["vibration_events"]["label_down"].max()
    frame = 270.0 - 60.0  # px
    assert high - (high - low) * down / frame > top
    assert ranges["vibration_load"][1] >= results.excerpt.ball_load.max()


def test_pass_frequencies_are_all_harmonics_of_the_race_with_the_defect() -> None:
    marks = pass_frequencies(FAN_RIG, 2500.0)["frequency"]
    assert marks[0] == pytest.approx(40.289, abs=1e-3)
    np.testing.assert_allclose(np.diff(marks), marks[0])
    assert 2500.0 - marks[0] < marks[-1] <= 2500.0
    still = pass_frequencies(FAN_RIG.replace(shaft_speed=0.0), 2500.0)
    assert still["frequency"].size == 0


def test_defects_of_both_races_are_both_marked_and_named() -> None:
    both = FAN_RIG.replace(defect=(FAN_RIG.defect, Defect(0.1, 50e-6, 1.0, "inner")))
    results = Results(both)
    sources, _ = VibrationSpectra(PackedSource()).data(results)
    first = sources["spectrum_first_pass"]
    assert first["inner"].tolist() == [0.0, 1.0]
    assert first["frequency"] == pytest.approx([40.289, 57.711], abs=1e-3)
    words = VibrationSpectra(PackedSource()).sentence(results)
    assert "outer race at 40.29 Hz and of the inner race at 57.71 Hz" in words


def test_balls_that_carry_nothing_are_drawn_on_the_scale_of_those_that_do() -> None:
    up = Results(FAN_RIG.replace(fy=100.0))
    assert up.excerpt.static_load.max() == 0.0
    _, ranges = VibrationInTime(PackedSource()).data(up)
    assert ranges["vibration_load"][1] > 35.0


@pytest.mark.parametrize("speed", [7.0, 1000.0])
def test_the_largest_peak_is_that_of_the_whole_spectrum_and_is_in_the_picture(speed: float) -> None:
    """At 1000 Hz balls pass at 5755 Hz, and the housing moves most as often as that."""
    results = Results(FAN_RIG.replace(shaft_speed=2.0 * np.pi * speed))
    view = VibrationSpectra(PackedSource())
    frequency, density = results.late_spectra["y"]
    above = frequency >= 100.0
    largest = frequency[above][np.argmax(density[above])]
    assert f"{largest:.0f} Hz along y" in view.sentence(results)
    assert view.data(results)[1]["spectrum_frequency"][1] >= max(largest, 2500.0)
    assert (largest > 5000.0) == (speed > 7.0)


@pytest.mark.parametrize("kind", [VibrationInTime, SlowPassage, MassInTime])
def test_a_healthy_bearing_has_no_defect_in_its_words(kind: type[PassageView]) -> None:
    healthy, view = Results(FAN_RIG.healthy()), kind(PackedSource())
    assert "defect" not in view.title_of(healthy) + view.caption(healthy)


def test_a_picture_that_is_of_an_earlier_scene_is_faded(results: Results) -> None:
    view = VibrationInTime(PackedSource())
    view.say(results, view.sentence(results))
    (picture,) = view._pictures
    assert picture.styles.get("opacity", "1") == "1"
    view.say(None, "Not shown for this scene: nothing turns.")
    assert picture.visible
    assert float(picture.styles["opacity"]) < 0.5
    view.put_head(results)
    view.say(results, view.sentence(results))
    assert picture.styles["opacity"] == "1", "Bokeh takes no style away"
    view.put_head(Results(presets["6205"]))
    view.say(None, "Not shown for this scene: nothing turns.")
    assert not picture.visible, "it is of another bearing"
    assert not view.csv()
