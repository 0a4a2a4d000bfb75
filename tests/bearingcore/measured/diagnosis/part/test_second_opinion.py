"""Knocks that whitening hides, computed signals, and motions that repeat every second knock."""

import math

import numpy as np
import pytest

from bearingcore import Recording, diagnose
from tests.bearingcore.measured.diagnosis.signals_made import Machine

MOTOR = Machine(9, 7.94 / 39.04, 29.53, 12_000.0, 10.0)
TIME = np.arange(int(MOTOR.duration * MOTOR.rate)) / MOTOR.rate


def steady(frequency: float, ringing: float, strengths: tuple[float, ...] = (1.0,)) -> np.ndarray:
    """Knocks that repeat exactly, each making one resonance ring; in turn of some strengths."""
    number = np.floor(TIME * frequency).astype(int)
    since = TIME - number / frequency
    size = np.array(strengths)[number % len(strengths)]
    return size * np.exp(-400.0 * since) * np.sin(2.0 * math.pi * ringing * since)


def turning_with(shaft: float) -> np.ndarray:
    """Through the load once a turn."""
    return 1.0 + 0.8 * np.cos(2.0 * math.pi * shaft * TIME)


def answer(signal: np.ndarray, speed: float = MOTOR.shaft_speed):
    return diagnose(Recording(signal, MOTOR.rate, ("y",)), MOTOR.bearing, speed)


@pytest.fixture(scope="module")
def hidden() -> np.ndarray:
    """An inner race that knocks as steadily as a tone, beneath another source in a lower band."""
    rng = np.random.default_rng(21)
    knocking = steady(MOTOR.lines["inner race"], 3600.0) * turning_with(MOTOR.turns)
    elsewhere = steady(4.286 * MOTOR.turns, 600.0)
    noise = rng.standard_normal(len(TIME))
    return 0.5 * knocking / knocking.std() + 4.0 * elsewhere / elsewhere.std() + noise


def test_a_part_that_fills_a_band_is_named_whatever_knocks_elsewhere(hidden):
    diagnosis = answer(hidden)
    assert diagnosis.fault == "inner race"
    assert diagnosis.probability < 0.99
    assert diagnosis.of("inner race").band.low > 2000.0


def test_the_other_source_alone_names_no_part():
    rng = np.random.default_rng(22)
    elsewhere = steady(4.286 * MOTOR.turns, 600.0)
    signal = 4.0 * elsewhere / elsewhere.std() + rng.standard_normal(len(TIME))
    assert answer(signal).fault == "cannot tell"
    swelling = steady(4.286 * MOTOR.turns, 600.0) * turning_with(MOTOR.turns)
    signal = 4.0 * swelling / swelling.std() + rng.standard_normal(len(TIME))
    assert answer(signal).fault == "cannot tell"


@pytest.mark.parametrize("strengths", [(1.0,), (1.0, 0.6), (1.0, 0.8, 0.5)])
def test_a_computed_signal_without_noise_is_named(strengths):
    """Be its knocks alike or such as repeat every second or third time only."""
    assert answer(steady(MOTOR.lines["outer race"], 3000.0, strengths)).fault == "outer race"


def test_a_source_of_half_the_rate_is_none_of_the_bearing_s():
    """Knocks at half the outer race's line have its lines too, and those between are as strong."""
    half = steady(0.5 * MOTOR.lines["outer race"], 3000.0)
    signal = half / half.std() + 0.3 * np.random.default_rng(3).standard_normal(len(TIME))
    assert answer(signal).fault == "cannot tell"
