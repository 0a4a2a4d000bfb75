"""Motions meet a reference on which two families of integrators agree: tests/reference/README.md.

They are the paper's rig, and scenes with tilt, axial motion, inner-race defects and contacts that
cannot pull. Where touching switches the damping, a fixed step has order 1 in the state, whatever
the method: tolerances are those of steps of 1/65,536 s, as an independent Runge-Kutta march in
plain C has them too, and finer steps close in on the reference.
"""

import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from bearingcore import Bearing, Defect, Load, Motion, Scene, Support, presets, simulate

RATE = 65536.0
REFERENCE = Path(__file__).parents[2] / "reference"
PAPER, GENERAL = (
    np.load(REFERENCE / f"{name}.npz") for name in ("motion_reference", "general_motion_reference")
)
RIG = {"sound": 0.0, "12.9deg": 12.9, "38.6deg": 38.6}
"""Cases of the paper's rig, and their extents [deg]."""

every_case = pytest.mark.parametrize("name", [*RIG, *(str(name) for name in GENERAL["cases"])])


def stored(name: str, what: str) -> np.ndarray:
    """Numbers of a case."""
    return np.asarray((PAPER if name in RIG else GENERAL)[f"{name}/{what}"])


def scene_of(name: str) -> Scene:
    """The case's scene."""
    if name in RIG:
        extent, depth, damping, _ = stored(name, "scene").tolist()
        scene = presets["fan-rig"].replace(contact_damping=damping)
        return scene.replace(extent=extent, depth=depth) if extent else scene.healthy()
    case = json.loads(str(stored(name, "scene")))
    return Scene(
        bearing=Bearing(**case["bearing"]),
        defect=Defect(**case["defect"]),
        load=Load(**case["load"]),
        shaft_speed=case["shaft_speed"],
        support=Support(**case["support"]),
        contact_damping=case["contact_damping"],
        contact_law=case["contact_law"],
        dofs=tuple(case["dofs"]),
    )


@cache
def motion_of(name: str, step_rate: float | None) -> Motion:
    """The case at 65,536 samples and so many steps a second, over 1.4 s of the rig."""
    duration = 1.4 if name in RIG else json.loads(str(stored(name, "scene")))["duration"]
    return simulate(scene_of(name), duration, RATE, step_rate=step_rate)


def compared(name: str, found: np.ndarray, what: str) -> tuple[np.ndarray, np.ndarray]:
    """Samples that are stored, found and expected; rotations times r_d [m]."""
    expected = stored(name, what)
    every = 32 if name not in RIG else 16 if what == "acceleration" else 64
    found = found[::every]
    assert len(expected) - 1 <= len(found) <= len(expected)
    arm = scene_of(name).bearing.groove_center_radius
    unit = [arm if dof.startswith("r") else 1.0 for dof in scene_of(name).active_dofs]
    units = np.tile(unit, expected.shape[1] // len(unit))
    return found * units, expected[: len(found)] * units


def error(name: str, inner: np.ndarray, outer: np.ndarray, what: str) -> float:
    """Greatest error of both rings over the greatest swing about the mean."""
    found, expected = compared(name, np.hstack([inner, outer]), what)
    swing = np.abs(expected - expected.mean(axis=0)).max()
    return float(np.abs(found - expected).max() / swing)


def displacement_error(name: str, times: int) -> float:
    """Of all free directions, with so many times 65,536 steps a second."""
    motion = motion_of(name, times * RATE)
    return error(name, motion.inner_displacement, motion.outer_displacement, "displacement")


@every_case
def test_the_two_families_agree(name: str) -> None:
    """Guards against a reference regenerated with a looser tolerance."""
    agreement = stored(name, "agreement")
    assert np.all(agreement < ([1e-8, 1e-6, 1e-4] if name in RIG else [1e-9, 1e-8, 1e-6]))
    first, second = stored(name, "events")
    assert first == second > (100 if name in RIG else 40)
    if name in RIG:
        assert stored(name, "scene")[0] == pytest.approx(math.radians(RIG[name]))


@every_case
def test_start(name: str) -> None:
    """At rest in the static state."""
    motion = motion_of(name, RATE)
    found = np.hstack([motion.inner_displacement[0], motion.outer_displacement[0]])
    assert found == pytest.approx(stored(name, "displacement")[0], rel=1e-9, abs=1e-15)
    for velocity in (motion.inner_velocity[0], motion.outer_velocity[0]):
        assert np.abs(velocity).max() < 1e-16  # [m/s]; rounding of smooth variables


@every_case
def test_finer_steps_close_in_on_the_reference(name: str) -> None:
    """An eighth of the step leaves at most a fifth of the error."""
    coarse, fine = displacement_error(name, 1), displacement_error(name, 8)
    assert coarse < (1e-3 if name in RIG else 6e-3)
    assert fine < coarse / 5.0
    assert fine < (1e-4 if name in RIG else 1e-3)


@every_case
def test_velocities_and_acceleration(name: str) -> None:
    motion = motion_of(name, 8 * RATE)
    assert error(name, motion.inner_velocity, motion.outer_velocity, "velocity") < 2e-3
    found, expected = compared(name, motion.instant_acceleration("outer"), "acceleration")
    off = np.abs(found - expected).max(axis=1) / np.abs(expected).max()
    # A sample within a step of a touch may be off by the jump of the force.
    assert np.median(off) < 1e-4
    assert np.quantile(off, 0.99) < 2e-3
