"""Bearings from the frequencies of their parts."""

import math

import pytest

from bearingcore import Bearing, catalogue
from bearingcore.bearings import bearing_of_frequencies

TURN = 2.0 * math.pi
LISTED = [entry.bearing for entry in catalogue().values()]


def orders(bearing: Bearing) -> dict[str, float]:
    return {name: getattr(bearing, name)(TURN) for name in ("bpfo", "bpfi", "ftf", "bsf")}


@pytest.mark.parametrize("bearing", LISTED)
@pytest.mark.parametrize("known", ["bpfo bpfi bsf", "bpfo ftf bsf", "bpfi ftf bsf"])
@pytest.mark.parametrize("scale", [0.5, 2.0])
def test_frequencies_lead_back_to_the_bearing(bearing: Bearing, known: str, scale: float) -> None:
    """Whatever its size, and whether the spin or twice the spin is printed."""
    given = {name: orders(bearing)[name] for name in known.split()}
    estimate = bearing_of_frequencies(given, scale * bearing.pitch_diameter)
    assert orders(estimate) == pytest.approx(orders(bearing), rel=2e-3)
    assert estimate.n_balls == bearing.n_balls
    doubled = bearing_of_frequencies({**given, "bsf": 2.0 * given["bsf"]}, bearing.pitch_diameter)
    assert orders(doubled) == pytest.approx(orders(bearing), rel=2e-3)
    assert "pitch_diameter" in estimate.estimated
