"""What a session does while its hand rests: begun late, given up at once."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable, Hashable
from typing import Generic, TypeVar

from bearing_explorer.results.executors import PLANS
from bearing_explorer.results.scheduler import Scheduler

log = logging.getLogger(__name__)

RESTS_AFTER = 0.25
"""[s] without anything newer after the last picture after which the hand counts as at rest."""

Inputs = TypeVar("Inputs")
Found = TypeVar("Found")


class IdleTask(Generic[Inputs, Found]):
    """Waits until the hand rests, works, and hands over; anything newer ends it.

    Parameters
    ----------
    work
        its second argument says whether it was overtaken meanwhile. It runs in a thread, or in
        turn with pictures where its `kind` was light before; what has no kind always in a thread.
    hand_over
        on the event loop, with what was found, if nothing newer came.
    drawn
        waits until what was asked for is drawn: only then rest can begin.
    """

    def __init__(
        self,
        work: Callable[[Inputs, Callable[[], bool]], Found],
        hand_over: Callable[[Inputs, Found], None],
        drawn: Callable[[], Awaitable[None]],
        scheduler: Scheduler,
        kind: Callable[[Inputs], Hashable | None],
        after: float = RESTS_AFTER,
    ) -> None:
        self._work, self._hand_over, self._drawn, self._after = work, hand_over, drawn, after
        self._scheduler, self._kind = scheduler, kind
        self._number = 0
        self._task: asyncio.Task[None] | None = None

    @property
    def idle(self) -> bool:
        """Whether there is nothing to wait for."""
        return self._task is None or self._task.done()

    def begin(self, inputs: Inputs) -> None:
        """Something was asked for: wait for rest from now on. On the event loop."""
        self.end()
        self._task = asyncio.get_running_loop().create_task(self._run(inputs, self._number))

    def end(self) -> None:
        """Give up what is waited for or worked on."""
        self._number += 1
        if self._task is not None:
            self._task.cancel()
            self._task = None  # its last error knows where it was, which is in here

    async def _run(self, inputs: Inputs, number: int) -> None:
        # The page asks for the next picture only when the last is there. Counted from the question,
        # a hand would seem to rest while it waits for a slow server, and plans for what it has left
        # behind would make the server slower still.
        await self._drawn()
        await asyncio.sleep(self._after)

        def work() -> Found:
            found = self._work(inputs, lambda: number != self._number)
            if number != self._number:  # what it cost until then says nothing
                raise asyncio.CancelledError
            return found

        try:
            # cancelled before its turn, it never begins; later, nobody hears of it
            found = await self._scheduler.run_idle(PLANS, self._kind(inputs), work)
        except Exception:
            log.exception("planning failed")
            return
        self._hand_over(inputs, found)
