"""How long a server is silent: ``python -m tests.fuzz.pulse PORT`` asks it over and over.

In a process of its own, or it would hear the strangers' work instead of the server's. Prints the
longest wait [s] for ``/liveness`` and how often there was no answer, when its input ends.
"""

from __future__ import annotations

import http.client
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

PATIENCE = 60.0  # [s]
READY = "ready"

Told = AbstractContextManager[Callable[[], list[float]]]


@contextmanager
def asking(module: str, *arguments: str) -> Iterator[Callable[[], list[float]]]:
    """Run a module beside this program, once it says that it is ready.

    What is given ends it and tells the numbers that it printed.
    """
    process = subprocess.Popen(
        [sys.executable, "-m", module, *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )

    def told() -> list[float]:
        return [float(word) for word in process.communicate("", PATIENCE + 5.0)[0].split()]

    assert process.stdout is not None
    try:
        if process.stdout.readline().strip() != READY:
            raise RuntimeError(f"{module} could not begin")
        yield told
    finally:
        if process.poll() is None:
            process.kill()
            process.wait()


def pulse(port: int) -> Told:
    """Listen for as long as the block lasts; the longest wait [s], and how often there was none."""
    return asking("tests.fuzz.pulse", str(port))


def main(port: int) -> None:
    """Ask until the input ends."""
    over = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), over.set()), daemon=True).start()
    longest, failed = 0.0, 0
    print(READY, flush=True)
    while not over.is_set():
        began = time.perf_counter()
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
        try:
            connection.request("GET", "/liveness")
            failed += connection.getresponse().status != 200
        except OSError:
            failed += 1
        finally:
            connection.close()
        longest = max(longest, time.perf_counter() - began)
        over.wait(0.02)
    print(longest, failed)


if __name__ == "__main__":
    main(int(sys.argv[1]))
