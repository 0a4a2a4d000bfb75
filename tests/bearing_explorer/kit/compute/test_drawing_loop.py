"""The newest inputs win, and what rests is drawn finely, unless newer inputs come."""

import asyncio
import threading
from collections.abc import Callable

import pytest
from bearing_explorer.kit.compute import drawing_loop
from bearing_explorer.kit.compute.drawing_loop import DrawingLoop

from tests.helpers.loops import run


class Page:
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
    page = Page(seconds=0.01)

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
    page = Page()

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
    page = Page()

    async def live() -> None:
        for inputs in (-1, 0):
            page.loop.submit(inputs)
            await until(lambda: page.loop.idle)

    run(live())
    assert [str(error) for error in page.errors] == ["a bug"]
    assert (page.drawn, page.fine) == ([0], [])


def test_a_thread_takes_the_newest_and_a_stopped_loop_takes_nothing() -> None:
    page = Page(seconds=0.05)

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
