"""No random pair, self-aligning or roller bearing gives a wrong or an unexplained answer."""

from __future__ import annotations

import numpy as np
import pytest

from bearingcore import equilibrium, kernels
from tests.helpers.judge import verdict
from tests.helpers.random_rows import KINDS, random_scene


@pytest.mark.parametrize("kind", KINDS)
def test_random_bearings_have_right_answers(kind: str) -> None:
    rng = np.random.default_rng([20_261_122, KINDS.index(kind)])
    converged = 0
    for number in range(200):
        found = equilibrium(random_scene(rng, kind), [float(rng.uniform(0.0, 6.28))])
        fault = verdict(found, 0)
        assert not fault, f"scene {number}: {fault}"
        converged += found.status[0] == kernels.CONVERGED
    assert converged > 150
