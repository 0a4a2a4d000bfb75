"""The versions of Python, Panel and Bokeh it runs with: the oldest allowed, and the newest.

    python -m tests.benchmarks.versions

For each Python that `pyproject.toml` names and that is found here, and for the oldest and the
newest releases of Panel and Bokeh that it allows, the project is installed by pip into an
environment in a temporary folder, and tests are run: by default those of what Panel and Bokeh
do not promise, a page that is served and drawn, and the static states against references; with
`--full` all of the server, the page and its session, and the page in a browser. One line of a table
for each; the exit code says whether all passed.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LIBRARIES = ("panel", "bokeh")
TESTS = (
    "tests/bearingcore/statics/test_static_reference.py",
    "tests/bearing_explorer/serve/test_bokeh_private.py",
    "tests/bearing_explorer/serve/test_serving.py::test_models_are_found_as_bokeh_finds_them",
    "tests/bearing_explorer/serve/test_jamming.py::test_buffers_without_end_are_cut",
)
FULL_TESTS = (
    "tests/bearingcore/statics",
    "tests/bearing_explorer/serve",
    "tests/bearing_explorer/test_page.py",
    "tests/bearing_explorer/test_session.py",
    "tests/browser/test_packed_source.py",
    "tests/browser/test_explorer.py",
)


@dataclass(frozen=True)
class Row:
    """What came of one environment."""

    python: str
    which: str
    versions: tuple[str, ...]
    passed: bool
    words: str
    seconds: float


def project() -> dict:
    """What `pyproject.toml` says of the project."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def pythons() -> list[str]:
    """Versions of Python that the project names, as 3.11."""
    pattern = re.compile(r"Programming Language :: Python :: (3\.\d+)$")
    return [found[1] for line in project()["classifiers"] if (found := pattern.match(line))]


def oldest() -> list[str]:
    """Constraints that hold the libraries at the oldest releases that are allowed."""
    found = []
    for line in project()["dependencies"]:
        name = re.match(r"[\w-]+", line)
        least = re.search(r">=\s*([\d.]+)", line)
        if name and least and name[0] in LIBRARIES:
            found.append(f"{name[0]}=={least[1]}")
    assert len(found) == len(LIBRARIES), "each of them has a lower bound"
    return found


def interpreter(version: str) -> str | None:
    """The program that is this version of Python, on the path or among those of pyenv."""
    if version == f"{sys.version_info.major}.{sys.version_info.minor}":
        return sys.executable
    beside = sorted((Path.home() / ".pyenv/versions").glob(f"{version}.*/bin/python"))
    return str(beside[-1]) if beside else shutil.which(f"python{version}")


def run(command: list[str], environment: dict[str, str]) -> tuple[int, str]:
    """Exit code and output."""
    done = subprocess.run(
        command,
        cwd=ROOT,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout


def tried(version: str, program: str, which: str, tests: list[str], home: Path, log: Path) -> Row:
    """Install into the environment of a Python and run the tests there; `log` gets all words.

    `home` is a folder that the rows of this Python share: packages that stay and kernels that are
    compiled are not made twice.
    """
    began = time.perf_counter()
    constraints = home / "constraints.txt"
    constraints.write_text("\n".join(oldest() if which == "oldest" else []) + "\n")
    python = str(home / "venv/bin/python")
    environment = {name: at for name, at in os.environ.items() if name != "PYTHONPATH"}
    environment["NUMBA_CACHE_DIR"] = str(home / "compiled")
    versions: tuple[str, ...] = ("–",) * len(LIBRARIES)
    words, code = "", 0
    install = [python, "-m", "pip", "install", "-q", "--no-compile", "-c", str(constraints)]
    steps = [
        [*install, "-e", ".[test]"],
        [*install, "-U", *LIBRARIES],
        [python, "-c", _VERSIONS],
        [python, "-c", "import bearingcore; bearingcore.warm()"],  # no test waits for the compiler
        [python, "-m", "pytest", "-q", "-n", "0", *tests],
    ]
    if not Path(python).exists():
        steps.insert(0, [program, "-m", "venv", str(home / "venv")])
    with log.open("a", encoding="utf-8") as file:
        for step in steps:
            code, text = run(step, environment)
            file.write(f"\n=== Python {version}, {which}: {' '.join(step[1:5])} ...\n{text}")
            file.flush()
            last = text.strip().splitlines()[-1:] or [""]
            if step[-1] == _VERSIONS and code == 0:
                versions = tuple(last[0].split())
            words = re.sub(r"=+", "", last[0]).strip()
            if code:
                break
    return Row(version, which, versions, code == 0, words, time.perf_counter() - began)


def tell(row: Row) -> None:
    """A line of the table."""
    panel, bokeh = row.versions
    print(
        f"{row.python:<8}{row.which:<9}{panel:<9}{bokeh:<9}"
        f"{'passed' if row.passed else 'FAILED':<8}{row.seconds:>6.0f} s  {row.words}",
        flush=True,
    )


_VERSIONS = (
    f"from importlib.metadata import version; print(*(version(name) for name in {LIBRARIES!r}))"
)


def main() -> int:
    """Try all of them, print the table, and say with the exit code whether all passed."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("tests", nargs="*", help="what pytest is given")
    parser.add_argument("--full", action="store_true", help="more tests, a quarter of an hour each")
    parser.add_argument("--python", nargs="*", default=pythons(), help="versions, as 3.12")
    parser.add_argument("--which", nargs="*", default=["oldest", "newest"])
    parser.add_argument("--log", type=Path, default=Path(tempfile.gettempdir()) / "versions.log")
    chosen = parser.parse_args()
    tests = chosen.tests or list(FULL_TESTS if chosen.full else TESTS)
    chosen.log.write_text("", encoding="utf-8")
    print(f"{'Python':<8}{'allowed':<9}{'Panel':<9}{'Bokeh':<9}{'':<8}{'':>8}")
    passed = True
    for version in chosen.python:
        program = interpreter(version)
        if program is None:
            print(f"{version:<8}not found here", flush=True)
            continue
        with tempfile.TemporaryDirectory(prefix="versions-") as folder:
            for which in chosen.which:
                row = tried(version, program, which, tests, Path(folder), chosen.log)
                passed &= row.passed
                tell(row)
    from tests.benchmarks.machine import pace  # needs the project, unlike all before it

    print(pace())
    print(f"All that was printed: {chosen.log}")
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
