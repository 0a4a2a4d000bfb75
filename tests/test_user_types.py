"""Scripts as users write them, by the README, documents and notebooks, pass strict type checks."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.proof
ROOT = Path(__file__).parents[1]
DOCUMENTS = ("README.md", *(f"assets/docs/{name}.md" for name in ("SWEEPS", "DIAGNOSIS", "LIFE")))
BEYOND = """
import numpy as np

from bearingcore import Defect, Load, Scene, equilibrium, presets, read_designation

rig = presets["fan-rig"]
spall = Defect(extent=0.1, depth=50e-6, center=1.5 * np.pi)
named = Scene("6205", spall, Load(fy=-500.0), 150.0, rig.support, dofs=["x", "y"])
twice = Scene(read_designation("6206"), [spall, spall], Load(), 150.0, rig.support)
balls: int = named.bearing.n_balls + twice.replace(bearing="6206").bearing.n_balls
pair = named.replace(bearing="7208 BECBP DB", preload_force=200.0)
preload: float | None = pair.bearing.preload
stiffest: float = equilibrium(pair, [0.0]).term("k_zz").max()
refused = Load(fy="much")  # type: ignore[arg-type]
"""
"""The last line fails the check if it is no mistake."""


@pytest.fixture(scope="module")
def scripts(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a script of each document and notebook, outside the sources."""
    folder = tmp_path_factory.mktemp("scripts")
    for name in DOCUMENTS:
        text = (ROOT / name).read_text(encoding="utf-8")
        blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        assert blocks, name
        (folder / f"{Path(name).stem.lower()}.py").write_text("\n".join(blocks), encoding="utf-8")
    cells = json.loads((ROOT / "assets/notebooks/first-steps.ipynb").read_text(encoding="utf-8"))
    code = ["".join(cell["source"]) for cell in cells["cells"] if cell["cell_type"] == "code"]
    (folder / "first_steps.py").write_text("\n".join(code), encoding="utf-8")
    shutil.copy(ROOT / "assets/notebooks/first_lines.py", folder)
    (folder / "beyond.py").write_text(BEYOND, encoding="utf-8")
    return folder


def check(command: list[str], folder: Path) -> None:
    files = sorted(file.name for file in folder.glob("*.py"))
    done = subprocess.run([*command, *files], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_mypy_takes_what_users_write(scripts: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MYPYPATH", f"{ROOT}:{ROOT / 'app'}")
    check([sys.executable, "-m", "mypy", "--strict"], scripts)


def test_pyright_takes_what_users_write(scripts: Path) -> None:
    pyright = shutil.which("pyright") or shutil.which("basedpyright")
    if pyright is None:
        pytest.skip("no pyright here: pip install basedpyright, which brings its own Node.js")
    settings = {"extraPaths": [str(ROOT), str(ROOT / "app")], "typeCheckingMode": "standard"}
    (scripts / "pyrightconfig.json").write_text(json.dumps(settings), encoding="utf-8")
    check([pyright, "--pythonpath", sys.executable, "--level", "error"], scripts)
