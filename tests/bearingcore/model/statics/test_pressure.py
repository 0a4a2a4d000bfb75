"""Pressure of the heaviest ball: where it is, and what is not known; `tests/outside` holds it."""

import numpy as np
import pytest

from bearingcore import Defect, equilibrium, limits, presets
from bearingcore.model.statics import contact_pressures, state_of_limits
from bearingcore.model.statics._pressure import heaviest_balls


def test_the_same_pressure_as_among_the_limits() -> None:
    scene = presets["6206"]
    pressures = contact_pressures(scene, state_of_limits(scene))
    told = {limit.name: limit.value for limit in limits(scene)}
    assert told["contact pressure, inner race"] == pressures.inner.greatest_pressure
    assert told["contact pressure, outer race"] == pressures.outer.greatest_pressure


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
