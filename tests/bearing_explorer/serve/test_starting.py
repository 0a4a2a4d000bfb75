"""Several servers that start at once with nothing compiled."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.benchmarks.starting import start


@pytest.mark.proof
def test_servers_that_start_at_once_draw_the_same(tmp_path: Path) -> None:
    first = start(2, tmp_path)
    [later] = start(1, tmp_path)
    assert later.picture
    for one in (*first, later):
        assert one.picture == later.picture
        assert "Traceback" not in one.log


@pytest.mark.proof
def test_a_first_map_imports_nothing_on_the_event_loop() -> None:
    code = (
        "import sys; from bearing_explorer.__main__ import _load_figures; _load_figures();"
        "import holoviews as hv, numpy as np; known = set(sys.modules);"
        "hv.Image(np.ones((3, 3))); print(len(set(sys.modules) - known))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split()[-1] == "0"
