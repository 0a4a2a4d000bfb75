"""Reading of foreign files in a separate process, with limits of time and memory.

Libraries read every format. On damaged or crafted files they may crash, unpack without end or need
hours. The process is then ended, and a sentence says so. A process returns only a line of JSON and
one matrix of numbers, which cannot run any code here.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from threading import Event, Thread
from typing import IO, Any

import numpy as np

from bearingcore.common import Array, _checks as checks
from bearingcore.measured.files._variables import MOST_NUMBERS

PROCESSOR_SECONDS = 10
"""Greatest processor time [s] for reading a file."""

WALL_SECONDS = 20.0
"""Greatest time by the clock [s] for reading a file."""

MEMORY = 500 * 10**6
"""Greatest memory [bytes] of the process in addition to its libraries."""

LONGEST_ANSWER = 2**22
"""Longest line of JSON [bytes] that is read back."""

_TICK = 0.1
"""Time [s] between two checks of the process."""

_PROGRAM = Path(__file__).with_name("_child_program.py")
_ENVIRONMENT = {
    "HDF5_PLUGIN_PATH": "::",  # no plugin is loaded
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
}


def read_file(
    name: str, content: bytes, give_up: Callable[[], bool] | None = None
) -> tuple[dict[str, Any], Array]:
    """Read words and numbers of a file: text (CSV), WAV, MATLAB or HDF5, by its first bytes.

    Parameters
    ----------
    name
        name of the file, for sentences; ".mat" at its end marks MATLAB's version 4.
    content
        the whole file.
    give_up
        called every tenth of a second; True ends the process.

    Returns
    -------
    about
        the fields of `_contents.FileColumns` by name, without the columns.
    columns : (n, c)
        the numbers; gaps are NaN.

    Raises
    ------
    FieldError
        for a damaged, empty or mis-shaped file, or one that takes too much time or memory.
    """
    try:
        child = subprocess.Popen(
            [sys.executable, "-I", str(_PROGRAM)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **_ENVIRONMENT},
        )
    except OSError:
        raise checks.refuse("file", name, "read by a process (none could start)") from None
    assert child.stdin is not None
    assert child.stdout is not None
    head = json.dumps([name, PROCESSOR_SECONDS, MEMORY]).encode() + b"\n"
    sender = Thread(target=_send, args=(child.stdin, head, content), daemon=True)
    ended = Event()
    watch = Thread(target=_watch, args=(child, ended, give_up), daemon=True)
    sender.start()
    watch.start()
    try:
        answer = _receive(child.stdout)
        is_late = not watch.is_alive()
    finally:
        ended.set()
        child.kill()
        code = child.wait()
        child.stdout.close()
        sender.join()
    if answer is None:
        allowed = "one without a damaged or unknown part"
        if is_late or code == -getattr(signal, "SIGXCPU", 0):
            allowed = f"one that can be read within {PROCESSOR_SECONDS} s"
        raise checks.refuse("file", name, allowed)
    about, columns = answer
    if "refused" in about:
        raise checks.refuse(*about["refused"])
    return about, columns


def _watch(
    child: subprocess.Popen[bytes], ended: Event, give_up: Callable[[], bool] | None
) -> None:
    """End the process if it is late or its answer is no longer wanted."""
    latest = time.monotonic() + WALL_SECONDS
    while not ended.wait(_TICK):
        if time.monotonic() > latest or (give_up is not None and give_up()):
            child.kill()
            return


def _send(pipe: IO[bytes], head: bytes, content: bytes) -> None:
    with suppress(OSError), pipe:  # a process that has ended reads no more
        pipe.write(head)
        pipe.write(content)


def _receive(pipe: IO[bytes]) -> tuple[dict[str, Any], Array] | None:
    """Receive the output of the process, limited in size; None if it ended early."""
    line = pipe.readline(LONGEST_ANSWER)
    if not line.endswith(b"\n"):
        return None
    try:
        about = json.loads(line)
    except (ValueError, RecursionError):
        return None
    rows, width = about.pop("shape", (0, 0))
    if rows * width > MOST_NUMBERS:
        return None
    columns = np.empty((rows, width), order="F")
    rest = columns.ravel(order="K").view(np.uint8).data
    while rest:
        count = pipe.readinto(rest)  # type: ignore[attr-defined]
        if not count:
            return None
        rest = rest[count:]
    return about, columns
