"""Sampled vibration against a march of its own, sampled at 0.5 MHz.

The witness is written here: the equations of motion of the fan rig's two bodies in the plane
(Petersen, Howard and Prime 2014, Eqs. 6, 18 and 19), integrated by SciPy's DOP853.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from numba import njit
from scipy.integrate import solve_ivp
from scipy.signal import firwin, freqz, upfirdn, welch

from bearingcore import orbit, presets, simulate
from bearingcore.dynamics.low_pass import low_passed
from bearingcore.dynamics.speed_runs import speed_run
from tests.outside.witness import witness

RATE, FINE = 65_536.0, 524_288.0
DURATION, SETTLED = 0.3, 0.1
BANDS = ((300.0, 2100.0), (2100.0, 5e3), (5e3, 1e4), (1e4, 1.6e4), (1.6e4, 2.4e4), (2.4e4, 2.62e4))

# the rig as printed; the damping is that of the text's range, given to both
N_BALLS, K, CLEARANCE, DAMPING = 14, 5453e6, 3e-6, 122.0
MASS, SUPPORT, SUPPORT_DAMPING, LOAD = 2.0, 212.2e6, 1648.2, -100.0
R_BALL, R_OUTER, DEPTH, EXTENT = 4e-3, 26.5e-3, 50e-6, math.radians(12.9)
CAGE = 0.5 * 2.0 * math.pi * 7.0 * (1.0 - 8.0 / 45.0)


@njit
def rates(
    t: float,
    y: np.ndarray,
    extent: float = EXTENT,
    cage: float = CAGE,
    damping: float = DAMPING,
    corner: float = 0.5,
) -> np.ndarray:
    """Rates of inner x, y, outer x, y [µm] and their velocities [mm/s] (Eqs. 6, 18, 19).

    `corner`: factor of the arc in Eq. 6; 0 for a ball that pivots on the corner of the race.
    """
    dx, dy = (y[0] - y[2]) * 1e-6, (y[1] - y[3]) * 1e-6
    ux, uy = (y[4] - y[6]) * 1e-3, (y[5] - y[7]) * 1e-3
    fx = fy = 0.0
    for j in range(N_BALLS):
        angle = cage * t + 2.0 * math.pi / N_BALLS * j
        c, s = math.cos(angle), math.sin(angle)
        away = (angle - 1.5 * math.pi + math.pi) % (2.0 * math.pi) - math.pi
        inside, deep, slope = 0.5 * extent - abs(away), 0.0, 0.0
        if inside > 0.0:
            deep, way = DEPTH, -1.0 if away > 0.0 else 1.0
            half = R_OUTER * (corner * inside if corner > 0.0 else math.sin(inside))
            if half < R_BALL:
                root = math.sqrt(R_BALL**2 - half**2)
                if corner > 0.0:
                    drop, turn = R_BALL - root, corner * R_OUTER * half / root
                else:
                    drop = R_OUTER * math.cos(inside) - root - (R_OUTER - R_BALL)
                    turn = R_OUTER * math.cos(inside) * half / root - R_OUTER * math.sin(inside)
                if drop < DEPTH:
                    deep, slope = drop, turn * way
        delta = dx * c + dy * s - CLEARANCE - deep
        if delta > 0.0:
            rate = ux * c + uy * s + cage * (dy * c - dx * s - slope)
            push = K * delta**1.5 + damping * rate
            fx += push * c
            fy += push * s
    found = np.empty(8)
    found[:4] = 1e3 * y[4:]
    found[4] = -1e3 * fx / MASS
    found[5] = 1e3 * (LOAD - fy) / MASS
    found[6] = 1e3 * (fx - SUPPORT * 1e-6 * y[2] - SUPPORT_DAMPING * 1e-3 * y[6]) / MASS
    found[7] = 1e3 * (fy - SUPPORT * 1e-6 * y[3] - SUPPORT_DAMPING * 1e-3 * y[7]) / MASS
    return found


@cache
def dense() -> np.ndarray:
    """Vertical acceleration of the housing at 0.5 MHz, from rest on the static state."""
    rig = presets["fan-rig"].replace(contact_damping=DAMPING)
    first = simulate(rig, 1e-3)  # only where it begins: what it does from there is found here
    start = np.concatenate([first.inner_displacement[0], first.outer_displacement[0]]) * 1e6
    time = np.arange(round(DURATION * FINE)) / FINE
    made = solve_ivp(
        rates, (0.0, time[-1]), np.concatenate([start, np.zeros(4)]), "DOP853", time,
        rtol=1e-9, atol=1e-8,
    )  # fmt: skip
    assert made.success
    return np.array([1e-3 * rates(t, y)[7] for t, y in zip(time, made.y.T, strict=True)])


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
    compared="levels of six bands up to 26 kHz [dB]",
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
        found = low_passed(history, 3, 200, RATE, step)[100:180, 0]
        phase = w * np.arange(100, 180) / RATE
        both = np.stack([np.sin(phase), np.cos(phase)], axis=1)
        in_phase, late = np.linalg.lstsq(both, found, rcond=None)[0]
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
    found, expected = motion.outer_acceleration[settled, 1], expected[settled]
    assert np.sqrt(np.mean((found - expected) ** 2) / np.mean(expected**2)) < 5e-3
    assert np.abs(found).max() == pytest.approx(np.abs(expected).max(), rel=2e-3)


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
    for found in (simulate(rig, 0.3).spectrum(), orbit(rig).spectrum()):
        assert found.frequency[-1] <= 0.4 * RATE
        assert (found.density[1:] > 0.0).all()
    run = speed_run(rig, [2.0 * math.pi * 7.0, 2.0 * math.pi * 30.0], duration=0.3)
    known = np.isfinite(run.density)
    assert known.any(axis=(1, 2)).all()
    assert known[:, -1].any()
    assert (run.density[:, 1:][known[:, 1:]] > 0.0).all()


@witness(
    "function: orbit",
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
