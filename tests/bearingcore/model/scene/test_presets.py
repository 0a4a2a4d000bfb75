"""Every preset: what its note says is so, and it can be computed through and through."""

import numpy as np
import pytest

from bearingcore import dynamic_load_rating, limits, preset_notes, presets, simulate

every_preset = pytest.mark.parametrize("name", list(presets))

CATALOGUE = {
    "6205": 14.0e3,
    "6206": 19.5e3,
    "7208-15deg": 38.0e3,
    "7208-25deg": 36.0e3,
    "7208-40deg": 32.0e3,
}
"""Dynamic ratings [N]: 6205 and 6206 as makers print them, 7208 as the notes state them."""


@every_preset
def test_each_preset_has_a_note_and_a_name_for_addresses(name: str) -> None:
    assert set(preset_notes) == set(presets)
    assert "Assumed" in preset_notes[name]
    assert name.replace("-", "").isalnum()
    assert name == name.lower()


@every_preset
def test_each_preset_moves(name: str) -> None:
    """Motion runs to its end, and the defect is felt in it."""
    motion = simulate(presets[name], duration=0.25)
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


@pytest.mark.parametrize("name", list(CATALOGUE))
def test_catalogue_bearings_keep_inside_the_model(name: str) -> None:
    scene = presets[name]
    step_rate = simulate(scene, duration=0.01).step_rate
    crossed = [limit.sentence for limit in limits(scene, step_rate=step_rate) if limit.crossed]
    assert crossed == []
