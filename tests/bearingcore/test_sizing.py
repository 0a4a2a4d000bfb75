"""The size of a defect from a housing signal: two that differ by a ball spacing are told apart."""

from __future__ import annotations

import numpy as np
import pytest

from bearingcore import presets, simulate
from bearingcore.recording import Recording
from bearingcore.sizing import size_defect

RIG = presets["fan-rig"]


@pytest.mark.parametrize(("extent_deg", "spacings"), [(12.9, 0), (38.6, 1)])
def test_a_ball_spacing_more_is_told_from_the_ringing(extent_deg: float, spacings: int) -> None:
    """The paper's pair of defects, at 20 dB: alike in time between events, not in frequency."""
    motion = simulate(RIG.replace(extent=np.radians(extent_deg)), 1.4)
    signal = motion.outer_acceleration
    noise = np.random.default_rng(5).normal(size=signal.shape) * 0.1 * signal.std(axis=0)
    found = size_defect(Recording(signal + noise, motion.sample_rate), RIG)
    best = max(found.candidates, key=lambda candidate: candidate.probability)
    assert np.degrees(best.extent) == pytest.approx(extent_deg, abs=1.0)
    assert int(best.extent / RIG.bearing.ball_spacing) == spacings
    assert best.probability > 0.9
    assert sum(candidate.probability for candidate in found.candidates) == pytest.approx(1.0)
