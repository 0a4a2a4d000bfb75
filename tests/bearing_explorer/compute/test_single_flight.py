"""Each answer is computed once, whoever asks."""

import threading
import time

import pytest
from bearing_explorer.compute.single_flight import SingleFlightCache


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
