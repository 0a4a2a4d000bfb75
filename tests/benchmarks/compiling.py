"""The compile work of a first start: ``python -m tests.benchmarks.compiling``.

A process of its own, with an empty folder for machine code, calls `bearingcore.warm`. Printed are
seconds of its processor until each part is there.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

from tests.benchmarks.machine import pace

WARM = """
import time, bearingcore
began = time.process_time()
say = lambda line: print(f"  {time.process_time() - began:6.1f} s of the processor until {line}")
bearingcore.warm(report=say)
say("all of it")
"""


def main() -> int:
    """Compile where nothing is on disk."""
    print(pace(), flush=True)
    with tempfile.TemporaryDirectory(prefix="kernels-") as folder:
        environment = {**os.environ, "NUMBA_CACHE_DIR": folder, "OPENBLAS_NUM_THREADS": "1"}
        return subprocess.run([sys.executable, "-c", WARM], env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
