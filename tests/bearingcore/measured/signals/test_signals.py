"""Signals: what is wrong with them, bands, envelopes, indicators, ball passes; closed forms."""

import itertools
import math

import numpy as np
import pytest

from bearingcore import Recording, envelope_spectrum, indicators, kurtogram
from bearingcore.measured.signals import (
    ZONES,
    BallPasses,
    average_passes,
    local_median,
    severity_zone,
)
from bearingcore.measured.signals._averaging import load_zone_weights
from bearingcore.measured.signals._dropouts import cut_off, signal_faults
from bearingcore.measured.signals._filter_bank import LOWEST, Band, split, squared_envelopes
from bearingcore.measured.signals._line_levels import line_levels
from bearingcore.measured.signals._whitening import LOUDEST, whiten
from tests.outside.witness import witness


@pytest.fixture
def noise() -> np.ndarray:
    return np.random.default_rng(1).standard_normal(4000)


def _held(noise: np.ndarray, begin: int, end: int) -> np.ndarray:
    return np.full(end - begin, noise[begin])


def _drawn(noise: np.ndarray, begin: int, end: int) -> np.ndarray:
    return np.linspace(noise[begin - 1], noise[end], end - begin + 2)[1:-1]


def _again(noise: np.ndarray, begin: int, end: int) -> np.ndarray:
    return noise[2 * begin - end : begin]


@pytest.mark.parametrize("fill", [_held, _drawn, _again])
@pytest.mark.parametrize(("step", "least"), [(0.0, 3), (1e-3, 6), (0.05, 16)])
def test_gaps_are_found_however_a_recorder_fills_them(noise, fill, step, least):
    """What is found is as short as numbers so coarse allow, and nothing else is found."""
    whole = np.round(noise / step) * step if step else noise
    assert signal_faults(whole).dropped_share == 0.0
    filled = whole.copy()
    expected = np.zeros(len(noise), dtype=bool)
    for begin in (500, 1000, 3500):
        filled[begin : begin + least] = fill(whole, begin, begin + least)
        expected[begin : begin + least] = True
    faults = signal_faults(filled)
    assert np.count_nonzero(faults.dropped != expected) <= 3  # neighbours, by chance
    assert faults.dropped_share == faults.dropped.mean()


def test_signals_that_were_resampled_or_are_periodic_have_no_gaps(noise):
    place = np.arange(0.0, 3900.0, 0.3)
    drawn = np.interp(place, np.arange(4000), noise)
    for whole in (np.tile(noise[:500], 8), drawn, np.repeat(noise, 4)):
        assert signal_faults(whole).dropped_share < 0.01


def test_a_sensor_that_stays_at_its_rail_has_dropped_out(noise):
    noise[1000:1400] = 9.0
    faults = signal_faults(noise)
    assert faults.dropped_share == 0.1
    assert faults.clipped_share == 0.0


@witness(
    "signal: cut_off",
    by="counting: noise clipped at a known limit",
    compared="samples at the limit; none of whole signals in coarse numbers",
    within="each sample",
)
@pytest.mark.parametrize("step", [1e-9, 1e-3, 0.02])
def test_peaks_that_a_recorder_cut_off_are_said_and_coarse_numbers_are_not(step: float) -> None:
    """Noise, a sine and pulses between rests, in numbers as coarse as cheap recorders give."""
    noise = np.random.default_rng(3).standard_normal(20_000)
    sine = np.sin(2.0 * np.pi * 29.5 / 12_800.0 * np.arange(20_000))
    pulses = np.where(np.arange(20_000) % 400 < 40, np.abs(noise) + 1.0, 0.0)
    for whole in (noise, sine, pulses):
        assert not cut_off(np.round(whole / step) * step)
    both = np.round(np.clip(noise, -2.0, 2.0) / step) * step
    count = np.count_nonzero(np.abs(both) == both.max())
    assert f"{count} samples of the file reach exactly 2 or −2:" in cut_off(both)
    assert " exactly 2:" in cut_off(np.minimum(np.round(noise / step) * step, 2.0))


RATE = 16_000.0


def test_dropouts_neither_knock_nor_lower_the_mean():
    rng = np.random.default_rng(6)
    signal = rng.standard_normal(64_000) + 5.0
    dropped = np.zeros(len(signal), dtype=bool)
    for begin in range(0, len(signal), 3200):  # five a second
        dropped[begin : begin + 800] = True
    signal[dropped] = 0.0
    (envelope,) = squared_envelopes(signal, RATE, [Band(LOWEST, 8000.0)], 300.0, dropped)
    levels = line_levels(envelope.values, envelope.rate, 2.0, 300.0, 60.0)
    fives = np.rint(5.0 * np.arange(1, 40) / levels.step).astype(int)
    assert levels.level[fives].mean() < 3.0
    (bare,) = squared_envelopes(signal, RATE, [Band(LOWEST, 8000.0)], 300.0)
    levels = line_levels(bare.values, bare.rate, 2.0, 300.0, 60.0)
    assert levels.level[fives[:10]].mean() > 15.0


def test_a_line_has_its_depth_and_stands_above_its_surroundings():
    rng = np.random.default_rng(7)
    time = np.arange(20_000) / 1000.0
    values = 1.0 + 0.1 * np.cos(2.0 * np.pi * 40.0 * time) + 0.3 * rng.standard_normal(20_000)
    levels = line_levels(values, 1000.0, 4.0, 200.0, 20.0)
    index = round(40.0 / levels.step)
    assert levels.depth[index] == pytest.approx(0.1, rel=0.05)
    assert levels.level[index] > 17.0
    away = np.abs(levels.step * np.arange(len(levels.level)) - 40.0) > 2.0
    assert np.mean(10.0 ** (0.1 * levels.level[away])) == pytest.approx(1.0, abs=0.1)
    assert levels.averages == pytest.approx(9.0 / (1.0 + 2.0 / 36.0 * 8.0 / 9.0), rel=0.02)


def test_bands_cover_the_range_without_gap_and_none_is_too_narrow():
    bands = split(RATE, 900.0)
    assert bands[0] == (LOWEST, 8000.0)
    assert min(band.high - band.low for band in bands) > 900.0
    for parts in (2, 3, 4, 6, 8):
        width = 8000.0 / parts
        level = [
            b
            for b in bands
            if b.high - b.low < width + 1e-6 and b.high - b.low > width - LOWEST - 1
        ]
        assert len(level) == parts
        for one, following in itertools.pairwise(level):
            assert one.high == pytest.approx(following.low)


WHITE_RATE = 8000.0


def test_coloured_noise_becomes_white_and_tones_no_louder_than_told():
    rng = np.random.default_rng(2)
    count = 80_000
    frequency = np.fft.rfftfreq(count, 1.0 / WHITE_RATE)
    shape = 1.0 / np.maximum(frequency, 1.0) + 0.01 * np.exp(-(((frequency - 2000) / 50.0) ** 2))
    noise = np.fft.irfft(np.fft.rfft(rng.standard_normal(count)) * shape, count)
    time = np.arange(count) / WHITE_RATE
    signal = noise + 100.0 * noise.std() * np.sin(2.0 * np.pi * 1234.0 * time)
    white = whiten(np.fft.rfft(signal), WHITE_RATE / count, 20.0)
    loudness = np.abs(white)
    assert loudness.max() <= LOUDEST * (1.0 + 1e-12)
    powers = [np.mean(part**2) for part in np.array_split(loudness[100:-100], 20)]
    np.testing.assert_allclose(powers, 1.0, atol=0.15)


def test_the_local_median_follows_a_slope_and_passes_over_a_line():
    slope = np.exp(np.linspace(0.0, 3.0, 3000))
    with_line = slope.copy()
    with_line[1500:1503] *= 1e6
    np.testing.assert_allclose(local_median(with_line, 101), slope, rtol=0.06)
    assert local_median(np.ones(5), 101) == pytest.approx(np.ones(5))


KNOCK_RATE = 25_600.0


def knocking(ring: float, every: float = 40.0, tone: float = 0.0, noise: float = 0.2) -> np.ndarray:
    """Knocks `every` [Hz] that ring at `ring` [Hz], a strong steady tone at 700 Hz, and noise."""
    time = np.arange(25_600) / KNOCK_RATE
    since = time % (1.0 / every)
    signal = np.exp(-600.0 * since) * np.sin(2.0 * math.pi * ring * since)
    signal += tone * np.sin(2.0 * math.pi * 700.0 * time)
    return np.asarray(signal + noise * np.random.default_rng(3).standard_normal(time.size))


@pytest.mark.parametrize("ring", [1500.0, 3000.0, 6000.0])
def test_the_band_that_rings_is_found_although_a_tone_is_louder(ring):
    signal = knocking(ring, tone=2.0)
    low, high = kurtogram(signal, KNOCK_RATE).best(200.0)
    assert low < ring < high
    frequency, density = envelope_spectrum(signal, KNOCK_RATE, (low, min(high, 0.49 * KNOCK_RATE)))
    shown = (frequency > 5.0) & (frequency < 200.0)
    assert frequency[shown][density[shown].argmax()] == pytest.approx(40.0, abs=1.5)


def test_what_is_too_faint_is_not_chosen():
    """Faint knocks at 8 kHz, 60 dB below a tone at 1 kHz that swells, do not draw the band."""
    time = np.arange(25_600) / KNOCK_RATE
    swell = 1.0 + 0.8 * np.cos(2.0 * math.pi * 40.0 * time)
    swelling = swell * np.sin(2.0 * math.pi * 1000.0 * time)
    faint = knocking(8000.0, every=10.0, noise=0.0)
    assert kurtogram(swelling + faint, KNOCK_RATE).best()[0] > 4000.0
    low, high = kurtogram(swelling + 1e-4 * faint, KNOCK_RATE).best()
    assert low < 1000.0 < high


def test_a_single_mishap_does_not_decide():
    signal = knocking(3000.0)
    signal[9000] += 200.0
    low, high = kurtogram(signal, KNOCK_RATE).best(200.0)
    assert low < 3000.0 < high


LEVEL_RATE = 12_000.0
LEVEL_TIME = np.arange(36_000) / LEVEL_RATE


def recorded(*columns: np.ndarray, rate: float = LEVEL_RATE) -> Recording:
    return Recording(np.stack(columns, axis=1), rate, ("x", "y")[: len(columns)])


@pytest.mark.parametrize(
    ("recording", "why"),
    [
        (recorded(np.sin(LEVEL_TIME), rate=2000.0), "sample rate is 2000 Hz"),
        (recorded(np.sin(100.0 * LEVEL_TIME[:1200])), "0.1 s long, and 10 Hz need 0.5 s"),
    ],
)
def test_where_there_is_no_velocity_it_says_why(recording, why):
    levels = indicators(recording)
    assert np.isnan(levels.velocity_rms).all()
    assert why in levels.velocity_reason
    assert np.isfinite(levels.rms).all()


@pytest.mark.parametrize("machine", ZONES)
def test_zones_begin_at_their_boundaries(machine):
    first, second, third = ZONES[machine]
    for boundary, below, above in ((first, "A", "B"), (second, "B", "C"), (third, "C", "D")):
        assert severity_zone(boundary, machine) == below
        assert severity_zone(1.001 * boundary, machine) == above


PASS_RATE, FREQUENCY, COUNT = 20_480.0, 57.3, 40


def passing(wander: float, decibels: float, seed: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Known passes on a clock that wanders, with noise: the signal, and how many have passed."""
    rng = np.random.default_rng(seed)
    time = np.arange(round(1.6 * PASS_RATE)) / PASS_RATE
    passed = FREQUENCY * (
        time
        + wander * math.sqrt(2.0) * (1.0 - np.cos(2.0 * math.pi * 0.9 * time)) / (2 * math.pi * 0.9)
    )
    order = np.arange(1, COUNT + 1)
    size = rng.standard_normal((COUNT, 2)) + 1j * rng.standard_normal((COUNT, 2))
    clean = 2.0 * (np.exp(2j * math.pi * passed[:, None] * order) @ size).real
    level = math.sqrt(np.mean(clean**2)) * 10.0 ** (-decibels / 20.0)
    return clean + level * rng.standard_normal(clean.shape), passed


def averaged(signal: np.ndarray, follow: bool) -> BallPasses:
    return average_passes(signal, PASS_RATE, 57.0, 0.02, 60.0, 2250.0, 2250.0, follow=follow)


def repeating(passes: BallPasses) -> float:
    power = passes.power[3:COUNT].sum()
    return float((np.abs(passes.harmonics[3:COUNT]) ** 2).sum() / power)


@pytest.mark.parametrize("wander", [0.002, 0.004, 0.008])
def test_a_wandering_cage_is_followed(wander: float) -> None:
    signal, passed = passing(wander, 20.0)
    lost, followed = averaged(signal, False), averaged(signal, True)
    assert repeating(lost) < 0.7
    assert repeating(followed) > 0.97
    # the passes begin when the balls pass, but for a constant
    assert followed.begins is not None
    at = np.interp(followed.begins, np.arange(len(passed)) / PASS_RATE, passed)
    away = (at - at.round() + 0.5) % 1.0
    assert np.ptp(at - np.arange(len(at))) < 0.012, away
    mean = (at[-1] - at[0]) / (followed.begins[-1] - followed.begins[0])
    assert followed.frequency == pytest.approx(mean, rel=2e-4)


@pytest.mark.parametrize("decibels", [40.0, 20.0, 5.0])
def test_a_steady_cage_is_left_alone(decibels: float) -> None:
    signal, _ = passing(0.0, decibels)
    with_it, without = averaged(signal, True), averaged(signal, False)
    assert with_it.begins is None
    assert np.array_equal(with_it.harmonics, without.harmonics)


PASSES, PASS_HARMONICS, TURNS = 300, 40, 0.203


def made(depth: float, noise: float, turns: float = TURNS) -> tuple[np.ndarray, np.ndarray]:
    """Loudness (n,) of passes, and their coefficients (n, N, 2) in noise."""
    rng = np.random.default_rng(5)
    shape = (PASSES, PASS_HARMONICS, 2)
    wave = rng.normal(size=shape[1:]) + 1j * rng.normal(size=shape[1:])
    loudness = 1.0 + depth * np.cos(2.0 * np.pi * turns * np.arange(PASSES) + 0.7)
    chance = rng.normal(size=shape) + 1j * rng.normal(size=shape)
    return loudness, loudness[:, None, None] * wave + noise * chance


@pytest.mark.parametrize("slip", [-0.015, 0.0, 0.015])
def test_loudness_of_passes_is_found_whatever_the_slip(slip):
    loudness, passes = made(0.9, 2.0, TURNS * (1.0 + slip))
    weights = load_zone_weights(passes, TURNS, 0.02)
    np.testing.assert_allclose(weights, loudness / loudness.mean(), atol=0.12)


def test_passes_that_are_equally_loud_count_alike():
    _, passes = made(0.0, 2.0)
    np.testing.assert_allclose(load_zone_weights(passes, TURNS, 0.02), 1.0, atol=0.08)


def test_weights_bring_the_mean_pass_nearer_to_the_truth():
    _, clean = made(0.9, 0.0)
    _, passes = made(0.9, 3.0)
    truth = clean.mean(axis=0)
    weights = load_zone_weights(passes, TURNS, 0.02)
    weighted = np.tensordot(weights, passes, 1) / (weights**2).sum()
    # of Gaussian noise the error falls by 1 / sqrt(1 + depth² / 2) = 0.84
    ratio = np.linalg.norm(weighted - truth) / np.linalg.norm(passes.mean(axis=0) - truth)
    assert ratio == pytest.approx(0.84, abs=0.05)
