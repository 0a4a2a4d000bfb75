"""What speaks for a part: combs above noise, modulation, hidden knocks; what sources are said."""

import math

import numpy as np
import pytest
from bearing_explorer.diagnosis.views.part_words import explanation

from bearingcore import Recording, diagnose, presets
from bearingcore.common import number
from bearingcore.measured.diagnosis import CANNOT_TELL, HARMONICS, Diagnosis, DiagnosisStatus
from bearingcore.measured.diagnosis._part.combs import comb_level, lines_at, noise_level
from bearingcore.measured.diagnosis._part.mains import WITHIN, magnetic_share
from bearingcore.measured.signals._line_levels import line_levels
from tests.bearingcore.measured.diagnosis.signals_made import Machine, knock_times


def test_the_loudest_line_does_not_count():
    lines = np.full((HARMONICS, 1), 10.0)
    assert comb_level(lines)[0] == pytest.approx(10.0)
    lines[2] = 40.0
    assert comb_level(lines)[0] == pytest.approx(10.0)
    only = np.zeros((HARMONICS, 1))
    only[0] = 40.0  # a tone
    assert comb_level(only)[0] == 0.0


@pytest.mark.parametrize("averages", [1, 4])
def test_noise_reaches_a_level_as_often_as_told(averages):
    """Held against noise through the real spectrum, windows, overlap and background."""
    rng = np.random.default_rng(8)
    rate, length = 500.0, 4.0
    seen, actual = [], 0.0
    for _ in range(25):
        values = rng.standard_normal(int(rate * length * (1 if averages == 1 else 2.5)))
        lines = line_levels(values, rate, length, 250.0, 120.0)
        actual = lines.averages
        frequency = np.arange(8.0, 40.0, 0.0625)
        level = np.clip(lines.level, -3.0, 40.0)
        seen.append(comb_level(lines_at(level, lines.step, frequency)))
    levels = np.concatenate(seen)
    for chance in (0.3, 0.1, 0.02):
        share = (levels >= noise_level(chance, actual)).mean()
        assert share == pytest.approx(chance, rel=0.35)


BEARING = presets["6205"].bearing
NOISE = Recording(np.random.default_rng(8).standard_normal(24_000), 12_000.0, ("y",))


def test_origins_are_said_and_given_is_only_what_is_given():
    diagnosis = diagnose(NOISE, BEARING, 150.0)
    assert (diagnosis.speed_source, diagnosis.bearing_source) == ("given", "given")
    assert "assumed" not in diagnosis.sentence
    diagnosis = diagnose(
        NOISE, BEARING, 150.0,
        speed_source="assumed: the scene's", bearing_source="assumed: the scene's",
    )  # fmt: skip
    assert "turns a minute (assumed: the scene's)" in diagnosis.sentence
    assert "Bearing assumed: the scene's." in diagnosis.sentence
    assert "given" not in diagnosis.sentence
    diagnosis = diagnose(NOISE, BEARING, (149.0, 151.0), speed_source="from the file")
    assert diagnosis.speed_source == "from the file as a range, its middle"
    assert diagnosis.shaft_speed == pytest.approx(150.0)


def test_without_a_bearing_no_part_is_named_and_it_is_asked_for():
    diagnosis = diagnose(NOISE, None, 150.0)
    assert diagnosis.status == DiagnosisStatus.BEARING_OPEN
    assert not diagnosis.conclusive
    assert diagnosis.bearing_source == "unknown"
    assert "depends on the bearing, which is not known" in diagnosis.sentence


def test_the_share_of_magnetic_noise_falls_with_the_distance_from_twice_the_mains():
    """Bayes by hand: exponential against uniform, as probable before; EN 50160's 1 %."""
    scale = 0.01 / np.log(200.0)
    for frequency, middle in ((100.0, 100.0), (100.4, 100.0), (119.2, 120.0)):
        away = abs(frequency / middle - 1.0)
        magnetic = np.exp(-away / scale) / (2.0 * scale)
        share = magnetic_share(frequency, 0.0, 0.02)
        assert share == pytest.approx(magnetic / (magnetic + 1.0 / 0.04), rel=1e-9)
    assert magnetic_share(100.0 * (1.0 + 1.01 * WITHIN), 0.0, 0.02) == 0.0
    assert magnetic_share(100.5, 0.5, 0.02) == magnetic_share(100.0, 0.0, 0.02)


MOTOR = Machine(9, 7.94 / 39.04, 19.75, 12_000.0, 2.0)
CARRIES = {"inner race": ("shaft", MOTOR.turns), "ball": ("cage", MOTOR.cage)}
"""What turns the part through the load, and how often [Hz]."""


def answer(part: str, strength: float, jitter: float, seed: int, swing: float = 0.0) -> Diagnosis:
    """Diagnosis of impacts that make 3.3 kHz ring, in white noise of deviation 1.

    `strength` is the deviation of their ringing, `swing` what share of their size turns.
    """
    rng = np.random.default_rng(seed)
    times = knock_times(MOTOR.lines[part], MOTOR.duration, rng, 0.0, jitter)
    size = 1.0 + swing * np.cos(2.0 * math.pi * CARRIES[part][1] * times)
    at = np.arange(int(MOTOR.duration * MOTOR.rate)) / MOTOR.rate
    before = np.searchsorted(times, at, side="right") - 1
    since = np.where(before < 0, 1.0, at - times[before])
    ringing = size[before] * np.exp(-500.0 * since) * np.sin(2.0 * math.pi * 3300.0 * since)
    signal = strength * ringing / ringing.std() + rng.standard_normal(len(at))
    return diagnose(Recording(signal, MOTOR.rate, ("y",)), MOTOR.bearing, MOTOR.shaft_speed)


@pytest.mark.parametrize("part", CARRIES)
@pytest.mark.parametrize(("strength", "jitter"), [(0.4, 0.0), (1.0, 0.0), (1.0, 0.01)])
def test_impacts_of_one_size_name_no_part_that_turns_and_are_said(part, strength, jitter):
    """A load that stands still would modulate them; whitening hides those that are regular."""
    for seed in range(3):
        diagnosis = answer(part, strength, jitter, seed)
        assert (diagnosis.fault, diagnosis.status) == (CANNOT_TELL, DiagnosisStatus.UNMODULATED)
        evidence = diagnosis.of(part)
        assert not evidence.modulated
        assert evidence.frequency == pytest.approx(MOTOR.lines[part], rel=0.005)
        assert diagnosis.detail.startswith(f"Impacts at {number(evidence.frequency, 4)} Hz")
        assert f"not modulated once per {CARRIES[part][0]} turn" in diagnosis.sentence


@pytest.mark.parametrize("part", CARRIES)
def test_the_same_impacts_name_the_part_where_its_turning_modulates_them(part):
    for seed in range(3):
        diagnosis = answer(part, 1.0, 0.01, seed, 0.8)
        assert diagnosis.fault == part
        assert diagnosis.probability > 0.9
        assert diagnosis.of(part).modulated
        assert f"modulated once per {CARRIES[part][0]} turn" in explanation(diagnosis, None)


STEADY_MOTOR = Machine(9, 7.94 / 39.04, 29.53, 12_000.0, 10.0)
TIME = np.arange(int(STEADY_MOTOR.duration * STEADY_MOTOR.rate)) / STEADY_MOTOR.rate


def steady(frequency: float, ringing: float, strengths: tuple[float, ...] = (1.0,)) -> np.ndarray:
    """Knocks that repeat exactly, each making one resonance ring; in turn of some strengths."""
    number = np.floor(TIME * frequency).astype(int)
    since = TIME - number / frequency
    size = np.array(strengths)[number % len(strengths)]
    return size * np.exp(-400.0 * since) * np.sin(2.0 * math.pi * ringing * since)


def turning_with(shaft: float) -> np.ndarray:
    """Through the load once a turn."""
    return 1.0 + 0.8 * np.cos(2.0 * math.pi * shaft * TIME)


def steady_answer(signal: np.ndarray, speed: float = STEADY_MOTOR.shaft_speed):
    return diagnose(Recording(signal, STEADY_MOTOR.rate, ("y",)), STEADY_MOTOR.bearing, speed)


def test_a_part_that_fills_a_band_is_named_whatever_knocks_elsewhere():
    """An inner race that knocks as steadily as a tone, beneath another source in a lower band."""
    rng = np.random.default_rng(21)
    knocking = steady(STEADY_MOTOR.lines["inner race"], 3600.0) * turning_with(STEADY_MOTOR.turns)
    elsewhere = steady(4.286 * STEADY_MOTOR.turns, 600.0)
    noise = rng.standard_normal(len(TIME))
    signal = 0.5 * knocking / knocking.std() + 4.0 * elsewhere / elsewhere.std() + noise
    diagnosis = steady_answer(signal)
    assert diagnosis.fault == "inner race"
    assert diagnosis.probability < 0.99
    assert diagnosis.of("inner race").band.low > 2000.0


def test_the_other_source_alone_names_no_part():
    rng = np.random.default_rng(22)
    for swelling in (1.0, turning_with(STEADY_MOTOR.turns)):
        elsewhere = swelling * steady(4.286 * STEADY_MOTOR.turns, 600.0)
        signal = 4.0 * elsewhere / elsewhere.std() + rng.standard_normal(len(TIME))
        assert steady_answer(signal).fault == "cannot tell"


@pytest.mark.parametrize("strengths", [(1.0,), (1.0, 0.6), (1.0, 0.8, 0.5)])
def test_a_computed_signal_without_noise_is_named(strengths):
    """Be its knocks alike or such as repeat every second or third time only."""
    signal = steady(STEADY_MOTOR.lines["outer race"], 3000.0, strengths)
    assert steady_answer(signal).fault == "outer race"


def test_a_source_of_half_the_rate_is_none_of_the_bearing_s():
    """Knocks at half the outer race's line have its lines too, and those between are as strong."""
    half = steady(0.5 * STEADY_MOTOR.lines["outer race"], 3000.0)
    signal = half / half.std() + 0.3 * np.random.default_rng(3).standard_normal(len(TIME))
    assert steady_answer(signal).fault == "cannot tell"
