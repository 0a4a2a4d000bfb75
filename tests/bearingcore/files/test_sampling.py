"""Columns of times: exact, rounded, jumping and wandering ones."""

import numpy as np
import pytest

from bearingcore.common.numbers import with_prefix
from bearingcore.errors import FieldError
from bearingcore.files.sampling import clock_columns, sampling_of
from bearingcore.files.table import Table
from bearingcore.units import STANDARD_GRAVITY

RATE = 12_800.0
TIME = np.arange(3000) / RATE


@pytest.mark.parametrize("decimals", [9, 6, 5])
def test_times_rounded_to_less_than_a_step_tell_the_rate(decimals: int) -> None:
    found = sampling_of(np.round(TIME, decimals))
    assert found.stated
    assert found.sample_rate == pytest.approx(RATE, rel=1e-6)
    assert not found.trouble


@pytest.mark.parametrize("decimals", [4, 3])
def test_times_rounded_to_more_than_a_step_propose_a_rate(decimals: int) -> None:
    found = sampling_of(np.round(TIME, decimals))
    assert not found.stated
    assert found.sample_rate == RATE
    assert f"rounded to {with_prefix(10.0**-decimals, 's')}," in found.trouble


@pytest.mark.parametrize(
    ("time", "rows", "words"),
    [
        (
            np.delete(TIME, slice(1000, 1010)),
            (1000, 2990),
            "once, first after row 1000 (10 samples",
        ),
        (np.delete(TIME, [500, 900]), (899, 2998), "2 times, first after row 500 (2 samples"),
        (np.concatenate([TIME, TIME[:500]]), (0, 3000), "once, first after row 3000 (back)"),
    ],
)
def test_only_the_longest_part_between_jumps_is_used(time, rows, words) -> None:
    found = sampling_of(time)
    assert found.stated
    assert found.sample_rate == pytest.approx(RATE)
    assert (found.first, found.last) == rows
    assert words in found.trouble


def test_recordings_in_one_file_are_counted_and_any_is_read() -> None:
    values = np.random.default_rng(0).standard_normal(3800)
    times = np.concatenate([TIME[:2000], TIME[:1500], TIME[:300]])
    table = Table(("time [s]", "a [g]"), np.stack([times, values], axis=1))
    assert table.recordings == ((0, 2000), (2000, 3500), (3500, 3800))
    words = "holds 3 recordings, or parts of one, of 156 ms, 117 ms and 23.4 ms; unless another is "
    words += "chosen number 1, rows 1 to 2000 of 3800, is read. The times jump 2 times"
    assert words in " ".join(table.recording([1], "y").notes)
    second = table.one_of_recordings(2).recording([1], "y")
    assert second.sample_rate == pytest.approx(RATE)
    assert second.acceleration[:, 0] == pytest.approx(STANDARD_GRAVITY * values[2000:3500])
    assert "Recording 2 of 3" in second.notes[0]
    assert (table.which, table.one_of_recordings(2).which) == (
        "recording 1 of 3", "recording 2 of 3",
    )  # fmt: skip
    with pytest.raises(FieldError, match="part is 4"):
        table.one_of_recordings(4)
    assert Table(("t [s]", "a [g]"), table.columns[:2000]).recordings == ()
    gap = table.columns[:2000].copy()
    gap[1500:1510, 1] = np.nan
    gap = Table(("t [s]", "a [g]"), gap)
    assert gap.recordings == ((0, 1500), (1510, 2000))
    assert len(gap.one_of_recordings(2).recording([1], "y").acceleration) == 490


def test_a_jump_shows_in_rounded_times_too() -> None:
    found = sampling_of(np.round(np.delete(TIME, slice(1000, 1200)), 3))
    assert not found.stated
    assert (found.first, found.last) == (1000, 2800)
    assert found.sample_rate == RATE
    assert "jump once" in found.trouble
    assert "rounded" in found.trouble


@pytest.mark.parametrize(
    "time",
    [
        np.cumsum(np.random.default_rng(0).exponential(1.0 / RATE, 3000)),
        np.delete(TIME, np.arange(5, 3000, 100)),
    ],
)
def test_times_that_wander_tell_no_rate_but_their_mean(time) -> None:
    found = sampling_of(time)
    assert not found.stated
    assert "do not rise evenly" in found.trouble
    assert found.sample_rate == pytest.approx((len(time) - 1) / (time[-1] - time[0]))


@pytest.mark.parametrize("time", [np.zeros(500), -TIME, np.where(TIME > 0.01, np.nan, TIME)])
def test_what_is_no_time_gives_no_rate(time) -> None:
    found = sampling_of(time)
    assert found.sample_rate is None
    assert found.trouble


def test_only_the_longest_part_with_times_is_used() -> None:
    time = TIME.copy()
    time[100:110] = np.nan
    found = sampling_of(time)
    assert (found.first, found.last) == (110, 3000)
    assert found.sample_rate == pytest.approx(RATE)
    assert "Times are missing in 10 rows" in found.trouble


def test_a_clock_that_drifts_a_little_says_its_mean_rate() -> None:
    time = np.cumsum(np.linspace(0.998, 1.002, 3000)) / RATE
    found = sampling_of(time)
    assert found.stated
    assert "drifts: by 0.36 %" in found.trouble
    assert found.sample_rate == pytest.approx(RATE, rel=1e-3)
    assert not sampling_of(np.cumsum(np.linspace(0.98, 1.02, 3000)) / RATE).stated


def test_a_time_that_stands_still_after_a_jump_is_no_error() -> None:
    assert not sampling_of(np.concatenate([np.arange(10.0), np.full(990, 1e3)])).stated


def test_a_clock_that_is_off_is_believed() -> None:
    assert sampling_of(TIME * 1.001).sample_rate == pytest.approx(RATE / 1.001, rel=1e-9)


def test_signals_are_no_clock() -> None:
    noise = np.random.default_rng(1).standard_normal((600, 6))
    assert clock_columns(noise) == 0
    assert clock_columns(np.abs(np.round(noise))) == 0
