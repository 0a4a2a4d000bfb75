"""What lies between a motion and its sensor, made by itself."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore import presets, spectrum
from tests.helpers.path_effects import (
    NO_EFFECTS,
    PathEffects,
    Resonance,
    pink_noise,
    recorded_through,
    wandering_clock,
)

SCENE = presets["fan-rig"].replace(extent=math.radians(20.0))


def recorded(effects: PathEffects) -> np.ndarray:
    return recorded_through(SCENE, effects, 0.6, seed=4).acceleration


@pytest.fixture(scope="module")
def plain() -> np.ndarray:
    return recorded(NO_EFFECTS)


def test_a_cage_wanders_by_what_is_asked() -> None:
    time = np.arange(20_000) / 10_000.0
    clock = wandering_clock(time, 0.004, SCENE, np.random.default_rng(1))
    speed = np.diff(clock) * 10_000.0 - 1.0
    assert speed.std() == pytest.approx(0.004, rel=1e-3)
    assert abs(speed.mean()) < 1e-5
    steady = wandering_clock(time, 0.0, SCENE, np.random.default_rng(1))
    assert steady == pytest.approx(time, abs=1e-12)


def test_pink_noise_falls_by_three_decibels_an_octave() -> None:
    noise = pink_noise(2**17, 1, np.random.default_rng(2))[:, 0]
    frequency, density = spectrum(noise, 8192.0, 8.0)
    level = [
        10.0 * math.log10(density[(frequency >= f) & (frequency < 1.2 * f)].mean())
        for f in (100.0, 200.0, 400.0, 800.0, 1600.0)
    ]
    assert np.diff(level) == pytest.approx(-3.01, abs=0.5)


def test_a_resonance_lifts_its_frequency_by_its_gain(plain: np.ndarray) -> None:
    ringing = PathEffects(resonances=(Resonance(1500.0, 0.05, (3.0, 3.0)),)).without(
        "cage_wander", "knock", "shaft_tones", "noise"
    )
    ratio = np.abs(np.fft.rfft(recorded(ringing), axis=0)) / np.abs(np.fft.rfft(plain, axis=0))
    frequency = np.fft.rfftfreq(len(plain), 1.0 / 20_480.0)
    for at, gain in ((1500.0, 4.0), (150.0, 1.0), (6000.0, 1.0)):
        near = np.abs(frequency - at) < 15.0
        assert np.median(ratio[near]) == pytest.approx(gain, rel=0.12)


def test_knocks_ring_at_the_exits_three_times_as_high(plain: np.ndarray) -> None:
    knocking = PathEffects().without("cage_wander", "resonances", "shaft_tones", "noise")
    added = (recorded(knocking) - plain)[:, 1]
    assert np.abs(added).max() == pytest.approx(3.0 * np.abs(plain).max(), rel=0.15)
    strength = np.abs(np.fft.rfft(added))
    peak = np.fft.rfftfreq(len(added), 1.0 / 20_480.0)[strength.argmax()]
    assert peak == pytest.approx(4700.0, rel=0.01)
    begins = np.flatnonzero(np.abs(added) > 0.5 * np.abs(added).max())
    apart = np.diff(begins)[np.diff(begins) > 200] / 20_480.0
    passing = 1.0 / SCENE.bearing.bpfo(SCENE.shaft_speed)
    assert apart == pytest.approx(passing, rel=0.05)
