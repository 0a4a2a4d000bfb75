"""Step rate of a motion."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.common import _checks as checks
from bearingcore.model.dynamics._ball_motion import STABLE_DECAY, ball_step_rate
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.dynamics._force import peak_force
from bearingcore.model.dynamics._modes import highest_frequency_of
from bearingcore.model.scene import WITH_MASS, PackedMotion, Scene
from bearingcore.model.scene._packing import pack
from bearingcore.model.statics._passes import STEPS_A_PASSAGE, shortest_passage

STEPS_A_CYCLE = 16.0
"""Default number of steps in a period of the highest natural frequency. Accuracy needs so many;
steps are stable down to 2.2. On the fan rig 16 leave an error of the spectrum near 0.02 dB, 8 leave
0.25 dB. On the Liew-Lim bearing, in five directions, 13 leave 0.05 dB up to 2.1 kHz and 0.11 dB
beyond, 26 leave 0.005 dB."""

LEAST_STEPS_A_SAMPLE = 0.45
"""Least number of steps per sample, also for slow modes, as contacts that open and close vibrate
faster. A heavy rotor on few balls had an error of 4 dB with an eighth. Rounding to a whole fraction
makes it a half, or a quarter if a `part` just over a half is requested."""


def default_step_rate(scene: Scene, sample_rate: float, part: float = 1.0) -> float:
    """Return the least sufficient step rate [Hz], a multiple or whole fraction of the sample rate.

    It has at least STEPS_A_CYCLE steps in a period of the highest natural frequency, also under
    unbalance, and LEAST_STEPS_A_SAMPLE steps per sample, or a `part` of both. It has at least
    STEPS_A_PASSAGE steps while a ball passes the defect, and enough for the decay by dampers. Balls
    with mass need more, see `ball_step_rate`. Raises ValueError if no finite rate suffices.
    """
    return step_rate_of(packed_motion(scene), sample_rate, part)


def step_rate_of(packed: PackedMotion, sample_rate: float, part: float = 1.0) -> float:
    """Return the `default_step_rate` of a packed scene."""
    scene = packed.scene
    highest = STEPS_A_CYCLE * _highest_loaded_frequency(packed)
    needed = part * max(LEAST_STEPS_A_SAMPLE * sample_rate, highest)
    if not math.isfinite(highest):
        needed = sample_rate
    needed = max(needed, STEPS_A_PASSAGE * scene.cage_speed / shortest_passage(scene))
    needed = max(needed, _greatest_decay(packed) / STABLE_DECAY)
    if scene.balls == WITH_MASS:
        needed = max(needed, ball_step_rate(packed, sample_rate))
    if not math.isfinite(needed):
        raise checks.refuse("the step rate that the scene needs", needed, "a finite one [Hz]")
    if needed <= sample_rate:
        return sample_rate / math.floor(sample_rate / needed)
    return sample_rate * math.ceil(needed / sample_rate - 1e-9)


def _highest_loaded_frequency(packed: PackedMotion) -> float:
    """Return the highest natural frequency, under the load alone or with unbalance and samples."""
    scene, highest = packed.scene, highest_frequency_of(packed)
    if not (force := scene.turning_force + peak_force(packed)):
        return highest
    load = np.array([scene.load.fx, scene.load.fy, scene.load.fz])
    size = float(np.linalg.norm(load))
    loaded = load * (1.0 + force / size) if size else np.array([force, 0.0, 0.0])
    heavier = scene.replace(**dict(zip(("fx", "fy", "fz"), loaded.tolist(), strict=True)))
    return float(np.fmax(highest, highest_frequency_of(pack(heavier, packed.dofs))))


def _greatest_decay(packed: PackedMotion) -> float:
    """Return a bound [1/s] on the decay of the rings: the trace of M⁻¹C with all balls loaded.

    If the decay is too fast for the steps, a motion diverges, or is wrong if contacts cannot pull.
    """
    contacts, line_r, line_z = packed.contacts, packed.contacts.line_r, packed.contacts.line_z
    tilting = contacts.reach * line_z - contacts.arm * line_r
    radial, axial, turned = (float(part @ part) for part in (line_r, line_z, tilting))
    along = np.array([0.5 * radial, 0.5 * radial, axial, 0.5 * turned, 0.5 * turned])
    rotor = packed.rotor
    inverse_mass = rotor.inverse_inner + rotor.inverse_outer
    decay = rotor.contact_damping * float(along[rotor.active] @ inverse_mass)
    return decay + float((rotor.damping * rotor.inverse_outer).max())


def fine_step_rate(scene: Scene, sample_rate: float) -> float:
    """Return a step rate [Hz] not below the sample rate, 0.4 of which is then the bandwidth."""
    packed = packed_motion(scene)
    return max(step_rate_of(packed, sample_rate), sample_rate)
