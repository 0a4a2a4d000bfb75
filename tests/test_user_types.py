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

STRICT = (
    "# mypy: disallow-any-generics, disallow-subclassing-any, disallow-untyped-calls, "
    "disallow-untyped-defs, disallow-incomplete-defs, check-untyped-defs, "
    "disallow-untyped-decorators, warn-unused-ignores, warn-return-any, no-implicit-reexport, "
    "strict-equality, extra-checks\n"
)
"""What `mypy --strict` asks, of the scripts alone: the sources are as the linters left them."""


@pytest.fixture(scope="module")
def scripts(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """A script of each document and notebook, in a folder outside the sources."""
    folder = tmp_path_factory.mktemp("scripts")
    texts = {"beyond": BEYOND}
    for name in DOCUMENTS:
        text = (ROOT / name).read_text(encoding="utf-8")
        blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        assert blocks, name
        texts[Path(name).stem.lower()] = "\n".join(blocks)
    cells = json.loads((ROOT / "assets/notebooks/first-steps.ipynb").read_text(encoding="utf-8"))
    code = ["".join(cell["source"]) for cell in cells["cells"] if cell["cell_type"] == "code"]
    texts["first_steps"] = "\n".join(code)
    texts["first_lines"] = (ROOT / "assets/notebooks/first_lines.py").read_text(encoding="utf-8")
    for name, text in texts.items():
        (folder / f"{name}.py").write_text(STRICT + text, encoding="utf-8")
    return sorted(folder.glob("*.py"))


def check(command: list[str], scripts: list[Path], cwd: Path) -> None:
    done = subprocess.run([*command, *scripts], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_mypy_takes_what_users_write(scripts: list[Path]) -> None:
    """In the folder of the sources, whose analysis is kept there and need not be done again."""
    check([sys.executable, "-m", "mypy"], scripts, ROOT)


def test_pyright_takes_what_users_write(scripts: list[Path]) -> None:
    pyright = shutil.which("pyright") or shutil.which("basedpyright")
    if pyright is None:
        pytest.skip("no pyright here: pip install basedpyright, which brings its own Node.js")
    settings = {"extraPaths": [str(ROOT), str(ROOT / "app")], "typeCheckingMode": "standard"}
    folder = scripts[0].parent
    (folder / "pyrightconfig.json").write_text(json.dumps(settings), encoding="utf-8")
    check([pyright, "--pythonpath", sys.executable, "--level", "error"], scripts, folder)
