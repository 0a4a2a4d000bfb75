"""Bearings from the frequencies of their parts."""

import math

import pytest

from bearingcore import Bearing, catalogue
from bearingcore.bearings.frequencies import bearing_of_frequencies

TURN = 2.0 * math.pi
LISTED = [one.bearing for one in catalogue().values()]


def orders(bearing: Bearing) -> dict[str, float]:
    return {name: getattr(bearing, name)(TURN) for name in ("bpfo", "bpfi", "ftf", "bsf")}


@pytest.mark.parametrize("bearing", LISTED)
@pytest.mark.parametrize("known", ["bpfo bpfi bsf", "bpfo ftf bsf", "bpfi ftf bsf"])
@pytest.mark.parametrize("scale", [0.5, 2.0])
def test_frequencies_lead_back_to_the_bearing(bearing: Bearing, known: str, scale: float) -> None:
    """Whatever its size, and whether the spin or twice the spin is printed."""
    given = {name: orders(bearing)[name] for name in known.split()}
    found = bearing_of_frequencies(given, scale * bearing.pitch_diameter)
    assert orders(found) == pytest.approx(orders(bearing), rel=2e-3)
    assert found.n_balls == bearing.n_balls
    doubled = bearing_of_frequencies({**given, "bsf": 2.0 * given["bsf"]}, bearing.pitch_diameter)
    assert orders(doubled) == pytest.approx(orders(bearing), rel=2e-3)
    assert "pitch_diameter" in found.estimated


@pytest.mark.parametrize(
    ("given", "allowed"),
    [
        ({"bpfo": 3.2}, "BPFO and BPFI"),
        ({"bpfo": 3.2, "bpfi": 5.3}, "nearly a whole number"),
        ({"bpfo": 4.8, "bpfi": 3.2}, "more than BPFO"),
        ({"bpfo": 0.2, "bpfi": 0.4}, "nearly a whole number"),
        ({"bpfo": math.nan, "bpfi": 4.8}, "finite"),
        ({}, "BPFO and BPFI"),
    ],
)
def test_frequencies_of_no_bearing_are_refused(given: dict[str, float], allowed: str) -> None:
    with pytest.raises(ValueError, match=allowed):
        bearing_of_frequencies(given, 0.04)
