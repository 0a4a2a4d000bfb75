"""The core without the page's packages, installed as `requirements-core.txt` says."""

import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SCRIPT = """
import numpy as np
from scipy.io import savemat
from bearing_explorer.__main__ import main
from bearingcore import FieldError, Scene, diagnose, equilibrium, life, presets, scene_of

scene = presets["fan-rig"].replace(extent=0.2)
state = equilibrium(scene, np.linspace(0.0, 0.4, 9))
assert state.converged.all() and "k_yy" in f"{state}{state._repr_html_()}"
assert life(scene_of("6208").replace(fy=-2000.0)).hours > 1000.0
assert Scene.from_toml(scene.to_toml()) == scene
noise = np.random.default_rng(5).standard_normal((12_000, 1))
savemat("105.mat", {"X105_DE_time": noise, "X105RPM": 1797})
assert "No clear result" in diagnose("105.mat", "6205").sentence
np.savetxt("signal.csv", noise)
try:
    diagnose("signal.csv", "6205", 180.0)
except FieldError as error:
    print(error)
assert main([]) == 1  # not a traceback
"""


def test_the_requirements_are_some_of_the_package() -> None:
    lines = (ROOT / "requirements-core.txt").read_text(encoding="utf-8").splitlines()[1:]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert lines
    assert set(lines) < set(project["dependencies"])


@pytest.mark.proof
def test_the_core_is_installed_alone_and_runs(tmp_path: Path) -> None:
    names = ("PYTHONPATH", "NUMBA_CACHE_DIR")
    environment = {key: text for key, text in os.environ.items() if key not in names}
    python = str(tmp_path / "core/bin/python")
    install = [sys.executable, "-m", "pip", "--python", python, "install", "--quiet"]
    wanted = ["-r", str(ROOT / "requirements-core.txt")]
    for command in (
        [sys.executable, "-m", "venv", "--without-pip", "core"],
        [*install, *wanted],
        [*install, "--no-deps", str(ROOT)],
        [python, "-c", SCRIPT],
    ):
        done = subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True
        )
        if done.returncode and wanted[1] in command:
            pytest.skip(f"the packages cannot be had from here: {done.stderr[-200:]}")
        assert done.returncode == 0, done.stderr
    assert "allowed: one that needs no package pandas, which is not installed" in done.stdout
