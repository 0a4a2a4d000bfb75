"""The least pivot of a stiffness, by which a direction without stiffness is known.

Its source is called: compiled kernels are for kernels to call, not for Python.
"""

import numpy as np
import pytest
from scipy.linalg.lapack import dpstrf

from bearingcore.model._kernels.statics import least_pivot


@pytest.mark.parametrize("rank", [1, 3, 4, 5])
def test_it_is_that_of_lapack_and_zero_without_full_rank(rank: int) -> None:
    random = np.random.default_rng(rank)
    for _ in range(20):
        root = random.normal(size=(5, rank)) * 10.0 ** random.uniform(-2.0, 0.0, rank)
        whole = root @ root.T
        active = np.sort(random.permutation(5)[: random.integers(rank, 6)])
        part = whole[np.ix_(active, active)]
        factor, _, known, _ = dpstrf(part, lower=1, tol=1e-13 * part.diagonal().max())
        pivots = np.diag(factor) ** 2
        expected = pivots[-1] / pivots[0] if known == active.size else 0.0
        pivot = least_pivot.py_func(whole, active, np.empty((5, 5)))
        assert pivot == pytest.approx(expected, rel=1e-6, abs=1e-12)
