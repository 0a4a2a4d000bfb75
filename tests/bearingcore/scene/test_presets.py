"""Every preset: what its note says is so, and it can be computed through and through."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore import (
    Scene,
    dynamic_load_rating,
    equilibrium,
    limits,
    modes,
    preset_notes,
    presets,
    simulate,
)
from bearingcore.scene.scene import DOF_NAMES

every_preset = pytest.mark.parametrize("name", list(presets))
TURN = np.linspace(0.0, 2.0 * math.pi, 361)

CATALOGUE = {
    "6205": 14.0e3,
    "6206": 19.5e3,
    "7208-15deg": 38.0e3,
    "7208-25deg": 36.0e3,
    "7208-40deg": 32.0e3,
}
"""Dynamic ratings [N]: 6205 and 6206 as makers print them, 7208 as the notes state them."""


def equivalent_load(scene: Scene) -> float:
    """Dynamic equivalent load X F_r + Y F_a [N] of a single row by ISO 281, α0 = 15, 25, 40°.

    X and Y at 15° are for F_a below 0.03 of the static rating.
    """
    radial = math.hypot(scene.load.fx, scene.load.fy)
    axial = abs(scene.load.fz)
    if axial == 0.0:
        return radial
    e, X, Y = {15: (0.40, 0.44, 1.40), 25: (0.68, 0.41, 0.87), 40: (1.14, 0.35, 0.57)}[
        round(math.degrees(scene.bearing.contact_angle))
    ]
    return X * radial + Y * axial if axial > e * radial else radial


@every_preset
def test_each_preset_has_a_note_and_a_name_for_addresses(name: str) -> None:
    assert set(preset_notes) == set(presets)
    assert "Assumed" in preset_notes[name]
    assert name.replace("-", "").isalnum()
    assert name == name.lower()


@every_preset
def test_each_preset_stands_at_every_cage_angle(name: str) -> None:
    state = equilibrium(presets[name], TURN)
    assert state.converged.all()
    assert state.residual.max() < 1e-9
    assert np.isfinite(state.stiffness).all()
    active = [DOF_NAMES.index(dof) for dof in state.dofs]
    inside = state.stiffness[:, active][:, :, active]
    assert np.linalg.eigvalsh(inside).min() > 0.0


@every_preset
def test_each_preset_has_damped_modes(name: str) -> None:
    found = modes(presets[name])
    assert np.isfinite(found.frequency).all()
    assert found.frequency.min() > 10.0
    assert found.damping_ratio.min() > 0.0
    assert found.damping_ratio.max() < 1.0


@every_preset
def test_each_preset_moves(name: str) -> None:
    """Motion runs to its end, and the defect is felt in it."""
    motion = simulate(presets[name], duration=0.25, ball_loads=True)
    assert motion.completed, motion.status
    assert np.isfinite(motion.outer_acceleration).all()
    late = motion.time > 0.15
    vertical = motion.outer_acceleration[late, 1]
    quiet = simulate(presets[name].healthy(), duration=0.25).outer_acceleration[late, 1]
    assert vertical.std() > 2.0 * quiet.std()
    assert np.abs(vertical).max() < 2000.0  # m/s²


@pytest.mark.parametrize("name", list(CATALOGUE))
def test_inside_dimensions_give_the_catalogue_rating(name: str) -> None:
    """Catalogues print ratings, not balls: the balls assumed must give the rating printed."""
    assert dynamic_load_rating(presets[name].bearing) == pytest.approx(CATALOGUE[name], rel=0.02)


@pytest.mark.parametrize("name", [*CATALOGUE, "seven-ball"])
def test_loads_are_5_to_10_percent_of_the_dynamic_rating(name: str) -> None:
    share = equivalent_load(presets[name]) / dynamic_load_rating(presets[name].bearing)
    assert 0.044 <= share <= 0.10


@pytest.mark.parametrize("name", list(CATALOGUE))
def test_catalogue_bearings_keep_inside_the_model(name: str) -> None:
    scene = presets[name]
    step_rate = simulate(scene, duration=0.01).step_rate
    crossed = [limit.sentence for limit in limits(scene, step_rate=step_rate) if limit.crossed]
    assert crossed == []


def test_6205_has_the_published_frequencies_of_the_case_western_bearing() -> None:
    """Multiples of the shaft's frequency, published with the data to five figures."""
    scene = presets["6205"]
    shaft = scene.shaft_speed / (2.0 * math.pi)
    bearing = scene.bearing
    assert bearing.bpfo(scene.shaft_speed) / shaft == pytest.approx(3.5848, abs=1e-4)
    assert bearing.bpfi(scene.shaft_speed) / shaft == pytest.approx(5.4152, abs=1e-4)
    assert bearing.ftf(scene.shaft_speed) / shaft == pytest.approx(0.39828, abs=5e-5)
    assert 2.0 * bearing.bsf(scene.shaft_speed) / shaft == pytest.approx(4.7135, abs=1e-3)


@pytest.mark.parametrize(("name", "angle_deg"), [("15", 15.0), ("25", 25.0), ("40", 40.0)])
def test_7208_has_its_contact_angle(name: str, angle_deg: float) -> None:
    bearing = presets[f"7208-{name}deg"].bearing
    assert math.degrees(bearing.free_contact_angle) == pytest.approx(angle_deg)


def test_the_steeper_the_contact_the_stiffer_along_the_shaft() -> None:
    """At the same load, 7208 at 15°, 25°, 40°: k_zz rises, k_yy falls."""
    state = [
        equilibrium(presets[f"7208-{angle}deg"].healthy().replace(fy=-500.0, fz=2000.0))
        for angle in (15, 25, 40)
    ]
    axial = [each.term("k_zz").mean() for each in state]
    radial = [each.term("k_yy").mean() for each in state]
    assert axial == sorted(axial)
    assert radial == sorted(radial, reverse=True)


def test_a_name_that_no_preset_has_is_answered_with_those_there_are() -> None:
    with pytest.raises(KeyError) as found:
        presets["foo"]
    assert all(name in str(found.value) for name in ("foo", *presets))
    assert "foo" not in presets
    assert presets.get("foo") is None
