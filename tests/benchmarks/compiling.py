"""What a first start compiles, kernel by kernel: ``python -m tests.benchmarks.compiling``.

Everything that `bearingcore.warm` calls, in this one process and with nothing on disk. Times are of
the processor, so that other work on the machine changes them little; a kernel's holds all that it
calls. The first picture of the page needs the kernels of statics, marked so: they cannot be had
sooner than the longest of them takes, however many processors there are.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time

FIRST = ("ball_path", "static_states", "contact_angles")
"""Kernels of the first tab: balls, loads, depth."""


def compile_all() -> None:
    """In a process of its own, in which nothing is compiled yet."""
    begun = time.process_time()
    from numba.core import event

    class Compiling(event.Listener):
        """Processor time of the outermost functions that are compiled."""

        def __init__(self) -> None:
            self.open: list[tuple[str, float]] = []
            self.seconds: dict[str, float] = {}

        def on_start(self, heard: event.Event) -> None:
            self.open.append((heard.data["dispatcher"].py_func.__name__, time.process_time()))

        def on_end(self, heard: event.Event) -> None:
            name, since = self.open.pop()
            if not self.open:
                took = time.process_time() - since
                self.seconds[name] = self.seconds.get(name, 0.0) + took

    listener = Compiling()
    event.register("numba:compile", listener)
    from bearing_explorer.page import page  # noqa: F401

    from bearingcore import warm_up

    imported = time.process_time() - begun
    warm_up.warm(lambda _: None)
    from tests.benchmarks.machine import pace

    machine = pace()
    print(machine)
    print(f"{'loading the page':<26}{imported:>8.1f} s{machine.ratio(imported):>10}")
    for name, seconds in sorted(listener.seconds.items(), key=lambda each: -each[1]):
        first = "   before the first picture" if name in FIRST else ""
        print(f"{name:<26}{seconds:>8.1f} s{machine.ratio(seconds):>10}{first}")
    whole = sum(listener.seconds.values())
    print(f"{'all':<26}{whole:>8.1f} s{machine.ratio(whole):>10}")


def main() -> int:
    """Run it where nothing is on disk."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--here", action="store_true", help="in this process")
    if parser.parse_args().here:
        compile_all()
        return 0
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "NUMBA_CACHE_DIR": folder, "OPENBLAS_NUM_THREADS": "1"}
        command = [sys.executable, "-m", "tests.benchmarks.compiling", "--here"]
        return subprocess.run(command, env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
