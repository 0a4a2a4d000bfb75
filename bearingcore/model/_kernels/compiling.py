"""Compilation of functions, and a cache of machine code on disk that stays up to date.

Numba compares a function on disk only with the source file of that function. If the function has
compiled a callee from another file into itself, it would be used with the old callee for ever.
Numba also trusts what it reads: half a file ends the program with a traceback, and a flipped byte
in machine code ends the process. So each file here carries a digest of itself, and a version made
of the contents of all source files of compiled code. A file that does not match is compiled again
and replaced; code that cannot be written is not kept.

Fast mathematics that drops NaN or reorders sums stays off, because NaN marks a missing answer. Of
its options only "contract" is used: a·b + c is one instruction, rounded once, which makes statics a
quarter faster. NaN, signs and the order of sums stay as written.

Private names of Numba are used in this file alone, and are looked up when it is loaded:

* `Compiler`, `JITCodeLibrary`, and the options in `_OPTIONS` and `_CALLED_BY_KERNELS`: kernels are
  compiled in a tenth of the time, and marching takes an eleventh (`PartLibrary`).
* `FunctionCache`, `CompileResultCacheImpl`, `dumps`: the cache above (`KernelCache`).

If one of them is missing, or with the environment variable ``BEARING_EXPLORER_PLAIN=1``, kernels
are compiled by Numba's public interface, and kept in a folder that is named after the sources. The
value "page" asks only the page, whose modules read the same variable, to avoid private names.
"""

from __future__ import annotations

import glob
import hashlib
import logging
import os
import pickle
import shutil
import uuid
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numba
from numba import njit

log = logging.getLogger(__name__)

PLAIN = os.environ.get("BEARING_EXPLORER_PLAIN", "0") not in ("", "0", "page")
"""True if only Numba's public interface is used."""

try:
    from numba.core.caching import CompileResultCacheImpl, FunctionCache
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import Compiler
    from numba.core.serialize import dumps

    _LOCATORS: list[Any] = list(CompileResultCacheImpl._locator_classes)
except (ImportError, AttributeError) as error:
    log.warning("kernels are compiled slowly with Numba %s: %s", numba.__version__, error)
    CompileResultCacheImpl = FunctionCache = JITCodeLibrary = Compiler = object
    _LOCATORS, dumps, PLAIN = [object], pickle.dumps, True

_PUBLIC_OPTIONS = {
    "nogil": True,
    "fastmath": {"contract"},
    "error_model": "numpy",  # x/0 is inf or NaN; a test for it would cost time at each division
}
_OPTIONS = {
    **_PUBLIC_OPTIONS,
    "no_cfunc_wrapper": True,
    # set for every function, or it is as in the function that happens to be the first to call it
    "forceinline": False,
    # Arrays are made by callers and not counted: counting their owners up and down at each call
    # took most of the time of functions that take structs (marching: 11 times as long).
    "_nrt": False,
}


class PartLibrary(JITCodeLibrary):  # type: ignore[misc]
    """Code of a function that only kernels call: optimised and translated with each kernel.

    Numba does both for every function separately, and then once more in each of its callers.
    """

    def _optimize_final_module(self) -> None: ...

    def _finalize_final_module(self) -> None:
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """Return 0, as there is no machine code to call."""
        return 0

    @property
    def codegen(self) -> Any:
        """Ignore the environment: only functions that Python can call need one."""
        return SimpleNamespace(set_env=lambda name, environment: None)


class PartCompiler(Compiler):  # type: ignore[misc]
    """Numba's compiler, with a `PartLibrary` as its target."""

    def define_pipelines(self) -> Any:
        """Return the usual passes, with the library replaced."""
        state = self.state
        if state.library is None:
            state.library = PartLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
        return super().define_pipelines()


# A wrapper holds its function once more, and unpacking structs is more code than most functions.
_CALLED_BY_KERNELS = {**_OPTIONS, "no_cpython_wrapper": True, "pipeline_class": PartCompiler}


def compiled(function: Callable[..., Any]) -> Any:
    """Return a kernel, which Python calls: it is compiled at its first call and kept on disk.

    Like all compiled functions here it neither makes nor returns arrays.
    """
    if PLAIN:
        return njit(cache=_keep_plain(), **_PUBLIC_OPTIONS)(function)
    kernel = njit(**_OPTIONS)(function)
    if not hasattr(kernel, "_cache"):  # compiling is switched off
        return kernel
    try:
        kernel._cache = KernelCache(function)
        _kernels.append(kernel)
    except RuntimeError:
        # Numba may write neither next to the sources nor in the home of the user. Then each start
        # compiles, see `kept_on_disk`.
        _not_kept.append(function.__name__)
    return kernel


def called(function: Callable[..., Any]) -> Any:
    """Return a compiled function that only kernels call."""
    return njit(**(_PUBLIC_OPTIONS if PLAIN else _CALLED_BY_KERNELS))(function)


def inlined(function: Callable[..., Any]) -> Any:
    """Return a `called` function that LLVM makes part of its callers.

    A call with many arrays costs more than the work of a small function. Numba's own inlining is
    not used, as it types and translates the body again at each call. Each inlined call makes the
    compilation of its kernel slower, so large functions are called at one place.
    """
    return (
        called(function) if PLAIN else njit(**_CALLED_BY_KERNELS | {"forceinline": True})(function)
    )


_kernels: list[Any] = []
_not_kept: list[str] = []


def kept_on_disk() -> bool:
    """Return True if machine code is kept for the next start; False without a writable folder."""
    return not _not_kept


def all_on_disk() -> bool:
    """Return True if machine code of all kernels, made of the present sources, is on disk."""
    if PLAIN:
        return _keep_plain() and any(Path(numba.config.CACHE_DIR).rglob("*.nbi"))
    return bool(_kernels) and all(kernel._cache._cache_file.has_any() for kernel in _kernels)


@cache
def _keep_plain() -> bool:
    """Let Numba keep code in a folder of these sources alone; return False if it is read-only."""
    here = Path(__file__).parent
    folder = Path(numba.config.CACHE_DIR or here / "__pycache__") / f"plain-{sources(here)}"
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
    if not os.access(folder, os.W_OK):  # Numba refuses a folder that it can only read
        _not_kept.append("plain")
        return False
    numba.config.CACHE_DIR = str(folder)
    return True


@cache
def _warn_once(words: str) -> None:
    log.warning(words)


class ReadableFolder(_LOCATORS[0]):  # type: ignore[misc, valid-type]
    """NUMBA_CACHE_DIR, which may be read-only, as it is in an image of a container."""

    def ensure_cache_path(self) -> None:
        """Raise OSError if the folder neither exists nor can be made."""
        if not Path(self.get_cache_path()).is_dir():
            super().ensure_cache_path()


class _Places(CompileResultCacheImpl):  # type: ignore[misc]
    _locator_classes = [ReadableFolder, *_LOCATORS]  # noqa: RUF012


class KernelCache(FunctionCache):  # type: ignore[misc]
    """Numba's cache of a function, whose faults never end the program.

    A file that cannot be read is removed and made anew; code that cannot be written is not kept.
    """

    _impl_class = _Places

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        base = Path(self._cache_path) / self._impl.filename_base
        here = Path(function.__code__.co_filename).parent
        version = f"{numba.__version__} {sources(Path(__file__).parent)} {sources(here)}"
        self._cache_file = KernelFiles(base, version)

    def load_overload(self, signature: Any, context: Any) -> Any:
        """Return the machine code for a signature; None if it has to be compiled."""
        try:
            return super().load_overload(signature, context)
        except Exception as error:
            _warn_once(f"kept machine code cannot be used and is made anew: {error!r}")
            return None

    def save_overload(self, signature: Any, compiled_code: Any) -> None:
        """Keep machine code on disk if possible."""
        try:
            super().save_overload(signature, compiled_code)
        except Exception as error:
            _warn_once(f"compiled kernels are not kept: {error}")
            _not_kept.append(self._name)


class KernelFiles:
    """The files of one function, one for each signature, with digest, version and machine code.

    They replace Numba's `IndexDataCacheFile`, whose files do not show a flipped byte, which in
    machine code ends the process.
    """

    def __init__(self, base: Path, version: str) -> None:
        self._base, self._version = base, hashlib.sha256(version.encode()).digest()

    def has_any(self) -> bool:
        """Return True if there is machine code of this version for any signature."""
        files = self._base.parent.glob(f"{glob.escape(self._base.name)}.*.kernel")
        return any(self._read(file) is not None for file in files)

    def load(self, key: object) -> Any:
        """Return the data saved with a key; None if missing, outdated or broken."""
        content = self._read(self._file(key))
        return None if content is None else pickle.loads(content)

    def save(self, key: object, data: object) -> None:
        """Write a file whole or not at all: two processes may do it at once."""
        file, content = self._file(key), self._version + dumps(data)
        partial = file.with_name(f"{file.name}.{uuid.uuid4().hex[:16]}")
        try:
            partial.write_bytes(hashlib.sha256(content).digest() + content)
            partial.replace(file)
        except BaseException:
            partial.unlink(missing_ok=True)
            raise

    def flush(self) -> None:
        """Do nothing when Numba recompiles: a file of another version counts as missing."""

    def _file(self, key: object) -> Path:
        digest = hashlib.sha256(repr(key).encode()).hexdigest()[:16]
        return self._base.with_name(f"{self._base.name}.{digest}.kernel")

    def _read(self, file: Path) -> bytes | None:
        if not file.exists():
            return None
        content = b"" if file.is_dir() else file.read_bytes()
        digest, content = content[:32], content[32:]
        if hashlib.sha256(content).digest() == digest:
            return content[32:] if content.startswith(self._version) else None
        _warn_once("kept machine code is broken and made anew")
        with suppress(OSError):  # the file may have another owner
            if file.is_dir():
                shutil.rmtree(file)
            else:
                file.unlink()
        return None


@cache
def sources(folder: Path) -> str:
    """Return a fingerprint of all Python files in and under a folder; empty if there are none."""
    digest = hashlib.sha256()
    files = sorted(folder.rglob("*.py"))
    for file in files:
        digest.update(str(file.relative_to(folder)).encode() + b"\0" + file.read_bytes() + b"\0")
    return digest.hexdigest()[:16] if files else ""
