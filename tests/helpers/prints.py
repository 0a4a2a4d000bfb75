"""Fingerprints of the core's answers, to hold runs, threads and processes against each other."""

import hashlib
from collections.abc import Callable

import numpy as np

from bearingcore import (
    diagnose,
    equilibrium,
    life,
    modes,
    orbit,
    presets,
    simulate,
    spectrum,
    stiffness_maps,
)
from bearingcore.signals.recording import Recording
from bearingcore.statics.ball_positions import ball_positions
from bearingcore.sweep.grid import Grid

RIG, ANGULAR = presets["fan-rig"], presets["liew-lim"]


def _sweep() -> list[np.ndarray]:
    over = {"extent": [0.1, 0.2, 0.3], "fy": [-2000.0, -1800.0]}
    status, numbers = Grid.of(ANGULAR, over, ["k_yy_*", "band_*"]).compute()
    return [status, *(numbers[name] for name in sorted(numbers))]


def _diagnosis() -> list[np.ndarray]:
    noise = np.random.default_rng(1).standard_normal((2**15, 1))
    found = diagnose(Recording(noise, 12_000.0, ("y",)), presets["6205"].bearing, 180.0)
    return [np.array([one.level for one in found.evidence])]


ANSWERS: dict[str, Callable[[], list[np.ndarray]]] = {
    "equilibrium": lambda: [equilibrium(ANGULAR).stiffness, equilibrium(ANGULAR).displacement],
    "maps": lambda: [stiffness_maps(ANGULAR, [0.2, 0.4, 0.6]).stiffness],
    "positions": lambda: [ball_positions(presets["6205"].replace(shaft_speed=900.0)).load],
    "modes": lambda: [modes(RIG).undamped_frequency, modes(RIG).shape],
    "motion": lambda: [simulate(RIG, 0.05).outer_acceleration],
    "five directions": lambda: [simulate(ANGULAR, 0.02).outer_acceleration],
    "with mass": lambda: [simulate(RIG.replace(balls="with mass"), 0.01).outer_acceleration],
    "orbit": lambda: [orbit(RIG).history, orbit(RIG).multipliers],
    "spectrum": lambda: [spectrum(simulate(RIG, 0.05).outer_acceleration, 65536.0).density],
    "life": lambda: [np.array(life(presets["6205"], 14_800.0).million_revolutions)],
    "sweep": _sweep,
    "diagnosis": _diagnosis,
}


def print_of(name: str) -> str:
    """A fingerprint of all bytes of an answer."""
    digest = hashlib.sha256()
    for array in ANSWERS[name]():
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()
