"""Lengths of spalls from signals of another program, `rigs.py`."""

import math

import numpy as np
import pytest

from bearingcore import Recording, Scene, presets, size_defect
from bearingcore.sizing import Sizing, SizingStatus
from tests.outside.rigs import RATE, RIGS, Machine, record
from tests.outside.witness import witness


def scene_of(machine: Machine) -> Scene:
    """The scene that a person would give for a machine, with a length that is not its own."""
    return presets[machine.rig].replace(
        extent=0.5, depth=RIGS[machine.rig].depth, edge=machine.edge, fy=-machine.load,
        shaft_speed=machine.speed, dofs=("x", "y"),
    )  # fmt: skip


def sized(machine: Machine, scene: Scene | None = None, seed: int = 1) -> Sizing:
    """The answer to 1.5 s of a machine behind noise and tones."""
    recording = Recording(record(machine, 1.5, seed, ("noise",)), RATE)
    return size_defect(recording, scene or scene_of(machine), support_known=True)


def rig(extent_deg: float, name: str = "fan-rig", **differing: object) -> Machine:
    speed, load = (10.0, 100.0) if name == "fan-rig" else (1797 / 60, 1000.0)
    edge = "published" if name == "fan-rig" else "exact"
    return Machine(
        math.radians(extent_deg), 2.0 * math.pi * speed, load, name, edge=edge, **differing
    )


@witness(
    "function: size_defect",
    by="vibration of the fan rig and of a 6205 by the program in `rigs.py`, with noise and tones",
    compared="length, whole ball spacings included: fan rig 12.9, 33 and 38.6°, 6205 a pit of 1.3°",
    within="0.5°",
)  # fmt: skip
@pytest.mark.parametrize(
    "machine",
    [rig(12.9), rig(38.6), rig(33.0), rig(1.3, "6205")],
    ids=["12.9", "38.6", "33", "pit"],
)
def test_lengths_of_spalls(machine: Machine) -> None:
    sizing = sized(machine)
    assert sizing.conclusive, sizing.sentence
    assert math.degrees(sizing.best.extent - machine.extent) == pytest.approx(0.0, abs=0.5)
    assert sizing.best.low <= machine.extent <= sizing.best.high


def test_two_spalls_that_touch_are_one_or_left_open() -> None:
    sizing = sized(rig(8.0, "6205", spalls=2))
    assert math.degrees(sizing.best.extent) == pytest.approx(8.0, abs=1.0) or not sizing.conclusive


def test_a_length_of_a_whole_ball_spacing_is_right_or_left_open() -> None:
    """One ball enters as another leaves: on the fan rig 360°/14."""
    sizing = sized(rig(25.7))
    assert math.degrees(sizing.best.extent) == pytest.approx(25.7, abs=0.5) or not sizing.conclusive


@pytest.mark.parametrize("differing", [{"support": 2.0, "load": 50.0}, {"inner": True}])
def test_another_machine_or_part_is_given_no_length(differing: dict[str, object]) -> None:
    machine = rig(15.0)
    other = Machine(**{**machine.__dict__, **differing})
    assert not sized(other, scene_of(machine)).conclusive


def test_noise_is_given_no_length() -> None:
    machine = rig(15.0)
    noise = np.random.default_rng(2).standard_normal((40_000, 2))
    sizing = size_defect(Recording(noise, RATE), scene_of(machine), support_known=True)
    assert sizing.status == SizingStatus.UNEXPLAINED
    tone = np.sin(2.0 * math.pi * 40.0 * 16 * np.arange(40_000) / RATE)
    sizing = size_defect(
        Recording(noise * 0.1 + tone[:, None], RATE), scene_of(machine), support_known=True
    )
    assert not sizing.conclusive
