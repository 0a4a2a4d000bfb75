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
        subprocess.run([sys.executable, "-m", "tests.helpers.compiled"], check=True)
        os.environ[DONE] = "1"


def main() -> None:
    """What a server does at its start and when its first page is asked for."""
    from bearing_explorer.kit.compute import compiling

    if compiling.all_on_disk():
        return
    print("Compiling the kernels, kept on disk for the next time ...", flush=True)
    import bearingcore

    bearingcore.warm(report=lambda _: None)


if __name__ == "__main__":
    main()
