"""Lengths of spalls by simulating each, offsets of entry and exit, and trends of recordings."""

import math
from dataclasses import replace
from datetime import datetime

import numpy as np
import pytest
from scipy.optimize import brentq

from bearingcore import Defect, Load, Recording, Scene, modes, presets, size_defect, trend
from bearingcore.measured.diagnosis import CANNOT_TELL
from bearingcore.model.statics import equilibrium
from bearingcore.sizing import LINES, Sizing, SizingStatus
from bearingcore.sizing._release import plausible_offset, release_offset
from tests.helpers.recordings import RATE, RIG, noisy, signal_of

EXTENT = math.radians(47.3)
SIGNAL = noisy(signal_of(RIG.replace(extent=EXTENT)), 20.0)
RECORDING = Recording(SIGNAL, RATE)
TWO_DEFECTS = RIG.replace(defect=(RIG.defect, replace(RIG.defect, center=1.0)))


@pytest.fixture(scope="module")
def sizing() -> Sizing:
    return size_defect(RECORDING, RIG, support_known=True)


def test_an_answer_has_what_a_picture_of_it_needs(sizing: Sizing) -> None:
    best, second = sizing.candidates[:2]
    assert sizing.status == SizingStatus.SIZED
    assert best.low < EXTENT < best.high
    assert best.extent == pytest.approx(EXTENT, abs=math.radians(0.1))
    assert best.ratio == 1.0 < second.ratio == pytest.approx(second.misfit / best.misfit)
    spacings = [abs(c.extent - best.extent) / RIG.bearing.ball_spacing for c in sizing.candidates]
    assert any(0.8 < count < 1.2 for count in spacings), "with the same entry and exit"
    assert best.bands == modes(RIG.replace(extent=best.extent)).bands() == modes(best.scene).bands()
    assert f"{math.degrees(best.extent):.1f}°" in sizing.sentence
    assert sizing.table()["extent"].tolist() == [c.extent for c in sizing.candidates]


def test_the_misfit_is_that_of_the_lines_it_comes_with(sizing: Sizing) -> None:
    """By the formula, written out: each direction of power 1."""
    for candidate in sizing.candidates:
        size = np.linalg.norm(sizing.lines, axis=0)
        measured, simulated = sizing.lines / size, candidate.lines / size
        alike = np.sum(np.conj(measured) * simulated).real
        alike /= math.sqrt(2.0 * np.sum(np.abs(simulated) ** 2))
        assert candidate.misfit == pytest.approx(1.0 - alike, abs=1e-9)
    near = np.abs(sizing.lines - sizing.candidates[0].lines).max() / np.abs(sizing.lines).max()
    assert near < 0.05, "the simulated lines are not scaled, and lie over the measured ones"


def test_one_direction_and_another_start_in_time_are_enough() -> None:
    late = size_defect(Recording(SIGNAL[777:, 1], RATE, ("y",)), RIG, support_known=True)
    assert late.best is not None
    assert late.best.extent == pytest.approx(EXTENT, abs=math.radians(0.2))


def test_a_changing_speed_that_was_measured_is_followed() -> None:
    """The signal of a steady shaft on a clock that runs 5 % fast and slow is as of such a shaft."""
    time = np.arange(len(SIGNAL)) / RATE
    pace = 2.0 * math.pi / time[-1]
    clock = time + 0.05 * (1.0 - np.cos(pace * time)) / pace
    warped = np.stack([np.interp(clock, time, column) for column in SIGNAL.T], axis=1)
    assert not size_defect(Recording(warped, RATE), RIG, support_known=True).conclusive
    measured = Recording(warped, RATE, shaft_angle=RIG.shaft_speed * clock)
    sizing = size_defect(measured, RIG, support_known=True)
    assert sizing.conclusive
    assert sizing.best.extent == pytest.approx(EXTENT, abs=math.radians(0.2))


@pytest.mark.parametrize(
    ("recording", "scene", "status"),
    [
        (RECORDING, RIG.replace(race="inner"), SizingStatus.INNER_RACE),
        (RECORDING, TWO_DEFECTS, SizingStatus.SEVERAL_DEFECTS),
        (Recording(SIGNAL[:2000], RATE), RIG, SizingStatus.TOO_SHORT),
        (Recording(SIGNAL, 5000.0), RIG, SizingStatus.TOO_COARSE),
        (RECORDING, RIG.replace(shaft_speed=1000.0), SizingStatus.TOO_FAST),
    ],
    ids=str,
)
def test_what_cannot_be_sized_says_why(
    recording: Recording, scene: Scene, status: SizingStatus
) -> None:
    sizing = size_defect(recording, scene, support_known=True)
    assert sizing.status == status
    assert (sizing.candidates, sizing.best, sizing.sentence) == ((), None, status.sentence)


def test_a_machine_of_unknown_support_is_given_no_length() -> None:
    sizing = size_defect(RECORDING, RIG)
    assert sizing.status == SizingStatus.SUPPORT_UNKNOWN
    assert "stiffness of its support" in sizing.sentence


def test_progress_is_called_often_and_ends_the_search() -> None:
    parts: list[float] = []

    def progress(part: float, words: str) -> None:
        assert words.endswith("°")
        parts.append(part)
        if len(parts) == 5:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        size_defect(RECORDING, RIG, support_known=True, progress=progress)
    assert parts == sorted(parts)
    assert parts[-1] < 0.1


BEARING = presets["6205"].bearing
UNDER = 1.5 * math.pi


def exact_drop(s: float) -> float:
    """[m] by which a ball pivoting on the corner of an outer race sinks."""
    outer, ball = BEARING.outer_raceway_radius, BEARING.ball_radius
    inner = ball**2 - (outer * math.sin(s)) ** 2
    return outer * math.cos(s) - math.sqrt(inner) - (outer - ball)


def compression_beside(load: float) -> float:
    """[m] of the ball under the load, on a whole race."""
    spall = Defect(0.0, 0.0, UNDER, "outer")
    bearing = replace(BEARING, radial_clearance=0.0)
    scene = Scene(bearing, spall, Load(fy=-load), 0.0, presets["6205"].support, dofs=("x", "y"))
    carried = float(equilibrium(scene, np.array([UNDER])).ball_load[0, 0])
    return (carried / bearing.load_deflection_factor) ** (2.0 / 3.0)


@pytest.mark.parametrize("load", [50.0, 400.0])
def test_a_ball_lets_go_where_it_has_sunk_by_its_compression_and_what_the_rings_follow(load):
    """The rings follow a ball that sinks until the others carry all: by less than its compression
    once more, as six or more of nine balls are there to carry.
    """
    compressed = compression_beside(load)
    offset = release_offset(BEARING, "outer", load, 0.0)
    alone = 2.0 * brentq(lambda s: exact_drop(s) - compressed, 0.0, 0.05)
    twice = 2.0 * brentq(lambda s: exact_drop(s) - 2.0 * compressed, 0.0, 0.05)
    assert alone < offset < twice


def test_offsets_measured_on_a_rig_fit_its_load():
    """A rig with 5 kg overhung: spalls of 5° on the outer race were 3.8-4.0° between knocks."""
    exact = [math.degrees(release_offset(BEARING, "outer", load, 3e-6)) for load in (80.0, 150.0)]
    assert exact == pytest.approx([1.11, 1.32], abs=0.03)
    assert math.degrees(release_offset(BEARING, "outer", 80.0, 3e-6, "published")) > 1.8


@pytest.mark.parametrize("race", ["outer", "inner"])
@pytest.mark.parametrize("edge", ["exact", "chord", "published"])
def test_offsets_grow_with_load_and_clearance(race, edge):
    by_load = [release_offset(BEARING, race, load, 3e-6, edge) for load in (50.0, 200.0, 800.0)]
    by_clearance = [release_offset(BEARING, race, 100.0, gap, edge) for gap in (0.0, 5e-6, 2e-5)]
    assert np.all(np.diff(by_load) > 0.0)
    assert np.all(np.diff(by_clearance) > 0.0)


@pytest.mark.parametrize("load", [1e-6, 1.0, 1e5])
def test_offsets_of_any_load_are_angles_inside_the_spall(load):
    """Under a light load a ball carries over a few degrees only, and was let go turns away."""
    for gap in (0.0, 1e-5, 1e-4):
        offset = release_offset(BEARING, "outer", load, gap)
        assert math.isnan(offset) or 0.0 <= offset < BEARING.ball_spacing
    low, _, high = plausible_offset(BEARING, "outer", load, None, "exact")
    assert 0.0 <= low < high < 0.5 * BEARING.ball_spacing


def test_what_is_known_narrows_what_is_plausible():
    def width(load, clearance):
        low, _, high = plausible_offset(BEARING, "outer", load, clearance)
        return high - low

    assert width(100.0, 3e-6) < width(100.0, None) < width(None, None)


TREND_RATE, TURN = 12_000.0, 25.0
SPEED = 2.0 * math.pi * TURN
TIME = np.arange(int(2 * TREND_RATE)) / TREND_RATE
BAND = (2500.0, 3500.0)


def recorded(depth: float, name: str = "", duration: float = 2.0) -> Recording:
    """Noise, and a 3 kHz tone that swells with BPFO by a share `depth` of 2 m/s²."""
    rng = np.random.default_rng(len(name))
    swell = 2.0 * (1.0 + depth * np.cos(2.0 * math.pi * BEARING.bpfo(SPEED) * TIME))
    signal = swell * np.sin(2.0 * math.pi * 3000.0 * TIME)
    signal += 0.3 * rng.standard_normal(TIME.size)
    return Recording(signal[: round(duration * TREND_RATE), None], TREND_RATE, ("y",), name)


def test_hours_since_the_first_and_the_first_that_shows_a_part():
    recordings = [
        replace(recorded(depth), recorded=datetime(2026, 5, day))
        for depth, day in ((0.0, 1), (0.2, 3), (0.5, 12))
    ]
    history = trend(recordings, BEARING, SPEED, band=BAND)
    assert history.hours.tolist() == [0.0, 48.0, 264.0]
    assert (history.seen_since("outer race"), history.seen_since("ball")) == (1, None)
    others = np.delete(history.clear_lines, LINES.index("bpfo"), axis=1)
    assert np.isnan(others[:2]).all()


def test_the_baseline_is_what_others_are_compared_with():
    recordings = [recorded(0.0), recorded(0.5)]
    first, second = (
        trend(recordings, BEARING, SPEED, band=BAND, baseline=k).rms_change for k in (0, 1)
    )
    assert first[0] == second[1] == 1.0
    assert first[1] == pytest.approx(1.0 / second[0])
    with pytest.raises(ValueError, match="baseline"):
        trend(recordings, BEARING, SPEED, band=BAND, baseline=2)


def test_it_ends_where_it_is_cancelled_with_what_it_has():
    seen = []

    def goes_on(so_far, of):
        seen.append((len(so_far.points), of))
        return len(seen) < 2

    recordings = [recorded(0.1)] * 3
    history = trend(recordings, BEARING, SPEED, band=BAND, goes_on=goes_on)
    assert seen == [(1, 3), (2, 3)]
    assert len(history.points) == 2


def test_what_is_not_known_is_not_a_number():
    short = trend([recorded(0.5, duration=0.1)], BEARING, SPEED, band=BAND)
    assert math.isnan(short.column("lines")[0, LINES.index("ftf")])
    assert math.isnan(short.points[0].extent.extent)


def test_without_bearing_and_speed_levels_stay_and_no_part_is_named():
    known = trend([recorded(0.5)], BEARING, SPEED, band=BAND).points[0]
    (alone,) = trend([recorded(0.5)], None).points
    assert (alone.rms, alone.kurtosis) == (known.rms, known.kurtosis)
    assert alone.fault == CANNOT_TELL
    assert math.isnan(alone.probability)
    assert math.isnan(alone.shaft_speed)
    assert np.isnan(alone.lines).all()
    (searched,) = trend([recorded(0.5)], BEARING).points  # the speed is looked for
    assert searched.rms == known.rms
    assert math.isnan(searched.shaft_speed) or searched.shaft_speed > 0.0
