"""Ellipse and pressure of the heaviest ball: by mpmath, and by what must hold for any ellipse."""

from __future__ import annotations

import dataclasses
import math

import mpmath
import numpy as np
import pytest

from bearingcore import Defect, equilibrium, limits, presets
from bearingcore.statics.pressure import RacePressure, contact_pressures, heaviest_balls
from bearingcore.statics.validity import looked_at

DRAWN = ("6205", "6206", "7208-15deg", "7208-40deg", "seven-ball")


@pytest.mark.parametrize("name", DRAWN)
def test_the_ellipse_carries_the_load(name: str) -> None:
    """Q = (2/3) π a b p, for the ball that carries most."""
    scene = presets[name]
    found = contact_pressures(scene)
    state = equilibrium(scene)
    assert found.ball.load == state.ball_load.max()
    for contact in (found.inner, found.outer):
        a, b, p = contact.semi_axis_across, contact.semi_axis_along, contact.greatest_pressure
        assert 2.0 / 3.0 * math.pi * a * b * p == pytest.approx(found.ball.load, rel=1e-12)
        assert a > b > 0.0


def test_by_mpmath() -> None:
    """The 6205 at 1 kN: ellipse ratio from the curvatures by elliptic integrals at 30 digits."""
    scene = presets["6205"].healthy()
    b = scene.bearing
    found = contact_pressures(scene)
    assert b.inner_groove_radius is not None
    assert b.youngs_modulus is not None
    assert b.poisson is not None
    with mpmath.workdps(30):
        D, gamma = mpmath.mpf(b.ball_diameter), mpmath.mpf(b.ball_diameter) / b.pitch_diameter
        groove, around = 1 / mpmath.mpf(b.inner_groove_radius), 2 * gamma / ((1 - gamma) * D)
        total = 4 / D + around - groove
        difference = (groove + around) / total

        def off(chi: mpmath.mpf) -> mpmath.mpf:
            m = 1 - 1 / chi**2
            ratio = mpmath.ellipk(m) / mpmath.ellipe(m)
            return 1 - 2 / (chi**2 - 1) * (ratio - 1) - difference

        chi = mpmath.findroot(off, (5, 15), solver="anderson")
        compliance = (1 - mpmath.mpf(b.poisson) ** 2) / b.youngs_modulus
        size = mpmath.cbrt(3 * mpmath.mpf(found.ball.load) * compliance / total)
        across = mpmath.cbrt(2 * chi**2 * mpmath.ellipe(1 - 1 / chi**2) / mpmath.pi) * size
        pressure = 1.5 * found.ball.load / (mpmath.pi * across * across / chi)
    assert found.inner.semi_axis_across == pytest.approx(float(across), rel=1e-10)
    assert found.inner.semi_axis_along == pytest.approx(float(across / chi), rel=1e-10)
    assert found.inner.greatest_pressure == pytest.approx(float(pressure), rel=1e-10)


def test_the_same_pressure_as_among_the_limits() -> None:
    scene = presets["6206"]
    found = contact_pressures(scene, equilibrium(scene, looked_at(scene)))
    told = {limit.name: limit.value for limit in limits(scene)}
    assert told["contact pressure, inner race"] == found.inner.greatest_pressure
    assert told["contact pressure, outer race"] == found.outer.greatest_pressure


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


def test_table_repeats_the_result() -> None:
    found = contact_pressures(presets["6206"])
    table = found.table()
    for i, contact in enumerate((found.inner, found.outer)):
        for field in dataclasses.fields(RacePressure):
            name = "ball_load" if field.name == "load" else field.name
            assert getattr(contact, field.name) == table[name][i]
    assert "greatest_pressure_pa" in table.csv()


def test_refusals() -> None:
    with pytest.raises(ValueError, match="inner_groove_radius"):
        contact_pressures(presets["fan-rig"])
    with pytest.raises(ValueError, match="state"):
        contact_pressures(presets["6205"], equilibrium(presets["6206"]))
