"""The notebooks run without changes, and are stored without outputs."""

import re
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

OUTSIDE = re.compile(r"https?://[^\s\"\\]+\.css\b|<(?:script|link)[^>]*(?:src|href)=")
FOLDER = Path(__file__).resolve().parents[2] / "assets" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
assert len(NOTEBOOKS) == 4


@pytest.mark.proof
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_shows_its_figures(path: Path) -> None:
    notebook = nbformat.read(path, as_version=4)
    needed = {"rotor-in-ross": "ross", "learning": "sklearn"}.get(path.stem)
    if needed is not None:
        pytest.importorskip(needed)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert not any(cell.outputs or cell.execution_count for cell in code), "kept with outputs"
    NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
    for cell in code:
        last = cell.source.strip().splitlines()[-1]
        if last.startswith(("figures.", "plane(")):
            assert any("text/html" in output.get("data", {}) for output in cell.outputs), last
            shown = "".join(output.get("data", {}).get("text/html", "") for output in cell.outputs)
            assert not OUTSIDE.findall(shown), "an exported notebook needs nothing from outside"
