"""Where knocks are clearest."""

import math

import numpy as np
import pytest

from bearingcore import envelope_spectrum, kurtogram

RATE = 25_600.0


def knocking(ring: float, every: float = 40.0, tone: float = 0.0, noise: float = 0.2) -> np.ndarray:
    """Knocks `every` [Hz] that ring at `ring` [Hz], a strong steady tone at 700 Hz, and noise."""
    time = np.arange(25_600) / RATE
    since = time % (1.0 / every)
    signal = np.exp(-600.0 * since) * np.sin(2.0 * math.pi * ring * since)
    signal += tone * np.sin(2.0 * math.pi * 700.0 * time)
    return np.asarray(signal + noise * np.random.default_rng(3).standard_normal(time.size))


@pytest.mark.parametrize("ring", [1500.0, 3000.0, 6000.0])
def test_the_band_that_rings_is_found_although_a_tone_is_louder(ring):
    signal = knocking(ring, tone=2.0)
    low, high = kurtogram(signal, RATE).best(200.0)
    assert low < ring < high
    frequency, density = envelope_spectrum(signal, RATE, (low, min(high, 0.49 * RATE)))
    shown = (frequency > 5.0) & (frequency < 200.0)
    assert frequency[shown][density[shown].argmax()] == pytest.approx(40.0, abs=1.5)


def test_what_is_too_faint_is_not_chosen():
    """Faint knocks at 8 kHz, 60 dB below a tone at 1 kHz that swells, do not draw the band."""
    time = np.arange(25_600) / RATE
    swell = 1.0 + 0.8 * np.cos(2.0 * math.pi * 40.0 * time)
    swelling = swell * np.sin(2.0 * math.pi * 1000.0 * time)
    faint = knocking(8000.0, every=10.0, noise=0.0)
    assert kurtogram(swelling + faint, RATE).best()[0] > 4000.0
    low, high = kurtogram(swelling + 1e-4 * faint, RATE).best()
    assert low < 1000.0 < high


def test_a_single_mishap_does_not_decide():
    signal = knocking(3000.0)
    signal[9000] += 200.0
    low, high = kurtogram(signal, RATE).best(200.0)
    assert low < 3000.0 < high
