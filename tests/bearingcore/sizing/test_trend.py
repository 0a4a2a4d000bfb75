"""Numbers of many recordings of one machine."""

import math
from dataclasses import replace
from datetime import datetime

import numpy as np
import pytest

from bearingcore import Recording, presets, trend
from bearingcore.measured.diagnosis import CANNOT_TELL
from bearingcore.sizing import LINES

BEARING = presets["6205"].bearing
RATE, TURN = 12_000.0, 25.0
SPEED = 2.0 * math.pi * TURN
TIME = np.arange(int(2 * RATE)) / RATE
BAND = (2500.0, 3500.0)


def recorded(depth: float, name: str = "", duration: float = 2.0) -> Recording:
    """Noise, and a 3 kHz tone that swells with BPFO by a share `depth` of 2 m/s²."""
    rng = np.random.default_rng(len(name))
    swell = 2.0 * (1.0 + depth * np.cos(2.0 * math.pi * BEARING.bpfo(SPEED) * TIME))
    signal = swell * np.sin(2.0 * math.pi * 3000.0 * TIME)
    signal += 0.3 * rng.standard_normal(TIME.size)
    return Recording(signal[: round(duration * RATE), None], RATE, ("y",), name)


def test_amplitudes_of_lines_and_only_those_above_noise():
    recordings = [
        replace(recorded(depth), recorded=datetime(2026, 5, day))
        for depth, day in ((0.0, 1), (0.2, 3), (0.5, 12))
    ]
    history = trend(recordings, BEARING, SPEED, band=BAND)
    assert history.hours.tolist() == [0.0, 48.0, 264.0]
    assert (history.seen_since("outer race"), history.seen_since("ball")) == (1, None)
    outer = LINES.index("bpfo")
    lines = history.clear_lines
    assert lines[1:, outer] == pytest.approx([0.4, 1.0], rel=0.1)
    assert np.isnan(lines[0]).all()
    assert np.isnan(np.delete(lines[1], outer)).all()


def test_the_baseline_is_what_others_are_compared_with():
    recordings = [recorded(0.0), recorded(0.5)]
    first, second = (
        trend(recordings, BEARING, SPEED, band=BAND, baseline=k).rms_change for k in (0, 1)
    )
    assert first[0] == second[1] == 1.0
    assert first[1] == pytest.approx(1.0 / second[0])
    with pytest.raises(ValueError, match="baseline"):
        trend(recordings, BEARING, SPEED, band=BAND, baseline=2)


def test_it_ends_where_it_is_cancelled_with_what_it_has():
    seen = []

    def goes_on(so_far, of):
        seen.append((len(so_far.points), of))
        return len(seen) < 2

    recordings = [recorded(0.1)] * 3
    history = trend(recordings, BEARING, SPEED, band=BAND, goes_on=goes_on)
    assert seen == [(1, 3), (2, 3)]
    assert len(history.points) == 2


def test_what_is_not_known_is_not_a_number():
    short = trend([recorded(0.5, duration=0.1)], BEARING, SPEED, band=BAND)
    assert math.isnan(short.column("lines")[0, LINES.index("ftf")])
    assert math.isnan(short.points[0].extent.extent)


def test_without_bearing_and_speed_levels_stay_and_no_part_is_named():
    known = trend([recorded(0.5)], BEARING, SPEED, band=BAND).points[0]
    (alone,) = trend([recorded(0.5)], None).points
    assert (alone.rms, alone.kurtosis) == (known.rms, known.kurtosis)
    assert alone.fault == CANNOT_TELL
    assert math.isnan(alone.probability)
    assert math.isnan(alone.shaft_speed)
    assert np.isnan(alone.lines).all()
    (searched,) = trend([recorded(0.5)], BEARING).points  # the speed is looked for
    assert searched.rms == known.rms
    assert math.isnan(searched.shaft_speed) or searched.shaft_speed > 0.0
