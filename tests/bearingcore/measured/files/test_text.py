"""Tables of numbers as people and loggers write them, and units as headings give them."""

import numpy as np
import pytest

from bearingcore.measured.files import UNITS, unit_in
from bearingcore.measured.files._text import read_text
from bearingcore.measured.files._units import differentiated


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
    actual = differentiated(np.sin(omega * time + 1.0)[:, None], rate)[:, 0]
    exact = omega * np.cos(omega * time + 1.0)
    np.testing.assert_allclose(actual[100:-100], exact[100:-100], atol=1e-3 * omega)
