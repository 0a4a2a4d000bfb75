"""Impacts of one size at the frequency of a part that turns, and such as its turning modulates."""

import math

import numpy as np
import pytest
from bearing_explorer.diagnosis.views.part_words import plain

from bearingcore import Recording, diagnose
from bearingcore.common import number
from bearingcore.measured.diagnosis import CANNOT_TELL, Diagnosis, DiagnosisStatus
from tests.bearingcore.measured.diagnosis.signals_made import Machine, knock_times

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
        assert f"modulated once per {CARRIES[part][0]} turn" in plain(diagnosis, None)
