"""Recordings refuse what is no signal."""

import numpy as np
import pytest

from bearingcore.signals.recording import Recording

RATE = 12_800.0
SIGNAL = np.random.default_rng(5).standard_normal((3000, 2))


@pytest.mark.parametrize(
    ("signal", "changes", "told"),
    [
        (SIGNAL, {"sample_rate": 0.0}, "sample_rate is 0"),
        (SIGNAL, {"directions": ("y", "z")}, "x, y or both"),
        (SIGNAL[:, 0], {}, "a column for each direction: x, y"),
        (SIGNAL[:100], {}, "100 samples long"),
        (SIGNAL * [1.0, np.inf], {}, "finite"),
        (SIGNAL * [1.0, 0.0], {}, "the same number throughout along y"),
        (SIGNAL * [1.0, 1e-300], {}, "swinging by .*e-300 along y"),
        (SIGNAL * 1e300, {}, "swinging by .*e.300 along x"),
    ],
)
def test_recordings_refuse_what_is_no_signal(signal, changes, told):
    arguments = {"sample_rate": RATE, "directions": ("x", "y")} | changes
    with pytest.raises(ValueError, match=told):
        Recording(signal, **arguments)
