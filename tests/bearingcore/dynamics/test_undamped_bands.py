"""Bands without damping: the same as from one matrix after the other, whatever the matrices."""

from __future__ import annotations

import dataclasses
import itertools
import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bearingcore import Scene, equilibrium, kernels, presets
from bearingcore.dynamics.modes import (
    _follow,
    _frequencies_like,
    _undamped,
    modes_at,
    two_body_matrix,
    undamped_bands,
)
from bearingcore.statics.equilibrium import STIFFNESS_TERMS, default_cage_angles
from bearingcore.statics.maps import stiffness_maps

RIG, ANGULAR = presets["fan-rig"], presets["liew-lim"]
SCENES = {
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
    """(15, 1, n)"""
    state = equilibrium(scene, default_cage_angles(scene, n))
    return np.stack([state.term(name) for name in STIFFNESS_TERMS])[:, None]


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_they_are_those_of_the_modes_one_matrix_after_the_other(scene: Scene) -> None:
    found = modes_at(equilibrium(scene, default_cage_angles(scene, 121)))
    least, greatest, [labels] = undamped_bands(scene, terms_of(scene))
    assert labels == found.label
    np.testing.assert_allclose(least[0], np.nanmin(found.undamped_frequency, axis=0), rtol=1e-10)
    np.testing.assert_allclose(greatest[0], np.nanmax(found.undamped_frequency, axis=0), rtol=1e-10)


def test_damping_moves_them_by_the_square_of_its_ratio() -> None:
    """So little that it shows what is left out, and so much that it is left out for a reason."""
    found = modes_at(equilibrium(RIG, default_cage_angles(RIG, 121)))
    least, greatest, _ = undamped_bands(RIG, terms_of(RIG))
    with_damping = np.array([found.bands()[label] for label in found.label]).T
    for without, edge in ((least[0], with_damping[0]), (greatest[0], with_damping[1])):
        np.testing.assert_allclose(without, edge, rtol=float(np.nanmax(found.damping_ratio)) ** 2)


def test_extents_together_are_extents_alone() -> None:
    extents = np.radians([5.0, 12.9, 38.6, 64.0, 85.0])
    angles = default_cage_angles(ANGULAR, 61)
    maps = stiffness_maps(ANGULAR, extents, angles)
    least, greatest, labels = undamped_bands(ANGULAR, maps.stiffness)
    for i, extent in enumerate(extents.tolist()):
        scene = ANGULAR.replace(extent=extent)
        low, high, [names] = undamped_bands(scene, terms_of(scene, 61))
        assert labels[i] == names
        # the map's stiffness is the curve's to rounding of an iteration
        np.testing.assert_allclose(least[i], low[0], rtol=1e-7)
        np.testing.assert_allclose(greatest[i], high[0], rtol=1e-7)


# ------------------------------------------------------------------------- the matrices themselves


def symmetric(rng: np.random.Generator, nd: int, n: int, spread: float) -> np.ndarray:
    """Upper triangles (nd (nd + 1)/2, n) of matrices about one that is positive definite."""
    root = rng.standard_normal((nd, nd))
    middle = root @ root.T + 0.3 * np.eye(nd)
    off = rng.standard_normal((n, nd, nd))
    K = 1e8 * (middle + spread * (off + np.swapaxes(off, 1, 2)))
    row, column = np.triu_indices(nd)
    return K[:, row, column].T.copy()


def full(terms: np.ndarray, support: np.ndarray) -> np.ndarray:
    """(n, m, m) of both bodies."""
    nd = len(support)
    K = np.zeros((terms.shape[1], nd, nd))
    row, column = np.triu_indices(nd)
    K[:, row, column] = K[:, column, row] = terms.T
    return two_body_matrix(K, support)


def template_of(terms: np.ndarray, support: np.ndarray, mass: np.ndarray) -> np.ndarray:
    """Modes of the mean, of unit modal mass."""
    root = np.sqrt(mass)
    mean = full(terms, support).mean(axis=0) / (root[:, None] * root)
    return np.linalg.eigh(mean)[1].T / root


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    nd=st.integers(1, 5),
    n=st.integers(1, 40),
    spread=st.sampled_from([0.0, 1e-6, 0.05, 0.4, 2.0]),
    free=st.booleans(),
)
def test_any_matrices_have_the_frequencies_of_lapack_and_the_best_assignment(
    seed: int, nd: int, n: int, spread: float, free: bool
) -> None:
    """Also indefinite ones, and free bodies, whose frequency is none."""
    rng = np.random.default_rng(seed)
    terms = symmetric(rng, nd, n, spread)
    support = np.zeros(nd) if free else 10.0 ** rng.uniform(5.0, 10.0, nd)
    mass = 10.0 ** rng.uniform(-3.0, 1.0, 2 * nd)
    template = template_of(terms, support, mass)
    found = _frequencies_like(template, terms, support, mass)
    root = np.sqrt(mass)
    values, vectors = np.linalg.eigh(full(terms, support) / (root[:, None] * root))
    expected = np.sqrt(np.maximum(values, 0.0)) / (2.0 * math.pi)
    # the square root of what rounding leaves of nothing
    noise = 1e-7 * float(np.sqrt(np.abs(values).max())) / (2.0 * math.pi)
    np.testing.assert_allclose(np.sort(found.T, axis=1), expected, rtol=1e-9, atol=noise)
    if nd <= 2:  # all ways to give each mode another template
        likeness = np.einsum("im,njm->nij", template * root, np.swapaxes(vectors, 1, 2)) ** 2
        for k in range(n):
            ways = itertools.permutations(range(2 * nd))
            sums = {way: sum(likeness[k, i, j] for i, j in enumerate(way)) for way in ways}
            ranked = sorted(sums, key=lambda way: -sums[way])
            if len(ranked) > 1 and sums[ranked[0]] - sums[ranked[1]] < 1e-6:
                continue  # either is as good
            best = expected[k, list(ranked[0])]
            np.testing.assert_allclose(found[:, k], best, rtol=1e-9, atol=noise)


def test_against_forty_digits() -> None:
    state = equilibrium(ANGULAR, default_cage_angles(ANGULAR, 121))
    dofs, support = ANGULAR.active_dofs, ANGULAR.support
    mass = np.concatenate([support.inertia(body, dofs) for body in ("inner", "outer")])
    stiffness = support.stiffness(dofs)
    row, column = np.triu_indices(5)
    terms = state.stiffness[::40, row, column].T
    template = template_of(terms, stiffness, mass)
    found = np.sort(_frequencies_like(template, terms, stiffness, mass).T, axis=1)
    with mpmath.workdps(40):
        for k, K in enumerate(full(terms, stiffness)):
            scaled = mpmath.matrix(10, 10)
            for i in range(10):
                for j in range(10):
                    scaled[i, j] = mpmath.mpf(K[i, j]) / mpmath.sqrt(
                        mpmath.mpf(mass[i]) * mpmath.mpf(mass[j])
                    )
            values = sorted(mpmath.eigsy(scaled, eigvals_only=True))
            exact = [float(mpmath.sqrt(value) / (2 * mpmath.pi)) for value in values]
            np.testing.assert_allclose(found[k], exact, rtol=1e-11)


def test_where_two_templates_want_the_same_mode_the_assignment_decides() -> None:
    """A mode between two templates: each comes out once, and as the other way finds them."""
    rng = np.random.default_rng(3)
    terms = symmetric(rng, 3, 400, 1.0)
    support, mass = np.full(3, 1e8), np.full(6, 2.0)
    template = template_of(terms, support, mass)
    squared, order = np.empty((400, 6)), np.empty((400, 6), dtype=np.int64)
    likeness = np.full((400, 6, 6), math.nan)
    mixing, outer = template[:, :3] - template[:, 3:], template[:, 3:]
    kernels.modes_like(
        terms, np.ascontiguousarray(mixing), (outer * support) @ outer.T, squared, order, likeness
    )
    doubtful = order[:, 0] == kernels.DOUBTFUL
    assert 3 < doubtful.sum() < 390, "or this tests nothing"
    assert np.isfinite(likeness[doubtful]).all()
    np.testing.assert_allclose(likeness[doubtful].sum(axis=1), 1.0, rtol=1e-12)
    np.testing.assert_array_equal(
        np.sort(order[~doubtful], axis=1), np.tile(np.arange(6), (sum(~doubtful), 1))
    )
    expected, _ = _follow(*_undamped(full(terms, support), mass), template, mass)
    found = _frequencies_like(template, terms, support, mass).T
    noise = 1e-7 * expected.max()
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=noise)


def test_what_is_not_known_is_left_out_and_nothing_known_is_not_a_number() -> None:
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


def test_a_support_that_lacks_a_number_is_refused_by_its_name() -> None:
    poor = dataclasses.replace(ANGULAR.support, stiffness_rx=None)
    with pytest.raises(ValueError, match="stiffness_rx"):
        undamped_bands(ANGULAR.replace(support=poor), terms_of(ANGULAR, 5))
