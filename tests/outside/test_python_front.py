"""The front for Python: files of other programs, a catalogue's rating, a record's envelope."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.signal import hilbert

from bearingcore import join_tables, presets, read_recording, read_table, scene_of, simulated_record
from tests.helpers.saved import saved
from tests.outside.witness import witness

RATE = 8000.0
RNG = np.random.default_rng(4)
SIGNAL = np.round(RNG.standard_normal(4000), 6)
TIME = np.arange(SIGNAL.size) / RATE


def written(part: slice) -> bytes:
    """A file as `numpy.savetxt` writes it."""
    table = np.column_stack([TIME, SIGNAL])[part]
    return saved(np.savetxt, table, "%.9g", ",", header="a,b", comments="")


@witness(
    "function: read_recording",
    by="NumPy's savetxt", compared="samples and rate of a file whose columns a hand names",
    within=1e-9,
)  # fmt: skip
def test_a_file_is_read_as_the_hand_says() -> None:
    recording = read_recording(
        "a.csv",
        written(slice(None)),
        columns={"time": "a", "signal": "b"},
        unit="g",
        directions="y",
    )
    assert recording.sample_rate == pytest.approx(RATE, rel=1e-9)
    np.testing.assert_allclose(recording.acceleration[:, 0], 9.80665 * SIGNAL, rtol=1e-9)


@witness(
    "function: join_tables",
    by="NumPy's savetxt", compared="a signal written in two files, joined", within=1e-9,
)  # fmt: skip
def test_two_files_are_one_signal() -> None:
    half = SIGNAL.size // 2
    parts = [slice(0, half), slice(half, None)]
    whole = join_tables([read_table(f"{k}.csv", written(part)) for k, part in enumerate(parts)])
    np.testing.assert_allclose(whole.columns[:, 1], SIGNAL, rtol=1e-9)


@witness(
    "function: scene_of",
    by="SKF's catalogue: 6205, C 14.8 kN (6205: 14 kN before), pitch diameter by (d + D)/2",
    compared="load C/15 and speed of n d_m = 150,000", within=0.06,
)  # fmt: skip
def test_a_usual_load_and_speed() -> None:
    scene = scene_of("6205")
    assert scene.load.fy == pytest.approx(-14.8e3 / 15.0, rel=0.06)
    turns = 60.0 * scene.shaft_speed / (2.0 * math.pi)
    assert turns * 0.5 * (25.0 + 52.0) == pytest.approx(150_000.0, rel=0.06)
    assert scene.healthy() == scene


@witness(
    "function: simulated_record", "output: record_x", "output: record_y",
    by="SciPy's Hilbert transform; balls pass at N/2 (1 − D/D_p) turns",
    compared="the loudest line of the squared envelope of a record", within=0.01,
)  # fmt: skip
def test_the_envelope_of_a_record_repeats_as_balls_pass() -> None:
    scene = presets["fan-rig"].replace(extent=math.radians(5.0), shaft_speed=2.0 * math.pi * 12.0)
    passing = 0.5 * 14 * (1.0 - 8.0 / 45.0) * 12.0
    record = simulated_record(scene, duration=4.0, seed=3)
    for signal in record.acceleration.T:
        envelope = np.abs(hilbert(signal)) ** 2
        lines = np.abs(np.fft.rfft((envelope - envelope.mean()) * np.hanning(signal.size)))
        frequency = np.fft.rfftfreq(signal.size, 1.0 / record.sample_rate)
        near = (frequency > 0.6 * passing) & (frequency < 1.4 * passing)
        loudest = frequency[near][lines[near].argmax()]
        assert loudest == pytest.approx(passing, rel=0.01)
