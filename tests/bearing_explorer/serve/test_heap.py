"""What is free in the heap of the C library goes back to the system."""

import subprocess
import sys

import pytest
from bearing_explorer.serve import heap

_PROCESS = """
import sys, threading
from pathlib import Path
import numpy as np
from bearing_explorer.serve import heap

def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6

if sys.argv[1] == "small":
    assert heap.keep_small()
go_on = threading.Barrier(9)

def work(kept):
    # arrays as those of a motion; behind each a little that is kept
    for _ in range(4):
        large = []
        for _ in range(8):
            large.append(np.ones(400_000))
            kept.append(np.ones(1000))
        del large
    go_on.wait()

kept = []
before = resident()
threads = [threading.Thread(target=work, args=(kept,)) for _ in range(8)]
for thread in threads:
    thread.start()
go_on.wait()
if sys.argv[1] == "small":
    heap.give_back()
print(resident() - before)
"""


@pytest.mark.skipif(heap._library() is None, reason="not the GNU C library")
def test_what_threads_let_go_of_goes_back() -> None:
    done = subprocess.run(
        [sys.executable, "-c", _PROCESS, "small"], capture_output=True, text=True, check=True
    )
    assert float(done.stdout) < 30.0, "MB of 200"


def test_where_the_library_is_another_all_stays_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(heap, "_library", lambda: None)
    assert not heap.keep_small()
    heap.give_back()
