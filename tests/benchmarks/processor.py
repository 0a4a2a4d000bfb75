"""Processor time and memory of processes: what a machine that others use too cannot hide.

A clock counts what neighbours take as well. The system counts what each process has worked.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

TICKS = os.sysconf("SC_CLK_TCK") if hasattr(os, "sysconf") else 100


def worked(process: int) -> float:
    """What a process has worked so far, all of its threads [s]; 0 where it is gone."""
    try:
        text = Path(f"/proc/{process}/stat").read_text()
    except OSError:
        return 0.0
    fields = text.rsplit(")", 1)[1].split()  # its name may hold anything
    return (int(fields[11]) + int(fields[12])) / TICKS


def resident(process: int) -> float:
    """The memory that a process holds [MB]; 0 where it is gone."""
    try:
        pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
    except OSError:
        return 0.0
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def started_by(process: int) -> Iterator[int]:
    """The processes that one has started, and those that they have."""
    try:
        tasks = list(Path(f"/proc/{process}/task").iterdir())
        children = [int(name) for task in tasks for name in (task / "children").read_text().split()]
    except OSError:
        return
    for child in children:
        yield child
        yield from started_by(child)


def is_browser(process: int) -> bool:
    """Whether a process is one of Chromium's."""
    try:
        program = Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")[0]
    except OSError:
        return False
    return b"chrom" in program


def worked_by_kind(server: int) -> dict[str, float]:
    """What this process and all that it started have worked [s].

    Of the "server", the "browser" and the "hand" that moves the mouse, which no page has to carry.
    """
    found = {"hand": worked(os.getpid()), "server": 0.0, "browser": 0.0}
    for process in started_by(os.getpid()):
        kind = "server" if process == server else "browser" if is_browser(process) else "hand"
        found[kind] += worked(process)
    return found
