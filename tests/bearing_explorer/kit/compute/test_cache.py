"""Results are computed once, whoever needs them, and no more bytes are kept than allowed."""

import threading
from collections.abc import Callable, Iterator

import cachetools
import numpy as np
import pytest
from bearing_explorer.kit.compute import cache
from bearing_explorer.kit.compute.cache import cached


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A cache of its own, of a megabyte."""
    own = cachetools.LRUCache(1_000_000, getsizeof=lambda kept: kept[1])
    monkeypatch.setattr(cache, "_results", own)
    yield
    assert not cache._under_way


def run_in_threads(*acts: Callable[[], object]) -> list[object]:
    values: list[object] = [None] * len(acts)

    def run(k: int) -> None:
        try:
            values[k] = acts[k]()
        except Exception as error:
            values[k] = error

    threads = [threading.Thread(target=run, args=(k,)) for k in range(len(acts))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30.0)
    return values


def test_each_key_is_computed_once_by_several_threads() -> None:
    begun, go_on = threading.Event(), threading.Event()
    calls: list[int] = []

    @cached
    def slow(key: int) -> list[int]:
        calls.append(key)
        begun.set()
        assert go_on.wait(30.0)
        return [key]

    def late() -> object:
        assert begun.wait(30.0)
        threading.Timer(0.05, go_on.set).start()
        return slow(1)

    first, second, third = run_in_threads(lambda: slow(1), late, late)
    assert calls == [1]
    assert first is second is third
    assert slow(1) is first
    assert slow.knows(1)
    assert not slow.knows(2)


def test_functions_do_not_share_keys_and_what_is_raised_is_not_kept() -> None:
    tries = [0]

    @cached
    def one(key: int) -> str:
        return f"one {key}"

    @cached
    def fails_first(key: int) -> str:
        tries[0] += 1
        if tries[0] == 1:
            raise ValueError("no")
        return f"two {key}"

    assert one(1) == "one 1"
    with pytest.raises(ValueError, match="no"):
        fails_first(1)
    assert not fails_first.knows(1)
    assert fails_first(1) == "two 1"


def test_bytes_are_bounded_and_the_least_used_go_first() -> None:
    calls: list[int] = []

    @cached
    def large(key: int) -> np.ndarray:
        calls.append(key)
        return np.zeros(25_000)  # 200 kB

    for key in (1, 2, 3, 4):
        large(key)
    large(1)
    large(5)
    assert sum(size for _, size in cache.kept_results().values()) <= 1_000_000
    assert large.knows(1)
    assert not large.knows(2)

    @cached
    def too_large() -> np.ndarray:
        return np.zeros(200_000)

    assert too_large().size == 200_000
    assert not too_large.knows()
    assert large.knows(1), "and nothing had to go for it"
