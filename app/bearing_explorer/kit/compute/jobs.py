"""Long computations of a session, in the background: one at a time, with progress and cancel.

The work runs in a thread and never touches the page. It reports its progress, checks whether to go
on, and shows what it has found so far; all of that is taken up on the event loop of the session,
a few times a second. A new job replaces the one before, and the end of the session cancels.

The threads are not those that draw: however many people compute maps, sliders stay lively. Where
more people compute than there are threads, jobs wait for their turn.
"""

from __future__ import annotations

import asyncio
import logging
import math
import threading
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any, Literal

from bearing_explorer.kit.compute.executors import JOBS
from bearing_explorer.kit.sentences import sentence_of

log = logging.getLogger(__name__)

LONGEST = 300.0
"""[s] after which a job is ended, with what it has found until then."""

_TICK = 0.12  # [s] between two looks at a job
_ASIDE = 1.0  # [s] that a sentence is shown at least, so that it can be read and read out

Mood = Literal["idle", "waiting", "busy", "done", "stopped", "failed"]


@dataclass(frozen=True)
class JobState:
    """Progress of a job: `part` of it is done, 0 to 1; `words` is a sentence for the page."""

    mood: Mood
    part: float
    words: str

    @property
    def running(self) -> bool:
        """True while there is something to cancel."""
        return self.mood in ("waiting", "busy")


class Work:
    """The session as a job sees it from its thread; can be passed to the core."""

    def __init__(self, longest: float = LONGEST) -> None:
        self._stop = threading.Event()
        self._lock = threading.Lock()
        self._found: list[Any] = []
        self._longest = longest
        self.part = 0.0
        self.started = math.nan
        self.timed_out = False

    def progress(self, part: float, _: str = "") -> None:
        """Report how much is done, 0 to 1."""
        self.part = min(max(float(part), 0.0), 1.0)

    def within(self, begin: float, end: float) -> Callable[[float, str], None]:
        """Progress of a share of the job, from `begin` to `end` of the whole."""

        def progress(part: float, words: str) -> None:
            self.progress(begin + (end - begin) * part, words)

        return progress

    def cancelled(self) -> bool:
        """True once the job should end, with what it has."""
        if time.monotonic() - self.started > self._longest:
            self.timed_out = True
        return self.timed_out or self._stop.is_set()

    def show(self, found: Any) -> None:
        """Hand over a result to be drawn; where several wait, the newest wins."""
        with self._lock:
            self._found = [found]

    def taken(self) -> list[Any]:
        """The result that waits to be drawn, if there is one."""
        with self._lock:
            found, self._found = self._found, []
        return found

    @property
    def has_found(self) -> bool:
        """Whether a result waits to be drawn."""
        return bool(self._found)

    def stop(self) -> None:
        """Ask the work to end soon."""
        self._stop.set()

    @property
    def stopped(self) -> bool:
        """True once it was cancelled."""
        return self._stop.is_set()


Change = Callable[[], None]

_NEVER_BEGAN = JobState("stopped", 0.0, "Cancelled before it began.")
_FAILED = JobState("failed", 0.0, "This could not be computed.")


class Jobs:
    """The background of one session. Call its methods on the event loop of the session.

    Parameters
    ----------
    assign
        runs a change of the page's models and sends it, as `live.one_message` does.
    """

    def __init__(self, assign: Callable[[Change], Awaitable[None]]) -> None:
        self._assign = assign
        self._job: _Job | None = None
        self._ended = False

    @property
    def busy(self) -> bool:
        """True while a job runs or waits."""
        return self._job is not None and not self._job.task.done()

    def start(
        self,
        work: Callable[[Work], str],
        take: Callable[[Any], None],
        report: Callable[[JobState], None],
    ) -> None:
        """Begin `work` in place of what is at work.

        Parameters
        ----------
        work
            computes, in a thread; returns a sentence that sums up. A ValueError is a sentence too.
        take
            gets each result that is shown, on the event loop.
        report
            gets the state of the job, on the event loop.
        """
        if self._ended:
            return
        before = self._job
        self._job = job = _Job(work, take, report)
        job.task = asyncio.get_running_loop().create_task(self._run(job, before))
        if before is not None:
            before.work.stop()

    def cancel(self) -> None:
        """End the job at work; what it has found stays."""
        if self._job is not None:
            self._job.work.stop()

    def stop(self) -> None:
        """The session is over."""
        self._ended = True
        self.cancel()

    async def _run(self, job: _Job, before: _Job | None) -> None:
        try:
            await self._follow(job, before)
        except Exception:  # of what takes results and states; this task has no other listener
            log.exception("a job could not be followed")
            job.work.stop()
            await self._report(job, _FAILED)

    async def _follow(self, job: _Job, before: _Job | None) -> None:
        if before is not None:
            while not before.task.done():
                await self._look(job)
                await asyncio.wait({before.task}, timeout=_TICK)
        if job.work.stopped:
            await self._report(job, _NEVER_BEGAN)
            return
        waiting = JOBS.submit(job.run)
        future = asyncio.wrap_future(waiting)
        while not future.done():
            await self._look(job)
            await asyncio.wait({future}, timeout=_TICK)
            if job.work.stopped and waiting.cancel():  # its turn had not come yet
                await self._report(job, _NEVER_BEGAN)
                return
        if not self._ended:
            await self._close(job, future)

    async def _look(self, job: _Job) -> None:
        """Take up what a job reports."""
        state = job.state()
        if not (self._ended or (not job.work.has_found and state == job.reported)):
            job.reported = state
            if job is self._job:
                await self._take_up(job, state)

    async def _take_up(self, job: _Job, state: JobState) -> None:
        found = job.work.taken()

        def change() -> None:
            for result in found:
                job.take(result)
            job.report(state)

        await self._assign(change)

    async def _close(self, job: _Job, future: asyncio.Future[str]) -> None:
        part = job.work.part
        error = future.exception()
        if isinstance(error, ValueError):
            state = JobState("failed", part, sentence_of(error))
        elif error is not None:
            log.error("a job failed", exc_info=error)
            state = _FAILED
        elif job is not self._job:
            state = JobState("stopped", part, "Cancelled: replaced by a newer request.")
        elif job.work.stopped:
            state = JobState("stopped", part, f"Cancelled. {future.result()}")
        elif job.work.timed_out:
            state = JobState("stopped", part, f"Stopped after {LONGEST:.0f} s. {future.result()}")
        else:
            state = JobState("done", 1.0, future.result())
        await self._report(job, state)

    async def _report(self, job: _Job, state: JobState) -> None:
        """Report the end of a job, unless its view works on a newer one."""
        newer = self._job
        if self._ended or (newer is not None and newer is not job and newer.report == job.report):
            return
        await self._take_up(job, state)


class _Job:
    """One job: what it does, whom it reports to, and what it reported last."""

    task: asyncio.Task[None]

    def __init__(
        self,
        compute: Callable[[Work], str],
        take: Callable[[Any], None],
        report: Callable[[JobState], None],
    ) -> None:
        self.work = Work()
        self.take = take
        self.report = report
        self.reported: JobState | None = None
        self._compute = compute
        self._words = ""
        self._said_at = -math.inf

    def run(self) -> str:
        """In a thread."""
        self.work.started = time.monotonic()
        return self._compute(self.work)

    def state(self) -> JobState:
        """The progress; its sentence changes seldom enough to be read."""
        now = time.monotonic()
        spent = now - self.work.started
        part = math.floor(self.work.part * 200.0) / 200.0
        if math.isnan(spent):
            return JobState("waiting", 0.0, "Waiting for another computation to end.")
        if now - self._said_at >= _ASIDE:
            self._said_at = now
            self._words = _progress_words(part, spent)
        return JobState("busy", part, self._words)


def _progress_words(part: float, spent: float) -> str:
    """Share done, and the time that the rest may take [s] at the same rate."""
    if part < 0.02 or spent < 1.0:
        return "Computing."
    left = spent * (1.0 - part) / part
    rest = f"{left:.0f} s" if left < 90.0 else f"{left / 60.0:.0f} minutes"
    return f"Computing: {100.0 * part:.0f} % done, about {rest} left."
