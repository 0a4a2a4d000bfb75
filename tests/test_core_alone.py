"""The core without the page's packages, as `requirements-core.txt` has it."""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LINES = (ROOT / "requirements-core.txt").read_text(encoding="utf-8").splitlines()
NEEDED = [line for line in LINES if not line.startswith("#")]
SCRIPT = ROOT / "tests/helpers/core_alone.py"
HIDE = """
import importlib.metadata as metadata, importlib.util, re, sys
from importlib.machinery import PathFinder

def needed(names):
    for name in names:
        own = metadata.requires(name) or []
        yield name.replace("_", "-").lower()
        yield from needed(re.match(r"[\\w.-]+", line)[0] for line in own if "extra ==" not in line)

allowed = {*needed(sys.argv[1].split()), "bearing-explorer"}
hidden = {
    top for top, owners in metadata.packages_distributions().items()
    if not allowed & {owner.replace("_", "-").lower() for owner in owners}
}
assert {"pandas", "panel", "bokeh", "h5py", "param"} <= hidden

class Hidden(PathFinder):
    @classmethod
    def find_spec(cls, name, path=None, target=None):
        if name.partition(".")[0] not in hidden:
            return super().find_spec(name, path, target)

sys.meta_path[:] = [Hidden if finder is PathFinder else finder for finder in sys.meta_path]
import runpy
runpy.run_path(sys.argv[2], run_name="__main__")
"""
"""Hides all packages but some and what those need, then runs a script."""


def names() -> list[str]:
    return [re.match(r"[\w-]+", line)[0] for line in NEEDED]  # type: ignore[index]


def test_the_requirements_are_those_of_the_package() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert NEEDED
    assert set(NEEDED) < set(project["dependencies"])


def test_the_core_runs_where_all_other_packages_are_hidden(tmp_path: Path) -> None:
    command = [sys.executable, "-c", HIDE, " ".join(names()), str(SCRIPT)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.proof
def test_the_core_is_installed_alone(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-m", "venv", "core"], cwd=tmp_path, check=True)
    python, more = tmp_path / "core/bin/python", ["--quiet", "--disable-pip-version-check"]
    wanted = [["-r", str(ROOT / "requirements-core.txt")], ["--no-deps", str(ROOT)]]
    environment = {key: text for key, text in os.environ.items() if key != "PYTHONPATH"}
    for packages in wanted:
        command = [str(python), "-m", "pip", "install", *more, *packages]
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if "No matching distribution" in done.stderr or "NewConnectionError" in done.stderr:
            pytest.skip(f"no package index can be reached: {done.stderr[-200:]}")
        assert done.returncode == 0, done.stderr
    environment["NUMBA_CACHE_DIR"] = str(tmp_path / "kernels")
    command = [str(python), str(SCRIPT)]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "signal.csv'; allowed: one that needs no package pandas" in done.stdout
