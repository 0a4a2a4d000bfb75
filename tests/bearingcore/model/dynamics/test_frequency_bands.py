"""Bands of natural frequencies: independent of the samples, and the same without damping."""

import math

import numpy as np
import pytest

from bearingcore import Scene, equilibrium, frequency_bands, presets
from bearingcore.model.dynamics._modes import BandSearch, modes_at
from bearingcore.model.statics import STIFFNESS_TERMS, default_cage_angles

RIG, ANGULAR = presets["fan-rig"], presets["liew-lim"]
SCENES = {
    "healthy": RIG.healthy(),
    "two directions": RIG,
    "a large defect": RIG.replace(extent=math.radians(38.6)),
    "five directions": ANGULAR,
    "five, a large defect": ANGULAR.replace(extent=math.radians(64.0)),
    "inner race": RIG.replace(race="inner", extent=0.5),
    "three directions": ANGULAR.replace(dofs=("x", "y", "z")),
    "one direction": RIG.replace(dofs=("y",)),
    "sideways": RIG.replace(fx=-70.0, fy=-70.0, extent=0.9),
}


def terms_of(scene: Scene, n: int = 121) -> np.ndarray:
    """Return the 15 stiffness terms at n cage angles, (15, n)."""
    state = equilibrium(scene, default_cage_angles(scene, n))
    return np.stack([state.term(name) for name in STIFFNESS_TERMS])


def search_of(scene: Scene, terms: np.ndarray) -> BandSearch:
    """Return the search whose modes follow those of the mean of the terms."""
    return BandSearch(scene, terms, np.ones(terms.shape[1]))


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_bands_of_many_matrices_are_those_of_single_modes(scene: Scene) -> None:
    single = modes_at(equilibrium(scene, default_cage_angles(scene, 121)))
    search = search_of(scene, terms_of(scene))
    assert search.labels == single.label
    frequencies = search.frequencies(terms_of(scene))
    np.testing.assert_allclose(frequencies, single.undamped_frequency.T, rtol=1e-10)


@pytest.mark.parametrize("extent", [0.0, 0.35, 1.1])
def test_approximate_damping_holds_where_modes_meet_and_balls_enter(extent: float) -> None:
    scene = ANGULAR.replace(extent=extent)
    state = equilibrium(scene, np.linspace(0.0, scene.bearing.period, 1001))
    exact, approximate = modes_at(state), modes_at(state, nearly=True)
    assert np.abs(exact.frequency / exact.undamped_frequency - 1.0).max() > 1e-3
    np.testing.assert_allclose(approximate.frequency, exact.frequency, rtol=1e-4)
    np.testing.assert_allclose(approximate.damping_ratio, exact.damping_ratio, atol=2e-3)


def test_unknown_terms_are_left_out_and_bands_without_any_are_nan() -> None:
    terms = terms_of(RIG)
    gone = terms.copy()
    gone[:, 30:60] = math.nan
    left = search_of(RIG, gone).frequencies(gone)
    few = np.delete(terms, slice(30, 60), axis=1)
    expected = search_of(RIG, few).frequencies(few)
    np.testing.assert_allclose(np.delete(left, slice(30, 60), axis=1), expected, rtol=1e-12)
    assert np.isnan(left[:, 30:60]).all()
    assert np.isnan(search_of(RIG, gone * math.nan).frequencies(gone * math.nan)).all()


@pytest.mark.parametrize("name", ["fan-rig", "liew-lim", "6205", "nu208"])
@pytest.mark.parametrize("race", ["outer", "inner"])
def test_coarse_bands_are_within_a_hundredth(name: str, race: str) -> None:
    scene = presets[name].replace(race=race)
    coarse, fine = (frequency_bands(scene, coarse=coarse) for coarse in (True, False))
    for label, ends in fine.items():
        assert coarse[label] == pytest.approx(ends, rel=0.01), label


def test_without_an_answer_there_is_no_band() -> None:
    bands = frequency_bands(RIG.replace(fy=0.0))
    assert list(bands) == list(frequency_bands(RIG))
    assert np.isnan(list(bands.values())).all()
