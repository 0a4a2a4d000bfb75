"""The compiled equations of motion against the independent contact law, every kind of bearing."""

import numpy as np
import pytest

from bearingcore import Defect, RoughFloor, Scene, presets
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene import _packing as packing
from tests.bearingcore.bearings.test_unlike_rows import BALLS
from tests.helpers.contact_law import motion_rates

FAN_RIG, LIEW_LIM = presets["fan-rig"], presets["liew-lim"]
DAMPING = 122.0

SCENES: dict[str, Scene] = {
    "planar": FAN_RIG,
    "five directions": LIEW_LIM,
    "inner race": LIEW_LIM.replace(race="inner", edge="exact"),
    "rough floor": LIEW_LIM.replace(
        floor=RoughFloor(rms_height=5e-6, correlation_length=3e-4, seed=3)
    ),
    "both races": FAN_RIG.replace(
        defect=(FAN_RIG.defects[0], Defect(0.2, 3e-5, 5.6, "inner", "exact"))
    ),
    "chord": FAN_RIG.replace(edge="chord"),
    "no tension": LIEW_LIM.replace(contact_law="no tension"),
    "three directions": LIEW_LIM.replace(dofs=("x", "y", "z")),
    "rollers": presets["nu208"],
    "tapered rollers": presets["30206-back-to-back"],
    "back to back": presets["7208-back-to-back"].replace(row=1, extent=0.25),
    "face to face": presets["7208-face-to-face"].replace(row=0, extent=0.25),
    "self-aligning": presets["1208"],
    "unlike rows, outer race": BALLS.replace(row=None, extent=0.25),
    "unlike rows, inner race": BALLS.replace(row=None, extent=0.25, race="inner", edge="exact"),
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_rates_are_those_of_the_law(scene: Scene) -> None:
    dofs = scene.active_dofs
    system = kernels.System(
        packing.rotor(scene, dofs, DAMPING)._replace(variables=kernels.VELOCITIES),
        packing.contacts(scene.bearing),
        packing.path(scene),
    )
    n = len(dofs)
    random = np.random.default_rng(1)
    pushed = 0
    for t in np.linspace(0.0, 0.03, 12):
        y = np.concatenate([random.normal(0.0, size, n) for size in (2e-5, 1e-3, 2e-6, 1e-3)])
        rates = kernels.motion_rates(np.array([t]), y[None], 0.0, system)[0]
        expected = motion_rates(scene, DAMPING, float(t), y)
        free = system.rotor.force * system.rotor.inverse_inner
        pushed += bool(np.any(expected[n : 2 * n] != free))
        scale = np.abs(expected).reshape(4, n).max(axis=1).repeat(n)
        assert np.abs((rates - expected) / scale).max() < 1e-6
    assert pushed > 6
