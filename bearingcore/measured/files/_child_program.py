"""The process that reads one file, see `_child`. It runs as a script, without package fronts."""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from pathlib import Path
from types import ModuleType
from typing import Any


def limit(seconds: int, memory: int) -> None:
    """Limit processor time [s] and memory [bytes] of this process, and let it write no files."""
    try:
        import resource
    except ImportError:
        return  # Windows has no such limits: the parent limits the time
    bounds = {
        resource.RLIMIT_AS: (2 * memory, 2 * memory),  # libraries map about as much again
        resource.RLIMIT_DATA: (memory, memory),
        resource.RLIMIT_CPU: (seconds, seconds + 2),  # the soft limit sends the signal SIGXCPU
        resource.RLIMIT_CORE: (0, 0),
        resource.RLIMIT_FSIZE: (0, 0),
    }
    for kind, soft_and_hard in bounds.items():
        with suppress(ValueError, OSError):  # a tighter limit exists, or the system has none
            resource.setrlimit(kind, soft_and_hard)


def find_core() -> None:
    """Make the packages of the core importable from this folder, although -I hides the path.

    The root is an empty module, because Python would search the path for the real one.
    """
    root = ModuleType("bearingcore")
    root.__path__ = [str(Path(__file__).parents[2])]
    sys.modules["bearingcore"] = root


def main() -> None:
    """Read the file on the standard input, and write its contents to the standard output."""
    name, seconds, memory = json.loads(sys.stdin.buffer.readline())
    limit(seconds, memory)
    find_core()
    from bearingcore.errors import FieldError
    from bearingcore.measured.files._formats import read

    parts: tuple[Any, ...] = ()
    try:
        content = sys.stdin.buffer.read()
        about, columns = read(name, content)
        about["shape"] = columns.shape
        parts = tuple(columns.T)
    except FieldError as error:
        about = {"refused": (error.field, error.value, error.allowed)}
    except MemoryError:
        about = {"refused": ("file", name, f"one that can be read in {memory // 10**6} MB")}
    except ImportError as error:
        needed = f"one that needs no package {error.name}, which is not installed"
        about = {"refused": ("file", name, needed)}
    out = sys.stdout.buffer
    out.write(json.dumps(about).encode() + b"\n")
    for part in parts:
        out.write(part.tobytes())
    out.flush()
    os._exit(0)  # without clean-up, because a damaged file may have broken a library


if __name__ == "__main__":
    main()
