"""Every Python block of the README runs as it stands, one after the other."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


def test_every_block_of_python_runs(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, Any] = {}
    printed = []
    assert len(BLOCKS) >= 3
    for block in BLOCKS:
        exec(compile(block, "README.md", "exec"), names)
        printed.append(capsys.readouterr().out)
    assert "Equilibrium" in printed[0]
    assert "[121 rows x 37 columns]" in printed[0]
    assert "of a catalogue, by the bearing's number" in printed[1]
    assert printed[2].startswith("inner race 0.9")
    assert "motor-b.csv" in printed[2]
    assert names["motion"].completed
    assert np.isfinite(names["density"]).all()
