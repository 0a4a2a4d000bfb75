"""The core without the page's packages: it needs what `requirements-core.txt` says."""

import os
import subprocess
import tomllib
import venv
from collections.abc import Iterable
from importlib import metadata
from pathlib import Path

from packaging.requirements import Requirement

ROOT = Path(__file__).parents[1]
SCRIPT = """
import numpy as np
from scipy.io import savemat
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
"""


def test_the_requirements_are_some_of_the_package() -> None:
    lines = (ROOT / "requirements-core.txt").read_text(encoding="utf-8").splitlines()[1:]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert lines
    assert set(lines) < set(project["dependencies"])


def with_all_they_require(names: Iterable[str]) -> set[str]:
    """Return distributions and those that they require, as their metadata say."""
    waiting, known = list(names), set()
    while waiting:
        name = waiting.pop()
        if name not in known:
            known.add(name)
            lines = map(Requirement, metadata.requires(name) or [])
            waiting += [line.name for line in lines if not line.marker or line.marker.evaluate()]
    return known


def test_the_core_runs_where_no_other_package_is(tmp_path: Path) -> None:
    """The environment holds links to the required packages; a process of it reads the file."""
    lines = (ROOT / "requirements-core.txt").read_text(encoding="utf-8").splitlines()[1:]
    venv.create(tmp_path / "core")
    (packages,) = tmp_path.glob("core/lib/*/site-packages")
    for name in with_all_they_require(Requirement(line).name for line in lines):
        distribution = metadata.distribution(name)
        for part in {file.parts[0] for file in distribution.files or ()} - {".."}:
            (packages / part).symlink_to(str(distribution.locate_file(part)))
    (packages / "bearingcore").symlink_to(ROOT / "bearingcore")
    done = subprocess.run(
        [tmp_path / "core/bin/python", "-c", SCRIPT],
        cwd=tmp_path,
        env={key: text for key, text in os.environ.items() if key != "PYTHONPATH"},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert "allowed: one that needs no package pandas, which is not installed" in done.stdout
