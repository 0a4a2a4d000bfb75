"""Pairs, double rows, self-aligning bearings and rollers meet 40-digit answers to 1e-10."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bearingcore import Bearing, Defect, Equilibrium, Load, Scene, equilibrium, presets
from bearingcore.bearings.rows import Row
from bearingcore.statics.passes import drops_now

REFERENCE = Path(__file__).parents[2] / "reference" / "rows_reference.json"
CASES: list[dict[str, Any]] = json.loads(REFERENCE.read_text(encoding="utf-8"))
TOLERANCE = 1e-10

every_case = pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])


def answer(case: dict[str, Any]) -> Equilibrium:
    rows = tuple(Row(**row) for row in case["rows"])
    single = rows == (Row(),)
    scene = Scene(
        bearing=Bearing(**case["bearing"], rows=() if single else rows),
        defect=Defect(**case["defect"]),
        load=Load(**case["load"]),
        shaft_speed=100.0,
        support=presets["fan-rig"].support,
    )
    return equilibrium(scene, [case["cage_angle"]], dofs=tuple(case["dofs"]))


def numbers(values: Any) -> np.ndarray:
    return np.array(values, dtype=float)


def test_the_reference_is_proven_and_covers_what_it_should() -> None:
    assert len(CASES) >= 20
    assert all(float(case["proof"]["relative_residual"]) < 1e-30 for case in CASES)
    assert all(
        float(case["proof"]["stiffness_against_difference_quotient"]) < 1e-30 for case in CASES
    )
    assert all(float(case["proof"]["least_eigenvalue_over_greatest_term"]) > 1e-6 for case in CASES)
    assert {case["defect"]["row"] for case in CASES} == {None, 0, 1}
    kinds = {case["name"].split(",")[0] for case in CASES}
    assert {
        "back to back",
        "face to face",
        "tandem",
        "double row",
        "rollers",
        "unlike rows",
    } <= kinds
    assert any("self-aligning" in kind for kind in kinds)


@every_case
def test_equilibrium_and_stiffness(case: dict[str, Any]) -> None:
    found = answer(case)
    assert found.converged[0]
    lever = case["bearing"]["groove_center_radius"]
    unit = np.array([1.0, 1.0, 1.0, lever, lever])
    expected = numbers(case["displacement"]) * unit
    error = np.abs(found.displacement[0] * unit - expected).max() / np.linalg.norm(expected)
    assert error < TOLERANCE, f"displacement off by {error:.1e}"

    loads = numbers(case["ball_load"])
    error = np.abs(found.ball_load[0] - loads).max() / loads.max()
    assert error < TOLERANCE, f"ball loads off by {error:.1e}"
    assert found.loaded_balls[0] == np.count_nonzero(loads)
    turned = np.abs(found.contact_angle[0] - numbers(case["contact_angle"]))[loads > 0.0]
    assert turned.max() < TOLERANCE

    expected = numbers(case["stiffness"])
    diagonal = np.diag(expected) / unit**2
    diagonal = np.maximum(diagonal, 1e-3 * diagonal.max()) * unit**2
    error = np.abs(found.stiffness[0] - expected) / np.sqrt(np.outer(diagonal, diagonal))
    assert error.max() < TOLERANCE, f"stiffness off by {error.max():.1e}"


@every_case
def test_drop_of_each_ball_of_each_row(case: dict[str, Any]) -> None:
    drop = drops_now(answer(case).scene, case["cage_angle"])
    assert drop == pytest.approx(numbers(case["drop"]), rel=TOLERANCE, abs=1e-16)


def test_the_self_aligning_reference_is_one() -> None:
    """Its numbers were written out from the sphere: the program knows it by them."""
    aligning = [answer(case).scene.bearing for case in CASES if "self-aligning" in case["name"]]
    assert all(bearing.kind.name == "self-aligning" for bearing in aligning)
    assert math.isclose(aligning[0].groove_radius("inner"), 4.6275e-3, rel_tol=1e-9)
