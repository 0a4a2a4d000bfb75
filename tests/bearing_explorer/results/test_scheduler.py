"""Light pictures in turn on the event loop, others in threads."""

import asyncio
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from bearing_explorer.results.scheduler import LIGHT, LIGHT_IDLE_WORK, Scheduler
from bearing_explorer.results.single_flight import SingleFlightCache
from numba.core.compiler_lock import global_compiler_lock

from tests.helpers.loops import run


def work(seconds: float) -> str:
    """Keep a core busy; where that was."""
    end = time.thread_time() + seconds
    while time.thread_time() < end:
        pass
    return threading.current_thread().name


def test_what_was_light_is_done_on_the_event_loop_next_time() -> None:
    async def session() -> list[bool]:
        here = threading.current_thread().name
        scheduler = Scheduler()
        return [
            await scheduler.run(kind, work, seconds) == here
            for kind, seconds in (
                ("one", 0.0),  # nobody knows what it costs
                ("one", 0.0),
                ("two", 0.0),  # another kind
                ("one", 1.5 * LIGHT),  # it was light
                ("one", 0.0),  # it was not
                ("one", 0.0),
            )
        ]

    assert run(session()) == [False, True, False, True, False, True]


def test_waiting_for_others_does_not_make_a_picture_heavy() -> None:
    async def session() -> bool:
        scheduler = Scheduler()
        await scheduler.run("kind", time.sleep, 3.0 * LIGHT)
        return scheduler.is_light("kind")

    assert run(session())


def test_sessions_take_turns_and_between_two_the_loop_hears_what_was_said() -> None:
    order: list[str] = []

    async def draw(name: str) -> None:
        scheduler = Scheduler()
        await scheduler.run(name, work, 0.0)
        ready.append(name)
        await all_ready.wait()
        for _ in range(3):
            await scheduler.run(name, order.append, name)

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


def test_how_long_pictures_take_is_known_however_long_they_waited() -> None:
    async def session() -> list[float]:
        schedulers = [Scheduler() for _ in range(4)]
        for one in schedulers:
            await one.run("kind", work, 0.0)
            one.worked = 0.0
        await asyncio.gather(*(one.run("kind", time.sleep, 0.1) for one in schedulers))
        alone = [one.worked for one in schedulers]
        await schedulers[0].run_slow(time.sleep, 0.1)
        return [*alone, schedulers[0].worked]

    *alone, twice = run(session())
    assert all(0.1 <= one < 0.35 for one in alone), "the last waited for 0.3 s beside"
    assert twice >= 0.2


def test_light_idle_work_lets_all_pictures_pass_and_heavy_ones_stay_in_threads() -> None:
    order: list[str] = []

    def note(name: str) -> str:
        order.append(name)
        return threading.current_thread().name

    async def live() -> None:
        here = threading.current_thread().name
        schedulers = [Scheduler() for _ in range(4)]
        with ThreadPoolExecutor(1, "idle") as threads:
            for one in schedulers:  # nobody knows what they cost
                assert await one.run("kind", work, 0.0) != here
                assert (await one.run_idle(threads, "kind", work, 0.0)).startswith("idle")
            doing = [one.run("kind", note, f"picture {n}") for n, one in enumerate(schedulers[1:])]
            doing.insert(2, schedulers[0].run_idle(threads, "kind", note, "idle"))
            assert set(await asyncio.gather(*doing)) == {here}
            assert order[-1] == "idle"

            assert (await schedulers[1].run_idle(threads, None, work, 0.0)).startswith("idle")
            await schedulers[1].run_idle(threads, "kind", work, 2.0 * LIGHT_IDLE_WORK)
            heavy = await schedulers[1].run_idle(threads, "kind", work, 0.0)
            assert heavy.startswith("idle")

            # known results are found at once; that does not make the others light
            await schedulers[2].run_idle(threads, "kind", work, 8.0 * LIGHT_IDLE_WORK)
            await schedulers[2].run_idle(threads, "kind", work, 0.0)
            assert (await schedulers[2].run_idle(threads, "kind", work, 0.0)).startswith("idle")

    run(live())


def test_idle_work_has_its_turn_however_many_pictures_wait(monkeypatch) -> None:
    monkeypatch.setattr("bearing_explorer.results.scheduler.PATIENCE", 0.02)
    stop = False

    async def drag(scheduler: Scheduler) -> None:
        while not stop:
            await scheduler.run("kind", work, 0.002)

    async def live() -> str:
        nonlocal stop
        schedulers = [Scheduler() for _ in range(3)]
        with ThreadPoolExecutor(1, "idle") as threads:
            for one in schedulers:
                await one.run("kind", work, 0.0)
                await one.run_idle(threads, "kind", work, 0.0)
            hands = [asyncio.ensure_future(drag(one)) for one in schedulers]
            where = await schedulers[0].run_idle(threads, "kind", work, 0.0)
            stop = True
            await asyncio.gather(*hands)
            return "here" if where == threading.current_thread().name else where

    assert run(live()) == "here"


def test_idle_work_that_was_overtaken_in_the_line_never_begins() -> None:
    began: list[int] = []

    async def live() -> None:
        scheduler, other = Scheduler(), Scheduler()
        with ThreadPoolExecutor(1) as threads:
            await scheduler.run_idle(threads, "kind", work, 0.0)
            await other.run("kind", work, 0.0)
            picture = asyncio.ensure_future(other.run("kind", work, 0.01))
            idle = asyncio.ensure_future(scheduler.run_idle(threads, "kind", began.append, 1))
            await asyncio.sleep(0.0)
            idle.cancel()
            await picture
            await scheduler.run_idle(threads, "kind", began.append, 2)

    run(live())
    assert began == [2]


def test_failures_come_through_and_the_next_has_its_turn() -> None:
    def fail() -> None:
        raise RuntimeError("a bug")

    async def session() -> bool:
        scheduler = Scheduler()
        for _ in range(2):  # in a thread and on the loop
            with pytest.raises(RuntimeError, match="a bug"):
                await scheduler.run("kind", fail)
            await scheduler.run("kind", work, 0.0)
        return await scheduler.run("kind", work, 0.0) == threading.current_thread().name

    assert run(session())


def test_kinds_are_not_remembered_for_ever() -> None:
    async def session() -> int:
        scheduler = Scheduler()
        for number in range(200):
            await scheduler.run(number, work, 0.0)
        return len(scheduler._cost)

    assert run(session()) < 100


def test_the_loop_does_not_wait_for_what_a_thread_has_at_work() -> None:
    begun, go_on = threading.Event(), threading.Event()

    def slow(key: str) -> str:
        begun.set()
        assert go_on.wait(60.0)
        return key

    async def session(idle: bool) -> tuple[bool, str]:
        scheduler = Scheduler()
        with ThreadPoolExecutor(1) as threads:
            for work_ in (lambda _: "", answers):  # light at first
                if work_ is answers:
                    other = threading.Thread(target=answers, args=("asked",))
                    other.start()
                    assert begun.wait(60.0)
                if idle:
                    task = asyncio.create_task(scheduler.run_idle(threads, "kind", work_, "asked"))
                else:
                    task = asyncio.create_task(scheduler.run("kind", work_, "asked"))
                if work_ is answers:
                    await asyncio.sleep(0.1)  # the loop turns
                    free = not task.done()
                    go_on.set()
                found = await task
            other.join()
        return free, found

    for idle in (False, True):
        begun.clear(), go_on.clear()
        answers = SingleFlightCache(slow, 4)
        assert run(session(idle)) == (True, "asked")


def test_what_is_light_goes_to_a_thread_while_another_compiles() -> None:
    """Numba lets one thread compile: who comes to need that too waits until it is done."""
    held, go_on = threading.Event(), threading.Event()

    def compile_() -> None:
        with global_compiler_lock:
            held.set()
            assert go_on.wait(60.0)

    async def session() -> list[bool]:
        here = threading.current_thread().name
        scheduler = Scheduler()
        await scheduler.run("kind", work, 0.0)
        thread = threading.Thread(target=compile_)
        thread.start()
        assert held.wait(60.0)
        meanwhile = await scheduler.run("kind", work, 0.0) == here
        go_on.set()
        thread.join()
        return [meanwhile, await scheduler.run("kind", work, 0.0) == here]

    assert run(session()) == [False, True]
