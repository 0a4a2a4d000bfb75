"""Figures that are zoomed into know the way back from the first."""

from __future__ import annotations

import pytest
from bearing_explorer.page import SECTIONS
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import View

VIEWS = [view for section in SECTIONS for view in section.views]


@pytest.mark.parametrize("view", VIEWS, ids=lambda view: view.name)
def test_every_figure_has_a_way_back(view: type[View]) -> None:
    """Also those whose ranges no packet ever moves: two clicks on them did nothing."""
    for plot in view(PackedSource()).figures:
        for shown in (plot.x_range, plot.y_range):
            assert (shown.reset_start, shown.reset_end) == (shown.start, shown.end)
