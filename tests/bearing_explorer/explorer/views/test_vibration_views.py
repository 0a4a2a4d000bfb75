"""Vibration in time, in frequency and over speed, and what the mass of balls adds to it."""

import dataclasses
import math
import time
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from bearing_explorer.explorer.results.ball_mass import BallMass, entry_of, exit_of
from bearing_explorer.explorer.results.excerpt import Event
from bearing_explorer.explorer.results.motions import motion, quick_duration
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.field_values import limits_of
from bearing_explorer.explorer.state.references import OTHER_BALLS
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.value_range import SWEEPABLE, Sweep, sweep
from bearing_explorer.explorer.views.folded_view import FoldedView
from bearing_explorer.explorer.views.mass_time import MassInTime
from bearing_explorer.explorer.views.mechanism import WhichMechanism, mechanism_words
from bearing_explorer.explorer.views.passage_view import EVENT_ROWS, LABEL_WIDTH, PassageView
from bearing_explorer.explorer.views.slow_passage import SlowPassage
from bearing_explorer.explorer.views.speed_run import (
    COUNTS,
    SPEED,
    SpeedRunSpectra,
    SweptRun,
    compute,
    levels_of,
)
from bearing_explorer.explorer.views.vibration_spectrum import (
    VibrationSpectra,
    pass_frequencies,
)
from bearing_explorer.explorer.views.vibration_time import VibrationInTime, event_rows
from bearing_explorer.kit.compute.jobs import JobState, Work
from bearing_explorer.kit.plots.layers import least_and_greatest
from bearing_explorer.kit.serve.packed_source import PackedSource
from hypothesis import given, strategies as st

from bearingcore import Defect, presets
from bearingcore.model.dynamics import contact_resonance_band, speed_run
from bearingcore.model.dynamics._ball_comparison import mass_share
from bearingcore.model.scene import is_planar
from tests.helpers.simulated import pit

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
    view.put_head(healthy)
    opener = view._last_title if isinstance(view, FoldedView) else ""
    assert "defect" not in view._caption.title + view.caption(healthy) + opener


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


ONE_PASS = 1.0 / FAN_RIG.bearing.bpfo(FAN_RIG.shaft_speed)


def test_it_begins_a_quarter_pass_before_an_entry_and_lasts_one_and_a_half(
    results: Results,
) -> None:
    shown = results.excerpt
    assert shown.time[0] == pytest.approx(-0.25 * ONE_PASS, abs=2e-5)
    assert shown.time[-1] == pytest.approx(1.25 * ONE_PASS, abs=4e-5)
    assert shown.motion_time > 0.7  # after the transient


def test_entry_to_exit_takes_the_time_that_the_paper_gives(results: Results) -> None:
    entry, leaving, following = results.excerpt.events
    assert (entry.enters, leaving.enters, following.enters) == (True, False, True)
    assert entry.time == pytest.approx(0.0, abs=1e-9)
    assert leaving.ball == entry.ball
    assert leaving.time == pytest.approx(math.radians(12.9) / FAN_RIG.cage_speed)
    assert leaving.time == pytest.approx(0.01245, abs=5e-6)
    assert following.time == pytest.approx(ONE_PASS)


def test_the_signal_is_the_housing_and_the_loads_are_those_of_the_balls_named(
    results: Results,
) -> None:
    shown, motion = results.excerpt, results.motion
    at = np.searchsorted(motion.time, shown.motion_time + shown.time[0] - 1e-9)
    cut = slice(at, at + shown.time.size)
    np.testing.assert_array_equal(shown.acceleration["y"], motion.outer_acceleration[cut, 1])
    loads = motion.ball_loads()[cut][:, shown.balls]
    np.testing.assert_allclose(shown.ball_load, loads, rtol=0.0, atol=1e-9)


def test_a_healthy_bearing_shows_the_balls_that_carry_most() -> None:
    shown = Results(FAN_RIG.healthy()).excerpt
    assert shown.events == ()
    assert shown.balls.size == 2
    assert shown.static_load.max() == pytest.approx(39.0, abs=0.2)


@given(st.integers(1, 4000), st.integers(1, 300), st.integers(0, 2**32 - 1))
def test_thinning_keeps_the_peaks_and_is_short(n: int, parts: int, seed: int) -> None:
    values = np.random.default_rng(seed).normal(size=(n, 2))
    rows, kept = least_and_greatest(values, parts)
    assert len(rows) == len(kept)
    assert len(kept) <= min(n, 2 * parts)
    assert rows[0] == 0
    assert rows[-1] == n - 1
    assert np.all(np.diff(rows) > 0)
    np.testing.assert_array_equal(kept.min(axis=0), values.min(axis=0))
    np.testing.assert_array_equal(kept.max(axis=0), values.max(axis=0))


def test_a_motion_that_was_compared_is_not_moved_again() -> None:
    """The tab of the mass and the vibration of a scene with it share one motion."""
    coarse = Results(FAN_RIG.replace(balls="with mass"), moving=True)
    again = Results(FAN_RIG.replace(balls="with mass"), moving=True).ball_mass
    assert coarse.ball_mass is again
    assert Results(FAN_RIG, moving=True).ball_mass is again, "whatever the scene's own choice"


@pytest.mark.parametrize("name", [n for n in presets if not presets[n].bearing.kind.mass_unknown])
def test_the_first_picture_is_short_and_shows_a_ball_on_its_way_through(name: str) -> None:
    """Counted, not timed: contacts that are stepped; a general one costs four flat ones."""
    scene = presets[name].replace(balls="with mass")
    moving = Results(scene, moving=True)
    how = moving.settings.coarse_marching
    if moving.is_coarse(frozenset({"ball_mass"})):
        duration = quick_duration(scene, how)
        ball_mass = moving.ball_mass
        run, _ = motion(scene, dataclasses.replace(how, duration=duration))
        assert len(run.time) == round(duration * how.sample_rate)
        cost = duration * run.step_rate * scene.bearing.total_balls
        assert cost * (1.0 if is_planar(scene) else 4.0) < 2.1e6
        assert entry_of(ball_mass.events) is not None
        if all(defect.extent < 0.35 * scene.bearing.ball_spacing for defect in scene.defects):
            assert exit_of(ball_mass.events) is not None  # else it is a longer way than is shown
        assert not ball_mass.broke_off


def test_a_bearing_whose_balls_have_no_mass_says_so() -> None:
    results = Results(presets["30206-back-to-back"], moving=True)
    with pytest.raises(ValueError, match="a rib holds them"):
        _ = results.ball_mass


MOTOR = presets["6205"]


@pytest.fixture(scope="module")
def ball_mass() -> BallMass:
    return Results(FAN_RIG).ball_mass


def test_a_ball_over_a_small_pit_meets_its_far_edge_half_way() -> None:
    """As geometry has it: it pivots on one corner, then on the other, and never lets go."""
    small = Results(MOTOR.replace(defect=pit(MOTOR, 3e-4)), moving=True).ball_mass
    assert small.strikes == ()
    assert exit_of(small.events) is not None
    assert small.far_edge == pytest.approx(0.5 * exit_of(small.events).time, rel=0.02)
    assert mechanism_words(small).startswith(
        "The varying stiffness gives most of the power in every"
    )


def test_shares_are_those_of_the_core(ball_mass: BallMass) -> None:
    """Another way to the same number: two motions of the sweep's, and their band."""
    low, high = ball_mass.octaves[-3], ball_mass.octaves[-2]
    theirs = mass_share(FAN_RIG, low, high, 1.4, ball_mass.sample_rate)
    assert ball_mass.share[-2] == pytest.approx(theirs, abs=0.02)
    assert ball_mass.share[-1] > 0.9
    loud = ~ball_mass.quiet
    assert np.abs(ball_mass.share[loud & (ball_mass.octaves[1:] <= 1000.0)]).max() < 0.1
    assert (ball_mass.spread[loud] < 0.1).all()


def test_what_is_drawn_is_what_was_found(results: Results, ball_mass: BallMass) -> None:
    packed = PackedSource()
    time, octaves = (kind(packed) for kind in (MassInTime, WhichMechanism))
    sources, ranges = time.data(results)
    assert np.nanmax(sources["mass_motion"]["y"]) == np.max(ball_mass.with_mass["y"])
    assert np.nanmax(sources["mass_motion"]["y_massless"]) == np.max(ball_mass.massless["y"])
    assert sources["mass_flights"]["from"].size >= 1
    assert ranges["mass_time"] == (ball_mass.time[0], ball_mass.time[-1])
    sources, ranges = octaves.data(results)
    bars = sources["mechanism_bars"]
    np.testing.assert_allclose(bars["top"], 100.0 * ball_mass.share)
    assert (bars["right"][:-1] < bars["left"][1:]).all()
    words = mechanism_words(ball_mass)
    assert words.startswith("From 4 kHz up the mass of the balls gives most of the power")


def test_balls_with_mass_are_a_reference_of_the_spectrum(ball_mass: BallMass) -> None:
    """In grey, with the band of the contact resonances, named in the caption and the table."""
    packed = PackedSource()
    spectra = VibrationSpectra(packed)
    spectra.take_look({"axis": "logarithmic"})
    results = Results(FAN_RIG, grey_kind=OTHER_BALLS)
    sources, _ = spectra.data(results)
    band = sources["spectrum_wide_resonance"]
    assert band["high"][0] == pytest.approx(contact_resonance_band(FAN_RIG)[1])
    assert band["above"][0] == 0.0
    own, other = sources["spectrum_wide_lines"], sources["spectrum_wide_grey"]
    high = own["frequency"] > 9e3
    assert np.median(other["y"][high] - own["y"][high]) > 10.0, "mass adds above 8 kHz"
    assert "with the mass of its balls" in spectra.caption(results)
    assert any(name.startswith("other_balls_") for name in spectra.table(results))


def test_what_is_folded_is_not_computed() -> None:
    view = MassInTime(PackedSource())
    assert view.needs == frozenset({"ball_mass"}), "outside of the page it is open"
    view.attach(SimpleNamespace(jobs=None, draw=lambda: None))  # type: ignore[arg-type]
    assert view.needs == frozenset()
    assert view.sentence(Results(FAN_RIG)) == ""
    view._toggle()
    assert view.needs == frozenset({"ball_mass"})


RIG = presets["fan-rig"].replace(contact_damping=130.0)
SPEEDS = Sweep(SWEEPABLE[SPEED], np.array([20.0, 30.0, 40.0]))


@pytest.fixture(scope="module")
def run() -> SweptRun:
    return SweptRun(speed_run(RIG, SPEEDS.in_si[1], resolution=16.0), SPEEDS)


def test_rows_are_speeds_and_columns_frequencies(run: SweptRun) -> None:
    view = SpeedRunSpectra(PackedSource())
    view.job_result = run
    sources, ranges = view.data(Results(RIG))
    packed = sources["speed_run_cells_y"]["packed"]
    n, m = int(packed[1]), int(packed[0])
    assert n == 3
    drawn = packed[7:].reshape(n, m)
    np.testing.assert_allclose(drawn, levels_of(run.run, "y")[:, :m])
    assert packed[2:6].tolist() == pytest.approx([-8.0, 16.0 * m, 15.0, 30.0])
    assert ranges["speed_run_speed"] == (15.0, 45.0)
    low, high = ranges["speed_run_level_y"]
    loudest = np.nanmax(drawn[:, run.run.frequency[:m] >= 100.0])
    assert low < loudest <= high
    assert sources["speed_run_now"]["speed"] == pytest.approx([7.0])


def test_marched_speeds_are_marked_and_told(run: SweptRun) -> None:
    view = SpeedRunSpectra(PackedSource())
    view.job_result = run
    assert run.run.from_orbit.tolist() == [True, False, True]
    results = Results(RIG)
    assert view.data(results)[0]["speed_run_marched"]["speed"].tolist() == [30.0]
    assert "At 1 of 3 speeds" in view.sentence(results)
    assert view.sentence(Results(RIG.replace(depth=1e-5))).startswith("Faint")
    table = view.table(results)
    assert len({np.size(column) for column in table.values()}) == 1
    assert {"shaft_speed_hz", "frequency_hz", "density_y_m2_per_s4_per_hz"} <= set(table)


def test_a_first_run_that_is_computed_is_not_called_missing() -> None:
    view = SpeedRunSpectra(PackedSource())
    for mood, words in (
        ("waiting", "is being computed"),
        ("busy", "is being computed"),
        ("failed", "no run yet"),
    ):
        view.report(JobState(mood, 0.5, "Its own words."))  # type: ignore[arg-type]
        assert words in view._sentence.text
        assert words in view.sentence(Results(RIG))
        assert "Its own words." in view.job.state.words


def test_a_coarse_run_comes_first_and_bounds_hold() -> None:
    job = Work()
    job.started = time.monotonic()
    shown: list[SweptRun] = []
    job.show = shown.append  # type: ignore[method-assign]
    words = compute(job, RIG, sweep(SPEED, "30", "60", 49, limits_of(RIG)))
    assert [one.speeds.values.size for one in shown] == [25, 49]
    assert words.startswith("49 speeds after")
    view, editor = SpeedRunSpectra(PackedSource()), SceneEditor("fan-rig")
    with pytest.raises(ValueError, match=f"at most {COUNTS[-1]}"):
        view.prepare({"from": "1", "to": "60", "count": "100000"}, editor)
    assert callable(view.prepare(view.form(editor)[0], editor))


def test_a_run_that_would_take_too_many_steps_is_said_not_begun(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    speeds = sweep(SPEED, "30", "60", 49, limits_of(RIG))
    enough = partial(speed_run, most_steps_in_all=4_000_000)
    monkeypatch.setattr("bearing_explorer.explorer.views.speed_run.speed_run", enough)
    words = compute(Work(), RIG, speeds)
    assert "speeds after" in words
    assert "A finer run was not begun: speeds must be fewer: they take about" in words
