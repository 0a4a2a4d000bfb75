"""Newest inputs win; a failure does not stop the worker."""

import asyncio

from bearing_explorer.results.latest_wins import LatestWins

from tests.helpers.loops import run


def test_inputs_overtaken_while_at_work_are_dropped() -> None:
    worked: list[int] = []

    async def drag() -> None:
        free = asyncio.Event()

        async def work(value: int) -> None:
            worked.append(value)
            await free.wait()

        worker = LatestWins(work)
        for value in range(50):
            worker.submit(value)
            await asyncio.sleep(0)
        assert worker.waiting
        assert not worker.idle
        free.set()
        while not worker.idle:
            await asyncio.sleep(0)

    run(drag())
    assert worked == [0, 49], "what was overtaken must not be drawn, the last position must"


def test_the_worker_survives_a_failure_and_says_so() -> None:
    worked: list[int] = []
    failures: list[str] = []

    async def failed(error: Exception) -> None:
        failures.append(str(error))

    async def drag() -> None:
        async def work(value: int) -> None:
            if value == 1:
                raise RuntimeError("the first scene is broken")
            worked.append(value)

        worker = LatestWins(work, failed=failed)
        for value in (1, 2):
            worker.submit(value)
            while not worker.idle:
                await asyncio.sleep(0.001)

    run(drag())
    assert worked == [2]
    assert failures == ["the first scene is broken"]


def test_a_stopped_worker_takes_nothing_more() -> None:
    worked: list[int] = []

    async def drag() -> None:
        async def work(value: int) -> None:
            worked.append(value)

        worker = LatestWins(work)
        worker.stop()
        worker.submit(1)
        await asyncio.sleep(0.01)

    run(drag())
    assert worked == []
