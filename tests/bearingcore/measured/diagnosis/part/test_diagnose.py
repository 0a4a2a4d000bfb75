"""The damaged part is named rightly where it can be told, and not at all where it cannot."""

import dataclasses
import json
import math
import os
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import fftconvolve

from bearingcore import Recording, diagnose, presets
from bearingcore.measured.diagnosis import (
    CANNOT_TELL,
    NONE_SEEN,
    PARTS,
    DiagnosisStatus,
    part_lines,
)
from bearingcore.measured.diagnosis._part import say
from tests.bearingcore.measured.diagnosis.signals_made import (
    Machine,
    background,
    knock_times,
    knocks,
    resonances,
    tone,
)
from tests.benchmarks.measured_records import records
from tests.benchmarks.scoreboard import FILE, WRONG, verdict
from tests.outside.changing_speeds import BALLS, machine
from tests.outside.motor_signals import Motor
from tests.outside.witness import witness

MEASURED = os.environ.get("MEASURED_RECORDS", "")
TURN = 2.0 * math.pi
MOTOR = Machine(9, 7.94 / 39.04, 29.93, 12_000.0, 4.0)


def made(part: str, decibels: float, seed: int, machine: Machine = MOTOR) -> np.ndarray:
    """A damaged motor bearing's signal."""
    rng = np.random.default_rng([99, seed])
    rest = background(machine, rng)
    knocking = knocks(machine, part, rng)
    return np.asarray(rest + knocking * 10.0 ** (decibels / 20.0) * rest.std() / knocking.std())


def answer(signal, machine: Machine = MOTOR, speed=None, **told):
    recording = Recording(signal, machine.rate, ("y",) if np.ndim(signal) == 1 else ("x", "y"))
    return diagnose(
        recording, machine.bearing, machine.shaft_speed if speed is None else speed, **told
    )


@pytest.fixture(scope="module")
def damaged() -> dict[str, np.ndarray]:
    return {part: made(part, 10.0, 3) for part in PARTS}


@pytest.fixture(scope="module")
def healthy() -> np.ndarray:
    return background(MOTOR, np.random.default_rng(12))


@pytest.mark.parametrize("part", PARTS)
def test_the_damaged_part_is_named_with_its_lines(damaged, part):
    diagnosis = answer(damaged[part])
    assert diagnosis.fault == part
    assert 0.5 < diagnosis.probability < 1.0
    assert part in diagnosis.sentence
    evidence = diagnosis.of(part)
    assert evidence.level > evidence.noise + 2.0
    assert evidence.nominal_frequency == pytest.approx(MOTOR.lines[part], rel=3e-3)
    assert evidence.slip == pytest.approx(evidence.frequency / evidence.nominal_frequency - 1.0)
    assert abs(evidence.slip) <= 0.02
    assert evidence.order == pytest.approx(evidence.frequency / (diagnosis.shaft_speed / TURN))
    assert evidence.lead > 5.0
    # what turns through the load zone has sidebands
    weaker = evidence.level - evidence.sidebands[:3].mean()
    assert weaker > 8.0 if part == "outer race" else weaker < 12.0
    for other in set(PARTS) - {part}:
        assert diagnosis.of(other).level < evidence.level - 3.0


def test_a_ball_that_slips_and_wanders_is_named_by_its_broad_lines():
    """4 % slower than rolling, wandering by 1.2 %: no line is sharp enough to stand out alone."""
    rng = np.random.default_rng(0)
    machine = dataclasses.replace(MOTOR, duration=8.0)
    times = knock_times(0.96 * machine.lines["ball"], machine.duration, rng, 0.012, 0.02)
    train = np.zeros(int(machine.duration * machine.rate) + 1)
    carried = np.cos(0.5 * machine.cage * TURN * times) ** 2  # through the load and out of it
    hits = carried * rng.uniform(0.3, 1.0, len(times))
    np.add.at(train, (times * machine.rate).astype(int), hits)
    ringing = fftconvolve(train, resonances(machine.rate, rng))[: len(train) - 1]
    diagnosis = answer(ringing / ringing.std() + rng.standard_normal(len(ringing)), machine)
    assert diagnosis.fault == "ball"
    assert diagnosis.of("ball").slip == pytest.approx(-0.04, abs=0.012)
    assert diagnosis.of("ball").lead < 3.0 < 9.0 < diagnosis.of("ball").deviations


@pytest.mark.parametrize(
    ("part", "preset"), [("inner race", "fan-rig"), ("outer race", "seven-ball")]
)
def test_a_race_is_no_ball_of_a_bearing_whose_ball_lines_are_there(damaged, part, preset):
    """2 BSF of the other bearing is where the race has its line; no cage carries what makes it."""
    bearing = presets[preset].bearing
    assert part_lines(bearing)[2].order == pytest.approx(MOTOR.lines[part] / MOTOR.turns, rel=0.025)
    diagnosis = diagnose(Recording(damaged[part], MOTOR.rate, ("y",)), bearing, MOTOR.shaft_speed)
    assert (diagnosis.fault, diagnosis.status) == (CANNOT_TELL, DiagnosisStatus.UNMODULATED)
    assert diagnosis.of("ball").level > diagnosis.of("ball").noise + 2.0
    assert "Check the bearing's geometry" in diagnosis.sentence


def test_faint_lines_of_a_race_name_none_and_the_sentence_says_what_may_make_them():
    diagnosis = answer(made("outer race", -17.0, 3))
    evidence = diagnosis.of("outer race")
    assert evidence.lead > 1.2
    assert evidence.swing < 0.137
    assert (diagnosis.fault, diagnosis.status) == (CANNOT_TELL, DiagnosisStatus.PERHAPS_A_BALL)
    assert "A damaged ball or a healthy bearing may make them" in diagnosis.sentence
    stronger = answer(made("outer race", -14.0, 3))
    assert stronger.perhaps_a_ball
    assert "inspect the balls too" in stronger.sentence


def test_a_healthy_machine_is_told_so_in_words(healthy):
    diagnosis = answer(healthy)
    assert diagnosis.fault == NONE_SEEN
    assert diagnosis.conclusive
    assert not diagnosis.names_a_part
    assert "No damage seen" in diagnosis.sentence
    assert diagnosis.detectable_depth < 0.12


def test_a_speed_in_the_wrong_unit_is_asked_about_where_the_shaft_shows_at_60_times_it():
    machine = Motor(1500.0, shaft_lines=(0.5, 0.3, 0.2))
    recording = Recording(machine.signal(1), machine.rate, ("y",))
    for rpm in (25.0, 90_000.0):
        sentence = diagnose(recording, "6205", rpm * TURN / 60.0).sentence
        assert f"do not show at {rpm:.0f} rpm, but clearly at 1500 rpm" in sentence
    quiet = Motor(1500.0, shaft_lines=())
    recording = Recording(quiet.signal(1), quiet.rate, ("y",))
    assert "clearly at" not in diagnose(recording, "6205", 25.0 * TURN / 60.0).sentence


@pytest.mark.proof
@pytest.mark.parametrize(("share", "least", "most"), [(1.0, 7, 8), (0.5, 0, 3)])
def test_the_swing_that_is_named_is_that_from_which_damage_shows(share, least, most, healthy):
    """Noise whose power swings by so much at the outer race's frequency and its harmonics."""
    depth = share * answer(healthy).detectable_depth
    time = np.arange(len(healthy)) / MOTOR.rate
    passes = 1.004 * TURN * MOTOR.bearing.bpfo(MOTOR.shaft_speed)
    power = 1.0 + depth * sum(np.cos(passes * k * time) for k in range(1, 7))
    shown = [
        answer(np.sqrt(power) * np.random.default_rng(seed).standard_normal(len(time)))
        for seed in range(8)
    ]
    assert least <= sum(diagnosis.fault != NONE_SEEN for diagnosis in shown) <= most


@pytest.mark.parametrize("part", PARTS)
def test_tones_on_the_lines_are_no_damage(healthy, part):
    """Steady tones on three harmonics of a part's line, each as loud as all noise together."""
    time = np.arange(len(healthy)) / MOTOR.rate
    rng = np.random.default_rng(14)
    tones = sum(tone(time, k * MOTOR.lines[part], rng, 1.0) for k in (1, 2, 3))
    assert answer(healthy + tones).fault == NONE_SEEN


def test_a_gear_that_swells_every_turn_is_no_damage(healthy):
    time = np.arange(len(healthy)) / MOTOR.rate
    tooth = time * MOTOR.turns % 1.0
    knock = np.exp(-300.0 * tooth / MOTOR.turns) * np.sin(TURN * 2500.0 * tooth / MOTOR.turns)
    assert answer(healthy + 20.0 * knock).fault not in PARTS


def test_blows_of_the_shaft_are_none_of_a_race_that_has_its_line_there():
    machine = dataclasses.replace(MOTOR, n_balls=8, ratio=0.25, duration=1.0)
    rng = np.random.default_rng(3)
    time = np.arange(round(machine.rate)) / machine.rate
    places = np.arange(87) * machine.rate / machine.lines["outer race"]
    blows = np.bincount(places.astype(int), [1.0, 0.6, 0.8] * 29, len(time))
    ringing = fftconvolve(blows, resonances(machine.rate, rng))[: len(time)]
    turns = sum(tone(time, k * machine.turns, rng, 0.3) for k in range(1, 7))
    signal = ringing / ringing.std() + turns + 0.7 * rng.standard_normal(len(time))
    assert answer(signal, machine).fault == CANNOT_TELL


@pytest.mark.parametrize("part", PARTS)
def test_another_bearings_damage_is_not_laid_to_this_one(damaged, part):
    """8 balls of 6.75 mm on 28.5 mm, the motor's other end: none of its lines lies near."""
    other = dataclasses.replace(MOTOR, n_balls=8, ratio=6.7462 / 28.4988)
    diagnosis = answer(damaged[part], other)
    assert diagnosis.fault == CANNOT_TELL
    assert diagnosis.other is not None
    share = diagnosis.other.frequency / MOTOR.lines[part]  # a ball's lines show at parts of it too
    assert min(abs(share - part) for part in (0.25, 0.5, 1.0)) < 0.012


def add_shaft_lines(signal: np.ndarray) -> np.ndarray:
    time = np.arange(len(signal)) / MOTOR.rate
    rng = np.random.default_rng(15)
    lines = sum(tone(time, k * MOTOR.turns, rng, 0.5) for k in range(1, 7))
    return np.asarray(signal + signal.std() * lines)


@pytest.mark.parametrize("part", PARTS)
def test_a_rough_speed_is_made_fine_by_the_shaft(damaged, part):
    speed = MOTOR.shaft_speed
    diagnosis = answer(add_shaft_lines(damaged[part]), speed=(0.9 * speed, 1.12 * speed))
    assert diagnosis.fault == part
    assert diagnosis.shaft_speed == pytest.approx(speed, rel=2e-3)
    assert "shaft's own lines" in diagnosis.speed_source
    assert "turns a minute" in diagnosis.sentence
    if part == "outer race":  # no speed at all is looked for alike
        unknown = diagnose(
            Recording(add_shaft_lines(damaged[part]), MOTOR.rate, ("y",)), MOTOR.bearing
        )
        assert (unknown.fault, unknown.shaft_speed) == (part, pytest.approx(speed, rel=2e-3))


def test_a_short_record_without_a_speed_asks_for_the_speed_and_not_for_a_longer_one(damaged):
    """At 300 rpm half a second holds 8 ball passes, at the machine's own speed it holds enough."""
    half = Recording(damaged["outer race"][:6000], MOTOR.rate, ("y",))
    diagnosis = diagnose(half, MOTOR.bearing, None)
    assert diagnosis.status == DiagnosisStatus.SPEED_OPEN
    assert diagnosis.sentence.startswith("No clear result: the shaft speed is not known.")
    assert "slowest possible speed, 300 rpm: 0.5 s hold 8 ball passes" in diagnosis.sentence
    assert diagnose(half, MOTOR.bearing, MOTOR.shaft_speed).fault == "outer race"
    hopeless = Recording(damaged["outer race"][:300], MOTOR.rate, ("y",))  # 9 at 6000 rpm, too
    assert diagnose(hopeless, MOTOR.bearing, None).status == DiagnosisStatus.TOO_SHORT
    assert diagnose(half, MOTOR.bearing, 0.2).status == DiagnosisStatus.TOO_SHORT  # 2 rpm


def test_open_speeds_count_as_so_many_chances_for_another_source_to_fit(damaged):
    speed = MOTOR.shaft_speed
    sure = answer(damaged["outer race"])
    rough = answer(damaged["outer race"], speed=(0.9 * speed, 1.1 * speed))
    assert (sure.fault, rough.fault) == ("outer race", "outer race")
    odds = [diagnosis.probability / (1.0 - diagnosis.probability) for diagnosis in (sure, rough)]
    assert odds[0] / odds[1] == pytest.approx(1.0 + math.log(1.1 / 0.9) / 0.04, rel=0.05)
    just_outside = answer(damaged["outer race"], speed=(1.02 * speed, 1.275 * speed))
    assert (just_outside.fault, just_outside.shaft_speed) == (CANNOT_TELL, None)
    assert "may be the outer race at 180" in just_outside.sentence


def test_without_lines_of_the_shaft_a_wide_range_leaves_the_part_open():
    rng = np.random.default_rng(16)
    signal = knocks(MOTOR, "outer race", rng)
    signal = signal / signal.std() + 0.5 * rng.standard_normal(len(signal))
    diagnosis = answer(signal, speed=(0.5 * MOTOR.shaft_speed, 2.0 * MOTOR.shaft_speed))
    assert diagnosis.fault == CANNOT_TELL
    assert "the shaft speed decides" in diagnosis.sentence
    # what holds at one of the speeds only is no verdict
    assert 0.0 < diagnosis.probability < 0.5
    assert max(part.probability for part in diagnosis.evidence) < 0.5
    diagnosis = answer(signal)
    assert diagnosis.fault == "outer race"


@pytest.mark.parametrize(("noise", "fault"), [(0.0, CANNOT_TELL), (1e-3, NONE_SEEN)])
def test_a_tone_alone_does_not_show_that_nothing_is_damaged(noise, fault):
    """Rounded to 1e-4, a tone of 1 holds nothing else; noise of 1e-3 is what a bearing may make."""
    t = np.arange(round(4.0 * MOTOR.rate)) / MOTOR.rate
    rest = noise * np.random.default_rng(4).standard_normal(t.size)
    diagnosis = answer(np.round(np.sin(TURN * 30.0 * t) + rest, 4))
    assert diagnosis.fault == fault
    assert (diagnosis.status == DiagnosisStatus.ROUNDED) == (fault == CANNOT_TELL)


def test_a_speed_the_recording_carries_is_taken(damaged):
    recording = Recording(damaged["outer race"], MOTOR.rate, ("y",))
    object.__setattr__(recording, "shaft_speed", MOTOR.shaft_speed)
    diagnosis = diagnose(recording, MOTOR.bearing, None)
    assert diagnosis.fault == "outer race"
    assert diagnosis.speed_source.startswith("given by the recording")


def test_scale_sign_and_offset_change_nothing(damaged):
    first = answer(damaged["inner race"])
    for changed in (-1e-3 * damaged["inner race"], damaged["inner race"] + 500.0):
        again = answer(changed)
        assert again.fault == first.fault
        assert again.probability == pytest.approx(first.probability, abs=1e-3)
        assert again.of("inner race").level == pytest.approx(first.of("inner race").level, abs=0.05)


def test_two_directions_are_both_heard(damaged, healthy):
    diagnosis = answer(np.stack([healthy, damaged["outer race"]], axis=1))
    assert diagnosis.fault == "outer race"
    assert diagnosis.of("outer race").direction == "y"


def test_a_tenth_of_a_second_tells_nothing_of_health(healthy):
    diagnosis = answer(healthy[:1200])
    assert diagnosis.fault == CANNOT_TELL
    diagnosis = answer(healthy[: 1200 * 6])
    assert diagnosis.fault == CANNOT_TELL
    assert "longer recording" in diagnosis.sentence


def test_clipped_and_coarse_signals_still_tell(damaged, healthy):
    signal = damaged["outer race"]
    assert answer(np.clip(signal, -signal.std(), signal.std())).fault == "outer race"
    assert answer(np.round(signal / signal.std() * 4.0)).fault == "outer race"
    diagnosis = answer(np.clip(healthy, -0.5 * healthy.std(), 0.5 * healthy.std()))
    assert diagnosis.fault == CANNOT_TELL
    assert "clipped" in diagnosis.sentence


def test_dropouts_are_left_out(damaged, healthy):
    rng = np.random.default_rng(17)

    def gaps(signal: np.ndarray, count: int) -> np.ndarray:
        torn = signal.copy()
        for begin in rng.integers(0, len(torn) - 600, count):
            torn[begin : begin + 600] = 0.0
        return torn

    assert answer(gaps(damaged["outer race"], 15)).fault == "outer race"
    assert answer(gaps(healthy, 15)).fault == CANNOT_TELL
    mostly = healthy.copy()
    mostly[5000:] = 0.0
    diagnosis = answer(mostly)
    assert diagnosis.fault == CANNOT_TELL
    assert "dropped out" in diagnosis.sentence
    assert diagnosis.evidence == ()
    with pytest.raises(KeyError):
        diagnosis.of("ball")


def test_gaps_at_every_pass_are_no_damage(damaged, healthy):
    """A recorder that loses ten samples as often as balls pass, and fills in others."""
    passes = np.arange(0.01, 3.99, 1.0 / MOTOR.lines["outer race"])

    def torn(signal: np.ndarray, back: int) -> np.ndarray:
        torn = signal.copy()
        for begin in (passes * MOTOR.rate).astype(int):
            torn[begin : begin + 10] = signal[begin - back : begin][:10]
        return torn

    held, again = (answer(torn(healthy, back)) for back in (1, 10))
    assert not held.names_a_part
    assert not again.names_a_part
    diagnosis = answer(torn(damaged["inner race"], 1))
    assert diagnosis.fault == "inner race"
    assert "were not measured but held" in diagnosis.sentence


def test_beats_of_an_inverter_are_no_race():
    """A carrier with sidebands six times the feeding frequency apart: two outer races' lines."""
    machine = dataclasses.replace(MOTOR, n_balls=8, ratio=0.2337)
    signal = background(machine, np.random.default_rng(14))
    time, loud = np.arange(len(signal)) / machine.rate, signal.std()
    for side, height in ((-2, 0.4), (-1, 1.5), (0, 2.0), (1, 1.5), (2, 0.4)):
        at = 2700.0 + side * 2.0 * 0.99 * machine.lines["outer race"]
        signal += height * loud * np.cos(TURN * at * time + side)
    assert not answer(signal, machine).names_a_part


def test_a_few_great_blows_hide_no_damage_and_make_none(damaged, healthy):
    def hit(signal: np.ndarray) -> np.ndarray:
        signal = signal.copy()
        signal[[7000, 20_000, 33_000]] += 200.0 * signal.std()
        return signal

    assert answer(hit(damaged["outer race"])).fault == "outer race"
    diagnosis = answer(hit(healthy))
    assert diagnosis.fault == CANNOT_TELL
    assert "not at the rate of any part" in diagnosis.sentence


def test_too_low_a_rate_is_said():
    slow = dataclasses.replace(MOTOR, rate=1000.0)
    diagnosis = answer(np.random.default_rng(18).standard_normal(4000), slow)
    assert diagnosis.fault == CANNOT_TELL
    assert "1000 Hz" in diagnosis.sentence


@witness(
    "function: diagnose",
    by="80 measured records of five machines (where MEASURED_RECORDS is set)",
    compared="damaged part", within="no part wrong, every answer as stored",
)  # fmt: skip
@pytest.mark.skipif(not MEASURED, reason="MEASURED_RECORDS names no folder")
def test_measured_records_are_answered_as_the_scoreboard_says_and_none_wrongly():
    board = {row["record"]: row["answer"] for row in json.loads(FILE.read_text("utf-8"))["records"]}
    answers = [
        (record, diagnose(record.recording, record.bearing, record.shaft_speed))
        for record in records(Path(MEASURED))
    ]
    assert answers
    assert [record.name for record, told in answers if verdict(record, told) == WRONG] == []
    assert {record.name: told.fault for record, told in answers if record.name in board} == board


@pytest.mark.parametrize(("level", "lines"), [(2.0, False), (6.0, True)])
def test_a_line_below_what_noise_reaches_is_none(level, lines):
    part = SimpleNamespace(part="ball", frequency=36.98, level=level, noise=4.4)
    assert ("There are faint lines" in say.faint(part)) == lines
    assert ("No line stands out" in say.faint(part)) != lines


@pytest.mark.parametrize("bearing", BALLS)
@pytest.mark.parametrize(
    ("change", "blow", "says"),
    [("steady", 0.0, False), ("steady", 40.0, False), ("2 %", 0.0, True)],
)
def test_a_small_change_of_an_unmeasured_speed_is_said(bearing, change, blow, says):
    """Blows that strike a steady machine move all lines of the shaft at once, and are no change."""
    _, signal, _ = machine(bearing, "inner race", change, 1)
    places = np.random.default_rng(6).integers(len(signal) - 400, size=4)
    for place in places.tolist():
        signal[place : place + 400] += blow * np.exp(-np.arange(400) / 80.0)
    answer = diagnose(Recording(signal, 12_800.0, ("y",)), bearing, TURN * 25.0)
    assert (answer.status == DiagnosisStatus.SPEED_CHANGES) == says
    assert ("record the speed along" in answer.sentence) == says
    assert not (says and answer.names_a_part)
