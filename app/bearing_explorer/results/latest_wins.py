"""One worker that works on the newest inputs: it keeps a dragged page from falling behind."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable
from typing import Generic, TypeVar

log = logging.getLogger(__name__)

Inputs = TypeVar("Inputs")


class LatestWins(Generic[Inputs]):
    """One worker that always works on the newest inputs and drops what they overtook.

    Slider events come faster than scenes can be drawn. A queue would grow into a tail that
    moves on after the hand has stopped; here at most one set of inputs waits.
    """

    def __init__(
        self,
        work: Callable[[Inputs], Awaitable[None]],
        failed: Callable[[Exception], Awaitable[None]] | None = None,
    ) -> None:
        self._work = work
        self._failed = failed
        self._newest: list[Inputs] = []
        self._task: asyncio.Task[None] | None = None
        self._stopped = False

    @property
    def waiting(self) -> bool:
        """Whether newer inputs wait than those at work."""
        return bool(self._newest)

    def newest(self, inputs: Inputs) -> Inputs:
        """The newest inputs there are in place of `inputs`, from any thread.

        Where many sessions wait for their turn, a hand has moved on meanwhile.
        """
        waiting = self._newest
        try:
            return waiting.pop()
        except IndexError:
            return inputs

    def put_back(self, inputs: Inputs) -> None:
        """Have `newest` inputs wait again, unless newer ones do."""
        if not self._newest:
            self._newest = [inputs]

    @property
    def idle(self) -> bool:
        """Whether all that was submitted has been worked on or overtaken."""
        return not self._newest and (self._task is None or self._task.done())

    async def finished(self) -> None:
        """Wait until all that was submitted has been worked on or overtaken."""
        while self._task is not None and not self._task.done():
            await asyncio.wait({self._task})

    def submit(self, inputs: Inputs) -> None:
        """Take these inputs as the newest. Call it on the event loop of the session."""
        if self._stopped:
            return
        self._newest = [inputs]
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._run())

    def stop(self) -> None:
        """Take no more inputs; the session is gone."""
        self._stopped = True
        self._newest = []
        if self._task is not None:
            self._task.cancel()
            self._task = None  # its last error knows where it was, which is in here

    async def _run(self) -> None:
        while True:
            try:
                inputs = self._newest.pop()
            except IndexError:
                return
            try:
                await self._work(inputs)
            except Exception as error:
                log.exception("drawing a scene failed")
                if self._failed is not None:
                    await self._failed(error)
