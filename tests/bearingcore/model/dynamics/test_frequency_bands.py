"""Bands of natural frequencies: independent of the samples, and the same without damping."""

import math

import numpy as np
import pytest

from bearingcore import Scene, equilibrium, frequency_bands, presets
from bearingcore.model.dynamics._modes import modes_at, undamped_bands
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
    """Return the 15 stiffness terms at n cage angles, (15, 1, n)."""
    state = equilibrium(scene, default_cage_angles(scene, n))
    return np.stack([state.term(name) for name in STIFFNESS_TERMS])[:, None]


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_bands_of_many_matrices_are_those_of_single_modes(scene: Scene) -> None:
    single = modes_at(equilibrium(scene, default_cage_angles(scene, 121)))
    least, greatest, [labels] = undamped_bands(scene, terms_of(scene))
    frequency = single.undamped_frequency
    assert labels == single.label
    np.testing.assert_allclose(least[0], np.nanmin(frequency, axis=0), rtol=1e-10)
    np.testing.assert_allclose(greatest[0], np.nanmax(frequency, axis=0), rtol=1e-10)


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
    gone[:, 0, 30:60] = math.nan
    least, greatest, _ = undamped_bands(RIG, np.concatenate([terms, gone, gone * math.nan], axis=1))
    few = np.delete(terms, slice(30, 60), axis=2)
    low, high, _ = undamped_bands(RIG, few)
    np.testing.assert_allclose(least[1], low[0], rtol=1e-12)
    np.testing.assert_allclose(greatest[1], high[0], rtol=1e-12)
    assert np.isnan(least[2]).all()
    assert np.isnan(greatest[2]).all()
    assert np.isfinite(least[0]).all()


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
