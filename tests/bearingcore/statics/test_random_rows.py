"""No random pair, self-aligning or roller bearing gives a wrong or an unexplained answer.

`tests.helpers.random_rows` judges, in extended precision and without the solver's code.
"""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from bearingcore import kernels
from tests.helpers.random_rows import KINDS, judged, verdict


@pytest.mark.parametrize("kind", KINDS)
def test_random_bearings_have_right_answers(kind: str) -> None:
    rng = np.random.default_rng([20_261_122, KINDS.index(kind)])
    converged = 0
    for number in range(400):
        _, found, fault = judged(rng, kind)
        assert not fault, f"scene {number}: {fault}"
        converged += found.status[0] == kernels.CONVERGED
    assert converged > 300


def test_the_judge_finds_what_is_wrong() -> None:
    """A judge that never objects proves nothing."""
    rng = np.random.default_rng(5)
    for kind in KINDS:
        _, found, fault = judged(rng, kind)
        while found.status[0] != kernels.CONVERGED:
            _, found, fault = judged(rng, kind)
        assert fault == ""
        moved = dataclasses.replace(found, displacement=1.01 * found.displacement)
        assert "residual" in verdict(moved, 0, rng)
        lopsided = found.stiffness.copy()
        lopsided[0, 0, 1] += 0.01 * np.abs(lopsided).max()
        assert "symmetric" in verdict(dataclasses.replace(found, stiffness=lopsided), 0, rng)
        stiffer = dataclasses.replace(found, stiffness=1.01 * found.stiffness)
        assert "finite differences" in verdict(stiffer, 0, rng)
        soft = dataclasses.replace(found, stiffness=-found.stiffness)
        assert "eigenvalue" in verdict(soft, 0, rng)
