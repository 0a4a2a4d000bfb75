"""Background jobs of a session: one type of work for everything that does not follow a slider.

A job computes in a thread and never touches the page. It reports its progress, checks whether to go
on, and shows its results; the event loop of the session takes up all of these. Its kind says in
which pool it runs. Of each kind, a session has one job at work and at most one that waits. A newer
job replaces the one that waits, and asks the one at work to end. So no message, however often it is
sent, starts more than one job at a time, and the end of the session ends all of them.

Each session has at most one entry of a kind in the queue of a pool, so that sessions take turns. A
job of many steps gives its turn away between two of them.

Pictures that follow a slider are no jobs: `drawing_loop` draws them, by the same rule.
"""

from __future__ import annotations

import asyncio
import logging
import math
import threading
import time
from collections.abc import Awaitable, Callable, Generator
from dataclasses import dataclass
from typing import Any, Literal, TypeVar

from bearing_explorer.kit.compute.executors import ANSWERS, FILES, JOBS, Pool
from bearing_explorer.kit.sentences import sentence_of

log = logging.getLogger(__name__)

Result = TypeVar("Result")


@dataclass(frozen=True)
class Kind:
    """A kind of job, with its pool and its longest time; in a session, the newest of a kind wins.

    `longest` [s]: a job that works for longer is asked to end, with the results so far.
    """

    name: str
    pool: Pool
    longest: float = 300.0


SEARCH = Kind("search", ANSWERS)
"""A list is searched while a person types."""
OPENING = Kind("opening", ANSWERS)
"""A link or a kept scene is read."""
REPORT = Kind("report", ANSWERS)
"""A report is written."""
READING = Kind("reading", FILES, longest=60.0)
"""All files of an upload are read, an answer about a file is read, or a signal is simulated."""
COMPUTATION = Kind("computation", JOBS)
"""A map, a sweep or a trend that a person has started."""
PART, EXTENT = (Kind(name, JOBS) for name in ("part", "extent"))
"""Analyses of a signal: the damaged part, the extent of its spall."""
SIZING = Kind("sizing", JOBS)
"""Lengths of a spall are simulated and compared with a signal."""

_TICK = 0.12  # [s] between two looks at a job
_READABLE = 1.0  # [s] that a sentence is shown at least, so that it can be read, also aloud

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

    def __init__(self, longest: float = COMPUTATION.longest) -> None:
        self._stop = threading.Event()
        self._lock = threading.Lock()
        self._results: list[Any] = []
        self._longest = longest
        self.part = 0.0
        #: when it began, as if it had never waited between two steps
        self.started = math.nan
        self.timed_out = False

    def progress(self, part: float, _: str = "") -> None:
        """Report how much is done, 0 to 1."""
        self.part = min(max(float(part), 0.0), 1.0)

    def cancelled(self) -> bool:
        """Return True once the job should end, with the results so far."""
        if time.monotonic() - self.started > self._longest:
            self.timed_out = True
        return self.timed_out or self._stop.is_set()

    def show(self, result: Any) -> None:
        """Hand over a result to be drawn; where several wait, the newest wins."""
        with self._lock:
            self._results = [result]

    def take_results(self) -> list[Any]:
        """Take the result that waits to be drawn, if there is one."""
        with self._lock:
            results, self._results = self._results, []
        return results

    @property
    def has_result(self) -> bool:
        """True if a result waits to be drawn."""
        return bool(self._results)

    def stop(self) -> None:
        """Ask the work to end soon."""
        self._stop.set()

    @property
    def stopped(self) -> bool:
        """True once the work was asked to end."""
        return self._stop.is_set()


Change = Callable[[], None]
Compute = Callable[[Work], str | Generator[None, None, str]]
"""The computation of a job: it returns a sentence that sums up, and may yield between its steps."""

_WAITS = JobState("waiting", 0.0, "Waiting for another computation to end.")
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
        self._lanes: dict[Kind, _Lane] = {}
        self._ended = False

    def busy(self, kind: Kind | None = None) -> bool:
        """True if a job of a kind, or of any kind, runs or waits."""
        return bool(self._lanes) if kind is None else kind in self._lanes

    def start(
        self,
        compute: Compute,
        take: Callable[[Any], None],
        report: Callable[[JobState], None] | None = None,
        kind: Kind = COMPUTATION,
    ) -> None:
        """Begin a job in place of earlier jobs of its kind.

        Parameters
        ----------
        compute
            computes, in a thread. A ValueError that it raises is a sentence for the page.
        take
            gets each result that is shown, on the event loop.
        report
            gets the state of the job, on the event loop.
        """
        if self._ended:
            return
        job, lane = _Job(compute, take, report, kind), self._lanes.get(kind)
        if lane is None:
            lane = self._lanes[kind] = _Lane(job)
            lane.task = asyncio.get_running_loop().create_task(self._run(kind, lane))
            return
        overtaken, lane.waiting = lane.waiting, job
        if overtaken is not None and overtaken.report not in (None, report):
            overtaken.report(_NEVER_BEGAN)
        if lane.at_work is not None:
            lane.at_work.overtaken = True
            lane.at_work.work.stop()

    def answer(
        self, kind: Kind, compute: Callable[[], Result], take: Callable[[Result], None]
    ) -> None:
        """Begin a job of one step with one result."""

        def show(work: Work) -> str:
            work.show(compute())
            return ""

        self.start(show, take, kind=kind)

    def cancel(self, kind: Kind = COMPUTATION) -> None:
        """End the jobs of a kind; results that are shown already stay."""
        if (lane := self._lanes.get(kind)) is not None:
            for job in filter(None, (lane.at_work, lane.waiting)):
                job.work.stop()

    def drop(self, kind: Kind) -> None:
        """End the jobs of a kind, and ignore their results."""
        if (lane := self._lanes.get(kind)) is not None:
            lane.waiting = None
            if lane.at_work is not None:
                lane.at_work.dropped = True
                lane.at_work.work.stop()

    def stop(self) -> None:
        """Drop all jobs and start no more: the session is over."""
        self._ended = True
        for kind in self._lanes:
            self.drop(kind)

    async def _run(self, kind: Kind, lane: _Lane) -> None:
        while (job := lane.waiting) is not None:
            lane.at_work, lane.waiting = job, None
            try:
                await self._follow(lane, job)
            except Exception:  # of `take` or `report`: nothing else listens to this task
                log.exception("a job could not be followed")
                job.work.stop()
                job.take = lambda _: None
                await self._report(lane, job, _FAILED)
        del self._lanes[kind]

    async def _follow(self, lane: _Lane, job: _Job) -> None:
        """Queue one step of a job after the other, and report its progress and its end."""
        ended = False
        while not ended:
            if job.work.stopped:  # before it began, or between two steps
                await self._report(lane, job, _NEVER_BEGAN)
                return
            queued = job.kind.pool.submit(job.step)
            future = asyncio.wrap_future(queued)
            while not future.done():
                await self._look(job)
                if lane.waiting is not None:
                    await self._look(lane.waiting)
                await asyncio.wait({future}, timeout=_TICK)
                if job.work.stopped and queued.cancel():  # its turn had not come yet
                    break
            ended = not queued.cancelled() and (future.exception() or future.result()) is not None
        await self._close(lane, job, future.exception())

    async def _look(self, job: _Job) -> None:
        """Report the progress of a job, and show its results."""
        if job.report is None or job.overtaken or job.dropped:
            return
        state = job.state()
        if job.work.has_result or state != job.reported:
            job.reported = state
            await self._take_up(job, state)

    async def _take_up(self, job: _Job, state: JobState) -> None:
        results = job.work.take_results()
        if not results and job.report is None:
            return

        def change() -> None:
            for result in results:
                job.take(result)
            if job.report is not None:
                job.report(state)

        await self._assign(change)

    async def _close(self, lane: _Lane, job: _Job, error: BaseException | None) -> None:
        part = job.work.part
        if isinstance(error, ValueError):
            state = JobState("failed", part, sentence_of(error))
        elif error is not None:
            log.error("a job failed", exc_info=error)
            state = _FAILED
        elif job.overtaken:
            state = JobState("stopped", part, "Cancelled: replaced by a newer request.")
        elif job.work.stopped:
            state = JobState("stopped", part, f"Cancelled. {job.words}")
        elif job.work.timed_out:
            after = f"Stopped after {job.kind.longest:.0f} s."
            state = JobState("stopped", part, f"{after} {job.words}")
        else:
            state = JobState("done", 1.0, job.words)
        await self._report(lane, job, state)

    async def _report(self, lane: _Lane, job: _Job, state: JobState) -> None:
        """Report the end of a job, unless it is dropped or its view waits for a newer one."""
        newer = lane.waiting
        if not (job.dropped or (newer is not None and newer.report == job.report)):
            await self._take_up(job, state)


@dataclass(eq=False)
class _Lane:
    """The jobs of one kind in a session: one at work, one that waits, and their task."""

    waiting: _Job | None
    at_work: _Job | None = None
    task: asyncio.Task[None] | None = None


@dataclass(eq=False)
class _Job:
    """One job: its computation, its listeners, and its last report."""

    compute: Compute
    take: Callable[[Any], None]
    report: Callable[[JobState], None] | None
    kind: Kind
    overtaken: bool = False
    dropped: bool = False
    reported: JobState | None = None
    #: the sentence that sums up, once it has ended
    words: str = ""
    _steps: Generator[None, None, str] | None = None
    _left_at: float = math.nan
    _progress: str = ""
    _worded_at: float = -math.inf

    def __post_init__(self) -> None:
        self.work = Work(self.kind.longest)

    def step(self) -> bool | None:
        """Compute, in a thread, up to the next step (None) or to the end (True)."""
        now = time.monotonic()
        if self._steps is None:
            self.work.started = now
            begun = self.compute(self.work)
            if isinstance(begun, str):
                self.words = begun
                return True
            self._steps = begun
        else:
            self.work.started += now - self._left_at
        try:
            next(self._steps)
        except StopIteration as end:
            self.words = end.value
            return True
        self._left_at = time.monotonic()
        return None

    def state(self) -> JobState:
        """Return the progress; its sentence changes seldom enough to be read."""
        now = time.monotonic()
        spent = now - self.work.started
        part = math.floor(self.work.part * 200.0) / 200.0
        if math.isnan(spent):
            return _WAITS
        if now - self._worded_at >= _READABLE:
            self._worded_at = now
            self._progress = _progress_words(part, spent)
        return JobState("busy", part, self._progress)


def _progress_words(part: float, spent: float) -> str:
    """Say which share is done, and the time that the rest may take at the same rate."""
    if part < 0.02 or spent < 1.0:
        return "Computing."
    left = spent * (1.0 - part) / part
    rest = f"{left:.0f} s" if left < 90.0 else f"{left / 60.0:.0f} minutes"
    return f"Computing: {100.0 * part:.0f} % done, about {rest} left."
