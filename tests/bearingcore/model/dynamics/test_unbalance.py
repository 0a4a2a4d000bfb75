"""A force that turns with the shaft, against a linear oscillator and an independent integrator."""

import math

import numpy as np
import pytest

from bearingcore import Defect, Scene, contact_damping, equilibrium, presets, simulate

SAMPLE_RATE = 65536.0
SPEED = 2.0 * math.pi * 100.0


def pushed_along_the_shaft() -> Scene:
    """An angular contact bearing whose balls are loaded alike: one stiffness whatever the angle."""
    return presets["7208-25deg"].replace(
        fx=0.0, fy=0.0, fz=2000.0, defect=Defect.none(), dofs=("x", "y", "z"), shaft_speed=SPEED
    )


def linear_response(scene: Scene) -> complex:
    """Amplitude x + iy [m] of the housing at the shaft's speed, two bodies on springs.

    The dampers of the contacts turn with the cage: seen from there the rings turn at ω_s − ω_c.
    """
    state = equilibrium(scene, [0.0])
    carried = scene.bearing.n_balls * math.cos(float(state.contact_angle[0, 0])) ** 2 / 2.0
    damping = contact_damping(scene) * carried
    contact = state.term("k_xx")[0] + 1j * damping * (SPEED - scene.cage_speed)
    support = scene.support
    ground = support.stiffness_x + 1j * SPEED * support.damping_x - support.outer_mass * SPEED**2
    matrix = np.array(
        [[contact - support.inner_mass * SPEED**2, -contact], [-contact, contact + ground]]
    )
    return complex(np.linalg.solve(matrix, [scene.unbalance * SPEED**2, 0.0])[1])


@pytest.mark.parametrize("balls", ["massless", "with mass"])
def test_a_small_unbalance_moves_the_housing_as_a_linear_oscillator(balls: str) -> None:
    scene = pushed_along_the_shaft().replace(unbalance=2e-6, balls=balls)
    duration = 0.25
    shaken, still = (
        simulate(scene.replace(unbalance=unbalance), duration, SAMPLE_RATE)
        for unbalance in (scene.unbalance, 0.0)
    )
    x, y = (shaken.outer_displacement - still.outer_displacement)[:, :2].T
    late = shaken.time >= duration - 10.0 * 2.0 * math.pi / SPEED  # whole turns
    amplitude = np.mean(((x + 1j * y) * np.exp(-1j * SPEED * shaken.time))[late])
    assert amplitude == pytest.approx(linear_response(scene), rel=1e-2 if "with" in balls else 1e-3)
