"""The spectra of the paper's rig meet a reference on which two families of integrators agree."""

from pathlib import Path

import numpy as np
import pytest

from bearingcore import presets, simulate, spectrum

RATE = 65536.0
PAPER = np.load(Path(__file__).parents[3] / "reference" / "motion_reference.npz")


def decibels_off(case: str, acceleration: np.ndarray) -> float:
    """Greatest error of the spectra in x and y over 0.3 to 2.1 kHz [dB].

    Frequencies at which a direction is 40 dB below its greatest level carry nothing and are left
    out; that concerns a few of the healthy bearing's, at −115 dB, and none of the defective one's.
    """
    frequency, density = spectrum(acceleration, RATE)
    assert frequency == pytest.approx(PAPER["frequency"])
    band = (frequency >= 300.0) & (frequency <= 2100.0)
    actual, reference = density[band], PAPER[f"{case}/density"][band]
    counts = reference > 1e-4 * reference.max(axis=0)
    if case != "sound":
        assert counts.all()
    return float(np.abs(10.0 * np.log10(actual / reference))[counts].max())


@pytest.mark.parametrize("step_rate", [None, RATE])
@pytest.mark.parametrize("case", ["sound", "12.9deg", "38.6deg"])
def test_spectra(case: str, step_rate: float | None) -> None:
    """To 0.05 dB at the step that is taken by default, to 0.01 dB at 65,536 steps a second.

    The healthy bearing moves a hundred times less, and the jump at touch counts for more.
    """
    extent, depth, damping, _ = PAPER[f"{case}/scene"].tolist()
    scene = presets["fan-rig"].replace(contact_damping=damping, extent=extent, depth=depth)
    motion = simulate(scene, 1.4, RATE, step_rate=step_rate)
    within = 0.1 if case == "sound" else 0.05 if step_rate is None else 0.01
    assert decibels_off(case, motion.outer_acceleration) < within
