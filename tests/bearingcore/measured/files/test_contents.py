"""Facts that files state, in the shapes in which real machines are recorded."""

import math
from typing import Any

import numpy as np
import pytest

from bearingcore import read_table
from bearingcore.measured.files import _facts as facts
from tests.helpers.saved import matlab

pytestmark = pytest.mark.usefixtures("files_read_here")

NOISE = np.random.default_rng(3).standard_normal((20_480, 8))


def lines(rows: np.ndarray, delimiter: str = ",", heading: str = "") -> bytes:
    told = [delimiter.join(f"{value:.9g}" for value in row) for row in rows]
    return "\n".join([heading, *told] if heading else told).encode()


def rpm(speed: float) -> float:
    return speed * 30.0 / math.pi


def test_case_western_variables_are_of_several_places() -> None:
    sides = {f"X130_{side}_time": NOISE[:5000, :1] for side in ("DE", "FE", "BA")}
    table = read_table("130.mat", matlab(**sides, X130RPM=np.array([[1796]], dtype="u2")))
    contents: Any = table.contents
    assert [column.place for column in contents.columns] == ["drive end", "fan end", "base"]
    assert contents.choice.columns == {"y": 0}  # the faults of this number are at the drive end
    assert not contents.choice.question
    assert contents.bearing.value == "6205-2RS, CWRU drive end"
    assert (contents.unit.value, contents.unit.stated, contents.unit.taken) == ("g", False, True)
    assert (contents.sample_rate.value, contents.sample_rate.stated) == (12_000.0, False)
    assert rpm(contents.shaft_speed.value) == pytest.approx(1796.0)
    with pytest.raises(ValueError, match="sensors at two places"):
        table.recording(["X130_DE_time", "X130_FE_time"], ["x", "y"], "g", 12e3)
    with pytest.raises(ValueError, match="12000 is likely"):
        table.recording(["X130_DE_time"], ["y"], "g")
    got = table.recording(["X130_DE_time"], ["y"], "g", 12e3)
    assert got.shaft_speed == contents.shaft_speed.value


def test_mfpt_structs_tell_rate_and_speed() -> None:
    run = {"gs": NOISE[:, :1], "sr": 48_828, "rate": 25, "load": "150"}
    table = read_table("run.mat", matlab(bearing=run, BPFO=81.125))
    contents: Any = table.contents
    assert contents.unit.stated
    assert contents.unit.value == "g"
    assert contents.load is None  # nothing says whether it is in pounds
    assert contents.said["BPFO"] == "81.125"
    got = table.recording([0], ["y"])
    assert got.sample_rate == 48_828.0
    assert got.shaft_speed == pytest.approx(2.0 * math.pi * 25.0)
    np.testing.assert_allclose(got.acceleration[:, 0], NOISE[:, 0] * 9.80665)


@pytest.mark.parametrize(
    ("delimiter", "rounding", "begin"), [(",", 0, 65_664.0), (";", -1, 954_410.0)]
)
def test_femto_columns_of_clock_and_signals(delimiter: str, rounding: int, begin: float) -> None:
    """Hours, minutes, seconds, microseconds; some printed as 9.5441e+05. One passes midnight."""
    micro = np.round(begin + np.arange(2560) / 25_600.0 * 1e6, rounding)
    second = np.where(micro >= 1e6, 0.0, 59.0)
    clock = [np.where(second > 0.0, 23.0, 0.0), second, second, micro % 1e6]
    rows = np.column_stack([*clock, NOISE[:2560, :2]])
    told = [
        delimiter.join(
            [*(f"{v:.0f}" for v in row[:3]), f"{row[3]:.5g}", *(f"{v:.4g}" for v in row[4:])]
        )
        for row in rows
    ]
    table = read_table("acc_00001.csv", "\n".join(told).encode())
    contents: Any = table.contents
    assert [column.role for column in contents.columns] == ["time"] * 4 + ["signal"] * 2
    assert contents.choice.columns == {"x": 4, "y": 5}
    assert "FEMTO" in contents.choice.reason
    assert (contents.unit.value, contents.bearing.value) == ("g", "6804RS, FEMTO-ST")
    got = table.recording([4, 5], ["x", "y"], "g")
    assert got.sample_rate == 25_600.0
    assert got.duration == pytest.approx(0.1)


def test_channels_of_structs_are_called_by_their_names() -> None:
    """As the rig of Paderborn saves them: slow channels and currents beside the vibration."""
    channels = np.zeros((1, 3), dtype=[("Name", "O"), ("Type", "O"), ("Data", "O")])
    channels[0, 0] = ("force", "f", NOISE[None, :30, 0])
    channels[0, 1] = ("phase_current_1", "c", NOISE[None, :, 0])
    channels[0, 2] = ("vibration_1", "v", NOISE[None, :, 1])
    table = read_table("KA01_1.mat", matlab(KA01_1={"Info": "rig", "Y": channels}))
    assert table.names[table.contents.choice.columns["y"]] == "KA01_1.Y.vibration_1"


def test_a_velocity_is_differentiated_with_a_note() -> None:
    time = np.arange(4000) / 4000.0
    velocity = 1e3 * np.sin(2.0 * np.pi * 80.0 * time)  # [mm/s]
    content = lines(np.column_stack([time, velocity]), heading="time [s],v [mm/s]")
    got = read_table("v.csv", content).recording([1], ["y"])
    exact = 2.0 * np.pi * 80.0 * np.cos(2.0 * np.pi * 80.0 * time)
    inside = slice(20, -20)
    np.testing.assert_allclose(got.acceleration[inside, 0], exact[inside], atol=0.5)
    assert "differentiated" in got.notes[0]


def test_a_column_of_speed_is_the_shafts_and_followed() -> None:
    both = np.column_stack([NOISE[:600, 0], 1480.0 + np.arange(600)])
    speed: Any = read_table(
        "a.csv", lines(both, heading="acc [g],speed [rpm]")
    ).contents.shaft_speed
    assert speed.stated
    assert "goes from 1480 to 2079" in speed.reason


def test_gravity_in_the_mean_tells_the_unit() -> None:
    shaken = 0.05 * NOISE[:600, :1]
    assert read_table("a.csv", lines(shaken + 1.0)).contents.unit.value == "g"
    assert read_table("a.csv", lines(shaken + 9.81)).contents.unit.value == "m/s²"


def test_a_rate_that_the_times_contradict_is_taken_but_said() -> None:
    content = lines(np.column_stack([np.arange(600) / 1e4, NOISE[:600, 0]]), heading="time,acc [g]")
    got = read_table("a.csv", content).recording([1], ["y"], sample_rate=12e3)
    assert got.sample_rate == 12e3
    assert "typed as 12000 Hz; the time column says 10000 Hz" in got.notes[0]


@pytest.mark.parametrize(
    ("name", "line", "number", "unit"),
    [
        ("a.csv", "speed: 1797 rpm", 1797.0, "rpm"),
        ("a.csv", "shaft speed = 29.95 Hz", 29.95, "Hz"),
        ("a.csv", "speed: 188 rad/s", 188.0, "rad/s"),
        ("a_1797rpm.csv", "no speed", 1797.0, "rpm"),
        ("a.csv", "shaft frequency: 29.95", 29.95, "Hz"),
    ],
)
def test_a_speed_is_in_si_and_names_the_unit_of_the_file(
    name: str, line: str, number: float, unit: str
) -> None:
    speed = facts.shaft_speed_in(facts.named_in([line]), name)
    assert speed is not None
    in_si = {"rpm": math.pi / 30.0, "Hz": 2.0 * math.pi, "rad/s": 1.0}[unit]
    assert (speed.file_unit, speed.value) == (unit, pytest.approx(number * in_si, rel=1e-12))
    assert speed.in_file_unit == pytest.approx(number, rel=1e-12)


@pytest.mark.parametrize("speed_first", [True, False])
def test_what_rises_like_a_speed_is_no_sure_clock(speed_first: bool) -> None:
    signal, speed = NOISE[:, :1], np.linspace(1200.0, 1800.0, len(NOISE))[:, None]
    both = [speed, signal] if speed_first else [signal, speed]
    rate: Any = read_table("run.csv", lines(np.hstack(both))).contents.sample_rate
    assert not rate.taken
    assert "if it is no speed: it rises from 1200 to 1800" in rate.reason
    time = np.arange(len(NOISE))[:, None] / 8000.0
    rate = read_table("a.csv", lines(np.hstack([time, signal, speed]))).contents.sample_rate
    assert (rate.value, rate.taken) == (8000.0, True)
