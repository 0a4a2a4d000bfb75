"""How the search for a static state ended, as data and in words."""

from __future__ import annotations

import math

from bearingcore import equilibrium, presets
from bearingcore.statics.status import StaticStatus
from bearingcore.sweep.status import OF_STATICS, STATUSES, SweepStatus


def test_a_solution_holds_members_of_it() -> None:
    found = equilibrium(presets["fan-rig"], [0.0])
    assert StaticStatus(int(found.status[0])) is StaticStatus.CONVERGED
    assert found.reason(0) == "converged"


def test_numbers_and_directions_are_in_its_sentence_where_they_are_known() -> None:
    words = StaticStatus.NOT_CONVERGED.sentence(residual=3e-4)
    assert words == "not converged: relative residual 3·10⁻⁴"
    assert StaticStatus.NOT_CONVERGED.sentence(residual=math.nan) == "not converged"
    assert StaticStatus.FREE_DIRECTION.sentence("z").endswith("along z")


def test_a_sweep_has_a_status_for_each_that_a_solver_ends_with() -> None:
    assert set(OF_STATICS) == set(StaticStatus) - {StaticStatus.NOT_COMPUTED}
    assert STATUSES[0] is SweepStatus.NOT_COMPUTED, "what an empty file says"
    assert all(STATUSES[status.code] is status for status in STATUSES)
