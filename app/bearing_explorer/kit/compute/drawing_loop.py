"""The drawing loop of a session: the newest inputs, and a fine picture once a slider rests."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable
from typing import Generic, TypeVar

from bearing_explorer.kit.compute.executors import FINE, run_in_thread

log = logging.getLogger(__name__)

RESTS_AFTER = 0.3
"""Time [s] after a picture without newer inputs from which a slider counts as at rest."""

Inputs = TypeVar("Inputs")
Fine = TypeVar("Fine")


class DrawingLoop(Generic[Inputs, Fine]):
    """Draws the newest inputs, and drops older ones that still wait.

    Slider events come faster than scenes can be drawn. In a queue they would pile up, and the
    picture would move on after the slider has stopped. Here at most one set of inputs waits.

    Parameters
    ----------
    draw
        draws inputs on the event loop, and returns those that it has drawn: `newest` may have given
        it newer ones.
    refine
        computes the fine picture of inputs, in a thread; None where there is nothing finer.
    draw_fine
        draws such a picture, on the event loop.
    failed
        called with an exception that one of these functions has raised.
    """

    def __init__(
        self,
        draw: Callable[[Inputs], Awaitable[Inputs]],
        refine: Callable[[Inputs], Fine | None],
        draw_fine: Callable[[Inputs, Fine], Awaitable[None]],
        failed: Callable[[Exception], Awaitable[None]],
    ) -> None:
        self._draw, self._refine, self._draw_fine = draw, refine, draw_fine
        self._failed = failed
        self._newest: list[Inputs] = []
        self._submitted = asyncio.Event()
        self._task: asyncio.Task[None] | None = None
        self._drawing = False
        self._stopped = False

    @property
    def waiting(self) -> bool:
        """True if there are newer inputs than those at work. For any thread."""
        return bool(self._newest)

    @property
    def drawn(self) -> bool:
        """True if the newest inputs are drawn."""
        return not (self._newest or self._drawing)

    @property
    def idle(self) -> bool:
        """True if the newest inputs are drawn finely."""
        return not self._newest and (self._task is None or self._task.done())

    def newest(self, inputs: Inputs) -> Inputs:
        """Return newer inputs if there are any, else `inputs`. For any thread.

        While many sessions wait for a thread, a slider moves on.
        """
        try:
            return self._newest.pop()
        except IndexError:
            return inputs

    def submit(self, inputs: Inputs) -> None:
        """Take these inputs as the newest. Call it on the event loop of the session."""
        if self._stopped:
            return
        self._newest = [inputs]
        self._submitted.set()
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._run())

    def stop(self) -> None:
        """Draw nothing more: the session is over."""
        self._stopped = True
        self._newest = []
        if self._task is not None:
            self._task.cancel()
            self._task = None

    async def _run(self) -> None:
        while self._newest:
            inputs = self._newest.pop()
            self._drawing = True
            try:
                inputs = await self._draw(inputs)
            except Exception as error:
                await self._report(error)
                continue
            finally:
                self._drawing = False
            if await self._rests():
                await self._draw_finely(inputs)

    async def _rests(self) -> bool:
        """True if no newer inputs come for a while."""
        if self._newest:
            return False
        self._submitted.clear()
        try:
            await asyncio.wait_for(self._submitted.wait(), RESTS_AFTER)
        except TimeoutError:
            return True
        return False

    async def _draw_finely(self, inputs: Inputs) -> None:
        """Draw finely, unless newer inputs come first: they do not wait for it."""
        fine = asyncio.ensure_future(run_in_thread(self._refine, inputs, pool=FINE))
        newer = asyncio.ensure_future(self._submitted.wait())
        try:
            await asyncio.wait({fine, newer}, return_when=asyncio.FIRST_COMPLETED)
            if not newer.done() and (picture := fine.result()) is not None:
                await self._draw_fine(inputs, picture)
        except Exception as error:
            await self._report(error)
        finally:
            newer.cancel()
            fine.cancel()

    async def _report(self, error: Exception) -> None:
        log.error("drawing a scene failed", exc_info=error)
        await self._failed(error)
