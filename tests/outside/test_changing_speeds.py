"""A part is named by order where the speed changes and was measured beside the signal.

Source of every right value: the closed forms of `changing_speeds`, whose part and speed are known.
"""

import io
import math

import numpy as np
import pytest

from bearingcore import Recording, diagnose
from bearingcore.errors import FieldError
from bearingcore.measured.diagnosis import DiagnosisStatus, speed_over_time
from bearingcore.measured.files import read_recording
from tests.outside.changing_speeds import BALLS, CHANGES, TURN, machine
from tests.outside.witness import witness

RPM = 1500.0


def file_of(time: np.ndarray, signal: np.ndarray, beside: np.ndarray, heading: str) -> bytes:
    out = io.StringIO()
    np.savetxt(out, np.stack([time, signal, beside], axis=1), "%.7g", ",", comments="",
               header=f"t [s],acc [m/s²],{heading}")  # fmt: skip
    return out.getvalue().encode()


def pulses(turns: np.ndarray, a_turn: int = 1) -> np.ndarray:
    return ((a_turn * turns + 0.3) % 1.0 < 0.2).astype(float)


@witness(
    "function: diagnose", by="closed form signals of run-ups",
    compared="part, and mean speed", within="the part right at 90 % or more, speed to 0.5 %",
)  # fmt: skip
@pytest.mark.parametrize(
    "change", [pytest.param(c, marks=[pytest.mark.proof] * c.endswith("%")) for c in CHANGES]
)
@pytest.mark.parametrize("part", ["outer race", "inner race"])
@pytest.mark.parametrize("bearing", BALLS)
def test_a_changing_speed_is_followed(bearing: str, part: str, change: str) -> None:
    time, signal, turns = machine(bearing, part, change, 1)
    speed = 60.0 * np.gradient(turns, time)
    content = file_of(time, signal, speed, "third")
    recording = read_recording("a.csv", content, columns={"speed": 2}, speed_unit="rpm")
    answer = diagnose(recording, bearing)
    assert (answer.fault, answer.probability >= 0.9) == (part, True)
    mean = (turns[-1] - turns[0]) / (time[-1] - time[0])
    assert answer.shaft_speed == pytest.approx(TURN * mean, rel=0.005)
    assert ("over the shaft's angle" in answer.sentence) == (change != "steady")


@pytest.mark.parametrize(
    ("a_turn", "given", "ratio"),
    [(1, 1450.0, 1.0), (2, 1450.0, 1.0), (1, None, 1.0), (1, 2207.0, 0.657), (1, None, 0.657)],
)
def test_a_tachometer_is_followed(a_turn: int, given: float | None, ratio: float) -> None:
    time, signal, turns = machine("6309", "inner race", "rising by half", 2)
    counted = turns / ratio  # of the shaft with the tachometer, which a gear joins to this one
    beside = pulses(counted, a_turn)
    recording = read_recording("a.csv", file_of(time, signal, beside, "tacho [V]"))
    assert recording.shaft_angle is not None
    np.testing.assert_allclose(
        recording.shaft_angle, TURN * a_turn * counted, atol=0.05 * TURN * a_turn
    )
    speed = None if given is None else TURN / 60.0 * given
    turning = np.gradient(TURN * counted, time)
    mean = float(turning.mean())
    beside = speed_over_time(recording, mean)
    np.testing.assert_allclose(beside[500:-500], turning[500:-500], rtol=0.01)
    answer = diagnose(recording, "6309", speed, shaft_ratio=ratio)
    assert (answer.fault, answer.probability >= 0.9) == ("inner race", True)
    assert answer.shaft_speed == pytest.approx(TURN / 60.0 * RPM, rel=0.01)


@pytest.mark.parametrize(("a_turn", "said"), [(1, b""), (12, b"# pulses per revolution: 12\n")])
def test_a_steady_tachometer_gives_the_speed(a_turn: int, said: bytes) -> None:
    time, signal, turns = machine("6309", "inner race", "steady", 2)
    content = said + file_of(time, signal, pulses(turns, a_turn), "tacho [V]")
    answer = diagnose(read_recording("a.csv", content), "6309")
    assert (answer.fault, answer.probability >= 0.9) == ("inner race", True)
    assert answer.shaft_speed == pytest.approx(TURN / 60.0 * RPM, rel=0.01)


@pytest.mark.parametrize(("change", "says"), [("10 %", True), ("steady", False)])
def test_a_speed_that_changes_unmeasured_is_said(change: str, says: bool) -> None:
    _, signal, _ = machine("6205", "inner race", change, 3)
    weak = signal + 3.0 * np.random.default_rng(4).standard_normal(len(signal))
    for samples in (signal, weak):
        answer = diagnose(Recording(samples, 12_800.0, ("y",)), "6205", TURN / 60.0 * RPM)
        assert not (says and answer.names_a_part)
        assert ("take a steadier part" in answer.sentence.lower()) == (says and samples is signal)
        assert (answer.status == DiagnosisStatus.SPEED_CHANGES) == (says and samples is signal)


@pytest.mark.parametrize(
    "angle", [[0.0, 1.0], np.r_[np.arange(511.0), 5.0], np.full(512, math.nan)]
)
def test_an_angle_that_cannot_be_is_refused(angle: np.ndarray) -> None:
    signal = np.random.default_rng(5).standard_normal(512)
    with pytest.raises(FieldError, match="shaft_angle"):
        Recording(signal, 1000.0, ("y",), shaft_angle=angle)


def test_irregular_pulses_are_no_angle() -> None:
    time, signal, turns = machine("6205", "outer race", "steady", 6)
    noise = np.random.default_rng(7).standard_normal(len(time))
    for beside in (noise, pulses(turns) * (turns % 5.0 > 1.0)):
        assert read_recording("a.csv", file_of(time, signal, beside, "tacho")).shaft_angle is None


@pytest.mark.parametrize("ratio", [1.0, 0.3])
def test_a_change_is_that_of_the_shaft_and_bands_are_inside_the_record(ratio: float) -> None:
    _, signal, turns = machine("6205", "inner race", "rising by half", 8)
    signal = signal + 3.0 * np.random.default_rng(9).standard_normal(len(signal))
    recording = Recording(signal, 12_800.0, ("y",), shaft_angle=TURN * turns / ratio)
    answer = diagnose(recording, "6205", TURN / 60.0 * RPM / ratio, shaft_ratio=ratio)
    assert "it changes by 40 % as measured" in answer.sentence  # 80 to 120 % of the mean
    assert max(part.band.high for part in answer.evidence) <= 6400.0
    speeds = speed_over_time(recording)
    assert speeds is not None
    ends = TURN / 60.0 * RPM / ratio * np.array([0.8, 1.2])
    np.testing.assert_allclose(speeds[[0, -1]], ends, rtol=1e-3)
