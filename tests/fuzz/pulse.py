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
from contextlib import contextmanager

PATIENCE = 60.0  # [s]


@contextmanager
def pulse(port: int) -> Iterator[Callable[[], tuple[float, int]]]:
    """Listen for as long as the block lasts; what is given ends it and tells what was heard."""
    process = subprocess.Popen(
        [sys.executable, "-m", "tests.fuzz.pulse", str(port)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )

    def told() -> tuple[float, int]:
        longest, failed = process.communicate("", PATIENCE + 5.0)[0].split()
        return float(longest), int(failed)

    try:
        yield told
    finally:
        if process.poll() is None:
            process.kill()
            process.wait()


def main(port: int) -> None:
    """Ask until the input ends."""
    over = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), over.set()), daemon=True).start()
    longest, failed = 0.0, 0
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
