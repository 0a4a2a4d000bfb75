"""What plans, orbits and balls with mass are made with, compiled before anybody waits for it.

That takes longer than a first start should, and a compiler in this process would hold up every
page. So another process does it, once the first page is asked for, and leaves the machine code on
disk. Until then the page draws as it does while a slider moves.
"""

from __future__ import annotations

import atexit
import os
import subprocess
import threading

from numba.core.compiler_lock import global_compiler_lock

from bearingcore import kernels, presets
from bearingcore.experiments.balls import balls_experiment
from bearingcore.plan import SETTLED, plan
from bearingcore.warm_up import motions_with_mass, start_python


class StillCompiling(ValueError):  # noqa: N818
    """Something that cannot be had until all is compiled, and comes by itself then."""

    def __init__(self) -> None:
        super().__init__(
            "balls with mass are still being compiled for this computer, once; that takes about "
            "half a minute"
        )


_NICE = 5
"""How far the page goes first: at 10 two busy processes of others leave hardly anything."""
_IMPORT = f"from {__name__} import compile_behind"
_lock = threading.Lock()
_helper: subprocess.Popen[str] | None = None
_begun = False


def begin() -> None:
    """Start compiling what is not on disk yet; does nothing the second time."""
    global _helper, _begun
    with _lock:
        if _begun:
            return
        _begun = True
        if all_on_disk():
            return
        # in a session of its own: Ctrl+C is for the server, which ends it
        _helper = start_python(f"{_IMPORT}; compile_behind()", new_session=True)
        if _helper is not None:  # or all is compiled where it is needed
            atexit.register(_end)


def all_on_disk() -> bool:
    """Whether an earlier start has compiled everything."""
    return all(map(kernels.on_disk, _slowest()))


def ready() -> bool:
    """Whether all is compiled, or nobody is at it."""
    return _helper is None or _helper.poll() is not None


def here() -> bool:
    """Whether another thread of this process compiles: who needs that too waits for seconds."""
    lock = getattr(global_compiler_lock, "_lock", None)
    if lock is None or not lock.acquire(blocking=False):
        return lock is not None
    lock.release()
    return False


def compile_behind() -> None:
    """`compile_all`, behind what serves the page."""
    if hasattr(os, "nice"):
        os.nice(_NICE)
    compile_all()


def compile_all() -> None:
    """Move balls with mass, and plan what calls every kernel that planning and orbits need."""
    motions_with_mass()
    for name in ("fan-rig", "liew-lim"):
        for law in ("published", "no tension"):
            plan(presets[name].replace(contact_law=law), SETTLED, duration=0.1)
    balls_experiment(presets["fan-rig"], duration=0.05, steps=(2,))


def _slowest() -> tuple[object, ...]:
    """The kernels that take longest or are compiled last."""
    return (
        kernels.march_with_tangent,
        kernels.march_balls,
        kernels.race_loads,
    )


def _end() -> None:
    if _helper is not None and _helper.poll() is None:
        _helper.kill()
        _helper.wait()
