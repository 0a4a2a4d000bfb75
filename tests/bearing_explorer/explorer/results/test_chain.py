"""A few numbers a link, held against the core."""

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results

from bearingcore import equilibrium, modes, presets, simulate, spectrum

FAN_RIG = presets["fan-rig"]
LONGER = FAN_RIG.replace(extent=FAN_RIG.defect.extent + FAN_RIG.bearing.ball_spacing)


@pytest.mark.parametrize("scene", [FAN_RIG, LONGER], ids=["as it is", "longer"])
def test_the_numbers_are_those_of_the_core(scene) -> None:
    chain = Results(scene).chain
    angles = np.linspace(0.0, scene.bearing.ball_spacing, 20_001)[:-1]  # a mean of its own
    state = equilibrium(scene, angles)
    assert chain.stiffness["k_yy"] == pytest.approx(state.term("k_yy").mean(), rel=5e-3)
    assert chain.stiffness["k_xx"] == pytest.approx(state.term("k_xx").mean(), rel=5e-3)
    assert chain.loaded_balls == pytest.approx(state.loaded_balls.mean(), rel=5e-3)
    assert chain.greatest_load == pytest.approx(state.ball_load.max(), rel=5e-3)
    for label, band in modes(scene, angles).bands().items():
        assert chain.bands[label] == pytest.approx(band, rel=5e-3)
    motion = simulate(scene, 1.4, 65536.0, step_rate=2 * 65536.0)  # finer than the page's own
    late = motion.outer_acceleration[motion.time.size // 2 :]
    frequency, density = spectrum(late, motion.sample_rate)
    heard = (frequency >= 100.0) & (frequency <= 2500.0)
    for i, dof in enumerate(motion.dofs):
        line = np.argmax(np.where(heard, density[:, i], 0.0))
        assert chain.peaks[dof].frequency == frequency[line]
        assert chain.peaks[dof].level == pytest.approx(10 * np.log10(density[line, i]), abs=0.2)
    assert chain.loudest == "y"
    assert not chain.silent


def test_what_is_missing_is_said() -> None:
    still = Results(FAN_RIG.replace(shaft_speed=0.0)).chain
    assert (still.peaks, still.silent) == ({}, "nothing turns")
    assert still.bands
    nothing = Results(FAN_RIG.replace(fy=0.0)).chain
    assert nothing.answered == 0.0
    assert "nothing touches" in nothing.reason
    unknown = Results(presets["6205"].replace(fz=100.0, stiffness_z=None)).chain
    assert not unknown.bands
    assert "stiffness_z" in unknown.silent
