"""Work in the background: progress, cancel, newest wins; results are kept and computed once."""

import asyncio
import threading
import time
from collections.abc import Callable, Generator, Iterator
from functools import partial

import cachetools
import numpy as np
import pytest
from bearing_explorer.kit.compute import cache, drawing_loop
from bearing_explorer.kit.compute.cache import cached
from bearing_explorer.kit.compute.drawing_loop import DrawingLoop
from bearing_explorer.kit.compute.executors import Pool
from bearing_explorer.kit.compute.jobs import SEARCH, Jobs, JobState, Kind, Work

from tests.helpers.loops import run


class Page:
    """What a job reported and showed."""

    def __init__(self) -> None:
        self.states: list[JobState] = []
        self.results: list[object] = []
        self.threads: set[str] = set()

    def take(self, result: object) -> None:
        self.results.append(result)
        self.threads.add(threading.current_thread().name)

    def report(self, state: JobState) -> None:
        self.states.append(state)
        self.threads.add(threading.current_thread().name)


async def assign(change: Callable[[], None]) -> None:
    change()


async def idle(jobs: Jobs) -> None:
    end = time.monotonic() + 60.0
    while jobs.busy():
        assert time.monotonic() < end
        await asyncio.sleep(0.005)


def steps(count: int, began: threading.Event | None = None) -> Callable[[Work], str]:
    def work(job: Work) -> str:
        for i in range(count):
            if job.cancelled():
                return f"{i} steps."
            job.progress(i / count)
            job.show(i)
            if began is not None:
                began.set()
            time.sleep(0.02)
        return f"All {count} steps."

    return work


def test_a_job_tells_how_it_goes_and_shows_what_it_finds() -> None:
    page, looked_at = Page(), threading.Event()

    def work(job: Work) -> str:
        for i in range(30):
            job.progress(i / 30)
            job.show(i)
            if i == 15:
                assert looked_at.wait(30.0)
        return "All 30 steps."

    async def session() -> str:
        jobs = Jobs(assign)
        jobs.start(work, page.take, page.report)
        assert jobs.busy()
        while not any(state.part > 0.4 for state in page.states):
            await asyncio.sleep(0.005)
        looked_at.set()
        await idle(jobs)
        return threading.current_thread().name

    loop_thread = run(session())
    assert page.threads == {loop_thread}, "models change on the loop of the session alone"
    assert page.states[-1] == JobState("done", 1.0, "All 30 steps.")
    parts = [state.part for state in page.states]
    assert parts == sorted(parts)
    assert any(0.0 < part < 1.0 for part in parts)
    assert page.results[-1] == 29
    assert page.results == sorted(page.results)  # type: ignore[type-var]
    assert len(page.results) < 30, "what was overtaken before a look at it is not drawn"


def test_a_new_request_replaces_the_old_one() -> None:
    first, second = Page(), Page()
    running = threading.Semaphore(1)

    def alone(work: Callable[[Work], str]) -> Callable[[Work], str]:
        def checked(job: Work) -> str:
            assert running.acquire(blocking=False), "two jobs of a session at a time"
            try:
                return work(job)
            finally:
                running.release()

        return checked

    async def session() -> None:
        jobs, began = Jobs(assign), threading.Event()
        jobs.start(alone(steps(500, began)), first.take, first.report)
        while not began.is_set():
            await asyncio.sleep(0.005)
        for _ in range(3):  # those between never begin
            jobs.start(alone(steps(3)), second.take, second.report)
        await idle(jobs)
        await asyncio.sleep(0.05)

    run(session())
    assert first.states[-1].mood == "stopped"
    assert first.results[-1] != 499, "it went on to its end"
    assert second.states[-1] == JobState("done", 1.0, "All 3 steps.")
    assert [state.mood for state in second.states].count("done") == 1


def test_the_end_of_a_session_cancels_and_says_nothing_more() -> None:
    page, began, ended = Page(), threading.Event(), threading.Event()

    def work(job: Work) -> str:
        words = steps(500, began)(job)
        ended.set()
        return words

    async def session() -> int:
        jobs = Jobs(assign)
        jobs.start(work, page.take, page.report)
        while not began.is_set():
            await asyncio.sleep(0.005)
        jobs.stop()
        reported = len(page.states)
        await idle(jobs)
        jobs.start(steps(1), page.take, page.report)
        assert not jobs.busy()
        return reported

    reported = run(session())
    assert ended.wait(60.0), "the thread must not go on for a page that is gone"
    assert len(page.states) == reported


def test_of_a_kind_one_is_at_work_however_often_it_is_asked_for() -> None:
    taken: list[int] = []
    at_work, most, begun = 0, 0, 0

    def compute(number: int) -> int:
        nonlocal at_work, most, begun
        at_work, begun = at_work + 1, begun + 1
        most = max(most, at_work)
        time.sleep(0.02)
        at_work -= 1
        return number

    async def session() -> None:
        jobs = Jobs(assign)
        for number in range(100):
            jobs.answer(SEARCH, partial(compute, number), taken.append)
            if number == 10:
                await asyncio.sleep(0.01)
        await idle(jobs)

    run(session())
    assert most == 1
    assert begun == 2, "what was overtaken before its turn never begins"
    assert taken[-1] == 99


def test_sessions_take_turns_between_steps_and_a_stop_comes_between_them() -> None:
    order: list[str] = []
    alone = Kind("reading", Pool(1))

    def steps_of(name: str) -> Callable[[Work], Generator[None, None, str]]:
        def work(_: Work) -> Generator[None, None, str]:
            for _ in range(20):
                order.append(name)
                time.sleep(0.005)
                yield
            return ""

        return work

    async def session() -> None:
        first, second = Jobs(assign), Jobs(assign)
        first.start(steps_of("a"), order.append, kind=alone)
        second.start(steps_of("b"), order.append, kind=alone)
        await idle(second)
        assert order[:8] in (["a", "b"] * 4, ["b", "a"] * 4)
        first.start(steps_of("c"), order.append, kind=alone)
        while "c" not in order:
            await asyncio.sleep(0.005)
        first.stop()
        await idle(first)

    run(session())
    assert order.count("c") < 20


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (ValueError("The shaft must turn."), "The shaft must turn."),
        (RuntimeError("secret"), "This could not be computed."),
    ],
)
def test_a_job_that_fails_says_so_and_the_next_one_runs(error: Exception, words: str) -> None:
    page = Page()

    def broken(_: Work) -> str:
        raise error

    async def session() -> None:
        jobs = Jobs(assign)
        jobs.start(broken, page.take, page.report)
        await idle(jobs)
        assert page.states[-1].mood == "failed"
        assert page.states[-1].words == words
        jobs.start(steps(1), page.take, page.report)
        await idle(jobs)

    run(session())
    assert page.states[-1].mood == "done"


def test_a_result_that_cannot_be_drawn_ends_its_job() -> None:
    page, work = Page(), steps(100_000)

    def take(_: int) -> None:
        raise RuntimeError("no such figure")

    async def session() -> None:
        jobs = Jobs(assign)
        jobs.start(work, take, page.report)
        await idle(jobs)

    run(session())
    assert page.states[-1].words == "This could not be computed."


def test_a_job_cannot_go_on_for_ever() -> None:
    work = Work(longest=60.0)
    work.started = time.monotonic()
    assert not work.cancelled()
    work.started -= 61.0
    assert work.cancelled()
    assert work.timed_out


class DrawnPage:
    """Notes what is drawn; `gate` holds the fine picture up."""

    def __init__(self, seconds: float = 0.0) -> None:
        self.drawn: list[int] = []
        self.refining: list[int] = []
        self.fine: list[int] = []
        self.errors: list[Exception] = []
        self.gate = threading.Event()
        self.gate.set()
        self.seconds = seconds
        self.loop: DrawingLoop[int, int] = DrawingLoop(
            self.draw, self.refine, self.draw_fine, self.failed
        )

    async def draw(self, inputs: int) -> int:
        await asyncio.sleep(self.seconds)
        if inputs < 0:
            raise ValueError("a bug")
        self.drawn.append(inputs)
        return inputs

    def refine(self, inputs: int) -> int | None:
        self.refining.append(inputs)
        assert self.gate.wait(30.0)
        return None if inputs == 0 else 10 * inputs

    async def draw_fine(self, inputs: int, picture: int) -> None:
        self.fine.append(picture)

    async def failed(self, error: Exception) -> None:
        self.errors.append(error)


@pytest.fixture(autouse=True)
def soon(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drawing_loop, "RESTS_AFTER", 0.05)


async def until(done: Callable[[], object]) -> None:
    async with asyncio.timeout(30.0):
        while not done():
            await asyncio.sleep(0.002)


def test_a_drag_is_drawn_by_its_newest_position_and_finely_once_it_rests() -> None:
    page = DrawnPage(seconds=0.01)

    async def live() -> None:
        for position in range(1, 41):
            page.loop.submit(position)
            await asyncio.sleep(0.002)
        assert not page.refining, "nothing finer is computed while a slider moves"
        await until(lambda: page.loop.idle)

    run(live())
    assert page.drawn[-1] == 40
    assert page.drawn == sorted(page.drawn)
    assert len(page.drawn) < 35, "what was overtaken is not drawn"
    assert page.fine == [400]


def test_newer_inputs_do_not_wait_for_a_fine_picture() -> None:
    page = DrawnPage()

    async def live() -> None:
        page.gate.clear()
        page.loop.submit(1)
        await until(lambda: page.refining)
        page.loop.submit(2)
        await until(lambda: page.drawn == [1, 2])
        page.gate.set()
        await until(lambda: page.loop.idle)

    run(live())
    assert page.fine == [20], "the first fine picture was no longer wanted"


def test_a_failure_is_reported_and_where_nothing_is_finer_nothing_more_is_drawn() -> None:
    page = DrawnPage()

    async def live() -> None:
        for inputs in (-1, 0):
            page.loop.submit(inputs)
            await until(lambda: page.loop.idle)

    run(live())
    assert [str(error) for error in page.errors] == ["a bug"]
    assert (page.drawn, page.fine) == ([0], [])


def test_a_thread_takes_the_newest_and_a_stopped_loop_takes_nothing() -> None:
    page = DrawnPage(seconds=0.05)

    async def live() -> None:
        page.loop.submit(1)
        await asyncio.sleep(0.01)
        page.loop.submit(2)
        assert page.loop.waiting
        assert page.loop.newest(1) == 2
        assert page.loop.newest(1) == 1
        page.loop.stop()
        page.loop.submit(3)
        await asyncio.sleep(0.1)

    run(live())
    assert page.drawn == []


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
