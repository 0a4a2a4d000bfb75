"""Rate of the steps of a motion."""

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
"""Steps in a period of the highest natural frequency, by default. On the fan rig this leaves an
error of the spectrum near 0.02 dB; half as many leave 0.25 dB. On the Liew-Lim bearing, in five
directions, 13 leave 0.05 dB up to 2.1 kHz and 0.11 dB beyond, 26 leave 0.005 dB: it is accuracy
that needs them, as steps stay stable down to 2.2."""

LEAST_STEPS_A_SAMPLE = 0.45
"""However slow the modes are: contacts that open and close shake faster. A heavy rotor on few
balls, stepped at an eighth of the samples, was 4 dB off. As a whole fraction it is a half, and a
quarter where just over half of the steps are asked for."""


def default_step_rate(scene: Scene, sample_rate: float, part: float = 1.0) -> float:
    """The least step rate [Hz], a multiple or whole fraction of the sample rate, that will do.

    It has STEPS_A_CYCLE steps in a period of the highest natural frequency, under the unbalance
    too, LEAST_STEPS_A_SAMPLE, or a `part` of both; STEPS_A_PASSAGE while a ball passes the defect,
    and as many as dampers need. Where balls have mass a multiple, see `ball_step_rate`. Raises
    ValueError where none is finite.
    """
    return step_rate_of(packed_motion(scene), sample_rate, part)


def step_rate_of(packed: PackedMotion, sample_rate: float, part: float = 1.0) -> float:
    """`default_step_rate` of a scene that is packed."""
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
    """`highest_frequency_of`, or that of a load greater by the force of unbalance and samples."""
    scene, highest = packed.scene, highest_frequency_of(packed)
    if not (force := scene.turning_force + peak_force(packed)):
        return highest
    still = np.array([scene.load.fx, scene.load.fy, scene.load.fz])
    size = float(np.linalg.norm(still))
    loaded = still * (1.0 + force / size) if size else np.array([force, 0.0, 0.0])
    heavier = scene.replace(**dict(zip(("fx", "fy", "fz"), loaded.tolist(), strict=True)))
    return float(np.fmax(highest, highest_frequency_of(pack(heavier, packed.dofs))))


def _greatest_decay(packed: PackedMotion) -> float:
    """Bound [1/s] of how fast dampers stop the rings: the trace of C over M, all elements loaded.

    Beyond what steps hold a motion diverges, or, under a law without tension, stays finite.
    """
    every, rotor = packed.contacts, packed.rotor
    tilting = every.reach * every.line_z - every.arm * every.line_r
    radial, axial, turned = (float(part @ part) for part in (every.line_r, every.line_z, tilting))
    along = np.array([0.5 * radial, 0.5 * radial, axial, 0.5 * turned, 0.5 * turned])
    both = rotor.inverse_inner + rotor.inverse_outer
    contacts = rotor.contact_damping * float(along[rotor.active] @ both)
    return contacts + float((rotor.damping * rotor.inverse_outer).max())


def fine_step_rate(scene: Scene, sample_rate: float) -> float:
    """Step rate [Hz] that is at least the sample rate: the motion is then known up to 0.4 of it."""
    packed = packed_motion(scene)
    return max(step_rate_of(packed, sample_rate), sample_rate)
