"""Long work reports how far it is and can be stopped, and its parts change no bit of a result."""

import os
import signal
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from bearingcore import orbit, presets, simulate, stiffness_maps
from bearingcore.model._kernels import in_parts
from bearingcore.model.statics import _maps as maps_module
from bearingcore.model.sweeps import sweep

RIG, ANGULAR = presets["fan-rig"], presets["liew-lim"]
HEAVY = RIG.replace(balls="with mass", contact_law="no tension")
EXTENTS, ANGLES = np.linspace(0.05, 1.0, 40), np.linspace(0.0, 0.4, 50)

WORK: dict[str, Callable[..., Any]] = {
    "massless": lambda **more: simulate(RIG, 0.1, **more).history,
    "five directions": lambda **more: simulate(ANGULAR, 0.05, **more).history,
    "balls with mass": lambda **more: simulate(HEAVY, 0.01, step_rate=524288.0, **more).ball_place,
    "diverging": lambda **more: simulate(RIG, 0.5, step_rate=2048.0, **more).history,
    "orbit": lambda **more: orbit(ANGULAR, **more).multipliers,
    "maps": lambda **more: stiffness_maps(ANGULAR, EXTENTS, ANGLES, **more).stiffness,
}


class StoppedError(Exception):
    """Raised by the progress of these tests."""


@pytest.fixture
def many_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(in_parts, "FIRST_WORK", 1)
    monkeypatch.setattr(in_parts, "PART_SECONDS", 0.0)  # they do not grow
    monkeypatch.setattr(maps_module, "FIRST_POINTS", 1)


@pytest.mark.parametrize("name", WORK)
def test_parts_change_no_bit(name: str, request: pytest.FixtureRequest) -> None:
    whole = WORK[name]()
    request.getfixturevalue("many_parts")
    told: list[float] = []
    cut = WORK[name](progress=lambda part, words: told.append(part))
    np.testing.assert_array_equal(cut, whole)
    assert len(told) > (1 if name == "diverging" else 10)
    assert told == sorted(told)
    assert 0.0 <= min(told) <= max(told) <= 1.0


@pytest.mark.usefixtures("many_parts")
@pytest.mark.parametrize("name", WORK)
def test_raising_ends_the_work(name: str) -> None:
    told: list[float] = []

    def progress(part: float, words: str) -> None:
        told.append(part)
        if len(told) == 2:
            raise StoppedError

    with pytest.raises(StoppedError):
        WORK[name](progress=progress)
    assert len(told) == 2


def test_an_interrupt_ends_a_motion_of_many_seconds() -> None:
    """SIGINT reaches Python between two parts: the whole motion would take some ten seconds."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # Panel's servers take it for theirs
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        simulate(HEAVY, 60.0, 16384.0, step_rate=131072.0, most_steps=10**9)
    assert time.monotonic() - begun < 4.0


@pytest.mark.parametrize(("processes", "most"), [(False, 5.0), (True, 2.0)])
def test_stopping_a_sweep_ends_what_its_workers_do(processes: bool, most: float) -> None:
    """The tasks that run would take some twenty seconds each, and Dask waits for them."""
    raised = []

    def progress(part: float, words: str) -> None:
        raised.append(time.monotonic())
        if len(raised) > 10:
            raise StoppedError

    over = {"extent": np.linspace(0.1, 0.6, 60)}
    with pytest.raises(StoppedError):
        sweep(
            ANGULAR, over, ["acceleration_rms_y"], duration=14.0, scenes_per_task=30,
            progress=progress, processes=processes, workers=2,
        )  # fmt: skip
    assert time.monotonic() - raised[-1] < most
