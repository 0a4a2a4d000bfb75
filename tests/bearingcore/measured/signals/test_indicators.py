"""Condition indicators against closed forms."""

import numpy as np
import pytest

from bearingcore import Recording, indicators
from bearingcore.measured.signals import ZONES, severity_zone

RATE = 12_000.0
TIME = np.arange(36_000) / RATE


def recorded(*columns: np.ndarray, rate: float = RATE) -> Recording:
    return Recording(np.stack(columns, axis=1), rate, ("x", "y")[: len(columns)])


@pytest.mark.parametrize(
    ("recording", "why"),
    [
        (recorded(np.sin(TIME), rate=2000.0), "sample rate is 2000 Hz"),
        (recorded(np.sin(100.0 * TIME[:1200])), "0.1 s long, and 10 Hz need 0.5 s"),
    ],
)
def test_where_there_is_no_velocity_it_says_why(recording, why):
    levels = indicators(recording)
    assert np.isnan(levels.velocity_rms).all()
    assert why in levels.velocity_reason
    assert np.isfinite(levels.rms).all()


@pytest.mark.parametrize("machine", ZONES)
def test_zones_begin_at_their_boundaries(machine):
    first, second, third = ZONES[machine]
    for boundary, below, above in ((first, "A", "B"), (second, "B", "C"), (third, "C", "D")):
        assert severity_zone(boundary, machine) == below
        assert severity_zone(1.001 * boundary, machine) == above
