"""Spalls from entry to exit: measured where both are there, silent where they are not."""

import math
import os
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import fftconvolve

from bearingcore import Recording, measure_extent, presets
from bearingcore.sizing import ExtentStatus
from tests.benchmarks.measured_records import records
from tests.benchmarks.scoreboard import RIGHT, WRONG, extent_verdict
from tests.outside.witness import witness

MEASURED = os.environ.get("MEASURED_RECORDS", "")
needs_records = pytest.mark.skipif(not MEASURED, reason="MEASURED_RECORDS names no folder")

MOTOR = presets["6205"].bearing
RATE, SECONDS = 25_600.0, 3.0
SPEED = 2.0 * math.pi * 15.0


def steady_time(change: float):
    """Time [s] in which a shaft at SPEED turns as far as one whose speed rises by a share of it."""
    time = np.arange(round(RATE * SECONDS)) / RATE
    return time * (1.0 - 0.5 * change + 0.5 * change * time / SECONDS)


@cache
def signal(
    race: str = "outer", apart_deg: float = 5.0, entry: float = 1.0, *, seed: int = 1, change=0.0
):
    """Soft and sharp blows so far apart, through resonances, with slip and noise.

    An `entry` of 0 leaves the sharp blows alone.
    """
    rng = np.random.default_rng(seed)
    frequency = MOTOR.bpfo(SPEED) if race == "outer" else MOTOR.bpfi(SPEED)
    count = round(RATE * SECONDS)
    steps = 1.0 + 0.004 * rng.standard_normal(math.ceil(SECONDS * frequency))
    passes = np.cumsum(steps) / frequency
    late = math.radians(apart_deg) / MOTOR.ball_spacing / frequency
    time = np.arange(round(0.02 * RATE)) / RATE
    soft = np.exp(-(((time - 0.002) / 1.2e-4) ** 2)) * (time - 0.002) / 1.2e-4
    sharp = np.exp(-(((time - 0.002) / 1.5e-5) ** 2))
    signal = np.zeros(count + len(time))
    for delay, shape in ((0.0, entry * soft), (late, sharp)):
        blows = np.zeros(count)
        at = np.interp(passes + delay, steady_time(change), np.arange(count), right=count)
        places = np.rint(at).astype(int)
        blows[places[places < count]] = 1.0
        signal[: count + len(time) - 1] += fftconvolve(blows, shape)
    path = np.zeros(len(time))
    path[0] = 1.0
    for ring, size in ((2300.0, 0.15), (4900.0, 0.2), (8100.0, 0.2)):
        path += size * np.exp(-0.03 * 2 * np.pi * ring * time) * np.sin(2 * np.pi * ring * time)
    heard = fftconvolve(signal, path)[:count]
    heard += 0.02 * rng.standard_normal(count)
    return heard + 0.3 * np.cos(SPEED * np.arange(count) / RATE)


def measured(samples, race="outer", **given):
    return measure_extent(Recording(samples, RATE, ("y",)), MOTOR, SPEED, race=race, **given)


@cache
def spall(race: str = "outer"):
    return measured(signal(race), race)


@pytest.mark.parametrize("race", ["outer", "inner"])
def test_the_time_between_knocks_and_the_offset_are_the_extent(race):
    extent = spall(race)
    assert extent.status == ExtentStatus.MEASURED
    assert math.degrees(extent.separation) == pytest.approx(5.0, abs=0.25)
    assert extent.extent == pytest.approx(extent.separation + extent.offset)
    assert extent.low < extent.extent < extent.high
    assert (extent.exit - extent.entry) % 1.0 * extent.ball_spacing == pytest.approx(
        extent.separation, abs=math.radians(0.3)
    )
    assert extent.race == race
    assert f"{math.degrees(extent.extent):.1f}°" in extent.sentence
    assert extent.alternatives[0] == (extent.extent, extent.low, extent.high)
    other = math.degrees(extent.ball_spacing - extent.separation + extent.offset)
    assert f"{other:.0f}° would look the same" in extent.sentence
    table = extent.table()
    assert table["extent"][0] == extent.extent
    assert len(table["envelope"]) == len(table["angle"])


def test_a_spall_that_would_nearly_reach_the_next_ball_is_not_believed():
    """A soft knock 5° after a sharp one may be its echo."""
    assert measured(signal()[::-1]).status == ExtentStatus.BOUNCES


def test_units_do_not_matter():
    louder = measured(1e3 * signal())
    assert louder.extent == pytest.approx(spall().extent, rel=1e-6)
    assert louder.high == pytest.approx(spall().high, rel=1e-6)


def test_a_pit_has_no_extent_to_measure():
    pit = measured(signal(entry=0.0))
    assert not pit.measured
    assert math.isnan(pit.extent)
    assert pit.status == ExtentStatus.SHORTER
    bound = f"{math.degrees(pit.high):.0f}°"
    assert pit.answer == f"shorter than about {bound} or near whole ball spacings, outer race"
    assert pit.low == 0.0
    for apart_deg in (0.7, 1.5):  # what does not resolve has a bound that holds
        close = measured(signal(apart_deg=apart_deg))
        assert not close.high < math.radians(apart_deg)


def test_noise_has_nothing_to_measure_and_names_no_race():
    noise = np.random.default_rng(4).standard_normal(round(RATE * SECONDS))
    assert measured(noise).status == ExtentStatus.NOT_VISIBLE
    blow = np.eye(1, len(noise), 999)[0]  # of a sensor that is dead else
    assert measured(blow).status == ExtentStatus.NOT_VISIBLE
    extent = measure_extent(Recording(noise, RATE, ("y",)), MOTOR, SPEED)
    assert extent.status == ExtentStatus.NO_RACE
    assert len(extent.table()["extent"]) == 1


def test_too_few_ball_passes_and_too_few_samples():
    assert measured(signal()[: round(0.15 * RATE)]).status == ExtentStatus.TOO_SHORT
    # enough for an average, and not for what its filter spoils at both ends
    some = measured(signal()[: round(16.0 / MOTOR.bpfo(SPEED) * RATE)])
    assert some.status == ExtentStatus.TOO_SHORT
    for race, share in (("outer", 32), ("inner", 8)):
        coarse = Recording(signal(race)[::share], RATE / share, ("y",))
        answer = measure_extent(coarse, MOTOR, SPEED, race=race)
        assert answer.status == ExtentStatus.TOO_COARSE


@witness(
    "function: measure_extent",
    by="spalls of the HIT-SM rig (where MEASURED_RECORDS is set), 5 and 8° as published",
    compared="extents of twelve records, and their intervals", within="1°, in all intervals",
)  # fmt: skip
@needs_records
def test_spalls_of_a_rig_are_measured():
    """Twelve of 5° and 8° within 1°, and none of 2° with an interval that it is not in."""
    spalls = [
        (one, measure_extent(one.recording, one.bearing, one.shaft_speed, race=one.truth[:5]))
        for one in records(Path(MEASURED, "hitsm"))
        if one.spall_extent_deg
    ]
    results = [extent_verdict(*pair) for pair in spalls]
    assert WRONG not in results
    for record, answer in spalls:
        assert not answer.high < math.radians(record.spall_extent_deg)
    long = [(record, answer) for record, answer in spalls if record.spall_extent_deg > 2.0]
    assert len(long) == 12
    for record, answer in long:
        assert math.degrees(answer.extent) == pytest.approx(record.spall_extent_deg, abs=1.0)
        assert math.degrees(answer.high - answer.low) <= 3.0
    assert results.count(RIGHT) >= 12


@needs_records
@pytest.mark.parametrize("collection", ["cwru", "mfpt"])
def test_pits_are_given_no_extent_that_cannot_be(collection):
    for record in records(Path(MEASURED, collection)):
        if record.truth in ("inner race", "outer race"):
            answer = measure_extent(
                record.recording, record.bearing, record.shaft_speed, race=record.truth[:5]
            )
            assert not answer.measured or answer.low < math.radians(3.0)
            assert not answer.high < math.radians(record.spall_extent_deg or 0.0)


@pytest.mark.parametrize("ratio", [1.0, 0.4])
def test_a_spall_is_as_long_where_the_speed_rises_by_half(ratio):
    steady = steady_time(0.4)
    recording = Recording(
        signal(change=0.4), RATE, ("y",), shaft_angle=SPEED * steady / ratio
    ).scale_shaft(ratio)
    answer = measure_extent(recording, MOTOR, SPEED, race="outer")
    assert math.degrees(answer.separation) == pytest.approx(5.0, abs=0.3)
    assert answer.frequency == pytest.approx(MOTOR.bpfo(SPEED), rel=0.003)
