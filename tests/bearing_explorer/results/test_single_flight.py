"""Each answer is computed once, whoever asks."""

import threading
import time

import numpy as np
import pytest
from bearing_explorer.results.budget import Budget, held_bytes
from bearing_explorer.results.single_flight import SingleFlightCache, WouldWait, never_waiting


def test_threads_that_ask_together_share_one_computation() -> None:
    calls = []

    def slow(key: int) -> int:
        calls.append(key)
        time.sleep(0.05)
        return 10 * key

    once = SingleFlightCache(slow, 4)
    answers: list[int] = []
    threads = [threading.Thread(target=lambda: answers.append(once(7))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == [70] * 8
    assert calls == [7]


def test_the_least_used_leaves_first() -> None:
    calls = []
    once = SingleFlightCache(lambda key: calls.append(key) or key, 2)
    for key in (1, 2, 1, 3, 1, 2):
        assert once(key) == key
    assert calls == [1, 2, 3, 2]


def test_what_is_kept_counts_as_what_was_computed() -> None:
    calls = []
    once = SingleFlightCache(lambda key: calls.append(key) or key, 2)
    for key in (1, 2, 3):
        once.keep(10 * key, key)
    once.keep(0, 3)
    assert [once.knows(key) for key in (1, 2, 3)] == [False, True, True]
    assert once(3) == 30
    assert not calls


def test_a_failure_reaches_everyone_and_is_not_kept() -> None:
    answers = iter([ValueError("no"), 5])

    def sometimes() -> int:
        answer = next(answers)
        if isinstance(answer, Exception):
            raise answer
        return answer

    once = SingleFlightCache(sometimes, 2)
    with pytest.raises(ValueError, match="no"):
        once()
    assert once() == 5


def test_all_caches_together_hold_no_more_bytes_than_agreed() -> None:
    budget = Budget(3_500_000)
    first = SingleFlightCache(lambda key: {"an array": np.zeros(125_000)}, 100, budget)
    second = SingleFlightCache(lambda key: [np.zeros(125_000)[:3]], 100, budget)
    for key in (1, 2):
        first(key)
        second(key)
    assert budget.total == 3_000_000, "of what is seen of an array, all of it counts"
    assert [first.knows(1), second.knows(1), first.knows(2), second.knows(2)] == [False] + [
        True
    ] * 3
    second(1)  # used again: now that of key 2 is the next to go
    first(3)
    assert [second.knows(1), first.knows(2), second.knows(2)] == [True, False, True]
    for key in range(50):
        first(key)
    assert budget.total <= 3_500_000
    huge = SingleFlightCache(lambda: np.zeros(10**6), 4, budget)
    assert huge().size == 10**6
    assert not huge.knows(), "what is too large alone is not kept"


def test_what_leaves_by_count_leaves_the_budget() -> None:
    budget = Budget(10**9)
    once = SingleFlightCache(lambda key: np.zeros(1000), 2, budget)
    for key in range(9):
        once(key)
    assert budget.total == 2 * 8000


def test_long_lists_count_and_nothing_counts_twice() -> None:
    numbers, array = (1.0,) * 10_000, np.zeros((10, 10))
    assert held_bytes(numbers) == 320_000
    assert held_bytes([array, array.T, array[2:4], {"again": array}]) == 800


def test_who_may_not_wait_is_told_so_and_takes_what_is_known() -> None:
    begun, go_on = threading.Event(), threading.Event()

    def slow(key: int) -> int:
        begun.set()
        assert go_on.wait(60.0)
        return 10 * key

    once = SingleFlightCache(slow, 4)
    thread = threading.Thread(target=lambda: once(7))
    thread.start()
    assert begun.wait(60.0)
    with never_waiting():
        with pytest.raises(WouldWait):
            once(7)
        go_on.set()
        thread.join()
        assert once(7) == 70
        assert once(8) == 80, "what nobody is at is computed"


def test_who_waits_for_somebody_that_may_not_wait_begins_anew() -> None:
    begun, asked, go_on = threading.Event(), threading.Event(), threading.Event()

    def first(key: int) -> int:
        begun.set()
        assert go_on.wait(60.0)
        return 10 * key

    def second(key: int) -> int:
        asked.set()
        if threading.current_thread() is threading.main_thread():
            while not waiting:
                time.sleep(0.001)
            time.sleep(0.05)  # until the other one waits for this
        return 1 + firsts(key)

    waiting: list[bool] = []
    answers: list[int] = []
    firsts, seconds = SingleFlightCache(first, 4), SingleFlightCache(second, 4)

    def wait() -> None:
        assert asked.wait(60.0)
        waiting.append(True)
        answers.append(seconds(7))

    threads = [threading.Thread(target=lambda: firsts(7)), threading.Thread(target=wait)]
    threads[0].start()
    assert begun.wait(60.0)
    threads[1].start()
    with never_waiting(), pytest.raises(WouldWait):
        seconds(7)
    go_on.set()
    for thread in threads:
        thread.join(60.0)
    assert answers == [71]
