"""Compiling the kernels in one thread of the server, part by part, while pages are open.

The first start compiles them, which takes long; later starts read machine code from disk in a
second. Until they are ready, pages draw stored results, their sliders do not move, and a progress
bar says why. A computation that needs a missing part raises `StillCompiling`. Without the half of
the page that simulates, nothing is compiled, and Numba is not imported.

Numba holds the interpreter lock as it compiles, and a page that is being made needs that too. So
compiling begins once the first picture is sent, or after `FIRST_PICTURE` if none is requested.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

from bearingcore import Scene, model, warm
from bearingcore.model import BALLS_WITH_MASS, MOTION, ORBITS, PARTS, STATICS
from bearingcore.model.scene import WITH_MASS

__all__ = ["BALLS_WITH_MASS", "MOTION", "ORBITS", "STATICS", "StillCompiling"]

log = logging.getLogger(__name__)

FIRST_PICTURE = 5.0
"""Time [s] that compiling waits for a first picture."""

_WORDS = {
    STATICS: "loads and stiffness",
    MOTION: "vibration",
    BALLS_WITH_MASS: "balls with mass",
    ORBITS: "steady orbits",
}


def all_on_disk() -> bool:
    """True if machine code of all parts is on disk, so that nothing takes long."""
    return model.all_on_disk()


class StillCompiling(ValueError):  # noqa: N818
    """A part that is needed is still being compiled; it will be ready by itself."""

    def __init__(self, part: str) -> None:
        super().__init__(f"{_WORDS[part]}: still being compiled for this computer, once")


class Compilation:
    """The compilation of all kernels in a process; `begin` starts it."""

    def __init__(self) -> None:
        self._begun = False
        self._left: tuple[str, ...] = ()
        self._drawn = threading.Event()
        self._over = threading.Event()
        self._lock = threading.Lock()

    def begin(
        self,
        meanwhile: Callable[[], object] = lambda: None,
        report: Callable[[str], object] = log.info,
        done: Callable[[], object] = lambda: None,
    ) -> None:
        """Compile in a thread; a second call does nothing.

        `meanwhile` is called if that will take long: it provides results to draw until then.
        `report` gets a line for each part. `done` is called in the thread at the end.
        """
        with self._lock:
            if self._begun:
                return
            self._begun, self._left = True, tuple(PARTS)
        if all_on_disk():
            self._drawn.set()
        else:
            meanwhile()
        threading.Thread(
            target=self._work, args=(report, done), name="compile", daemon=True
        ).start()

    def drawn(self) -> None:
        """Let compiling begin: a picture is sent."""
        self._drawn.set()

    def wait(self, seconds: float) -> bool:
        """Wait at most this many seconds; return True if compiling has ended."""
        return self._over.wait(seconds)

    def left(self) -> tuple[str, ...]:
        """Return the parts that are not ready yet; none if nothing is being compiled."""
        return self._left

    def need(self, part: str, scene: Scene | None = None) -> None:
        """Raise `StillCompiling` if a part, or the part for the scene's balls, is not ready."""
        for name in (part, BALLS_WITH_MASS if scene and scene.balls == WITH_MASS else part):
            if name in self._left:
                raise StillCompiling(name)

    def progress(self) -> dict[str, object]:
        """Return the progress for a bar; empty where all parts are ready.

        `still` is True while sliders do not move.
        """
        left = self._left
        if not left:
            return {}
        still = STATICS in left
        shown = "The default scene is shown, as computed beforehand. " if still else ""
        words = f"{shown}Being compiled for this computer, once: {_WORDS[left[0]]}"
        return {"done": len(PARTS) - len(left), "of": len(PARTS), "words": words, "still": still}

    def _work(self, report: Callable[[str], object], done: Callable[[], object]) -> None:
        self._drawn.wait(FIRST_PICTURE)
        try:
            for part in PARTS:
                warm(report, (part,))
                self._left = self._left[1:]
        except Exception:
            log.exception("compiling failed; kernels are compiled where they are needed")
        finally:
            self._left = ()
            self._over.set()
            done()


_current = Compilation()
begin, wait, left = _current.begin, _current.wait, _current.left
need, progress, drawn = _current.need, _current.progress, _current.drawn
