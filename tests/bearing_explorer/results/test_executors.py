"""Work off the event loop."""

import asyncio
import threading

from bearing_explorer.results.executors import FILES, in_thread

from tests.helpers.loops import run


def test_two_files_are_read_at_a_time_and_pictures_do_not_wait_for_them() -> None:
    started, go_on = threading.Semaphore(0), threading.Event()
    at_work: list[str] = []

    def read() -> None:
        at_work.append(threading.current_thread().name)
        started.release()
        assert go_on.wait(60.0)

    async def upload() -> int:
        reading = [asyncio.ensure_future(in_thread(read, pool=FILES)) for _ in range(5)]
        for _ in range(2):
            await in_thread(started.acquire)  # in another pool: it is not held up
        count = len(at_work)
        go_on.set()
        await asyncio.gather(*reading)
        return count

    assert run(upload()) == 2
    assert len(at_work) == 5
