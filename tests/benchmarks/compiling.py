"""The compile work of a first start: ``python -m tests.benchmarks.compiling``.

A process of its own, with an empty folder for machine code, calls `bearingcore.warm`. Printed are
seconds of its processor for each part, and the Python calls in numba's own files, which other work
on the machine does not change. `--tree` measures another checkout in the same minute.
"""

from __future__ import annotations

import argparse
import cProfile
import os
import pstats
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def compile_here(count_calls: bool) -> None:
    """In a process in which nothing is compiled: the parts, and what older trees compile after."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {0})  # older trees compile in two processes where there are two
    import bearingcore
    from bearingcore import orbit, presets, simulate

    def rest() -> None:
        for name in ("fan-rig", "liew-lim"):
            scene = presets[name]
            _ = simulate(scene.replace(balls="with mass"), 1e-3, ball_loads=True).outer_acceleration
            orbit(scene).outer_acceleration([0.0])

    profile = cProfile.Profile(builtins=False)
    if count_calls:
        profile.enable()
    began = time.process_time()

    def report(line: str) -> None:
        print(f"  {time.process_time() - began:6.1f} s of the processor until {line}")

    bearingcore.warm(report=report)
    rest()
    print(f"  {time.process_time() - began:6.1f} s of the processor in all")
    if count_calls:
        profile.disable()
        stats = pstats.Stats(profile).stats  # type: ignore[attr-defined]
        calls = sum(row[1] for (file, *_), row in stats.items() if "numba" in file)
        print(f"  {1e-6 * calls:6.1f} million Python calls in numba (seconds hold the counting)")


def measure(tree: Path, *options: str) -> int:
    """Compile a tree where nothing is on disk."""
    with tempfile.TemporaryDirectory(prefix="kernels-") as folder:
        environment = {
            **os.environ,
            "NUMBA_CACHE_DIR": folder,
            "OPENBLAS_NUM_THREADS": "1",
            "PYTHONPATH": os.pathsep.join([str(tree), str(tree / "app")]),
        }
        command = [sys.executable, "-P", str(Path(__file__).resolve()), "--here", *options]
        return subprocess.run(command, env=environment, cwd=folder, check=False).returncode


def main() -> int:
    """Compile, with and without counting calls."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--tree", type=Path, action="append", help="a checkout; repeatable")
    parser.add_argument("--calls", action="store_true", help="count Python calls too")
    parser.add_argument("--here", action="store_true", help="in this process")
    chosen = parser.parse_args()
    if chosen.here:
        compile_here(chosen.calls)
        return 0
    from tests.benchmarks.machine import pace  # older trees, compiled above, have none

    failed = 0
    print(pace())
    for tree in chosen.tree or [ROOT]:
        print(tree, flush=True)
        failed |= measure(tree)
        if chosen.calls:
            failed |= measure(tree, "--calls")
    return failed


if __name__ == "__main__":
    sys.exit(main())
