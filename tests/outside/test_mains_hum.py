"""A given speed stays under mains hum, and magnetic noise is no damaged race.

Source of every right value: the closed forms of `motor_signals`, from which the true speed and the
true part of each signal are known, as no program had to find them.
"""

import numpy as np
import pytest

from bearingcore import Bearing, Recording, diagnose
from bearingcore.measured.diagnosis import CANNOT_TELL, DiagnosisStatus
from tests.outside.motor_signals import INNER_ORDER, OUTER_ORDER, RATIO, TURN, Motor
from tests.outside.sample_records import FOLDER, MOTORS
from tests.outside.witness import witness

BALL = 7.94e-3
MOTOR_BEARING = Bearing.from_drawing(
    9, BALL, BALL / RATIO, 0.52 * BALL, 0.53 * BALL, contact_angle=0.0
)
BALL_ORDER = 1.0 / RATIO - RATIO
"""Twice the spin of a ball, in turns of the shaft."""


def answer(motor: Motor, seed: int, rpm=None):
    given = motor.rpm if rpm is None else rpm
    speed = tuple(TURN / 60.0 * np.array(given)) if np.ndim(given) else TURN / 60.0 * given
    return diagnose(Recording(motor.signal(seed), motor.rate, ("y",)), MOTOR_BEARING, speed)


def hum(mains: float) -> list[tuple[float, float]]:
    return [(2.0 * mains, 0.8), (4.0 * mains, 0.32), (6.0 * mains, 0.2)]


def rpm_of(diagnosis) -> float:
    return 60.0 / TURN * diagnosis.shaft_speed


def check_pair(rpm: float, mains: float, seed: int) -> None:
    """The same part and the true speed, with hum and without."""
    for tones in ([], hum(mains)):
        slip = 0.002 * (seed % 5 - 2)
        motor = Motor(rpm, "inner race", height=1.5, slip=slip, hum=tones)
        diagnosis = answer(motor, seed)
        assert diagnosis.fault == "inner race"
        assert rpm_of(diagnosis) == pytest.approx(rpm, rel=1e-3)


@witness(
    "function: diagnose",
    by="closed form signals of motors",
    compared="part and speed",
    within="the part right, speed to 0.1 %",
)
@pytest.mark.parametrize(("rpm", "mains"), [(2955.0, 50.0), (1478.0, 50.0), (3546.0, 60.0)])
def test_hum_changes_neither_part_nor_speed(rpm, mains):
    check_pair(rpm, mains, 0)


@pytest.mark.proof
@pytest.mark.parametrize("seed", [0, 2, 4])  # slips of -0.4, 0 and 0.4 %
@pytest.mark.parametrize(
    ("rpm", "mains"),
    [(2955.0, 50.0), (2960.0, 50.0), (2965.0, 50.0), (1478.0, 50.0),
     (3546.0, 60.0), (3552.0, 60.0), (3558.0, 60.0), (1774.0, 60.0)],
)  # fmt: skip
def test_all_pairs_agree(rpm, mains, seed):
    check_pair(rpm, mains, seed)


@pytest.mark.parametrize(("rpm", "mains"), [(1478.0, 50.0), (2960.0, 50.0), (1774.0, 60.0)])
def test_a_sound_motor_does_not_turn_at_the_mains_frequency(rpm, mains):
    diagnosis = answer(Motor(rpm, hum=[*hum(mains), (mains, 0.5), (3.0 * mains, 0.3)]), 3)
    assert not diagnosis.names_a_part
    assert rpm_of(diagnosis) == pytest.approx(rpm, rel=1e-3)


@pytest.mark.parametrize("bounds", [(1477.0, 1479.0), (1470.0, 1490.0), (1400.0, 1560.0)])
@pytest.mark.parametrize("part", ["inner race", "outer race"])
def test_a_speed_is_never_outside_given_bounds(bounds, part):
    diagnosis = answer(Motor(1478.0, part, height=1.5, slip=-0.008, hum=hum(50.0)), 1, bounds)
    assert diagnosis.fault == part
    assert bounds[0] <= rpm_of(diagnosis) * (1.0 + 1e-12)
    assert rpm_of(diagnosis) <= bounds[1] * (1.0 + 1e-12)


def test_a_speed_that_is_off_is_refined_to_a_thousandth():
    """Lines of unbalance that the mains cannot make are evidence: the true speed is 2931 rpm."""
    lines = (0.5, 0.3, 0.2, 0.2, 0.1, 0.1)
    motor = Motor(2931.0, "inner race", height=1.0, shaft_lines=lines, hum=hum(50.0))
    diagnosis = answer(motor, 2, 2955.0)
    assert "refined" in diagnosis.speed_source
    assert rpm_of(diagnosis) == pytest.approx(2931.0, rel=1e-3)


@pytest.mark.proof
@pytest.mark.parametrize("tones", [True, False])
def test_refined_speeds_are_right_to_a_thousandth(tones):
    """Of motors of any speed on either mains, given up to 1.8 % off; none outside its window."""
    rng = np.random.default_rng(41)
    moved = 0
    for seed in range(30):
        mains = float(rng.choice([50.0, 60.0]))
        rpm = float(
            rng.choice([rng.uniform(600.0, 3600.0), 30.0 * mains - 22.0, 60.0 * mains - 45.0])
        )
        off = float(rng.choice([0.0, 0.003, -0.01, 0.018]))
        motor = Motor(
            rpm,
            str(rng.choice(["inner race", "outer race", ""])),
            height=rng.uniform(0.3, 3.0),
            slip=rng.uniform(-0.01, 0.01),
            shaft_lines=[float(rng.exponential(0.3)) for _ in range(int(rng.integers(2, 8)))],
            hum=[(k * mains, rng.uniform(0.02, 1.5)) for k in range(1, 13) if tones and k % 3],
            duration=float(rng.choice([2.0, 4.0])),
        )
        diagnosis = answer(motor, seed, rpm * (1.0 + off))
        if "refined" in diagnosis.speed_source:
            moved += 1
            assert rpm_of(diagnosis) == pytest.approx(rpm, rel=1e-3)
        else:
            assert rpm_of(diagnosis) == pytest.approx(rpm * (1.0 + off), rel=1e-9)
    assert moved >= 5


@pytest.mark.parametrize(
    ("frequency", "order", "sharpness"),
    [(100.0, OUTER_ORDER, 4.0), (120.0, OUTER_ORDER, 4.0), (100.0, OUTER_ORDER / 1.012, 4.0),
     (120.0, INNER_ORDER, 4.0), (100.0, BALL_ORDER, 1.0)],
)  # fmt: skip
def test_magnetic_noise_at_twice_the_mains_is_no_damaged_part(frequency, order, sharpness):
    """A sound bearing whose line is there, and noise that swells with the magnetic pull."""
    motor = Motor(60.0 * frequency / order, swell=(frequency, 0.8), sharpness=sharpness)
    diagnosis = answer(motor, 0)
    assert (diagnosis.fault, diagnosis.status) == (CANNOT_TELL, DiagnosisStatus.MAGNETIC)
    assert diagnosis.probability < 0.5
    assert f"twice the mains frequency ({frequency:g} Hz) looks alike" in diagnosis.sentence


@pytest.mark.parametrize(("harmonic", "rpm"), [(1, 1273.0), (2, 646.0)])
def test_one_line_in_all_bands_is_no_ball(harmonic, rpm):
    """All noise swells by two fifths 100 times a second: a harmonic of a ball's line, all alone."""
    assert harmonic * BALL_ORDER * rpm / 60.0 == pytest.approx(100.0, rel=0.02)
    diagnosis = answer(Motor(rpm, swell=(100.0, 0.4), sharpness=1.0, duration=3.0), 0)
    assert not diagnosis.names_a_part
    assert diagnosis.of("ball").probability < 0.5


@pytest.mark.parametrize(
    ("frequency", "least", "most"), [(100.5, 0.5, 0.8), (100.9, 0.8, 0.95), (103.0, 0.97, 1.0)]
)
def test_damage_near_twice_the_mains_is_less_sure_and_says_so(frequency, least, most):
    diagnosis = answer(Motor(60.0 * frequency / OUTER_ORDER, "outer race", height=1.5), 0)
    assert diagnosis.fault == "outer race"
    assert least <= diagnosis.probability <= most
    assert ("looks alike" in diagnosis.sentence) == (frequency < 101.0)


@pytest.mark.parametrize(("name", "faults"), [("motor-a.csv", ["inner race"]),
                                              ("motor-b.csv", [CANNOT_TELL, "none"])])  # fmt: skip
def test_the_records_to_try_are_of_the_closed_forms_and_are_judged_so(name, faults):
    text = (FOLDER / name).read_text(encoding="utf-8")
    assert "not measured" in text
    values = np.array(text.splitlines()[5:], dtype=float)
    np.testing.assert_allclose(values, MOTORS[name].signal(1), atol=0.011)
    assert diagnose(FOLDER / name).fault in faults
