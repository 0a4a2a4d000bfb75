"""Curves over a turn of the shaft, where a defect turns with it."""

import math

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.stiffness import Stiffness
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import presets

OUTER = presets["fan-rig"]
INNER = OUTER.replace(race="inner")
TURN = 2.0 * math.pi * OUTER.bearing.cage_ratio  # of the cage while the shaft turns once


def test_curves_are_over_a_ball_spacing_or_over_the_turn_that_is_shown() -> None:
    outer = Results(OUTER, 3.0)
    assert outer.stretch[:2] == (0.0, OUTER.bearing.ball_spacing)
    for turn in (0, 1, 2):
        inner = Results(INNER, (turn + 0.3) * TURN)
        np.testing.assert_allclose(inner.stretch[:2], [turn * TURN, (turn + 1) * TURN])
        assert inner.along([(turn + 0.3) * TURN])[0] == pytest.approx(0.3 * 360.0)
        assert inner.along(inner.equilibrium.cage_angles[[0, -1]]).tolist() == [0.0, 360.0]


@pytest.mark.parametrize("cage_angle", [0.4, 0.4 + TURN, 0.4 + 2 * TURN])
def test_the_mark_stands_on_the_curve(cage_angle: float) -> None:
    """Also in later turns, in which the defect meets the balls elsewhere."""
    results = Results(INNER, cage_angle)
    state = results.equilibrium
    at_now = np.interp(cage_angle, state.cage_angles, state.term("k_yy"))
    assert at_now == pytest.approx(results.now.term("k_yy")[0], rel=2e-3)
    sources, _ = Stiffness(PackedSource()).data(results)
    share = results.along([cage_angle])[0] / 360.0
    marks, cells = sources["stiffness_now"]["x"], sources["stiffness_cells"]
    np.testing.assert_allclose(
        marks, cells["left"] + share * (cells["right"] - cells["left"]), rtol=1e-9
    )
    assert set(cells["foot"]) == {0.0, 360.0}
    assert sources["stiffness_axis"]["shaft"].tolist() == [1.0]
