"""Work in the background: progress, cancel, newest wins, and nothing left behind."""

import asyncio
import threading
import time
from collections.abc import Callable, Generator
from functools import partial

import pytest
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
