"""Pressure of the heaviest ball: where it is, and what is not known; `tests/outside` holds it."""

import numpy as np
import pytest

from bearingcore import Defect, equilibrium, presets
from bearingcore.model.statics import contact_pressures
from bearingcore.model.statics._pressure import heaviest_balls


def test_the_heaviest_ball_is_where_it_is_said_to_be() -> None:
    scene = presets["6206"]
    (ball,) = heaviest_balls(equilibrium(scene))
    there = equilibrium(scene, [ball.cage_angle])
    at = int(there.ball_load[0].argmax())
    assert there.ball_load[0, at] == pytest.approx(ball.load, rel=1e-9)
    assert there.ball_angle[0, at] == pytest.approx(ball.ball_angle)


def test_nothing_carried_and_nothing_known() -> None:
    nothing = contact_pressures(presets["6205"].replace(fy=0.0))
    assert nothing.inner.greatest_pressure == nothing.inner.semi_axis_across == 0.0
    two_balls = presets["6205"].replace(n_balls=2, defect=Defect.none())
    unknown = contact_pressures(two_balls, equilibrium(two_balls, [0.0]))
    table = unknown.table()
    assert all(np.isnan(table[name]).all() for name in table if table.unit(name))
