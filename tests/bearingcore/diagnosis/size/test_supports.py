"""Where the support is not known, the answer says how much it depends on it."""

import math

import pytest

from bearingcore import Recording, size_defect
from tests.helpers.recordings import RATE, RIG, noisy, signal_of


@pytest.mark.proof
def test_the_support_that_explains_the_signal_is_found_among_others() -> None:
    """The truth stands on springs twice as stiff as told."""
    truth = RIG.replace(
        extent=math.radians(38.6),
        stiffness_x=2.0 * RIG.support.stiffness_x,
        stiffness_y=2.0 * RIG.support.stiffness_y,
        damping_x=math.sqrt(2.0) * RIG.support.damping_x,
        damping_y=math.sqrt(2.0) * RIG.support.damping_y,
    )
    recording = Recording(noisy(signal_of(truth), 20.0), RATE)
    shares: list[float] = []
    sized = size_defect(recording, RIG, fault="outer race", progress=shares.append)
    assert shares == sorted(shares)
    assert len(sized.supports) == 5
    assert sum(one.weight for one in sized.supports) == pytest.approx(1.0)
    best = max(sized.supports, key=lambda one: one.weight)
    assert best.words == "stiffness × 2"
    assert math.degrees(sized.best.extent) == pytest.approx(38.6, abs=0.5)
    assert "The support is not known" in sized.sentence
