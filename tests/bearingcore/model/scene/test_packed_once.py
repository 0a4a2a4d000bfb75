"""A scene is packed once: whoever solves it enters `packing` for that and not again."""

import sys
from collections.abc import Callable
from itertools import count
from types import FrameType

import pytest

from bearingcore import Scene, equilibrium, presets, simulate
from bearingcore.model.scene import _packing as packing
from bearingcore.model.statics import ball_positions

NEW_LOAD = count(1)


def new_scene(preset: str, race: str) -> Scene:
    """A scene that nothing was computed of before: no cache knows it."""
    return presets[preset].replace(race=race, extent=0.2, fy=-150.0 - 1e-3 * next(NEW_LOAD))


SCENES = pytest.mark.parametrize(
    ("preset", "race"), [("fan-rig", "outer"), ("liew-lim", "inner")], ids=["outer", "inner"]
)


def entries(call: Callable[[], object]) -> list[str]:
    """Functions of `packing` that are called from another file."""
    names: list[str] = []

    def watch(frame: FrameType, event: str, _: object) -> None:
        here, caller = frame.f_code, frame.f_back
        entered = event == "call" and here.co_filename == packing.__file__
        if entered and caller is not None and caller.f_code.co_filename != here.co_filename:
            names.append(here.co_name)

    sys.setprofile(watch)
    try:
        call()
    finally:
        sys.setprofile(None)
    return names


@SCENES
def test_an_equilibrium_packs_its_scene_once(preset: str, race: str) -> None:
    assert entries(lambda: equilibrium(new_scene(preset, race))) == ["pack"]


@SCENES
@pytest.mark.parametrize("balls", ["massless", "with mass"])
def test_a_simulation_packs_its_scene_once(preset: str, race: str, balls: str) -> None:
    scene = new_scene(preset, race).replace(balls=balls)
    assert entries(lambda: simulate(scene, 0.001)) == ["pack_motion"]


@SCENES
def test_balls_with_mass_are_packed_with_the_scene(preset: str, race: str) -> None:
    assert entries(lambda: ball_positions(new_scene(preset, race))) == ["pack"]
