"""How functions are compiled and kept on disk, and what keeps their machine code up to date.

numba compares a function on disk with the file that the function stands in, and with nothing else
(it hashes that file, so that not even a new date of it counts): a function that has compiled a
callee from another file into itself would be used with the old callee for ever. So the contents of
all files of a folder of compiled code are part of the version that numba writes at the head of
each index and reads before anything else in it. Another version is no index: what it names is
compiled again and takes its place. Nothing is deleted, so two processes that start at once, or a
folder that cannot be written, need no care of ours.

Fast mathematics that drops NaN or reorders sums stays off: NaN stands where an answer is missing.
"contract" alone of all that fastmath means: a·b + c in one instruction, rounded once, which makes
statics a quarter faster. NaN, signs and the order of sums are as written.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from numba import njit

_OPTIONS = {"nogil": True, "fastmath": {"contract"}}


def compiled(function: Callable[..., Any]) -> Any:
    """A function to be compiled at its first call, and kept on disk."""
    return _made(function, _nrt=True)


def borrowing(function: Callable[..., Any]) -> Any:
    """A compiled function that uses its callers' arrays without counting itself among their owners.

    Counting them up and down again, array by array and at each call, took most of the time of
    functions that take structs (marching: 11 times as long). Such a function must neither make
    arrays nor return any.
    """
    return _made(function, _nrt=False)


def inlined(function: Callable[..., Any]) -> Any:
    """A `borrowing` function that becomes part of its callers.

    A call with many arrays costs more than a small kernel's work. LLVM puts it there: numba's own
    inlining types and translates the body again at each call. Every caller is a little slower to
    compile for it, and a kernel is compiled together with all that it calls, so large functions are
    called at one place.
    """
    return _made(function, _nrt=False, forceinline=True)


def _made(function: Callable[..., Any], **options: bool) -> Any:
    try:
        return kept_up_to_date(njit(**_OPTIONS, cache=True, **options)(function))
    except RuntimeError:
        # numba found no folder that it may write to: not beside the sources, not in the home of
        # whoever runs this. Each start compiles then, which `kept_on_disk` tells.
        _nowhere.append(function.__name__)
        return njit(**_OPTIONS, **options)(function)


_nowhere: list[str] = []


def kept_on_disk() -> bool:
    """Whether machine code is kept for the next start; False where no folder can be written."""
    return not _nowhere


def kept_up_to_date(kernel: Any) -> Any:
    """Make numba ignore the kernel's machine code from other sources than those of now."""
    index = getattr(getattr(kernel, "_cache", None), "_cache_file", None)
    if index is not None:  # none where compiling is switched off
        own = Path(kernel.py_func.__code__.co_filename).parent
        index._version = f"{index._version} {sources(Path(__file__).parent)} {sources(own)}"
    return kernel


def on_disk(kernel: Any) -> bool:
    """Whether machine code of a kernel, made of the sources of now, lies on disk."""
    index = getattr(getattr(kernel, "_cache", None), "_cache_file", None)
    return index is None or bool(index._load_index())


@cache
def sources(folder: Path) -> str:
    """A fingerprint of a folder's Python files, those of folders in it too; empty without any."""
    digest = hashlib.sha256()
    files = sorted(folder.rglob("*.py"))
    for file in files:
        digest.update(str(file.relative_to(folder)).encode() + b"\0" + file.read_bytes() + b"\0")
    return digest.hexdigest()[:16] if files else ""
