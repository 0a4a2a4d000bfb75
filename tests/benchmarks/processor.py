"""Processor time and memory of processes: what a machine that others use too cannot hide.

A clock counts what neighbours take as well. The system counts what each process has worked.
"""

import psutil


def worked(process: int) -> float:
    """What a process has worked so far, all of its threads [s]; 0 where it is gone."""
    try:
        times = psutil.Process(process).cpu_times()
    except psutil.NoSuchProcess:
        return 0.0
    return float(times.user + times.system)


def resident(process: int) -> float:
    """The memory that a process holds [MB]."""
    return float(psutil.Process(process).memory_info().rss) / 1e6


def worked_by_kind(server: int) -> dict[str, float]:
    """What this process and all that it started have worked [s].

    Of the "server", the "browser" and the "hand" that moves the mouse, which no page has to carry.
    """
    found = {"hand": worked(psutil.Process().pid), "server": 0.0, "browser": 0.0}
    for process in psutil.Process().children(recursive=True):
        try:
            browser = "chrom" in process.exe()
        except psutil.Error:
            continue
        kind = "server" if process.pid == server else "browser" if browser else "hand"
        found[kind] += worked(process.pid)
    return found
