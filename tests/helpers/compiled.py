"""Machine code of the kernels, made once before anybody who needs it at the same time starts."""

import os
import subprocess
import sys

DONE = "BEARING_EXPLORER_TESTS_COMPILED"
"""Environment variable that says to this process's children that it is done."""


def compile_once() -> None:
    """Compile what is not on disk yet, in a process of its own; not twice in a test run.

    Otherwise each of the parallel processes, and each server they start, would compile the same.
    """
    if DONE not in os.environ:
        print("Compiling what is not on disk yet of the kernels ...", flush=True)
        subprocess.run([sys.executable, "-c", "import bearingcore; bearingcore.warm()"], check=True)
        os.environ[DONE] = "1"
