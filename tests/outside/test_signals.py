"""Spectra of signals whose power is known by closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore import envelope_spectrum, spectrum
from tests.outside.witness import witness

RATE = 25_600.0
TIME = np.arange(round(4.0 * RATE)) / RATE


@witness(
    "function: spectrum",
    "signal: spectrum",
    by="closed form: A²/2",
    compared="power of a sine",
    within=5e-4,
)
def test_a_sine_has_half_its_amplitude_squared() -> None:
    """3 sin: 9/2, in its lines."""
    lines = spectrum(3.0 * np.sin(2.0 * math.pi * 1234.5 * TIME), RATE, 8.0)
    assert float(lines.powers([1100.0, 1400.0])[0]) == pytest.approx(4.5, rel=5e-4)


@witness(
    "function: spectrum",
    "signal: spectrum",
    by="closed form: variance over half the rate",
    compared="density of noise",
    within=5e-3,
)
def test_noise_has_its_variance_over_half_the_rate() -> None:
    """White noise of variance 5.12: 4e-4 (unit)²/Hz at every frequency."""
    noise = math.sqrt(5.12) * np.random.default_rng(3).standard_normal(round(40.0 * RATE))
    lines = spectrum(noise, RATE, 8.0)
    inner = (lines.frequency > 100.0) & (lines.frequency < 12_000.0)
    assert lines.density[inner].mean() == pytest.approx(4e-4, rel=5e-3)


@witness(
    "function: envelope_spectrum",
    "signal: envelope_spectrum",
    by="closed form of a modulated tone",
    compared="line at the modulation",
    within=1e-3,
)
def test_the_envelope_shows_the_depth_of_modulation() -> None:
    """2 (1 + 0.3 cos) on a carrier: the line at the modulation has (2·0.3)²/2 = 0.18."""
    carrier = np.sin(2.0 * math.pi * 4000.0 * TIME)
    signal = 2.0 * (1.0 + 0.3 * np.cos(2.0 * math.pi * 97.0 * TIME)) * carrier
    lines = envelope_spectrum(signal, RATE, (3000.0, 5000.0), 1.0)
    assert float(lines.powers([90.0, 104.0])[0]) == pytest.approx(0.18, rel=1e-3)
