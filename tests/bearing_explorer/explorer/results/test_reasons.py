"""Each reason is that of its scene, and what is named is what the core gives."""

import dataclasses
import math
import re
from functools import cache

import numpy as np
import pytest
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.bearing import BearingDrawing
from bearing_explorer.explorer.views.load_distribution import LoadDistribution
from bearing_explorer.explorer.views.modes import NaturalFrequencies
from bearing_explorer.explorer.views.overview.bearing import OverviewBearing
from bearing_explorer.explorer.views.vibration_spectrum import why_words
from bearing_explorer.explorer.views.vibration_time import VibrationInTime
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import DOF_NAMES, STIFFNESS_TERMS, Scene, equilibrium, presets

RIG = presets["fan-rig"]
SIDEWAYS = RIG.replace(fx=100.0, fy=0.0)
"""The load passes by the defect, which is below."""
FAST = RIG.replace(shaft_speed=60.0 * math.pi)
UNDER = 3.0 * math.pi / 2.0 - RIG.bearing.ball_spacing * 10
"""Cage angle with ball 11 at the bottom."""


@cache
def of(scene: Scene) -> Results:
    return Results(scene, UNDER)


def test_a_ball_in_the_defect_leaves_its_load_to_those_beside_it() -> None:
    words = BearingDrawing(PackedSource()).sentence
    load = equilibrium(RIG, [UNDER]).ball_load[0]
    assert load[10] == 0.0
    assert words(of(RIG)).startswith(
        f"Balls 10 and 12 carry most, {load[9]:.3g} N each: ball 11, nearer the line of the load, "
        "lies in the defect and carries nothing."
    )
    assert "Ball 11 carries most, 39 N: it lies on the line of the load" in words(of(RIG.healthy()))
    assert "nearest the line of the load (13°)" in words(of(SIDEWAYS))
    evenly = RIG.healthy().replace(fy=0.0, fz=100.0)
    assert "All balls carry alike" in words(of(evenly))
    assert "rollers" not in words(of(RIG))
    assert "Roller" in words(Results(presets["nu208"], UNDER))
    short = OverviewBearing(PackedSource()).sentence
    assert short(of(RIG)) == "Balls 10 and 12 carry most: ball 11 is in the defect."
    assert short(of(RIG.healthy())) == "Ball 11 carries most: it lies on the line of the load."
    most = LoadDistribution(PackedSource()).sentence
    assert "ball 11, nearer the line of the load, lies in the defect" in most(of(RIG))
    assert "in the defect" not in most(of(RIG.healthy()))
    ranges = of(RIG).ranges.state
    worst = math.degrees(ranges.cage_angles[np.argmax(ranges.ball_load.max(axis=1))])
    assert f"It occurs with the cage at {worst:.1f}°. There ball" in most(of(RIG))


@pytest.mark.parametrize("name", ["fan-rig", "3208", "nu208"])
def test_all_that_carry_the_most_are_named(name: str) -> None:
    """Halfway between two balls as many of each row carry alike, by symmetry."""
    scene = presets[name].healthy().replace(fx=0.0, fy=-1000.0, fz=0.0)
    at = 1.5 * math.pi - scene.bearing.ball_spacing * 10.5
    state = equilibrium(scene, [at])
    most = np.flatnonzero(state.ball_load[0] > 0.99 * state.ball_load.max())
    said = reasons.most_loaded(scene, state, 0, np.zeros(state.ball_load.shape[1]))
    head, rest = said.split(" carry most")
    assert (
        len(most)
        == 2 * len(scene.bearing.all_rows)
        == len(re.findall(r"\d+(?! of| and of)", re.sub(r"of row \d", "", head)))
    )
    assert " each: they lie nearest the line of the load" in rest


def test_stiffness_falls_as_balls_push_back_sideways_or_as_fewer_carry() -> None:
    text = reasons.stiffness(of(RIG))
    damaged, healthy = (equilibrium(s, np.linspace(0, s.bearing.ball_spacing, 721)[:-1])
                      for s in (RIG, RIG.healthy()))  # fmt: skip
    share = [float((e.term("k_yy")).mean() / (e.term("k_xx") + e.term("k_yy")).mean())
             for e in (healthy, damaged)]  # fmt: skip
    # of contacts alone: what each pushes back with goes with the cube root of its load (Hertz)
    for e, expected in zip((healthy, damaged), share, strict=True):
        k = np.cbrt(e.ball_load)
        angles = float((k * np.sin(e.ball_angle) ** 2).sum() / k.sum())
        assert angles == pytest.approx(expected, abs=0.01)
    assert f"sin²φ {share[0]:.2f} → {share[1]:.2f}" in text
    assert "k_yy falls" in text
    assert "farther from the vertical" in text
    assert "and fewer balls carry" in text
    assert "and fewer balls carry" in reasons.stiffness(of(RIG), briefly=True)
    assert "hardly changes" in reasons.stiffness(of(SIDEWAYS))
    assert "lie near the vertical" in reasons.stiffness(of(RIG.healthy()))
    assert "lie near the horizontal" in reasons.stiffness(of(SIDEWAYS.healthy()))
    assert "alike" in reasons.stiffness(of(RIG.healthy().replace(fy=0.0, fz=100.0)))


def test_each_term_is_what_the_contacts_add() -> None:
    """k·cos²φ, k·sin²φ and k·sinφ·cosφ of all contacts, with k as the cube root of the load."""
    why = {term: reasons.stiffness_term(of(RIG), term) for term in STIFFNESS_TERMS}
    assert all(text.startswith(("Each contact", "k_")) for text in why.values())
    assert "square of the lever of θx" in why["k_rxrx"]
    rollers = Results(presets["nu208"], UNDER)
    assert reasons.stiffness_term(rollers, "k_zz") == "k_zz is zero: no contact resists z."
    assert "adds k·(cosα·cosφ)² to k_xx" in why["k_xx"]
    assert "fewer balls carry" in why["k_yy"]
    assert "k_xz is zero" in why["k_xz"]
    assert "left and right cancel" in why["k_xy"]
    state = equilibrium(RIG, np.linspace(0.0, RIG.bearing.ball_spacing, 25)[:-1])
    assert "so k_yy steps as balls enter or leave the loaded zone or the defect" in why["k_yy"]
    assert np.ptp(state.loaded_balls) > 0
    k = np.cbrt(state.ball_load)
    added = (k * np.sin(state.ball_angle) * np.cos(state.ball_angle)).sum(axis=1)
    assert np.corrcoef(added, state.term("k_xy"))[0, 1] > 0.99
    assert added.min() < 0.0 < added.max()


def test_a_frequency_moves_with_the_root_of_its_stiffness_or_less() -> None:
    assert "square root of the stiffness" in reasons.frequencies(of(RIG))
    shared = RIG.replace(fz=200.0, dofs=DOF_NAMES)
    assert "less than its square root, as the support's" in reasons.frequencies(of(shared))
    (low, high), ranges = of(shared).bands["y1"], of(shared).ranges
    most = math.sqrt(ranges.greatest["k_yy"] / ranges.least["k_yy"])
    assert high / low - 1.0 < 0.7 * (most - 1.0)
    words = NaturalFrequencies(PackedSource()).sentence
    assert words(of(RIG)).startswith(reasons.frequencies(of(RIG)))


def test_a_peak_is_in_a_band_or_at_a_multiple_of_the_ball_passes() -> None:
    slow, fast = why_words(of(RIG)), why_words(of(FAST))
    assert "672 Hz along y, lies in the band of y₁" in slow
    assert "No peak at the ball-pass frequency, 40.3 Hz: this spectrum resolves only 32 Hz" in slow
    assert "lies in no band of y. It is the line nearest 10 × 172.7 Hz" in fast
    assert "Peaks stand 173 Hz apart" in fast
    rate = FAST.bearing.bpfo(FAST.shaft_speed)
    for scene in (RIG, FAST):  # too slow to be resolved, and a line that stands out
        assert "No defect: a healthy bearing also shakes as its" in why_words(of(scene.healthy()))
    assert "healthy" not in fast + slow
    assert 10 * rate == pytest.approx(1728, abs=16)


def test_the_largest_jolt_is_of_a_ball_that_carries() -> None:
    words = VibrationInTime(PackedSource()).sentence
    assert "leaves the defect and takes back its load" in words(of(RIG))
    assert "No loaded ball passes the defect" in words(of(SIDEWAYS))
    inner = RIG.replace(race="inner")
    opposite = dataclasses.replace(inner.defect, center=inner.defect.center - math.pi)
    both = of(inner.replace(defect=(opposite, inner.defect)))
    assert both.excerpt.ball_load.max() > 0.5 * both.excerpt.greatest_static_load
    assert "its load (" in words(both), "one of two defects is where nothing is loaded"


def test_what_life_assumes_is_said_by_life_and_limits_alike() -> None:
    """The Life tab has a pressure with usual groove radii, which limits do not judge."""
    rig = of(RIG)
    assert "no limit is judged by them" in rig.endurance.assumed
    assert rig.endurance.pressures is not None
    pressures = [limit for limit in rig.limits if limit.name.startswith("contact pressure, ")]
    assert len(pressures) == 2
    for limit in pressures:
        assert math.isnan(limit.value)
        assert limit.sentence.endswith("Life assumes usual ones, by which no limit is judged.")
    assert not any("Life assumes" in limit.sentence for limit in Results(presets["nu208"]).limits)
