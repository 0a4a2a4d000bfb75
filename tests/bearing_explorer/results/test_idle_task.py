"""What is done while a hand rests."""

import asyncio
import threading
import time
from collections.abc import Awaitable, Callable

from bearing_explorer.results.idle_task import IdleTask
from bearing_explorer.results.latest_wins import LatestWins
from bearing_explorer.results.scheduler import Scheduler

from tests.helpers.loops import run


async def nothing_to_draw() -> None:
    """All is drawn."""


def rested(
    act: Callable[[IdleTask[int, int]], object],
    drawn: Callable[[], Awaitable[None]] = nothing_to_draw,
    work: Callable[[int, Callable[[], bool]], int] = lambda number, _: 10 * number,
) -> list[tuple[int, int]]:
    """What is handed over when `act` begins things, 10 ms being rest."""
    handed: list[tuple[int, int]] = []

    async def live() -> None:
        rest: IdleTask[int, int] = IdleTask(
            work, lambda *what: handed.append(what), drawn, Scheduler(), hash, 0.01
        )
        waited = act(rest)
        if asyncio.iscoroutine(waited):
            await waited
        while not rest.idle:
            await asyncio.sleep(0.002)

    run(live())
    return handed


def test_only_the_newest_is_worked_on_and_in_another_thread() -> None:
    worked: list[tuple[int, str]] = []

    def work(number: int, _: Callable[[], bool]) -> int:
        worked.append((number, threading.current_thread().name))
        return number

    assert rested(lambda rest: [rest.begin(k) for k in range(20)], work=work) == [(19, 19)]
    assert [number for number, _ in worked] == [19]
    assert worked[0][1].startswith("plan")


def test_what_was_overtaken_while_it_was_worked_on_knows_it_and_is_never_drawn() -> None:
    began, overtaken_seen = threading.Event(), []

    def work(number: int, overtaken: Callable[[], bool]) -> int:
        began.set()
        if number == 1:
            end = time.monotonic() + 5.0
            while not overtaken() and time.monotonic() < end:
                time.sleep(0.001)
            overtaken_seen.append(overtaken())
        return number

    async def act(rest: IdleTask[int, int]) -> None:
        rest.begin(1)
        while not began.is_set():
            await asyncio.sleep(0.001)
        rest.begin(2)

    assert rested(act, work=work) == [(2, 2)]
    assert overtaken_seen == [True]


def test_rest_begins_when_what_was_asked_for_is_drawn() -> None:
    """However long that takes: a hand that waits for a slow server does not rest."""
    order: list[str] = []
    worker: LatestWins[int]

    async def draw(number: int) -> None:
        await asyncio.sleep(0.05)
        order.append(f"drawn {number}")

    async def drawn() -> None:
        await worker.finished()

    def work(number: int, _: Callable[[], bool]) -> int:
        order.append(f"worked on {number}")
        return number

    async def act(rest: IdleTask[int, int]) -> None:
        nonlocal worker
        worker = LatestWins(draw)
        for number in range(4):  # the page waits for each answer
            worker.submit(number)
            rest.begin(number)
            while f"drawn {number}" not in order:
                await asyncio.sleep(0.0)

    assert rested(act, drawn, work) == [(3, 3)]
    assert order == [*(f"drawn {number}" for number in range(4)), "worked on 3"]


def test_it_outlives_a_failure() -> None:
    def fails(number: int, _: Callable[[], bool]) -> int:
        raise RuntimeError(number)

    assert rested(lambda rest: rest.begin(1), work=fails) == []
