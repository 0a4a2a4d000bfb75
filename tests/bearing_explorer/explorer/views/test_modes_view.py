"""Natural frequencies: bands are what the curves cover, labels keep their distance."""

import numpy as np
import pytest
from bearing_explorer.explorer.plots.frequency_bands import spread
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.modes import NaturalFrequencies
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from hypothesis import given, strategies as st

from bearingcore import presets

FAN_RIG = presets["fan-rig"]


@pytest.mark.parametrize("name", list(presets))
def test_each_band_holds_a_curve_that_is_drawn_and_little_more(name: str) -> None:
    results = Results(presets[name])
    sources, ranges = NaturalFrequencies(PackedSource()).data(results)
    bands = sources["modes_bands"]
    drawn = []
    for direction in style.DIRECTIONS:
        line = sources[f"modes_{direction}"]["frequency"]
        breaks = np.flatnonzero(np.isnan(line))
        for curve in np.split(line, breaks):
            known = curve[np.isfinite(curve)]
            if known.size:
                drawn.append((known.min(), known.max()))
    least, most = np.sort(np.array(drawn), axis=0).T
    low, high = np.sort(bands["low"]), np.sort(bands["high"])
    assert np.all(((1.0 - 1e-9) * low <= least) & (least <= 1.02 * low))
    assert np.all((0.98 * high <= most) & (most <= (1.0 + 1e-9) * high))
    assert len(drawn) == len(results.modes.label)
    low, high = ranges["modes_frequency"]
    assert low <= bands["low"].min()
    assert bands["high"].max() <= high


@given(
    st.lists(st.floats(0.0, 2000.0), max_size=12),
)
def test_labels_never_overlap_and_stay_in_order(places: list[float]) -> None:
    moved = spread(np.array(places), 80.0, 0.0, 2000.0)
    order = np.argsort(places, kind="stable")
    assert np.all(np.diff(moved[order]) >= 80.0 - 1e-6)
