"""Attributes and results that are computed once, and kept up to a number of bytes."""

import threading

import numpy as np
import pytest

from bearingcore import Defect, RoughFloor, presets
from bearingcore.common import cached_property
from bearingcore.common._byte_cache import lru_cache_by_bytes
from bearingcore.model.scene._defect import path_tables


class Slow:
    """One that waits for an event, or does not."""

    def __init__(self, go_on: threading.Event | None = None) -> None:
        self.go_on = go_on
        self.begun = threading.Event()
        self.asked = 0

    @cached_property
    def answer(self) -> int:
        """The words of it."""
        self.asked += 1
        self.begun.set()
        if self.go_on is not None:
            assert self.go_on.wait(60.0)
        return 42


def test_it_is_computed_once_and_can_be_replaced() -> None:
    slow = Slow()
    assert (slow.answer, slow.answer, slow.asked) == (42, 42, 1)
    del slow.answer
    assert (slow.answer, slow.asked) == (42, 2)
    assert Slow.answer.__doc__ == "The words of it."


def test_one_object_does_not_wait_for_another() -> None:
    go_on = threading.Event()
    slow, quick = Slow(go_on), Slow()
    thread = threading.Thread(target=lambda: slow.answer)
    thread.start()
    assert slow.begun.wait(60.0)
    answers: list[int] = []
    other = threading.Thread(target=lambda: answers.append(quick.answer))
    other.start()
    other.join(10.0)
    try:
        assert answers == [42], "while the other is at work"
    finally:
        go_on.set()
        thread.join()
        other.join()


def test_results_are_kept_up_to_a_number_of_bytes() -> None:
    asked: list[int] = []

    @lru_cache_by_bytes(1_000_000, lambda result, n: 1000 * n)
    def made(n: int) -> np.ndarray:
        asked.append(n)
        return np.zeros(n)

    assert made(400) is made(400)
    assert asked == [400]
    made(401), made(402)  # together more than a million: the oldest goes
    made(400)
    assert asked == [400, 401, 402, 400]
    made(1000), made(1000)
    assert asked[-2:] == [1000, 1000], "what is larger than all, with its overhead, is not kept"


def test_errors_are_not_kept() -> None:
    @lru_cache_by_bytes(10_000, lambda result, n: 1)
    def refused(n: int) -> int:
        raise ValueError(n)

    for _ in range(2):
        with pytest.raises(ValueError, match="7"):
            refused(7)


def test_tables_of_large_rough_floors_do_not_fill_the_memory() -> None:
    """256 of them were kept, whatever their size: four gigabytes."""
    import tracemalloc

    bearing = presets["fan-rig"].bearing
    tracemalloc.start()
    for seed in range(60):
        floor = RoughFloor(rms_height=1e-7, correlation_length=2e-6, seed=seed % 2)
        path_tables(
            (Defect(extent=1.0 + 1e-3 * seed, depth=20e-6, center=4.7, floor=floor),), bearing
        )
    held, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert held < 150e6
