"""Light pictures in turn on the event loop, others in threads."""

import asyncio
import os
import threading
import time

import pytest

from app.turns import LIGHT, Turns
from tests.app.loops import run


def work(seconds: float) -> str:
    """Keep a core busy; where that was."""
    end = time.thread_time() + seconds
    while time.thread_time() < end:
        pass
    return threading.current_thread().name


def test_what_was_light_is_done_on_the_event_loop_next_time() -> None:
    async def session() -> list[bool]:
        here = threading.current_thread().name
        turns = Turns()
        return [
            await turns.run(kind, work, seconds) == here
            for kind, seconds in (
                ("one", 0.0),  # nobody knows what it costs
                ("one", 0.0),
                ("two", 0.0),  # another kind
                ("one", 2.0 * LIGHT),  # it was light
                ("one", 0.0),  # it was not
                ("one", 0.0),
            )
        ]

    assert run(session()) == [False, True, False, True, False, True]


def test_waiting_for_others_does_not_make_a_picture_heavy() -> None:
    async def session() -> bool:
        turns = Turns()
        await turns.run("kind", time.sleep, 3.0 * LIGHT)
        return turns.is_light("kind")

    assert run(session())


def test_sessions_take_turns_and_between_two_the_loop_hears_what_was_said() -> None:
    order: list[str] = []

    async def draw(name: str) -> None:
        turns = Turns()
        await turns.run(name, work, 0.0)
        ready.append(name)
        await all_ready.wait()
        for _ in range(3):
            await turns.run(name, order.append, name)

    async def listen() -> None:
        while len(order) < 9:
            order_seen.append(len(order))
            await asyncio.sleep(0.0)

    async def live() -> None:
        drawing = [asyncio.ensure_future(draw(name)) for name in "abc"]
        while len(ready) < 3:
            await asyncio.sleep(0.001)
        all_ready.set()
        await asyncio.gather(listen(), *drawing)

    ready: list[str] = []
    order_seen: list[int] = []
    all_ready = asyncio.Event()
    run(live())
    rounds = [set(order[k : k + 3]) for k in (0, 3, 6)]
    assert rounds == [set("abc")] * 3
    assert set(order_seen) >= set(range(9)), "the loop went round between any two pictures"


def test_what_pictures_wait_for_others_is_known() -> None:
    async def session() -> tuple[float, float, float]:
        first, second, alone = Turns(), Turns(), Turns()
        for turns in (first, second, alone):
            await turns.run("kind", work, 0.0)
            turns.queued = 0.0
        await asyncio.gather(first.run("kind", time.sleep, 0.05), second.run("kind", work, 0.0))
        await alone.run("kind", time.sleep, 0.05)
        return first.queued, second.queued, alone.queued

    first, second, alone = run(session())
    assert second >= 0.05
    assert max(first, alone) < second

    async def slow() -> float:
        turns = [Turns() for _ in range((os.cpu_count() or 2) + 1)]
        await asyncio.gather(*(one.run_slow(time.sleep, 0.05) for one in turns))
        return max(one.queued for one in turns)

    assert run(slow()) >= 0.05


def test_failures_come_through_and_the_next_has_its_turn() -> None:
    def fail() -> None:
        raise RuntimeError("a bug")

    async def session() -> bool:
        turns = Turns()
        for _ in range(2):  # in a thread and on the loop
            with pytest.raises(RuntimeError, match="a bug"):
                await turns.run("kind", fail)
        return await turns.run("kind", work, 0.0) == threading.current_thread().name

    assert run(session())


def test_kinds_are_not_remembered_for_ever() -> None:
    async def session() -> int:
        turns = Turns()
        for number in range(200):
            await turns.run(number, work, 0.0)
        return len(turns._cost)

    assert run(session()) < 100
