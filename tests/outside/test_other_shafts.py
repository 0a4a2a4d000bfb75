"""A wrong speed, a wrong sample rate or another shaft's bearing is no damaged outer race.

Source of every right value: the closed forms of `motor_signals`, whose part and speed are known.
"""

import numpy as np
import pytest

from bearingcore import Diagnosis, Recording, diagnose
from bearingcore.common import number
from bearingcore.measured.diagnosis import CANNOT_TELL, DiagnosisStatus
from tests.outside.motor_signals import INNER_ORDER, OUTER_ORDER, TURN, Motor
from tests.outside.test_mains_hum import MOTOR_BEARING
from tests.outside.witness import witness

RPM, LINES = 1480.0, (0.8, 0.4, 0.2)
AS_OUTER = OUTER_ORDER / INNER_ORDER
"""Of the speed of a shaft, at which its inner race's lines are those of an outer race."""


def answer(signal: np.ndarray, rate: float, rpm: float = RPM) -> Diagnosis:
    return diagnose(Recording(signal[:, None], rate, ("y",)), MOTOR_BEARING, TURN / 60.0 * rpm)


def test_a_wrong_sample_rate_names_no_part_and_says_where_the_shaft_is() -> None:
    motor = Motor(RPM, "inner race", height=1.5, shaft_lines=LINES)
    assert answer(motor.signal(1), motor.rate).fault == "inner race"
    diagnosis = answer(motor.signal(1), AS_OUTER * motor.rate)
    assert (diagnosis.fault, diagnosis.status) == (CANNOT_TELL, DiagnosisStatus.OTHER_SHAFT)
    assert max(one.probability for one in diagnosis.evidence) < 0.5
    spacing = diagnosis.of("outer race").foreign_spacing
    assert spacing == pytest.approx(AS_OUTER * RPM / 60.0, rel=0.01)
    shown = float(diagnosis.sentence.split("own lines are at ")[1].split(" rpm")[0])
    assert shown == pytest.approx(AS_OUTER * RPM, rel=1e-3)


@pytest.mark.parametrize("ratio", [AS_OUTER, 0.997 * AS_OUTER])
def test_an_inner_race_of_a_driven_shaft_is_no_outer_race(ratio: float) -> None:
    driven = Motor(ratio * RPM, "inner race", height=1.5, shaft_lines=())
    signal = driven.signal(2) + Motor(RPM, shaft_lines=LINES).signal(3)
    diagnosis = answer(signal, driven.rate)
    assert not diagnosis.names_a_part
    assert "Neither this shaft nor its cage" in diagnosis.sentence
    assert "own lines" not in diagnosis.sentence  # they are where they were said to be


@witness(
    "function: diagnose", by="closed form signals of motors",
    compared="part and speed of a shaft behind a gear, by its teeth", within=0.005,
)  # fmt: skip
@pytest.mark.parametrize("part", ["outer race", "inner race"])
@pytest.mark.parametrize("teeth", [(23, 47), (71, 37)])
def test_a_bearing_behind_a_gear_is_diagnosed_by_the_ratio(teeth: tuple, part: str) -> None:
    ratio = teeth[0] / teeth[1]
    driven = Motor(RPM * teeth[0] / teeth[1], part, height=2.5, shaft_lines=())
    signal = driven.signal(2) + Motor(RPM, shaft_lines=LINES).signal(3)
    recording = Recording(signal[:, None], driven.rate, ("y",))
    for speed in (RPM, (0.998 * RPM, 1.002 * RPM)):
        given = np.multiply(TURN / 60.0, speed)
        diagnosis = diagnose(recording, MOTOR_BEARING, given, shaft_ratio=ratio)
        assert diagnosis.fault == part
        assert diagnosis.shaft_speed == pytest.approx(TURN / 60.0 * driven.rpm, rel=0.005)
        assert f"{number(ratio, 4)} times the measured shaft" in diagnosis.sentence
    assert not answer(signal, driven.rate).names_a_part


@witness(
    "function: diagnose", by="closed form signals of motors",
    compared="speed that is proposed, where the stated one is off", within=0.002,
)  # fmt: skip
@pytest.mark.parametrize("off", [0.965, 1.035])
def test_a_nameplate_that_is_off_is_answered_by_the_speed_of_the_lines(off: float) -> None:
    motor = Motor(RPM, "outer race", height=1.5, shaft_lines=LINES)
    diagnosis = answer(motor.signal(4), motor.rate, off * RPM)
    assert not diagnosis.names_a_part
    proposed = float(diagnosis.sentence.split("give ")[1].split(" rpm")[0].replace(" ", ""))
    assert proposed == pytest.approx(RPM, rel=0.002)
    assert answer(motor.signal(4), motor.rate, proposed).fault == "outer race"


@pytest.mark.parametrize("seed", [5, 6, 7])
def test_the_second_of_two_damaged_races_has_a_probability_of_its_own(seed: int) -> None:
    outer = Motor(RPM, "outer race", height=1.5, shaft_lines=LINES)
    inner = Motor(RPM, "inner race", height=1.5, shaft_lines=())
    both = answer(outer.signal(seed) + inner.signal(seed + 10), outer.rate)
    assert both.probability >= 0.5
    assert both.other_race is not None
    assert {both.fault, both.other_race.part} == {"outer race", "inner race"}
    assert f"The {both.other_race.part} shows too" in both.sentence
    for alone in (outer, inner):
        only = answer(alone.signal(seed) + Motor(RPM).signal(seed), outer.rate)
        assert only.fault == alone.part
        assert only.other_race is None
