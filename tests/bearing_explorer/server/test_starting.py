"""Several servers that start at once with nothing compiled."""

from __future__ import annotations

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
