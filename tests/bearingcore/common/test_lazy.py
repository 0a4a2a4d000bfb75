"""Attributes that are computed once, and by nobody else's leave."""

import threading

from bearingcore.common import cached_property


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
