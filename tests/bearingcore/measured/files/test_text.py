"""Tables of numbers as people and loggers write them: headings, units and columns of times."""

import numpy as np
import pytest

from bearingcore.common import with_prefix
from bearingcore.errors import FieldError
from bearingcore.measured.files import UNITS, Table, unit_in
from bearingcore.measured.files._sampling import clock_columns, sampling_of
from bearingcore.measured.files._text import read_text
from bearingcore.measured.files._units import differentiate
from bearingcore.units import STANDARD_GRAVITY


def read(text: str | bytes):
    """The table in a text, in this process."""
    content = text.encode() if isinstance(text, str) else text
    return read_text("t", content, 10**6, 20)


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        ("1,2\n3,4", [[1, 2], [3, 4]]),
        ("0;1\n0,1;2", [[0, 1], [0.1, 2]]),
        ("1\t2\n3\t4\r\n", [[1, 2], [3, 4]]),
        ("1,5 2,5\n3,0 4,0", [[1.5, 2.5], [3, 4]]),
        ("0,051\n-0,5\n1,25", [[0.051], [-0.5], [1.25]]),
        ("Weg [mm]\n1,5\n1,7\n1,9", [[1.5], [1.7], [1.9]]),
        ("1,2,\n3,4,", [[1, 2], [3, 4]]),
        ('"1","2"\n"3",""', [[1, 2], [3, np.nan]]),
        ("1,2\n# remark\n\n,4", [[1, 2], [np.nan, 4]]),
        ("1e3\n1.6558e+005", [[1e3], [165580.0]]),
    ],
)
def test_habits(text, columns) -> None:
    np.testing.assert_array_equal(read(text)[1], columns)


@pytest.mark.parametrize(
    ("text", "headings"),
    [
        ("acc [g]\n1\n2", ("acc [g]",)),
        ("# time, ax\n1,2", ("time", "ax")),
        ("time [s] ax [g]\n1 2", ("time [s]", "ax [g]")),
        ("time [s]  acc x\n1 2", ("time [s]", "acc x")),
        ("Time,Acc X\ns,m/s^2\n1,2", ("Time [s]", "Acc X [m/s^2]")),
        ("remarks of many words, you see, here\n1,2", None),
        ("x,x\n1,2", ["x, column 1", "x, column 2"]),
    ],
)
def test_headings(text, headings) -> None:
    about = read(text)[0]
    assert (about["names"] if about["headed"] else None) == (
        None if headings is None else list(headings)
    )


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("2024-03-01T12:00:00.125Z,1\n2024-03-01T12:00:00.250Z,2", [0.125, 0.25]),
        ("2024-03-01 12:00:00.5+01:00 1\n2024-03-01 12:00:01.5+01:00 2", [0.5, 1.5]),
        ("Date;Time;X\n2024-02-29;23:59:59,5;1\n2024-03-01;00:00:00,5;2", [0.5, 1.5]),
        ("31.12.2024 23:59:59.5\t1\n01.01.2025 0:00:00.5\t2", [0.5, 1.5]),
        ("12/31/2024 23:59:59\t1\n01/01/2025 00:00:01\t2", [0.0, 2.0]),
        ("23:59:59.9;1\n00:00:00.1;2", [0.9, 1.1]),
    ],
)
def test_dates_and_times_of_day_are_seconds(text, seconds) -> None:
    about, columns = read(text)
    assert about["stamps"] == [0]
    np.testing.assert_allclose(columns, np.column_stack([seconds, [1, 2]]))


@pytest.mark.parametrize(
    ("heading", "unit"),
    [
        ("a / g", "g"),
        ("Vibration [mG]", "mg"),
        ("acceleration_y_m_per_s2", "m/s²"),
        ("ch1 (V)", "V"),
        ("vel [ips]", "in/s"),
        ("Zeit [µs]", "µs"),
        ("Horizontal_vibration_signals", None),
        ("Acceleration", None),
    ],
)
def test_units_in_headings(heading: str, unit: str | None) -> None:
    assert unit_in(heading) == unit


def test_factors_of_units() -> None:
    factors = [UNITS[unit] for unit in ("mg", "m/s²", "in/s²")]
    assert factors == pytest.approx([9.80665e-3, 1.0, 0.0254], rel=1e-12)


@pytest.mark.parametrize("frequency", [3.7, 123.3, 390.0])
def test_a_velocity_is_differentiated_far_from_its_ends(frequency: float) -> None:
    """A tenth of the error that differences of neighbours make, even near half the rate."""
    rate, time = 1000.0, np.arange(3000) / 1000.0
    omega = 2.0 * np.pi * frequency
    actual = differentiate(np.sin(omega * time + 1.0)[:, None], rate)[:, 0]
    exact = omega * np.cos(omega * time + 1.0)
    np.testing.assert_allclose(actual[100:-100], exact[100:-100], atol=1e-3 * omega)


RATE = 12_800.0
TIME = np.arange(3000) / RATE
ALL = (0, 3000)
WANDERS = np.cumsum(np.random.default_rng(0).exponential(1.0 / RATE, 3000))
STUMBLES = np.delete(TIME, np.arange(5, 3000, 100))
STOPS = np.concatenate([np.arange(10.0), np.full(990, 1e3)])
WITHOUT = TIME.copy()
WITHOUT[100:110] = np.nan


def drifting(share: float) -> np.ndarray:
    """Times of a clock that ends so much slower than it began."""
    return np.cumsum(np.linspace(1.0 - share, 1.0 + share, 3000)) / RATE


def mean_rate(time: np.ndarray) -> float:
    return float((len(time) - 1) / (time[-1] - time[0]))


#: times; whether they state a rate, and which; the rows that are used; what is said
CLOCKS: list[tuple[np.ndarray, bool, float | None, tuple[int, int] | None, str]] = [
    # rounded to less than a step, and to more
    *((np.round(TIME, decimals), True, RATE, ALL, "") for decimals in (9, 6, 5)),
    (np.round(TIME, 4), False, RATE, ALL, f"rounded to {with_prefix(1e-4, 's')},"),
    (np.round(TIME, 3), False, RATE, ALL, f"rounded to {with_prefix(1e-3, 's')},"),
    # of jumping times the longest part between jumps, also where they are rounded
    (np.delete(TIME, slice(1000, 1010)), True, RATE, (1000, 2990),
     "once, first after row 1000 (10 samples"),
    (np.delete(TIME, [500, 900]), True, RATE, (899, 2998), "2 times, first after row 500 (2 sampl"),
    (np.concatenate([TIME, TIME[:500]]), True, RATE, ALL, "once, also back, first after row 3000"),
    (np.round(np.delete(TIME, slice(1000, 1200)), 3), False, RATE, (1000, 2800), "jump once"),
    (np.round(np.delete(TIME, slice(1000, 1200)), 3), False, RATE, (1000, 2800), "rounded"),
    (WITHOUT, True, RATE, (110, 3000), "Times are missing in 10 rows"),
    # wandering and drifting ones say their mean
    (WANDERS, False, mean_rate(WANDERS), None, "do not rise evenly"),
    (STUMBLES, False, mean_rate(STUMBLES), None, "do not rise evenly"),
    (STOPS, False, mean_rate(STOPS), None, "do not rise evenly"),
    (drifting(0.002), True, mean_rate(drifting(0.002)), ALL, "drifts: by 0.36 %"),
    (drifting(0.02), False, mean_rate(drifting(0.02)), None, ""),
    (TIME * 1.001, True, RATE / 1.001, ALL, ""),  # a clock that is off is believed
    # what is no time
    *((time, False, None, None, ".") for time in (
        np.zeros(500), -TIME, np.where(TIME > 0.01, np.nan, TIME))),
]  # fmt: skip


@pytest.mark.parametrize(("time", "stated", "rate", "rows", "words"), CLOCKS)
def test_what_times_say(
    time: np.ndarray, stated: bool, rate: float | None, rows: tuple[int, int] | None, words: str
) -> None:
    sampling = sampling_of(time)
    assert sampling.stated == stated
    assert sampling.sample_rate == (rate and pytest.approx(rate, rel=1e-6))
    assert rows is None or (sampling.first, sampling.last) == rows
    assert words in sampling.trouble
    assert bool(sampling.trouble) == bool(words) or rows is None


def test_recordings_in_one_file_are_counted_and_any_is_read() -> None:
    values = np.random.default_rng(0).standard_normal(3800)
    times = np.concatenate([TIME[:2000], TIME[:1500], TIME[:300]])
    table = Table(("time [s]", "a [g]"), np.stack([times, values], axis=1))
    assert table.recordings == ((0, 2000), (2000, 3500), (3500, 3800))
    words = "holds 3 recordings, or parts of one; number 1, rows 1 to 2000 of 3800, is read"
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


def test_signals_are_no_clock() -> None:
    noise = np.random.default_rng(1).standard_normal((600, 6))
    assert clock_columns(noise) == 0
    assert clock_columns(np.abs(np.round(noise))) == 0
