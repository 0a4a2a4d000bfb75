"""Each answer is computed once, whoever asks."""

import math

import numpy as np
import pytest
from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.plots.spectra import levels_of_compared
from bearing_explorer.explorer.results.motions import MOST_STEPS, SHORTEST
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import Reference
from bearing_explorer.explorer.views.mass_time import MassInTime
from bearing_explorer.explorer.views.overview.spectrum import OverviewSpectrum
from bearing_explorer.explorer.views.vibration_time import VibrationInTime
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View

from bearingcore import equilibrium, presets


def test_equal_scenes_share_their_answers() -> None:
    scene = presets["fan-rig"]
    one, two = Results(scene), Results(scene.replace(fy=scene.load.fy))
    assert one.equilibrium is two.equilibrium
    assert one.reference.equilibrium is Results(scene.replace(extent=0.5)).reference.equilibrium


def test_a_motion_that_takes_too_many_steps_is_shorter_or_refused() -> None:
    fast = presets["fan-rig"].replace(race="inner", extent=math.radians(0.2), shaft_speed=600.0)
    motion = Results(fast).motion
    assert motion.time.size * motion.step_rate / motion.sample_rate <= 1.001 * MOST_STEPS
    assert SHORTEST <= motion.time[-1] < 1.4
    with pytest.raises(ValueError, match="steps a second"):
        _ = Results(fast.replace(extent=1e-5)).motion
    usual = Results(presets["fan-rig"]).motion
    assert usual.time[-1] == pytest.approx(1.4, rel=1e-3)


def test_compared_scenes_have_results_of_their_own() -> None:
    scene, other = presets["fan-rig"], presets["liew-lim"].replace(n_balls=9)
    results = Results(scene, 0.1, compared=[Reference(other, "mine")])
    first, last, n = results.stretch
    angles = np.linspace(first, last, n)
    state = results.against(results.compared[0]).equilibrium
    np.testing.assert_array_equal(state.term("k_yy"), equilibrium(other, angles).term("k_yy"))
    (own,) = results.compared_results
    assert own.equilibrium.cage_angles[-1] == pytest.approx(2.0 * np.pi / 9)
    assert Results(scene, 0.1).compared_results == []


def test_curves_of_a_compared_scene_are_those_that_it_has_alone() -> None:
    scene, other = presets["fan-rig"], presets["fan-rig"].replace(extent=0.1)
    view = MassInTime(PackedSource())
    both, _ = view.data(Results(scene, compared=[Reference(other, "shorter")]))
    alone, _ = MassInTime(PackedSource()).data(Results(other))
    for column, values in both["mass_motion_compared_0"].items():
        assert values.size
        np.testing.assert_array_equal(values, alone["mass_motion"][column])
    assert not np.array_equal(both["mass_motion"]["y"], both["mass_motion_compared_0"]["y"])


def test_a_compared_scene_without_a_motion_has_no_curve_and_the_others_have_theirs() -> None:
    still = presets["liew-lim"].replace(stiffness_z=None)
    shorter = presets["fan-rig"].replace(extent=0.1)
    results = Results(
        presets["fan-rig"], compared=[Reference(still, "still"), Reference(shorter, "shorter")]
    )
    drawn = levels_of_compared("here", results, 2000.0)
    sizes = [curve["x"].size for curve in drawn.values()]
    assert sizes[0] == sizes[2] == sizes[3] == 0
    assert np.isfinite(list(drawn.values())[1]["y"]).all()
    assert sizes[1]


@pytest.mark.parametrize("name", ["fan-rig", "liew-lim", "6205"])
def test_bands_of_frequencies_are_looked_at_coarsely_while_a_hand_moves(name: str) -> None:
    scene = presets[name].replace(extent=math.radians(38.0))
    moving, rested = Results(scene, moving=True), Results(scene)
    assert moving.modes.cage_angles.size < 0.5 * rested.modes.cage_angles.size
    for label, band in moving.bands.items():
        assert band == pytest.approx(rested.bands[label], rel=0.03)


def test_curves_have_a_fixed_number_of_cage_angles() -> None:
    scene = presets["nu208"]  # which can only move in some directions
    for moving, n in ((True, 121), (False, 361)):
        assert Results(scene, moving=moving).equilibrium.cage_angles.size == n
    turning = Results(scene.replace(race="inner"))
    assert turning.equilibrium.cage_angles.size == 8 * 120 + 1


@pytest.mark.parametrize("kind", [OverviewSpectrum, VibrationInTime])
def test_of_two_curves_of_a_compared_scene_one_is_thin_and_the_key_says_so(
    kind: type[View],
) -> None:
    several = 0
    for plot in kind(PackedSource()).figures:
        lines = [
            renderer.glyph.line_width
            for renderer in plot.renderers
            if str(renderer.data_source.name).endswith("_compared_0")
        ]
        several += len(lines) > 1
        assert len(set(lines)) == len(lines)
        assert (compared_curves.THIN in plot.tags) == (len(lines) > 1)
    assert several == 1
