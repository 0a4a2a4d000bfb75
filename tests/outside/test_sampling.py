"""Sampled vibration against a march of its own, sampled at 0.5 MHz.

The witness is `march.py`: the equations of motion by SciPy's DOP853.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.signal import firwin, freqz, upfirdn, welch

from bearingcore import orbit, presets, simulate
from bearingcore.model.dynamics import speed_run
from bearingcore.model.dynamics._low_pass import low_passed
from tests.outside.test_charts import problem
from tests.outside.witness import witness

RATE, FINE = 65_536.0, 524_288.0
DURATION, SETTLED = 0.3, 0.1
BANDS = ((300.0, 2100.0), (2100.0, 5e3), (5e3, 1e4), (1e4, 1.6e4), (1.6e4, 2.4e4), (2.4e4, 2.62e4))

DAMPING = 122.0


@cache
def dense() -> np.ndarray:
    """Vertical acceleration of the housing at 0.5 MHz, from rest on the static state."""
    one = replace(problem("fan-rig"), c=DAMPING)
    time = np.arange(round(DURATION * FINE)) / FINE
    return one.accelerations(time, one.solved(one.start(), time, 1e-9))[:, 1]


def bands(signal: np.ndarray, rate: float) -> np.ndarray:
    """Levels [dB] of the settled signal; lines of 32 Hz."""
    settled = signal[round(SETTLED * rate) :]
    frequency, density = welch(settled, rate, nperseg=round(rate / 32.0))
    return np.array(
        [10.0 * np.log10(density[(frequency >= a) & (frequency < b)].sum()) for a, b in BANDS]
    )


@witness(
    "function: simulate",
    "ball bearing: motion",
    by="SciPy's DOP853 at 0.5 MHz on Eqs. 6, 18, 19",
    compared="levels of six bands up to 26 kHz [dB]; damping of the support to no closer than 3 %",
    within="0.1 dB",
)
@pytest.mark.proof
@pytest.mark.parametrize("step_rate", [None, RATE])
def test_nothing_folds_back(step_rate: float | None) -> None:
    """Within 0.1 dB of what 0.5 MHz show as far as the motion says it is known."""
    rig = presets["fan-rig"].replace(contact_damping=DAMPING)
    motion = simulate(rig, DURATION, RATE, step_rate=step_rate)
    off = bands(motion.outer_acceleration[:, 1], RATE) - bands(dense(), FINE)
    known = [high <= 1.001 * max(motion.bandwidth, 13_107.0) for _, high in BANDS]
    assert sum(known) == (3 if step_rate is None else 6)
    assert np.abs(off[known]).max() < 0.1
    # half as many steps as samples: less right above what is claimed, and still not folded back
    assert np.abs(off).max() < 0.7


@pytest.mark.parametrize("ratio", [1, 4])
def test_a_tone_keeps_its_phase_and_has_the_gain_of_a_windowed_sinc(ratio: int) -> None:
    """SciPy's firwin of the same length and window, 64 times as dense."""
    step = ratio * RATE
    taps = firwin(2 * 19 * 64 + 1, 0.45 * RATE, window=("kaiser", 5.65326), fs=64.0 * RATE)
    time = np.arange(400 * ratio) / step
    for part in (0.02, 0.1):
        w = 2.0 * math.pi * part * RATE
        history = np.zeros((len(time), 6, 1))
        waves = -np.sin(w * time) / w**2, -np.cos(w * time) / w, np.sin(w * time)
        history[:, 3:, 0] = np.transpose(waves)
        filtered = low_passed(history, 3, 200, RATE, step)[100:180, 0]
        phase = w * np.arange(100, 180) / RATE
        both = np.stack([np.sin(phase), np.cos(phase)], axis=1)
        in_phase, late = np.linalg.lstsq(both, filtered, rcond=None)[0]
        gain = abs(freqz(taps, worN=[part * RATE], fs=64.0 * RATE)[1][0])
        assert in_phase == pytest.approx(gain, abs=5e-4)  # its gain at 0 Hz is made exactly 1
        assert abs(late) < 1e-6


@pytest.mark.proof
def test_the_signal_is_what_a_filter_makes_of_a_dense_one() -> None:
    """SciPy's firwin of the witness, decimated: peak and waveform."""
    rig = presets["fan-rig"].replace(contact_damping=DAMPING)
    motion = simulate(rig, DURATION, RATE)
    taps = firwin(2 * 320 + 1, 0.45 * RATE, window=("kaiser", 8.0), fs=FINE)
    expected = upfirdn(taps, dense(), 1, 8)[40 : 40 + len(motion.time)]
    settled = slice(round(SETTLED * RATE), -100)
    actual, expected = motion.outer_acceleration[settled, 1], expected[settled]
    assert np.sqrt(np.mean((actual - expected) ** 2) / np.mean(expected**2)) < 5e-3
    assert np.abs(actual).max() == pytest.approx(np.abs(expected).max(), rel=2e-3)


@pytest.mark.parametrize("balls", ["massless", "with mass"])
def test_a_denser_sampling_shows_the_same(balls: str) -> None:
    """Eight times the samples, low-passed by SciPy: third of the claim of 0.1 dB, mass or not."""
    rig = presets["fan-rig"].replace(contact_damping=DAMPING, balls=balls)
    coarse = simulate(rig, DURATION, RATE, step_rate=None if balls == "with mass" else RATE)
    dense = simulate(rig, DURATION, 8.0 * RATE, step_rate=8.0 * RATE)
    assert coarse.bandwidth == 0.4 * RATE
    off = bands(coarse.outer_acceleration[:, 1], RATE)
    off -= bands(dense.outer_acceleration[:, 1], 8.0 * RATE)
    assert np.abs(off).max() < 0.1


def test_spectra_end_where_they_are_known() -> None:
    """No line is exactly 0: above half the steps of a period nothing is known of an orbit."""
    rig = presets["fan-rig"].replace(contact_damping=DAMPING)
    for lines in (simulate(rig, 0.3).spectrum(), orbit(rig).spectrum()):
        assert lines.frequency[-1] <= 0.4 * RATE
        assert (lines.density[1:] > 0.0).all()
    run = speed_run(rig, [2.0 * math.pi * 7.0, 2.0 * math.pi * 30.0], duration=0.3)
    known = np.isfinite(run.density)
    assert known.any(axis=(1, 2)).all()
    assert known[:, -1].any()
    assert (run.density[:, 1:][known[:, 1:]] > 0.0).all()


@witness(
    "function: orbit",
    "function: speed_run",
    "chart: orbits",
    by="SciPy's DOP853, settled",
    compared="levels below 5 kHz [dB]",
    within=0.02,
)
@pytest.mark.proof
def test_an_orbit_and_a_speed_run_agree_with_the_witness() -> None:
    """The steady state of the march of its own, below 5 kHz."""
    rig = presets["fan-rig"].replace(contact_damping=DAMPING)
    span = DURATION - SETTLED
    lines = orbit(rig, step_rate=RATE).spectrum(duration=span, since=SETTLED)
    settled = dense()[round(SETTLED * FINE) :]
    frequency, density = welch(settled, FINE, nperseg=round(FINE / 32.0))
    for low, high in BANDS[:2]:
        ours = lines.density[(lines.frequency >= low) & (lines.frequency < high), 1].sum()
        theirs = density[(frequency >= low) & (frequency < high)].sum()
        assert abs(10.0 * math.log10(ours / theirs)) < 0.02
