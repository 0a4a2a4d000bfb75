"""Every Python block of the README runs as it stands, one after the other."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


def signal(path: Path) -> None:
    """Noise with a rate and a speed in its names, where the README reads a file."""
    noise = np.random.default_rng(5).standard_normal(12_000)
    rows = "\n".join(f"{k / 12e3:.9f},{value:.5f}" for k, value in enumerate(noise))
    path.write_text(f"time (s),vertical (m/s²)\n{rows}\n", encoding="utf-8")


def test_every_block_of_python_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "records").mkdir()
    for place in ("105.mat", "records/a_1797rpm.csv"):  # what a file is shows in its first bytes
        signal(tmp_path / place)
    names: dict[str, Any] = {}
    printed = []
    assert len(BLOCKS) >= 3
    for block in BLOCKS:
        exec(compile(block, "README.md", "exec"), names)
        printed.append(capsys.readouterr().out)
    assert "Equilibrium" in printed[0]
    assert "[121 rows x 37 columns]" in printed[0]
    assert "of a catalogue, by the bearing's number" in printed[1]
    assert "FolderDiagnosis" in printed[2]
    assert names["motion"].completed
    assert np.isfinite(names["density"]).all()
