"""Ranges that grow at once and shrink late."""

import numpy as np
import pytest
from bearing_explorer.kit.plots.ranges import StickyRange, nice_range


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (0.0, 48.6, (0.0, 50.0)),
        (0.0, 1389.0, (0.0, 1400.0)),
        (364.6, 1840.0, (200.0, 2000.0)),
        (-4.6, 4.6, (-6.0, 6.0)),
        (0.0, 5e-5, (0.0, 5e-5)),
        (2.0, 2.0, (1.0, 3.0)),
        (0.0, 0.0, (-0.6, 0.6)),
    ],
)
def test_nice_ranges_hold_their_numbers_on_round_ones(
    low: float, high: float, expected: tuple[float, float]
) -> None:
    assert nice_range(low, high) == pytest.approx(expected)


def test_it_grows_at_once_and_shrinks_only_below_half() -> None:
    shown = StickyRange(0.0, 1.0, anchor="zero")
    assert shown.fit([10.0, 99.0]) == (0.0, 100.0)
    assert shown.fit([10.0, 51.0]) == (0.0, 100.0)  # still more than half in use
    assert shown.fit([10.0, 101.0]) == (0.0, 120.0)  # grows
    assert shown.fit([10.0, 99.0]) == (0.0, 120.0)  # and stays
    assert shown.fit([10.0, 59.0]) == (0.0, 60.0)  # shrinks


def test_numbers_that_are_none_do_not_count() -> None:
    shown = StickyRange(0.0, 5.0, anchor="zero")
    assert shown.fit([np.nan, np.inf]) == (0.0, 5.0)
    assert shown.fit([np.nan, 80.0], []) == (0.0, 80.0)


def test_zero_stays_in_and_symmetric_ranges_are_symmetric() -> None:
    assert StickyRange(0, 1, anchor="zero").fit([70.0, 80.0]) == (0.0, 80.0)
    assert StickyRange(0, 1, anchor="zero").fit([-80.0, -70.0]) == (-80.0, 0.0)
    low, high = StickyRange(0, 1, anchor="symmetric").fit([-1.0, 4.6])
    assert low == -high
    assert high >= 4.6


@pytest.mark.parametrize("anchor", ["free", "zero", "symmetric"])
def test_room_keeps_curves_off_the_edges(anchor: str) -> None:
    shown = StickyRange(0.0, 1.0, anchor=anchor, room=0.03)  # type: ignore[arg-type]
    for top in (50.0, 80.0, 100.0, 60.0, 30.0):
        low, high = shown.fit([0.0, top])
        assert high - top >= 0.03 * top
        assert low < 0.0 if anchor == "symmetric" else low == 0.0


@pytest.mark.parametrize("anchor", ["free", "zero", "symmetric"])
def test_noise_is_not_blown_up(anchor: str) -> None:
    shown = StickyRange(-1.0, 1.0, anchor=anchor, least_span=0.5)  # type: ignore[arg-type]
    low, high = shown.fit([1e-12, 2e-12])
    assert high - low >= 0.5
