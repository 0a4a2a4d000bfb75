"""Balls with mass in a session: compiled before they move, coarse first, then compared."""

import dataclasses

import pytest
from bearing_explorer.explorer.results.ball_mass import entry_of, exit_of
from bearing_explorer.explorer.results.motions import motion, quick_duration
from bearing_explorer.explorer.results.results import Results

from bearingcore import presets
from bearingcore.model.scene import is_planar

FAN_RIG = presets["fan-rig"]


def test_a_motion_that_was_compared_is_not_moved_again() -> None:
    """The tab of the mass and the vibration of a scene with it share one motion."""
    coarse = Results(FAN_RIG.replace(balls="with mass"), moving=True)
    again = Results(FAN_RIG.replace(balls="with mass"), moving=True).ball_mass
    assert coarse.ball_mass is again
    assert Results(FAN_RIG, moving=True).ball_mass is again, "whatever the scene's own choice"


@pytest.mark.parametrize("name", [n for n in presets if not presets[n].bearing.kind.mass_unknown])
def test_the_first_picture_is_short_and_shows_a_ball_on_its_way_through(name: str) -> None:
    """Counted, not timed: contacts that are stepped; a general one costs four flat ones."""
    scene = presets[name].replace(balls="with mass")
    moving = Results(scene, moving=True)
    how = moving.settings.coarse_marching
    if moving.is_coarse(frozenset({"ball_mass"})):
        duration = quick_duration(scene, how)
        ball_mass = moving.ball_mass
        run, _ = motion(scene, dataclasses.replace(how, duration=duration))
        assert len(run.time) == round(duration * how.sample_rate)
        cost = duration * run.step_rate * scene.bearing.total_balls
        assert cost * (1.0 if is_planar(scene) else 4.0) < 2.1e6
        assert entry_of(ball_mass.events) is not None
        if all(defect.extent < 0.35 * scene.bearing.ball_spacing for defect in scene.defects):
            assert exit_of(ball_mass.events) is not None  # else it is a longer way than is shown
        assert not ball_mass.broke_off


def test_a_bearing_whose_balls_have_no_mass_says_so() -> None:
    results = Results(presets["30206-back-to-back"], moving=True)
    with pytest.raises(ValueError, match="a rib holds them"):
        _ = results.ball_mass
