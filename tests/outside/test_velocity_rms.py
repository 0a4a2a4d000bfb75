"""Velocity of vibration and its zones, against what tones and bursts are by definition."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore import Recording
from bearingcore.errors import FieldError
from bearingcore.measured.signals import indicators, severity_zone, shaft_share
from bearingcore.measured.signals._indicators import displacement_rms, velocity_rms
from tests.outside.witness import witness

RATE = 25_600.0


def tone(
    frequency: float, duration: float, level: float = 1.0, phase: float = 0.3, rate: float = RATE
) -> np.ndarray:
    """Acceleration of a tone whose velocity has the root mean square `level`."""
    time = np.arange(round(duration * rate)) / rate
    turn = 2.0 * math.pi * frequency
    return level * math.sqrt(2.0) * turn * np.cos(turn * time + phase)


@witness(
    "indicator: velocity_rms",
    "signal: velocity_rms",
    "signal: severity_zone",
    "signal: indicators",
    by="root mean square by definition",
    compared="velocity of a burst, its zone",
    within=2e-3,
)
@pytest.mark.parametrize("begin", [0.0, 3.0, 4.0, 8.0])
def test_a_burst_counts_alike_wherever_it_is(begin: float) -> None:
    """Root mean square by definition: sqrt(0.8·1² + 0.2·7²) = 3.256 mm/s, zone B of group 2."""
    time = np.arange(round(10.0 * RATE)) / RATE
    level = np.where((time >= begin) & (time < begin + 2.0), 7.0, 1.0)
    actual = float(velocity_rms(1e-3 * level * tone(100.0, 10.0), RATE))
    assert actual == pytest.approx(1e-3 * math.sqrt(0.8 + 0.2 * 49.0), rel=2e-3)
    assert severity_zone(actual, "medium, rigid") == "C"
    assert severity_zone(actual, "medium, flexible") == "B"


@witness(
    "signal: shaft_share",
    by="Parseval's theorem: tones of 4, 3 and 2 mm/s at 1, 2 and 3 turns, 5 mm/s elsewhere",
    compared="share of the mean square at 1 to 3 turns", within=0.02,
)  # fmt: skip
def test_the_share_of_the_shaft_is_that_of_its_three_lines() -> None:
    levels = {24.7: 4.0, 49.4: 3.0, 74.1: 2.0, 91.0: 5.0}
    signal = sum(1e-3 * tone(at, 10.0, level) for at, level in levels.items())
    recording = Recording(np.array(signal)[:, None], RATE, ("y",))
    assert shaft_share(recording, 2.0 * math.pi * 24.7) == pytest.approx([29.0 / 54.0], abs=0.02)
    assert shaft_share(recording, 2.0 * math.pi * 40.0) == pytest.approx([0.0], abs=0.02)


@pytest.mark.parametrize("duration", [0.5, 0.53, 1.0, 1.05, 2.03, 10.02])
@pytest.mark.parametrize("frequency", [10.0, 12.3, 160.0, 1000.0])
def test_tones_up_to_both_ends_are_kept(frequency: float, duration: float) -> None:
    """A tone's own root mean square within 3 %, whatever its phase and the signal's length."""
    for rate in (2560.0, RATE):
        for phase in np.linspace(0.0, math.pi, 5):
            actual = float(velocity_rms(tone(frequency, duration, 1.0, phase, rate), rate))
            assert actual == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize("frequency", [7.0, 1400.0])
def test_tones_outside_the_band_are_left_out(frequency: float) -> None:
    """Of 10 to 1000 Hz they are no part; a twentieth is what the signal's ends leave of 7 Hz."""
    assert float(velocity_rms(tone(frequency, 10.0), RATE)) < 0.05


@pytest.mark.parametrize(("frequency", "least", "most"), [(7.0, 0.9, 1.0), (5.0, 0.24, 0.4)])
def test_short_signals_count_a_part_of_what_is_below_the_band(
    frequency: float, least: float, most: float
) -> None:
    """Of one second, as `velocity_rms` says of itself."""
    for phase in np.linspace(0.0, math.pi, 9):
        assert least < float(velocity_rms(tone(frequency, 1.0, 1.0, phase), RATE)) < most


@pytest.mark.parametrize("samples", [[], [math.nan], [1.0], [1.0, math.inf], 3.0])
def test_what_is_no_signal_is_refused(samples: object) -> None:
    for of in (velocity_rms, displacement_rms):
        with pytest.raises(FieldError, match="two or more finite numbers"):
            of(samples, RATE, (10.0, 1000.0))  # type: ignore[arg-type]


@witness(
    "indicator: displacement_rms", "signal: displacement_rms", "signal: severity_zone",
    by="tones by definition; boundaries of ISO 10816-3, Tables A.1 and A.2",
    compared="displacement of tones from 2 to 160 Hz, zones of slow machines", within=0.04,
)  # fmt: skip
def test_slow_machines_are_judged_by_their_displacement_too() -> None:
    """2.0 mm/s at 6.37 Hz are 50 µm: zone B by velocity, C by displacement (group 2, rigid)."""
    for duration in (2.5, 2.63, 10.0):
        for frequency in (2.0, 3.1, 6.37, 160.0):
            for phase in np.linspace(0.0, math.pi, 5):
                signal = tone(frequency, duration, 2e-3, phase)
                moved = float(displacement_rms(signal, RATE, (2.0, 1000.0)))
                assert moved * 2.0 * math.pi * frequency == pytest.approx(2e-3, rel=0.04)
    signal = tone(6.37, 10.0, 2e-3)[:, None]
    slow, fast = (
        indicators(Recording(signal, RATE, ("y",), shaft_speed=2.0 * math.pi * turns / 60.0))
        for turns in (382.0, 1500.0)
    )
    sizes = float(slow.velocity_rms[0]), float(slow.displacement_rms[0])
    assert (severity_zone(sizes[0], "medium, rigid"), 1e6 * sizes[1]) == (
        "B",
        pytest.approx(50.0, 0.01),
    )
    assert severity_zone(sizes[0], "medium, rigid", sizes[1]) == "C"
    assert severity_zone(sizes[0], "medium, flexible", sizes[1]) == "B"
    assert float(fast.displacement_rms[0]) < 0.05 * sizes[1]  # its band begins at 10 Hz
    printed = {"medium, rigid": (22, 45, 71), "medium, flexible": (37, 71, 113),
               "large, rigid": (29, 57, 90), "large, flexible": (45, 90, 140)}  # fmt: skip
    for machine, ends in printed.items():
        zones = [severity_zone(0.0, machine, 1e-6 * (end + d)) for end in ends for d in (-0.5, 0.5)]
        assert "".join(zones) == "ABBCCD"


def test_drift_and_offset_are_no_vibration() -> None:
    """An accelerometer's offset and drift add up to a velocity that no machine has."""
    time = np.arange(round(10.0 * RATE)) / RATE
    clean = tone(50.0, 10.0)
    actual = float(velocity_rms(clean + 5.0 + 0.3 * time, RATE))
    assert actual == pytest.approx(1.0, rel=2e-3)


def test_noise_has_the_integral_of_its_density() -> None:
    """White acceleration of 1 (m/s²)²: v² = ∫ 1/(rate/2)/(2πf)² df from 10 to 1000 Hz."""
    noise = np.random.default_rng(1).standard_normal(round(60.0 * RATE))
    expected = math.sqrt((1.0 / 10.0 - 1.0 / 1000.0) / (4.0 * math.pi**2) / (0.5 * RATE))
    assert float(velocity_rms(noise, RATE)) == pytest.approx(expected, rel=0.05)


@witness(
    "indicator: band",
    by="ISO 10816-3",
    compared="band of slow machines",
    within=0.03,
)
@pytest.mark.parametrize(("turns", "low"), [(480.0, 2.0), (600.0, 2.0), (601.0, 10.0)])
def test_slow_machines_are_judged_from_2_hz(turns: float, low: float) -> None:
    """ISO 10816-3: 10 to 1000 Hz; at and below 600 turns a minute from 2 Hz."""
    signal = tone(4.0, 10.0)[:, None]
    speed = 2.0 * math.pi * turns / 60.0
    levels = indicators(Recording(signal, RATE, ("y",), shaft_speed=speed))
    assert levels.band == (low, 1000.0)
    expected = 1.0 if low < 4.0 else 0.0
    assert float(levels.velocity_rms[0]) == pytest.approx(expected, abs=0.03)
