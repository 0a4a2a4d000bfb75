"""Simulated motion meets a reference on which two families of integrators agree.

See tests/reference/README.md. Where touching switches the damping, a fixed step has order 1 in the
state, whatever the method: the tolerances below are those of steps of 1/65,536 s, as an independent
Runge-Kutta march in plain C has them too, and finer steps close in on the reference.
"""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from bearingcore import Motion, Scene, presets, simulate, spectrum

RATE = 65536.0
STORED = np.load(Path(__file__).parents[2] / "reference" / "motion_reference.npz")
CASES = {"sound": 0.0, "12.9deg": 12.9, "38.6deg": 38.6}
DEFECTIVE = ("12.9deg", "38.6deg")


@cache
def motion_of(case: str, step_rate: float | None = RATE) -> Motion:
    """The fan rig over 1.4 s."""
    return simulate(scene_of(case), 1.4, RATE, step_rate=step_rate)


def scene_of(case: str) -> Scene:
    """The case's scene with the reference's contact damping."""
    extent, depth, damping, _ = STORED[f"{case}/scene"]
    scene = presets["fan-rig"].replace(contact_damping=damping)
    if extent == 0.0:
        return scene.healthy()
    return scene.replace(extent=extent, depth=depth)


def decibels_off(case: str, acceleration: np.ndarray) -> float:
    """Greatest error of the spectra in x and y over 0.3 to 2.1 kHz [dB].

    Frequencies at which a direction is 40 dB below its greatest level carry nothing and are left
    out; that concerns a few of the healthy bearing's, at −115 dB, and none of the defective one's.
    """
    frequency, density = spectrum(acceleration, RATE)
    assert frequency == pytest.approx(STORED["frequency"])
    band = (frequency >= 300.0) & (frequency <= 2100.0)
    found, reference = density[band], STORED[f"{case}/density"][band]
    counts = reference > 1e-4 * reference.max(axis=0)
    if case != "sound":
        assert counts.all()
    return float(np.abs(10.0 * np.log10(found / reference))[counts].max())


def displacement_error(case: str, motion: Motion) -> float:
    """Greatest error of any displacement over the greatest swing about the mean."""
    found = np.hstack([motion.inner_displacement, motion.outer_displacement])[::64]
    expected = STORED[f"{case}/displacement"]
    assert len(expected) - 1 <= len(found) <= len(expected)
    expected = expected[: len(found)]
    return float(np.abs(found - expected).max() / np.abs(expected - expected.mean(axis=0)).max())


def test_the_two_families_agree() -> None:
    """Guards against a reference regenerated with a looser tolerance."""
    assert {str(case) for case in STORED["cases"]} == set(CASES)
    for case in CASES:
        displacement, acceleration, decibel = STORED[f"{case}/agreement"]
        assert displacement < 1e-8
        assert acceleration < 1e-6
        assert decibel < 1e-4
        first, second = STORED[f"{case}/events"]
        assert first == second > 100
        assert STORED[f"{case}/scene"][0] == pytest.approx(math.radians(CASES[case]))


@pytest.mark.parametrize("step_rate", [None, RATE])
@pytest.mark.parametrize("case", CASES)
def test_spectra(case: str, step_rate: float | None) -> None:
    """To 0.05 dB at the step that is taken by default, to 0.01 dB at 65,536 steps a second.

    The healthy bearing moves a hundred times less, and the jump at touch counts for more.
    """
    within = 0.1 if case == "sound" else 0.05 if step_rate is None else 0.01
    assert decibels_off(case, motion_of(case, step_rate).outer_acceleration) < within


@pytest.mark.parametrize("case", CASES)
def test_displacements(case: str) -> None:
    assert motion_of(case).dofs == ("x", "y")
    assert displacement_error(case, motion_of(case)) < 1e-3


@pytest.mark.parametrize("case", CASES)
def test_finer_steps_close_in_on_the_reference(case: str) -> None:
    """With order 1, so that 8 times the steps leave an eighth of the error: at most a fifth."""
    fine = simulate(scene_of(case), 1.4, RATE, step_rate=8.0 * RATE)
    assert displacement_error(case, fine) < displacement_error(case, motion_of(case)) / 5.0
    assert displacement_error(case, fine) < 1e-4


@pytest.mark.parametrize("case", CASES)
def test_velocities(case: str) -> None:
    motion = motion_of(case)
    found = np.hstack([motion.inner_velocity, motion.outer_velocity])[::64]
    expected = STORED[f"{case}/velocity"][: len(found)]
    assert np.abs(found - expected).max() / np.abs(expected).max() < 5e-3


@pytest.mark.parametrize("case", DEFECTIVE)
def test_acceleration(case: str) -> None:
    """Typically to 1e-4; a sample within a step of a touch may be off by the jump of the force."""
    found = motion_of(case).outer_acceleration[::16]
    expected = STORED[f"{case}/acceleration"][: len(found)]
    error = np.abs(found - expected).max(axis=1) / np.abs(expected).max()
    assert np.median(error) < 2e-4
    assert np.quantile(error, 0.999) < 1e-2


def test_rest_at_the_static_state_is_where_it_starts() -> None:
    motion = motion_of("12.9deg")
    start = np.hstack([motion.inner_displacement[0], motion.outer_displacement[0]])
    assert start == pytest.approx(STORED["12.9deg/displacement"][0], rel=1e-9, abs=1e-15)
    assert np.abs(motion.inner_velocity[0]).max() < 1e-16  # [m/s]; rounding of smooth variables
    assert np.abs(motion.outer_velocity[0]).max() < 1e-16


@pytest.mark.parametrize(
    ("step_rate", "decibel"), [(4096.0, 15.0), (8192.0, 4.4), (16384.0, 0.25), (32768.0, 0.012)]
)
def test_error_of_the_spectrum_against_the_step(step_rate: float, decibel: float) -> None:
    """The known errors of classical Runge-Kutta, within a factor of 3: no better, no worse."""
    acceleration = motion_of("12.9deg", step_rate).outer_acceleration
    assert decibel / 3.0 < decibels_off("12.9deg", acceleration) < decibel * 3.0


# --- what the paper shows ------------------------------------------------------------------------


def test_levels_are_inside_the_published_axes() -> None:
    """Fig. 10, dB re 1 (m/s²)²/Hz, 0.3 to 2.1 kHz: y −56 to −20, x −66 to −28 were found."""
    for column, (least, greatest) in enumerate([(-80.0, -28.0), (-56.0, -20.0)]):
        levels = []
        for case in DEFECTIVE:
            frequency, density = spectrum(motion_of(case).outer_acceleration, RATE)
            band = (frequency >= 300.0) & (frequency <= 2100.0)
            levels.append(10.0 * np.log10(density[band, column]))
        assert least < np.min(levels)
        assert np.max(levels) < greatest


def test_peaks_of_the_signal_are_the_published_ones() -> None:
    """Fig. 9: about ±4 m/s² vertically; ±0.5 and ±1.5 m/s² horizontally."""
    for case, horizontal in (("12.9deg", 0.5), ("38.6deg", 1.5)):
        x, y = np.abs(motion_of(case).outer_acceleration[round(0.1 * RATE) :]).max(axis=0)
        assert 0.5 * horizontal < x < 2.0 * horizontal
        assert 2.0 < y < 6.0


def centroid(case: str, column: int, least: float, greatest: float) -> tuple[float, float]:
    """Mean frequency [Hz] of a range weighted by density, and its power [(m/s²)²]."""
    frequency, density = spectrum(motion_of(case).outer_acceleration[:, column], RATE)
    inside = (frequency >= least) & (frequency <= greatest)
    power = density[inside].sum()
    return float((frequency[inside] * density[inside]).sum() / power), float(power * 32.0)


@pytest.mark.parametrize(
    ("column", "least", "greatest", "shift"),
    [
        (0, 350.0, 580.0, 10.0),
        (0, 1650.0, 1780.0, 10.0),
        (1, 500.0, 760.0, -40.0),
        (1, 1740.0, 1900.0, -5.0),
    ],
    ids=["x1", "x2", "y1", "y2"],
)
def test_the_larger_defect_shifts_x_up_and_y_down(
    column: int, least: float, greatest: float, shift: float
) -> None:
    """Section 4.4 and Fig. 10: by at least so many Hz, within the bands of each mode."""
    small = centroid("12.9deg", column, least, greatest)[0]
    large = centroid("38.6deg", column, least, greatest)[0]
    assert (large - small) / shift > 1.0


@pytest.mark.parametrize(("least", "greatest"), [(350.0, 580.0), (1650.0, 1780.0)])
def test_the_larger_defect_raises_the_level_in_x(least: float, greatest: float) -> None:
    """Fig. 10a: by more than 10 dB."""
    small = centroid("12.9deg", 0, least, greatest)[1]
    assert centroid("38.6deg", 0, least, greatest)[1] > 10.0 * small
