"""The core inside a service, for SERVICE.md: ``python -m tests.benchmarks.service``.

Each line is measured in a process of its own: times by the clock [s] and memory [MB].
"""

import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import psutil

from bearingcore import equilibrium, presets, simulate

START = """
import time, psutil
began = time.perf_counter()
from bearingcore import diagnose, equilibrium, presets, simulate
scene = presets["fan-rig"]
{call}
print(f"{{time.perf_counter() - began:.2f}} s, {{psutil.Process().memory_info().rss / 1e6:.0f}} MB")
"""
CALLS = {
    "diagnosis imported": "diagnose",
    "first equilibrium": "equilibrium(scene)",
    "first motion, 0.2 s": "simulate(scene, 0.2)",
}
SCENES = [presets["fan-rig"].replace(fy=-100.0 - k) for k in range(8)]


def motion(number: int) -> float:
    """Simulate 1.4 s of a scene."""
    return float(simulate(SCENES[number], 1.4).time[-1])


def main() -> None:
    """Print first calls with and without compiled kernels, and eight motions in each way."""
    equilibrium(SCENES[0])
    motion(0)
    with tempfile.TemporaryDirectory() as empty:
        for name, call in CALLS.items():
            for words, more in (("", {}), (", nothing compiled", {"NUMBA_CACHE_DIR": empty})):
                command = [sys.executable, "-c", START.format(call=call)]
                answer = subprocess.check_output(command, env=os.environ | more, text=True)
                print(f"{name}{words}: {answer.strip()}")
    spawned = get_context("spawn")
    for name, pool in (
        ("one thread", ThreadPoolExecutor(1)),
        ("two threads", ThreadPoolExecutor(2)),
        ("two processes", ProcessPoolExecutor(2, mp_context=spawned)),
    ):
        with pool:
            list(pool.map(motion, range(2)))  # processes have started
            began = time.perf_counter()
            list(pool.map(motion, range(8)))
            print(f"eight motions of 1.4 s, {name}: {time.perf_counter() - began:.2f} s")
    print(f"memory then: {psutil.Process().memory_info().rss / 1e6:.0f} MB")


if __name__ == "__main__":
    main()
