"""Machine code on disk is that of the present sources, whatever file a callee stands in."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from bearingcore.model._kernels import compiling

CALLEE = """
from typing import NamedTuple
import numpy as np
from mini.compiling import inlined

class {struct}(NamedTuple):
    values: np.ndarray

Struct = {struct}

@inlined
def total(struct):
    return struct.values.sum() + {number}
"""
CALLER = """
from mini.callee import total
from mini.compiling import compiled

@compiled
def doubled(struct):
    return 2.0 * total(struct)
"""
RUN = """
import numpy as np
from mini import caller, callee, compiling
before = compiling.all_on_disk()
value = caller.doubled(callee.Struct(np.ones(3)))
print(value, sum(caller.doubled.stats.cache_hits.values()), before,
      compiling.all_on_disk())
"""


def write_callee(package: Path, struct: str, number: str) -> None:
    """Another callee of the same length and date: neither tells that it has changed."""
    callee = package / "callee.py"
    callee.write_text(CALLEE.format(struct=struct, number=number))
    os.utime(callee, (1_700_000_000, 1_700_000_000))


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A small package of compiled code, with the real `compiling`."""
    folder = tmp_path / "mini"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    shutil.copy(compiling.__file__, folder / "compiling.py")
    (folder / "caller.py").write_text(CALLER)
    write_callee(folder, "Early", "1.0")
    return folder


def start(
    package: Path,
    cache: Path | None,
    prefix: tuple[str, ...] = (),
    environment: dict[str, str] | None = None,
    code: str = RUN,
) -> subprocess.Popen[str]:
    """A process that calls the caller; with cache None code is kept beside the sources."""
    inherited = {**os.environ, "PYTHONPATH": str(package.parent), "PYTHONDONTWRITEBYTECODE": "1"}
    inherited.pop("NUMBA_CACHE_DIR", None)
    if cache is not None:
        inherited["NUMBA_CACHE_DIR"] = str(cache)
    return subprocess.Popen(
        [*prefix, sys.executable, "-c", code],
        env={**inherited, **(environment or {})},
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def command_that_obeys() -> tuple[str, ...]:
    """Return a command under which a process obeys permissions of folders, which root does not."""
    if os.geteuid() != 0:
        return ()
    command = ("setpriv", "--bounding-set", "-dac_override,-dac_read_search")
    if shutil.which("setpriv") is None or subprocess.run([*command, "true"]).returncode:
        pytest.skip("root may write everywhere, and nothing here takes that from it")
    return command


def told(process: subprocess.Popen[str]) -> tuple[float, int, bool, bool]:
    """Return the value, how often code was on disk, and whether all was there before and after."""
    out, err = process.communicate(timeout=300.0)
    assert err == ""
    assert process.returncode == 0
    value, hits, before, after = out.split()
    return float(value), int(hits), before == "True", after == "True"


@pytest.mark.proof
def test_an_upgrade_that_changes_only_a_callee_counts(package: Path) -> None:
    """Code is made anew, even where the upgrade renames a struct that the old index names."""
    assert told(start(package, None)) == (8.0, 0, False, True)
    assert told(start(package, None)) == (8.0, 1, True, True)
    write_callee(package, "Later", "2.0")
    assert told(start(package, None)) == (10.0, 0, False, True)
    write_callee(package, "Early", "1.0")
    assert told(start(package, None))[0] == 8.0, "and back again"


def flip(file: Path, at: int) -> None:
    content = bytearray(file.read_bytes())
    content[at] ^= 0x10
    file.write_bytes(content)


def folder(file: Path) -> None:
    file.unlink()
    file.mkdir()
    (file / "something").write_text("x")


BROKEN: dict[str, Callable[[Path], object]] = {
    "empty": lambda file: file.write_bytes(b""),
    "cut in half": lambda file: file.write_bytes(file.read_bytes()[: file.stat().st_size // 2]),
    "a flipped byte in the version": lambda file: flip(file, 40),
    "a flipped byte in the code": lambda file: flip(file, file.stat().st_size // 2),
    "a folder": folder,
}


@pytest.mark.proof
def test_broken_files_are_dropped_and_made_anew(package: Path, tmp_path: Path) -> None:
    told(start(package, tmp_path))
    files = list(tmp_path.rglob("*.kernel"))
    assert len(files) == 1, "what it calls is part of it"
    for shape, break_file in BROKEN.items():
        for file in files:
            break_file(file)
        process = start(package, tmp_path)
        out, err = process.communicate(timeout=300.0)
        assert (shape, process.returncode, out.split()[:2]) == (shape, 0, ["8.0", "0"])
        assert out.split()[3] == "True", f"{shape}: it is on disk again"
        assert err.count("\n") == 1, f"{shape}: one line says so: {err}"
        assert "broken and made anew" in err
    assert told(start(package, tmp_path)) == (8.0, 1, True, True)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a disk that is full")
@pytest.mark.proof
def test_a_full_disk_keeps_nothing_and_says_so(package: Path, tmp_path: Path) -> None:
    """Writing fails as on a full disk: computing goes on, and one line says so."""
    full = (
        "from pathlib import Path; write = Path.write_bytes\n"
        "Path.write_bytes = lambda self, data: write(Path('/dev/full'), data)\n"
    )
    process = start(package, tmp_path, code=full + RUN + "print(compiling.kept_on_disk())")
    out, err = process.communicate(timeout=300.0)
    assert out.split() == ["8.0", "0", "False", "False", "False"]
    assert err.count("\n") == 1
    assert "No space left" in err
    assert not list(tmp_path.rglob("*.kernel*")), "nothing is left half written"


@pytest.mark.proof
def test_four_processes_that_start_at_once_are_all_right(package: Path, tmp_path: Path) -> None:
    told(start(package, tmp_path))
    write_callee(package, "Later", "2.0")
    all_four = [start(package, tmp_path) for _ in range(4)]
    assert [told(process)[0] for process in all_four] == [10.0] * 4
    assert told(start(package, tmp_path)) == (10.0, 1, True, True)


@pytest.mark.proof
def test_a_folder_that_cannot_be_written_is_left_alone(package: Path, tmp_path: Path) -> None:
    """Machine code is then kept in the user's own folder."""
    told(start(package, None))  # machine code beside the sources, soon out of date
    write_callee(package, "Later", "2.0")
    home = tmp_path / "home"
    home.mkdir()
    folders = {"XDG_CACHE_HOME": str(home), "HOME": str(home)}
    before = {file: file.read_bytes() for file in package.rglob("*.kernel*")}
    modes = {folder: folder.stat().st_mode for folder in (package, package / "__pycache__")}
    for folder in modes:
        folder.chmod(0o555)
    try:
        assert told(start(package, None, command_that_obeys(), folders))[0] == 10.0
        assert told(start(package, None, command_that_obeys(), folders))[:2] == (10.0, 1)
    finally:
        for folder, mode in modes.items():
            folder.chmod(mode)
    assert before == {file: file.read_bytes() for file in package.rglob("*.kernel*")}


@pytest.mark.proof
def test_kernels_of_somebody_else_are_read_and_left_alone(package: Path, tmp_path: Path) -> None:
    """As in an image, where they are root's."""
    kept = tmp_path / "kept"
    told(start(package, kept))
    [file] = kept.rglob("*.kernel")
    for content in (file.read_bytes(), b"broken"):
        file.write_bytes(content)
        file.parent.chmod(0o555)
        try:
            process = start(package, kept, command_that_obeys())
            out, err = process.communicate(timeout=300.0)
        finally:
            file.parent.chmod(0o755)
        hits = "0" if content == b"broken" else "1"
        assert (process.returncode, out.split()[:2]) == (0, ["8.0", hits]), err
        assert ("broken" in err) == (hits == "0")
        assert file.read_bytes() == content


@pytest.mark.proof
@pytest.mark.parametrize("gone", [False, True])
def test_public_ways_give_the_same_and_stay_up_to_date(
    package: Path, tmp_path: Path, gone: bool
) -> None:
    """As asked for, and with a Numba that has other private names."""
    if gone:
        gone_name = "import numba.core.caching as c; del c.CompileResultCacheImpl"
        (package / "__init__.py").write_text(gone_name)
    environment = {} if gone else {"BEARING_EXPLORER_PLAIN": "1"}

    def run() -> list[str]:
        process = start(package, tmp_path, environment=environment)
        out, err = process.communicate(timeout=300.0)
        assert process.returncode == 0, err
        assert ("kernels are compiled slowly with Numba" in err) == gone, err
        return out.split()

    assert run() == ["8.0", "0", "False", "True"]
    assert run() == ["8.0", "1", "True", "True"]
    write_callee(package, "Later", "2.0")
    assert run()[:2] == ["10.0", "0"]
