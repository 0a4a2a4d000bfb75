"""Where knocks are heard best."""

import math

import numpy as np
import pytest

from bearingcore import envelope_spectrum, impulsive_band

RATE = 25_600.0


def knocking(ring: float, every: float = 40.0, tone: float = 0.0, noise: float = 0.2) -> np.ndarray:
    """Knocks `every` [Hz] that ring at `ring` [Hz], a strong steady tone at 700 Hz, and noise."""
    time = np.arange(25_600) / RATE
    since = time % (1.0 / every)
    signal = np.exp(-600.0 * since) * np.sin(2.0 * math.pi * ring * since)
    signal += tone * np.sin(2.0 * math.pi * 700.0 * time)
    return np.asarray(signal + noise * np.random.default_rng(3).standard_normal(time.size))


@pytest.mark.parametrize("ring", [1500.0, 3000.0, 6000.0])
def test_the_octave_that_rings_is_found_beside_a_louder_tone(ring):
    signal = knocking(ring, tone=2.0)
    low, high = impulsive_band(signal, RATE, 200.0, 10_000.0)
    assert low < ring < high
    assert high == pytest.approx(2.0 * low)
    assert low >= 200.0
    assert high <= 10_000.0
    frequency, density = envelope_spectrum(signal, RATE, (low, high))
    shown = (frequency > 5.0) & (frequency < 200.0)
    assert frequency[shown][density[shown].argmax()] == pytest.approx(40.0, abs=1.5)


def test_a_single_mishap_does_not_decide():
    signal = knocking(3000.0)
    signal[9000] += 200.0
    low, high = impulsive_band(signal, RATE, 200.0, 10_000.0)
    assert low < 3000.0 < high


def test_what_is_too_faint_is_not_listened_to():
    """Faint knocks at 8 kHz, 60 dB below a tone at 1 kHz that swells, do not draw the band."""
    time = np.arange(25_600) / RATE
    swell = 1.0 + 0.8 * np.cos(2.0 * math.pi * 40.0 * time)
    swelling = swell * np.sin(2.0 * math.pi * 1000.0 * time)
    faint = knocking(8000.0, every=10.0, noise=0.0)
    assert impulsive_band(swelling + faint, RATE, 200.0, 12_000.0)[0] > 4000.0
    low, high = impulsive_band(swelling + 3e-3 * faint, RATE, 200.0, 12_000.0)
    assert low < 1000.0 < high


def test_limits_closer_than_an_octave_are_the_answer():
    assert impulsive_band(knocking(1000.0), RATE, 700.0, 1200.0) == (700.0, 1200.0)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ((np.zeros(100), RATE, 200.0, 1000.0), r"signal is .*\(100,\)"),
        ((np.full(2000, math.nan), RATE, 200.0, 1000.0), "signal is "),
        ((np.ones(2000), RATE, 200.0, 20_000.0), "highest is 20000"),
        ((np.ones(2000), RATE, -1.0, 2000.0), "lowest is -1"),
        ((np.ones((2000, 2)), RATE, 200.0, 2000.0), "signal is "),
    ],
)
def test_bad_input_is_refused(arguments, told):
    with pytest.raises(ValueError, match=told):
        impulsive_band(*arguments)
