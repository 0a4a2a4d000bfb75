"""Kernels are compiled in one thread of the server: first what the first tab needs, then the rest.

The first part takes 25 s of processor time on a first start; a waiting page stands in for the
explorer meanwhile. The second, for balls with mass and orbits, takes 45 s more; the page is open
then, and views that need it say so. Afterwards both are read from disk in a second.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable

from bearingcore import kernels, orbit, presets, warm
from bearingcore.experiments.balls import BALL_METHODS
from bearingcore.warm_up import motions_with_mass

log = logging.getLogger(__name__)

WAITING = (
    "The kernels are being compiled for this processor. That is done once and takes about "
    "half a minute; {:.0f} s have passed. The explorer opens here by itself."
)


class StillCompiling(ValueError):  # noqa: N818
    """Something that cannot be computed until all is compiled, and comes by itself then."""

    def __init__(self) -> None:
        super().__init__(
            "balls with mass are still being compiled for this computer, once; that takes about "
            "a minute"
        )


class Compilation:
    """The compiling of a process; `begin` starts it."""

    def __init__(self) -> None:
        self.failed: Exception | None = None
        """The error that ended the first part."""
        self._begun = 0.0  # [s] of `time.monotonic`; 0 before
        self._first = threading.Event()
        self._all = threading.Event()
        self._lock = threading.Lock()

    def begin(
        self,
        report: Callable[[str], object] = log.info,
        load: Callable[[], object] = lambda: None,
        done: Callable[[], object] = lambda: None,
    ) -> None:
        """Compile in a thread; does nothing the second time.

        `report` gets a line for each part. `load` is called before there is a page: to import what
        takes long, and must not be imported by two threads at once. `done` is called in the thread
        once the first part has ended, however it ended.
        """
        with self._lock:
            if self._begun:
                return
            self._begun = time.monotonic()
        threading.Thread(
            target=self._work, args=(report, load, done), name="compile", daemon=True
        ).start()

    def startup_message(self) -> str:
        """A sentence for the waiting page; empty once the first part is compiled."""
        if not self._begun or self._first.is_set():
            return ""
        return WAITING.format(time.monotonic() - self._begun)

    def ready(self) -> bool:
        """Whether all is compiled, or nothing is being compiled."""
        return not self._begun or self._all.is_set()

    def _work(self, report: Callable[[str], object], *then: Callable[[], object]) -> None:
        load, done = then
        try:
            warm(report)
            load()
        except Exception as error:
            self.failed = error
        finally:
            self._first.set()
            done()
        try:
            if self.failed is None and not all_on_disk():
                compile_rest()
        except Exception:
            log.exception("compiling failed; the rest is compiled where it is needed")
        finally:
            self._all.set()


_current = Compilation()
begin, ready, startup_message = _current.begin, _current.ready, _current.startup_message


def failed() -> Exception | None:
    """The error that ended the first part; None where all is well."""
    return _current.failed


def all_on_disk() -> bool:
    """Whether an earlier start has compiled everything."""
    return all(map(kernels.on_disk, _slowest()))


def compile_rest() -> None:
    """Move balls with mass, and look for orbits."""
    motions_with_mass()
    for name in ("fan-rig", "liew-lim"):
        for law in ("published", "no tension"):
            orbit(presets[name].replace(contact_law=law))
    for march in BALL_METHODS.values():
        march(presets["fan-rig"].replace(balls="with mass"), 2, 0.01, 65536.0)


def _slowest() -> tuple[object, ...]:
    """The kernels that take longest or are compiled last."""
    return (
        kernels.march_with_tangent,
        kernels.march_balls,
        kernels.race_loads,
    )
