"""Where the support is not known, the answer says how much it depends on it."""

from __future__ import annotations

import math

import pytest

from bearingcore import Recording, size_defect
from bearingcore.diagnosis.size.supports import SupportTrial, dependence, other_supports
from tests.helpers.recordings import RATE, RIG, noisy, signal_of


def test_other_supports_differ_in_one_thing_and_keep_their_damping_ratio() -> None:
    tried = other_supports(RIG.support)
    assert [words for words, _ in tried] == [
        "as given", "stiffness × 0.5", "stiffness × 2", "masses × 0.5", "masses × 2",
    ]  # fmt: skip
    told = RIG.support
    for _, one in tried[1:]:
        ratio = one.damping_y / math.sqrt(one.stiffness_y * one.outer_mass)
        assert ratio == pytest.approx(
            told.damping_y / math.sqrt(told.stiffness_y * told.outer_mass)
        )
    assert tried[2][1].stiffness_x == 2.0 * told.stiffness_x
    assert tried[3][1].inner_mass == 0.5 * told.inner_mass


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


def trial(words: str, extent_deg: float, weight: float) -> SupportTrial:
    return SupportTrial(words, RIG.support, math.radians(extent_deg), 0.01, 0.9, 0.1, weight)


def test_the_sentence_says_what_the_supports_say() -> None:
    alone = dependence((trial("as given", 20.0, 0.999), trial("masses × 2", 60.0, 0.001)))
    assert "from 20.0° to 60.0°" in alone
    assert "only one explains the signal (as given): 20.0°" in alone
    both = dependence((trial("as given", 20.0, 0.6), trial("masses × 2", 22.0, 0.4)))
    assert "2 of 2 supports" in both
    assert "from 20.0° to 22.0°" in both
