"""Which part, how long, and how it grows: signals built here from blows whose truth is known.

Sources of the right values: the multiples of the shaft speed that Case Western Reserve University
prints for the 6205 of its motor (Bearing Data Center, "Bearing Information"), and blows that stand
where kinematics puts them. Nothing of the program makes a signal here.
"""

import math

import numpy as np
import pytest

from bearingcore import Bearing, Recording, diagnose, measure_extent, presets, trend
from bearingcore.measured.diagnosis import CANNOT_TELL, NONE_SEEN
from bearingcore.measured.files import read_table
from bearingcore.sizing import LINES, ExtentStatus
from tests.helpers.recordings import file_from_elsewhere
from tests.outside.elements import Array
from tests.outside.witness import witness

TURN = 2.0 * math.pi
PRINTED = {"inner race": 5.4152, "outer race": 3.5848, "ball": 4.7135}
"""Multiples of the shaft speed of a 6205-2RS JEM SKF, as printed."""
CAGE = 0.39828
BEARING = presets["6205"].bearing
SHAFT, RATE, SECONDS = 1797.0 / 60.0, 12_000.0, 4.0
BALLS = 9


def blows(times: Array, sizes: Array, rate: float, count: int, rings: tuple[float, float]) -> Array:
    """Decaying sines from instants between the samples [s]; `rings`: frequency, decay [1/s]."""
    frequency, decay = rings
    first = np.ceil(times * rate).astype(int)
    index = first[:, None] + np.arange(int(8.0 / decay * rate))
    since = index / rate - times[:, None]
    shape = sizes[:, None] * np.exp(-decay * since) * np.sin(TURN * frequency * since)
    kept = index < count
    return np.bincount(index[kept], shape[kept], count)


def damaged(part: str, height: float, seed: int = 1) -> Array:
    """Noise of deviation 1, and blows as often as printed, carried through the load zone."""
    rng = np.random.default_rng(seed)
    count = round(RATE * SECONDS)
    noise = rng.standard_normal(count)
    if not height:
        return noise
    step = 1.0 / (PRINTED[part] * SHAFT)
    number = int(SECONDS / step)
    times = step * (np.arange(number) + 0.5 + 0.01 * rng.standard_normal(number))
    turns = {"outer race": 0.0, "inner race": SHAFT, "ball": CAGE * SHAFT}[part]
    sizes = 1.0 + np.cos(TURN * turns * times)
    ringing = blows(times, sizes, RATE, count, (3300.0, 900.0))
    return noise + height * ringing / ringing.std()


def recording(signal: Array, rate: float = RATE, name: str = "signal") -> Recording:
    return Recording(signal[:, None], rate, ("y",), name)


@witness(
    "function: diagnose",
    by="CWRU's printed multiples for the 6205: blows so often, through a load zone, in noise",
    compared="part named, its frequency", within=0.002,
)  # fmt: skip
@pytest.mark.parametrize("part", list(PRINTED))
def test_parts_by_their_printed_multiples(part: str) -> None:
    diagnosis = diagnose(recording(damaged(part, 1.5)), BEARING, TURN * SHAFT)
    assert diagnosis.fault == part
    assert diagnosis.probability > 0.9
    assert diagnosis.of(part).frequency == pytest.approx(PRINTED[part] * SHAFT, rel=0.002)
    assert diagnosis.of(part).nominal_order == pytest.approx(PRINTED[part], rel=1e-4)
    # blows as often as those of no part of this bearing name none
    times = np.arange(0.01, SECONDS, 1.0 / (4.21 * SHAFT))
    other = blows(times, np.ones_like(times), RATE, round(RATE * SECONDS), (3300.0, 900.0))
    strange = recording(damaged(part, 0.0) + 1.5 * other / other.std())
    assert not diagnose(strange, BEARING, TURN * SHAFT).names_a_part


@pytest.mark.parametrize(("off", "sure"), [(0.0, True), (0.017, False)])
def test_lines_that_a_ball_may_have_name_a_race_only_near_its_own(off: float, sure: bool) -> None:
    """Of 8 balls at 40°, thrust all around, twice the spin is 2.5 % above the outer race's line."""
    ball = 8e-3
    race = 4.0 * (1.0 - 0.3 * math.cos(math.radians(40.0)))
    spin = (1.0 - (1.0 - race / 4.0) ** 2) / 0.3
    assert spin / race == pytest.approx(1.025, abs=1e-3)
    bearing = Bearing.from_drawing(
        8, ball, ball / 0.3, 0.52 * ball, 0.52 * ball, contact_angle=math.radians(40.0)
    )
    rng = np.random.default_rng(33)
    often = race * (1.0 + off) * SHAFT
    times = np.cumsum(1.0 + 0.002 * rng.standard_normal(int(0.98 * SECONDS * often))) / often
    knocks = blows(times, np.ones_like(times), RATE, round(RATE * SECONDS), (3300.0, 900.0))
    signal = damaged("", 0.0) + 1.5 * knocks / knocks.std()
    diagnosis = diagnose(recording(signal), bearing, TURN * SHAFT)
    assert (diagnosis.fault == "outer race" and diagnosis.probability >= 0.9) == sure
    assert sure or diagnosis.probability < 0.6


def test_blows_that_no_speed_of_the_range_explains_name_no_part() -> None:
    """Blows 15.4 times a second that wander: of the outer race they would need 258 rpm."""
    rng = np.random.default_rng(1)
    often = 4.3 * PRINTED["outer race"]
    times = np.cumsum(1.0 + 0.05 * rng.standard_normal(int(0.99 * SECONDS * often))) / often
    knocks = blows(times, np.ones_like(times), RATE, round(RATE * SECONDS), (3300.0, 900.0))
    diagnosis = diagnose(recording(damaged("", 0.0) + 0.9 * knocks / knocks.std()), BEARING)
    assert (diagnosis.fault, diagnosis.shaft_speed) == (CANNOT_TELL, None)
    assert diagnosis.probability < 0.5
    assert "outer race at 2" in diagnosis.sentence


@witness(
    "function: trend", "function: trend_point",
    by="closed form: blows that grow in noise of deviation 1, as often as CWRU prints",
    compared="root mean square √(1 + h²), growth of the line, part named from when on",
    within=0.1,
)  # fmt: skip
def test_a_fault_that_grows() -> None:
    heights = np.array([0.0, 0.0, 0.8, 1.6, 3.2])
    series = [
        recording(damaged("inner race", height, seed), name=f"{seed}")
        for seed, height in enumerate(heights)
    ]
    history = trend(series, BEARING, TURN * SHAFT, band=(2500.0, 4500.0))
    assert history.column("rms") == pytest.approx(np.sqrt(1.0 + heights**2), rel=0.03)
    assert history.rms_change[-1] == pytest.approx(math.sqrt(1.0 + 3.2**2), rel=0.03)
    named = [point.fault for point in history.points]
    assert set(named[:2]) <= {NONE_SEEN, CANNOT_TELL}
    assert named[2:] == ["inner race"] * 3
    # a line of the envelope is as high as the blows, but for the noise that fills it up below them
    line = history.clear_lines[:, LINES.index("bpfi")]
    assert np.isnan(line[:2]).all()
    assert line[4] / line[3] == pytest.approx(2.0, rel=0.1)
    grown = history.line_change("inner race")
    assert np.isnan(grown[:2]).all()
    assert grown[4] / grown[3] == pytest.approx(line[4] / line[3])
    hidden = history.points[0].noise[LINES.index("bpfi")]
    assert grown[4] == pytest.approx(line[4] / hidden)  # the baseline shows no line: at least


def passages(apart_deg: float, rate: float = 25_600.0, seed: int = 3) -> Array:
    """Soft blows as balls enter a spall of the outer race and sharp ones as they leave it."""
    rng = np.random.default_rng(seed)
    shaft, seconds = 15.0, 3.0
    count, frequency = round(rate * seconds), PRINTED["outer race"] * shaft
    number = int((seconds - 0.05) * frequency)
    enters = np.cumsum(1.0 + 0.004 * rng.standard_normal(number)) / frequency
    leaves = enters + apart_deg / (360.0 / BALLS) / frequency
    ones = np.ones(number)
    soft = blows(enters, 3.0 * ones, rate, count, (1500.0, 9000.0))
    sharp = blows(leaves, 3.0 * ones, rate, count, (6000.0, 20_000.0))
    path = blows(leaves, 0.3 * ones, rate, count, (4300.0, 700.0))
    return soft + sharp + path + 0.02 * rng.standard_normal(count)


@witness(
    "function: measure_extent",
    by="blows at entry and exit, so far apart as kinematics says", compared="angle between them",
    within="0.3°, either way round where both are likely",
)  # fmt: skip
@pytest.mark.parametrize("apart", [4.0, 6.0, 12.0, 27.0])
def test_an_extent_known_by_entry_and_exit(apart: float) -> None:
    spall = measure_extent(recording(passages(apart), 25_600.0), BEARING, TURN * 15.0, race="outer")
    sure = apart < 40.0 / 6.0
    assert spall.status == (ExtentStatus.MEASURED if sure else ExtentStatus.EITHER)
    shorter = min(apart, 40.0 - apart)
    assert math.degrees(spall.separation) == pytest.approx(shorter, abs=0.3)
    (one, low, high), (other, _, _) = np.degrees(spall.alternatives)
    assert one + other == pytest.approx(40.0 + 2.0 * math.degrees(spall.offset))
    assert low < shorter + math.degrees(spall.offset) < high


@witness(
    "function: measure_extent",
    by="a motion by SciPy's solve_ivp over a defect of 47.3°, with no code of the program",
    compared="extent, but for ball spacings and for which peak is the entry",
    within="the interval that is stated",
)  # fmt: skip
@pytest.mark.proof
def test_an_extent_of_a_motion_by_scipy() -> None:
    truth, content = file_from_elsewhere()
    read = read_table("rig.csv", content).recording(["vertical", "horizontal"], ["y", "x"], "g")
    extent = measure_extent(
        read, truth.bearing, truth.shaft_speed, race="outer", load=300.0, clearance=0.0,
        edge="published",
    )  # fmt: skip
    assert extent.status == ExtentStatus.EITHER
    assert math.isnan(extent.extent)
    beyond = math.radians(47.3) - extent.ball_spacing
    assert any(low <= beyond <= high for _, low, high in extent.alternatives)
