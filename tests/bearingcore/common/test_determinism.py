"""Equal scenes give equal results, bit for bit: in one thread or two, in whichever process."""

import hashlib
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

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
from bearingcore.model.statics import ball_positions
from bearingcore.model.sweeps import Grid
from bearingcore.recordings import Recording

RIG, ANGULAR = presets["fan-rig"], presets["liew-lim"]


def _sweep() -> list[np.ndarray]:
    over = {"extent": [0.1, 0.2, 0.3], "fy": [-2000.0, -1800.0]}
    status, numbers = Grid.of(ANGULAR, over, ["k_yy_*", "band_*"]).compute()
    return [status, *(numbers[name] for name in sorted(numbers))]


def _diagnosis() -> list[np.ndarray]:
    noise = np.random.default_rng(1).standard_normal((2**15, 1))
    diagnosis = diagnose(Recording(noise, 12_000.0, ("y",)), presets["6205"].bearing, 180.0)
    return [np.array([part.level for part in diagnosis.evidence])]


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


@pytest.fixture(scope="module")
def first() -> dict[str, str]:
    """All, one after the other."""
    return {name: print_of(name) for name in ANSWERS}


@pytest.mark.proof
def test_the_same_again_in_two_threads(first: dict[str, str]) -> None:
    names = [*ANSWERS, *reversed(ANSWERS)]  # others beside each the second time
    with ThreadPoolExecutor(2) as threads:
        again = list(zip(names, threads.map(print_of, names), strict=True))
    assert [(name, first[name]) for name in names] == again


@pytest.mark.proof
def test_the_same_in_another_process(first: dict[str, str]) -> None:
    """Another order of hashes and of everything in memory."""
    ask = (
        "from tests.bearingcore.common.test_determinism import ANSWERS, print_of\n"
        "for name in reversed(ANSWERS): print(name, print_of(name), sep='=')"
    )
    said = subprocess.run([sys.executable, "-c", ask], capture_output=True, text=True, check=True)
    other = dict(line.rsplit("=", 1) for line in said.stdout.splitlines())
    assert other == first
