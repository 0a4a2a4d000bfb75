"""Kernels are made ready in one thread of the server, part by part, behind pages that are open.

On a first start that compiles, which takes long; later starts read machine code from disk in a
second. Until then pages draw results that come with the package, their sliders do not move, and a
progress bar says why. What a part is needed for raises `StillCompiling`. Where nothing simulates,
it is not begun, and Numba is not imported.

numba holds the interpreter as it compiles, which a page that is being made needs too: compiling
begins once the first picture is sent, or after `FIRST_PICTURE` where none is asked for.
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
    """A part that is needed is still being compiled; it comes by itself."""

    def __init__(self, part: str) -> None:
        super().__init__(f"{_WORDS[part]}: still being compiled for this computer, once")


class Compilation:
    """The compiling of a process; `begin` starts it."""

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
        """Compile in a thread; does nothing the second time.

        `meanwhile` is called where that will take long, to have something to draw until then.
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
        """A picture is sent: compiling may begin."""
        self._drawn.set()

    def wait(self, seconds: float) -> bool:
        """Wait at most this many seconds; return True if compiling has ended."""
        return self._over.wait(seconds)

    def left(self) -> tuple[str, ...]:
        """Parts that are not ready yet; none where nothing is being compiled."""
        return self._left

    def need(self, part: str, scene: Scene | None = None) -> None:
        """Raise `StillCompiling` where a part, or that of a scene's balls, is not ready."""
        for name in (part, BALLS_WITH_MASS if scene and scene.balls == WITH_MASS else part):
            if name in self._left:
                raise StillCompiling(name)

    def progress(self) -> dict[str, object]:
        """The parts that are ready, for a progress bar; empty where all are.

        `still`: whether sliders do not move yet.
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
