"""The envelope spectrum finds how often something rings, not what rings."""

import numpy as np
import pytest

from bearingcore import envelope_spectrum, spectrum

RATE = 20_000.0
TIME = np.arange(40_000) / RATE


def knocks(frequency: float, rings_at: float) -> np.ndarray:
    since = TIME % (1.0 / frequency)
    return np.exp(-since / 2e-3) * np.sin(2.0 * np.pi * rings_at * since)


def strongest(spec, lowest=5.0) -> float:
    frequency, density = spec
    inside = frequency > lowest
    return float(frequency[inside][density[inside].argmax()])


@pytest.mark.parametrize("rings_at", [2000.0, 4321.0])
def test_knocks_show_at_their_rate_whatever_rings(rings_at):
    noise = np.random.default_rng(3).standard_normal(TIME.size)
    signal = knocks(40.3, rings_at) + 0.3 * noise + 2.0 * np.sin(2.0 * np.pi * 50.0 * TIME)
    assert strongest(spectrum(signal, RATE, 1.0)) == pytest.approx(50.0, abs=1.0)
    found = envelope_spectrum(signal, RATE, (rings_at - 800.0, rings_at + 800.0))
    assert strongest(found) == pytest.approx(40.3, abs=0.6)


@pytest.mark.parametrize(
    ("signal", "rate", "band", "told"),
    [
        (np.zeros(1000), RATE, (3000.0, 2000.0), "upper end of the band is 2000"),
        (np.zeros(1000), RATE, (0.0, 2000.0), "lower end of the band is 0"),
        (np.zeros(1000), RATE, (100.0, 10_000.0), "below 10000"),
        (np.zeros(10), RATE, (100.0, 200.0), "at least 64 samples"),
        (np.full(1000, np.nan), RATE, (100.0, 200.0), "finite"),
    ],
)
def test_bad_input_is_refused_with_a_sentence(signal, rate, band, told):
    with pytest.raises(ValueError, match=told):
        envelope_spectrum(signal, rate, band)
