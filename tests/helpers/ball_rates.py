"""The equations of motion of balls with mass, compiled, for integrators of other families."""

import numpy as np

from bearingcore.kernels.balls.motion import lay_out, new_ball_steps, rates
from bearingcore.kernels.compiling import compiled


def ball_motion_rates(times, states, start_angle, system):
    """dy/dt (m, size) at times (m,) [s] and states (m, size) of a system in VELOCITIES."""
    work = new_ball_steps(states.shape[1], 1, system.contacts.angle)
    found = np.zeros(states.shape)
    fill_rates(start_angle + system.rotor.cage_speed * times, states, system, found, work)
    return found


@compiled
def fill_rates(angles, states, system, found, work):
    """Body of `ball_motion_rates`."""
    for i in range(angles.size):
        lay_out(angles[i], 0.0, 1, system, work)
        rates(states[i], 0.0, found[i], found[i], 0, system, work)
