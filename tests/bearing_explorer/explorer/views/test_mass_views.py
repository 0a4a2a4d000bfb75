"""What the mass of balls adds, in time, in frequency and by octave."""

from types import SimpleNamespace

import numpy as np
import pytest
from bearing_explorer.explorer.results.ball_mass import BallMass, exit_of
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import OTHER_BALLS
from bearing_explorer.explorer.views.mass_time import MassInTime
from bearing_explorer.explorer.views.mechanism import WhichMechanism, mechanism_words
from bearing_explorer.explorer.views.vibration_spectrum import VibrationSpectra
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import presets
from bearingcore.model.dynamics import contact_resonance_band
from bearingcore.model.dynamics._ball_comparison import mass_share
from tests.helpers.simulated import pit

FAN_RIG = presets["fan-rig"]
MOTOR = presets["6205"]


@pytest.fixture(scope="module")
def ball_mass() -> BallMass:
    return Results(FAN_RIG).ball_mass


@pytest.fixture(scope="module")
def results() -> Results:
    return Results(FAN_RIG)


def test_a_ball_over_a_small_pit_meets_its_far_edge_half_way() -> None:
    """As geometry has it: it pivots on one corner, then on the other, and never lets go."""
    small = Results(MOTOR.replace(defect=pit(MOTOR, 3e-4)), moving=True).ball_mass
    assert small.strikes == ()
    assert exit_of(small.events) is not None
    assert small.far_edge == pytest.approx(0.5 * exit_of(small.events).time, rel=0.02)
    assert mechanism_words(small).startswith(
        "The varying stiffness gives most of the power in every"
    )


def test_shares_are_those_of_the_core(ball_mass: BallMass) -> None:
    """Another way to the same number: two motions of the sweep's, and their band."""
    low, high = ball_mass.octaves[-3], ball_mass.octaves[-2]
    theirs = mass_share(FAN_RIG, low, high, 1.4, ball_mass.sample_rate)
    assert ball_mass.share[-2] == pytest.approx(theirs, abs=0.02)
    assert ball_mass.share[-1] > 0.9
    loud = ~ball_mass.quiet
    assert np.abs(ball_mass.share[loud & (ball_mass.octaves[1:] <= 1000.0)]).max() < 0.1
    assert (ball_mass.spread[loud] < 0.1).all()


def test_what_is_drawn_is_what_was_found(results: Results, ball_mass: BallMass) -> None:
    packed = PackedSource()
    time, octaves = (kind(packed) for kind in (MassInTime, WhichMechanism))
    sources, ranges = time.data(results)
    assert np.nanmax(sources["mass_motion"]["y"]) == np.max(ball_mass.with_mass["y"])
    assert np.nanmax(sources["mass_motion"]["y_massless"]) == np.max(ball_mass.massless["y"])
    assert sources["mass_flights"]["from"].size >= 1
    assert ranges["mass_time"] == (ball_mass.time[0], ball_mass.time[-1])
    sources, ranges = octaves.data(results)
    bars = sources["mechanism_bars"]
    np.testing.assert_allclose(bars["top"], 100.0 * ball_mass.share)
    assert (bars["right"][:-1] < bars["left"][1:]).all()
    words = mechanism_words(ball_mass)
    assert words.startswith("From 4 kHz up the mass of the balls gives most of the power")


def test_balls_with_mass_are_a_reference_of_the_spectrum(ball_mass: BallMass) -> None:
    """In grey, with the band of the contact resonances, named in the caption and the table."""
    packed = PackedSource()
    spectra = VibrationSpectra(packed)
    spectra.take_look({"axis": "logarithmic"})
    results = Results(FAN_RIG, grey_kind=OTHER_BALLS)
    sources, _ = spectra.data(results)
    band = sources["spectrum_wide_resonance"]
    assert band["high"][0] == pytest.approx(contact_resonance_band(FAN_RIG)[1])
    assert band["above"][0] == 0.0
    own, other = sources["spectrum_wide_lines"], sources["spectrum_wide_grey"]
    high = own["frequency"] > 9e3
    assert np.median(other["y"][high] - own["y"][high]) > 10.0, "mass adds above 8 kHz"
    assert "with the mass of its balls" in spectra.caption(results)
    assert any(name.startswith("other_balls_") for name in spectra.table(results))


def test_what_is_folded_is_not_computed() -> None:
    view = MassInTime(PackedSource())
    assert view.needs == frozenset({"ball_mass"}), "outside of the page it is open"
    view.attach(SimpleNamespace(jobs=None, draw=lambda: None))  # type: ignore[arg-type]
    assert view.needs == frozenset()
    assert view.sentence(Results(FAN_RIG)) == ""
    view._turn()
    assert view.needs == frozenset({"ball_mass"})
