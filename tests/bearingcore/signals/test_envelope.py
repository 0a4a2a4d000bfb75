"""The envelope spectrum finds how often something rings, not what rings."""

import numpy as np
import pytest

from bearingcore import envelope_spectrum

RATE = 20_000.0


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
