"""What two scenes differ in, in words."""

import pytest
from bearing_explorer.explorer.state.difference import difference, distinct_name
from bearing_explorer.explorer.state.history import LastState

from bearingcore import Defect, presets

SCENE = presets["fan-rig"]
SPACING = SCENE.bearing.ball_spacing
TWO = SCENE.replace(defect=(Defect(0.2, 1e-5, 4.7), Defect(0.1, 2e-5, 1.0)))


@pytest.mark.parametrize(
    ("now", "before", "words"),
    [
        (SCENE.replace(extent=SCENE.defect.extent + SPACING), SCENE,
         "Defect longer by one ball spacing (12.9 → 38.61°)"),
        (SCENE, SCENE.replace(extent=SCENE.defect.extent + 2 * SPACING),
         "Defect shorter by 2 ball spacings (64.33 → 12.9°)"),
        (SCENE.replace(fy=-120.0), SCENE, "Load, downwards (100 → 120 N)"),
        (SCENE.replace(fy=-100.01), SCENE, "Load, downwards (100 → 100.01 N)"),
        (SCENE.replace(fy=-1e6), SCENE, "Load, downwards (100 → 1000000 N)"),
        (SCENE.replace(fy=-120.0, depth=8e-5), SCENE,
         "Depth (50 → 80 µm), load, downwards (100 → 120 N)"),
        (SCENE.healthy(), SCENE, "Without the defect"),
        (TWO, SCENE, "A defect more"),
        (presets["6205"], SCENE, "Another bearing"),
        (SCENE.replace(fx=1.0, fy=-2.0, fz=3.0, depth=8e-5), SCENE, "Several changes at once"),
        (TWO.replace(defect=(TWO.defects[0], Defect(0.1, 9e-5, 1.0))), TWO,
         "Another defect has changed"),
        (SCENE.replace(dofs=("y",)), SCENE, "Other free directions"),
    ],
)  # fmt: skip
def test_what_has_changed(now, before, words: str) -> None:
    assert difference(now, before) == words


LOADED, FAST = SCENE.replace(fy=-200.0), SCENE.replace(shaft_speed=SCENE.shaft_speed * 2.0)


@pytest.mark.parametrize(
    ("scene", "others", "name"),
    [
        (SCENE, [SCENE], "12.9°, 50 µm"),
        (SCENE, [LOADED], "100 N"),
        (SCENE, [SCENE.replace(fx=30.0)], "100 N at 270°"),
        (FAST, [SCENE, LOADED], "14 Hz, 100 N"),
        (SCENE.replace(race="inner"), [SCENE], "inner"),
        (SCENE.healthy(), [SCENE], "no defect"),
        (SCENE, [SCENE.replace(center=1.0, extent=0.1)], "12.9°, 50 µm, centre 270°"),
    ],
)
def test_a_scene_is_named_by_what_differs(scene, others, name: str) -> None:
    assert distinct_name(scene, others) == name


def test_the_scene_before_a_drag_is_where_it_began() -> None:
    last = LastState(SCENE)
    steps = [SCENE.replace(depth=depth) for depth in (6e-5, 7e-5, 8e-5)]
    last.follow(SCENE, moving=False)
    assert last.before is None
    for scene in steps:
        last.follow(scene, moving=True)
        assert last.before == SCENE
    last.follow(steps[-1], moving=False)
    assert last.before == SCENE, "until the next change begins"
    last.follow(steps[-1], moving=True)  # the bearing turns: no change of the scene
    assert last.before == SCENE
    other = steps[-1].replace(fy=-5.0)
    last.follow(other, moving=True)
    assert last.before == steps[-1]
    last.follow(other, moving=False)
    last.follow(SCENE, moving=False)  # at once, as an undo is
    assert last.before == other
