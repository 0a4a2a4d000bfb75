"""Every Python block of the README runs as it stands, one after the other."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import savemat

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


NOISE = np.random.default_rng(5).standard_normal((12_000, 1))


def test_every_block_of_python_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "records").mkdir()
    savemat("105.mat", {"X105_DE_time": NOISE, "X105_FE_time": NOISE[::-1], "X105RPM": 1797})
    rows = [f"{k / 12e3:.9f},{value:.5f}" for k, value in enumerate(NOISE[:, 0])]
    text = "\n".join(["time (s),vertical (m/s²)", *rows])
    Path("records/a_1797rpm.csv").write_text(text, encoding="utf-8")
    names: dict[str, Any] = {}
    printed = []
    assert len(BLOCKS) >= 3
    for block in BLOCKS:
        exec(compile(block, "README.md", "exec"), names)
        printed.append(capsys.readouterr().out)
    assert "Equilibrium" in printed[0]
    assert "[121 rows x 37 columns]" in printed[0]
    assert "of a catalogue, by the bearing's number" in printed[1]
    assert "a_1797rpm.csv" in printed[2]
    assert names["motion"].completed
    assert np.isfinite(names["density"]).all()
