"""Statics of one row and of several meet 40-digit answers to 1e-10.

See tests/reference/README.md.
"""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bearingcore import Bearing, Defect, Load, Scene, equilibrium, presets
from bearingcore.bearings import Row
from bearingcore.model.statics import drops_now
from bearingcore.model.statics._status import StaticStatus

REFERENCE = Path(__file__).parents[3] / "reference"
SINGLE, ROWS = (
    json.loads((REFERENCE / f"{name}_reference.json").read_text(encoding="utf-8"))
    for name in ("static", "rows")
)
CASES: list[dict[str, Any]] = SINGLE + ROWS
TOLERANCE = 1e-10
BEYOND = ("zero contact angle, axial load, clearance 50", "heavy")
"""Cases whose inner groove moves past the outer one: a balance of the formulas alone."""
PITCH = "groove_center_radius"

every_case = pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])


def scene_of(case: dict[str, Any]) -> Scene:
    """The case as a Scene; support and speed do not enter the statics."""
    rows = tuple(Row(**row) for row in case.get("rows", ()))
    return Scene(
        bearing=Bearing(**case["bearing"], rows=() if rows == (Row(),) else rows),
        defect=Defect(**case["defect"]),
        load=Load(**case["load"]),
        shaft_speed=2.0 * math.pi * 7.0,
        support=presets["fan-rig"].support,
    )


def numbers(values: Any) -> np.ndarray:
    """Strings of 20 digits as doubles."""
    return np.array(values, dtype=float)


def test_the_reference_is_proven_and_covers_what_it_should() -> None:
    """Guards against a reference regenerated with fewer or easier cases."""
    assert len(SINGLE) >= 68
    assert len(ROWS) >= 20
    assert all(float(case["proof"]["relative_residual"]) < 1e-30 for case in CASES)
    quotient = "stiffness_against_difference_quotient"
    assert all(float(case["proof"][quotient]) < 1e-30 for case in CASES)
    # a ball that carries while it is on an edge, for each edge model on each race
    on_an_edge = {
        (case["defect"]["race"], case["defect"]["edge"])
        for case in SINGLE
        for drop, load in zip(numbers(case["drop"]), numbers(case["ball_load"]), strict=True)
        if 0.0 < drop < case["defect"]["depth"] and load > 0.0
    }
    assert len(on_an_edge) == 6
    assert {len(case["dofs"]) for case in CASES} >= {2, 3, 5}
    assert sum(case["proof"]["guarded_and_loaded_balls"] > 0 for case in SINGLE) >= 3
    kinds = {"back to back", "face to face", "tandem", "double row", "rollers", "unlike rows"}
    for kind in kinds | {"self-aligning"}:
        assert any(case["name"].startswith(kind) for case in ROWS), kind


@every_case
def test_drop_of_the_ball_centres(case: dict[str, Any]) -> None:
    drop = drops_now(scene_of(case), case["cage_angle"])
    expected = numbers(case["drop"])
    # The angle of a ball has rounding of 1e-16 per radian turned; the edge slopes by 1e-2 m/rad.
    assert drop == pytest.approx(expected, rel=TOLERANCE, abs=1e-16)


@every_case
def test_equilibrium_and_stiffness(case: dict[str, Any]) -> None:
    """All 5×5 terms, also of directions held still, against the geometric mean of k_ii, k_jj."""
    answer = equilibrium(scene_of(case), np.array([case["cage_angle"]]), dofs=tuple(case["dofs"]))
    lever = case["bearing"][PITCH]
    if case["name"] in BEYOND:
        assert answer.status[0] == StaticStatus.BEYOND_GEOMETRY
        assert np.isnan(answer.stiffness).all()
        expected = numbers(case["displacement"]) * np.array([1.0, 1.0, 1.0, lever, lever])
        error = np.abs(answer.state[0] - expected).max() / np.linalg.norm(expected)
        assert error < TOLERANCE, f"displacement off by {error:.1e}"
        return
    assert answer.converged[0]

    unit = np.array([1.0, 1.0, 1.0, lever, lever])
    expected = numbers(case["displacement"]) * unit
    error = np.abs(answer.displacement[0] * unit - expected).max() / np.linalg.norm(expected)
    assert error < TOLERANCE, f"displacement off by {error:.1e}"

    loads = numbers(case["ball_load"])
    error = np.abs(answer.ball_load[0] - loads).max() / loads.max()
    assert error < TOLERANCE, f"ball loads off by {error:.1e}"
    assert answer.loaded_balls[0] == np.count_nonzero(loads)

    turned = np.abs(answer.contact_angle[0] - numbers(case["contact_angle"]))[loads > 0.0]
    assert turned.max() < TOLERANCE, f"contact angle off by {turned.max():.1e} rad"

    expected = numbers(case["stiffness"])
    # A direction in which nothing is stiff is measured by the greatest stiffness instead.
    diagonal = np.diag(expected) / unit**2
    diagonal = np.maximum(diagonal, 1e-3 * diagonal.max()) * unit**2
    off = np.abs(answer.stiffness[0] - expected) / np.sqrt(np.outer(diagonal, diagonal))
    assert off.max() < TOLERANCE, f"stiffness off by {off.max():.1e}"
