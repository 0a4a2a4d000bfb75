"""Motion with tilt, axial motion, inner-race defects and contacts that cannot pull.

Against a reference on which two families of integrators agree, see tests/reference/README.md.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bearingcore import Bearing, Defect, Load, Motion, Scene, Support, simulate

RATE = 65536.0
STORED = np.load(Path(__file__).parents[2] / "reference" / "general_motion_reference.npz")
CASES = [str(name) for name in STORED["cases"]]

every_case = pytest.mark.parametrize("name", CASES)


def stored_scene(name: str) -> dict[str, Any]:
    """What went into the reference."""
    return dict(json.loads(str(STORED[f"{name}/scene"])))


@cache
def motion_of(name: str, times: int) -> Motion:
    """The case with so many times 65,536 steps a second."""
    case = stored_scene(name)
    scene = Scene(
        bearing=Bearing(**case["bearing"]),
        defect=Defect(**case["defect"]),
        load=Load(**case["load"]),
        shaft_speed=case["shaft_speed"],
        support=Support(**case["support"]),
        contact_damping=case["contact_damping"],
        contact_law=case["contact_law"],
        dofs=tuple(case["dofs"]),
    )
    return simulate(scene, case["duration"], RATE, step_rate=times * RATE)


def levers(name: str) -> np.ndarray:
    """What makes rotations comparable with displacements [m], for both bodies."""
    case = stored_scene(name)
    arm = case["bearing"]["groove_center_radius"]
    return np.tile([arm if dof.startswith("r") else 1.0 for dof in case["dofs"]], 2)


def error(name: str, found: np.ndarray, what: str) -> float:
    """Greatest error over the greatest swing about the mean."""
    expected = STORED[f"{name}/{what}"]
    found = found[::32]
    assert len(expected) - 1 <= len(found) <= len(expected)
    unit = levers(name)[: expected.shape[1]]
    expected = expected[: len(found)]
    swing = np.abs((expected - expected.mean(axis=0)) * unit).max()
    return float(np.abs((found - expected) * unit).max() / swing)


def displacement_error(name: str, times: int) -> float:
    """Of all free directions of both rings."""
    motion = motion_of(name, times)
    found = np.hstack([motion.inner_displacement, motion.outer_displacement])
    return error(name, found, "displacement")


@every_case
def test_the_two_families_agree(name: str) -> None:
    """Guards against a reference regenerated with a looser tolerance."""
    displacement, acceleration, decibel = STORED[f"{name}/agreement"]
    assert displacement < 1e-9
    assert acceleration < 1e-8
    assert decibel < 1e-6
    first, second = STORED[f"{name}/events"]
    assert first == second > 40


@every_case
def test_start(name: str) -> None:
    motion = motion_of(name, 1)
    assert motion.dofs == tuple(stored_scene(name)["dofs"])
    found = np.hstack([motion.inner_displacement[0], motion.outer_displacement[0]])
    assert found == pytest.approx(STORED[f"{name}/displacement"][0], rel=1e-9, abs=1e-15)


@every_case
def test_displacements(name: str) -> None:
    """To 6e-3 at 65,536 steps a second: order 1, as damping switches when a ball touches."""
    assert displacement_error(name, 1) < 6e-3


@every_case
def test_finer_steps_close_in_on_the_reference(name: str) -> None:
    """An eighth of the step leaves at most a fifth of the error, and no more than 1e-3."""
    assert displacement_error(name, 8) < displacement_error(name, 1) / 5.0
    assert displacement_error(name, 8) < 1e-3


@every_case
def test_velocities_and_acceleration(name: str) -> None:
    motion = motion_of(name, 8)
    velocity = np.hstack([motion.inner_velocity, motion.outer_velocity])
    assert error(name, velocity, "velocity") < 2e-3
    expected = STORED[f"{name}/acceleration"]
    found = motion.outer_acceleration[::32]
    unit = levers(name)[: expected.shape[1]]
    expected = expected[: len(found)]
    off = np.abs((found - expected) * unit).max(axis=1) / np.abs(expected * unit).max()
    # A sample within a step of a touch may be off by the jump of the force.
    assert np.median(off) < 1e-4
    assert np.quantile(off, 0.99) < 2e-3
