"""Pairs, unlike rows, self-aligning and roller bearings: writes `rows_reference.json`.

    python -m tests.reference.make_rows_reference   # a minute

The equations are in `statics.py` of this folder.
"""

from __future__ import annotations

import math
from typing import Any

from tests.reference.make_static_reference import LIEW_LIM as SMALL
from tests.reference.make_static_reference import case as one_row
from tests.reference.statics import DOFS, row, write

ALL, XYZ, XY = DOFS, DOFS[:3], DOFS[:2]
DOUBLE_ROW = {
    "n_balls": 14,
    "ball_diameter": 10.31875e-3,
    "pitch_diameter": 60e-3,
    "contact_angle": math.radians(30.0),
    "groove_center_radius": 30.17872e-3,
    "groove_center_distance": 515.9375e-6,
    "radial_clearance": 0.0,
    "load_deflection_factor": 9.96e9,
    "outer_raceway_radius": 35.159375e-3,
    "inner_raceway_radius": 24.840625e-3,
}
SPHERE, GROOVE, ALIGNING_ANGLE = 34.4e-3, 4.6275e-3, math.radians(10.0)
_FROM_MIDDLE = SPHERE + GROOVE - 8.73125e-3
ALIGNING = {
    "n_balls": 16,
    "ball_diameter": 8.73125e-3,
    "pitch_diameter": 2.0 * (SPHERE - 0.5 * 8.73125e-3) * math.cos(ALIGNING_ANGLE),
    "contact_angle": ALIGNING_ANGLE,
    "groove_center_radius": _FROM_MIDDLE * math.cos(ALIGNING_ANGLE),
    "groove_center_distance": _FROM_MIDDLE,
    "radial_clearance": 5e-6,
    "load_deflection_factor": 5.4e9,
    "outer_raceway_radius": SPHERE,
    "inner_raceway_radius": 25.28e-3,
}
ROLLERS = {
    "n_balls": 14,
    "ball_diameter": 11e-3,
    "pitch_diameter": 60.5e-3,
    "contact_angle": 0.0,
    "groove_center_radius": 30.25e-3,
    "groove_center_distance": 11e-3,
    "radial_clearance": 15e-6,
    "load_deflection_factor": 1.4634e9,
    "outer_raceway_radius": 35.75e-3,
    "inner_raceway_radius": 24.75e-3,
    "roller_length": 11e-3,
}
TAPERED = {
    "n_balls": 17,
    "ball_diameter": 7.66e-3,
    "pitch_diameter": 46e-3,
    "contact_angle": math.radians(14.0),
    "groove_center_radius": 23e-3,
    "groove_center_distance": 10.0,
    "radial_clearance": 0.0,
    "load_deflection_factor": 1.38e9,
    "outer_raceway_radius": 26.7e-3,
    "inner_raceway_radius": 19.3e-3,
    "roller_length": 10.3e-3,
}

DRAWN_BALL = 15.0 / 32.0 * 25.4e-3
DRAWN = {
    "n_balls": 14,
    "ball_diameter": DRAWN_BALL,
    "pitch_diameter": 60e-3,
    "contact_angle": math.radians(25.0),
    "groove_center_radius": 30e-3 + 0.02 * DRAWN_BALL * math.cos(math.radians(25.0)),
    "groove_center_distance": 0.52 * DRAWN_BALL + 0.53 * DRAWN_BALL - DRAWN_BALL,
    "radial_clearance": 2e-6,
    "load_deflection_factor": 1.07e10,
    "outer_raceway_radius": 30e-3 + 0.5 * DRAWN_BALL,
    "inner_raceway_radius": 30e-3 - 0.5 * DRAWN_BALL,
    "inner_groove_radius": 0.52 * DRAWN_BALL,
    "outer_groove_radius": 0.53 * DRAWN_BALL,
    "youngs_modulus": 210e9,
    "poisson": 0.3,
}


def pair(place: float, upper: int, push: float, **of_upper: float) -> list[dict[str, Any]]:
    """Two rows ± `place`, the upper one facing `upper`, each pushed by `push` [m]."""
    low = row(-place, -upper, offset=-upper * push)
    return [low, {**row(place, upper, offset=upper * push), **of_upper}]


def case(
    name: str,
    bearing: dict[str, Any],
    rows: list[dict[str, Any]],
    load: tuple[float, float, float, float, float],
    *numbers: Any,
    defect_row: int | None = None,
    **more: Any,
) -> dict[str, Any]:
    """As of one row, with exact edges; the load is fx, fy, fz, mx, my."""
    loads = dict(zip(("fx", "fy", "fz", "mx", "my"), load, strict=True))
    made = one_row(name, bearing, loads, *numbers, **{"edge": "exact", **more})
    return {**made, "rows": rows, "defect": {**made["defect"], "row": defect_row}}


def scenes() -> list[dict[str, Any]]:
    """Each kind, healthy and damaged, in one row and in all."""
    down = (0.0, -2000.0, 500.0, 0.0, 0.0)
    all_five = (300.0, -1500.0, 600.0, 12.0, -7.0)
    unlike = {"n_balls": 11, "ball_diameter": 10e-3, "pitch_diameter": 55e-3,
              "contact_angle": math.radians(40.0), "inner_groove_radius": 5.25e-3}  # fmt: skip
    place = _FROM_MIDDLE * math.sin(ALIGNING_ANGLE)
    aligning = [row(-place, -1), row(place, 1)]
    loose = [row(-place, -1, clearance=-8e-6), row(place, 1, clearance=-8e-6)]
    half = math.pi / 12.0
    return [
        case("back to back, preloaded", SMALL, pair(8e-3, -1, 4e-6), down, 3.0),
        case("face to face, preloaded", SMALL, pair(8e-3, 1, 4e-6), down, 3.0),
        case("back to back, all loads, defect in row 1", SMALL, pair(8e-3, -1, 4e-6), all_five, 7.0,
             30.0, 20.0, defect_row=0),
        case("face to face, all loads, defect in row 2", SMALL, pair(8e-3, 1, 3e-6), all_five, 7.0,
             30.0, 20.0, defect_row=1),
        case("back to back, defect across both rows", SMALL, pair(9e-3, -1, 2e-6), all_five, 11.0,
             40.0, 15.0, 250.0, edge="chord"),
        case("face to face, inner race, later", SMALL, pair(9e-3, 1, 5e-6), all_five, 411.0, 25.0,
             10.0, 100.0, "inner", defect_row=1),
        case("tandem", SMALL, [row(-7e-3), row(7e-3)], (0.0, -1500.0, 2500.0, 0.0, 0.0), 5.0, 20.0,
             10.0, dofs=XYZ),
        case("tandem, all directions", SMALL, [row(-7e-3), row(7e-3)],
             (100.0, -1500.0, 4500.0, 10.0, 5.0), 5.0),
        case("rows half a spacing apart", SMALL, pair(8e-3, -1, 3e-6, turn=half), all_five, 2.0,
             20.0, 30.0),
        case("rows of unlike clearance", SMALL, pair(8e-3, -1, 2e-6, clearance=-1.5e-6), all_five,
             2.0),
        case("double row, angular contact", DOUBLE_ROW, pair(7e-3, -1, 2e-6),
             (0.0, -2500.0, 500.0, 0.0, 0.0), 4.0, 8.0, 100.0, 272.0, defect_row=0),
        case("double row, moment", DOUBLE_ROW, pair(7e-3, -1, 2e-6),
             (400.0, -1500.0, -700.0, 20.0, -15.0), 9.0),
        case("self-aligning", ALIGNING, aligning, (0.0, -1000.0, 0.0, 0.0, 0.0), 3.0, dofs=XYZ),
        case("self-aligning, defect in row 1", ALIGNING, aligning,
             (150.0, -1000.0, 60.0, 0.0, 0.0), 1.0, 8.0, 100.0, defect_row=0, dofs=XYZ),
        case("self-aligning, preloaded, axial", ALIGNING, loose,
             (0.0, -700.0, 300.0, 0.0, 0.0), 1.0, dofs=XYZ),
        case("rollers", ROLLERS, [row(0.0)], (0.0, -3000.0, 0.0, 0.0, 0.0), 3.0, dofs=XY),
        case("rollers over a defect", ROLLERS, [row(0.0)], (200.0, -3000.0, 0.0, 0.0, 0.0), 9.5,
             8.0, 100.0, 268.0, dofs=XY),
        case("rollers, inner race", ROLLERS, [row(0.0)], (0.0, -5000.0, 0.0, 0.0, 0.0), 77.0, 20.0,
             12.0, 30.0, "inner", dofs=XY),
        case("tapered rollers, back to back", TAPERED, pair(15e-3, -1, 3e-6), all_five, 7.0),
        case("tapered rollers, face to face, defect in row 2", TAPERED, pair(15e-3, 1, 4e-6),
             (300.0, -4000.0, 900.0, 25.0, -15.0), 12.5, 12.0, 20.0, defect_row=1),
        case("a row of tapered rollers", TAPERED, [row(0.0)],
             (500.0, -2000.0, 1500.0, 0.0, 0.0), 3.0, dofs=XYZ),
        case("unlike rows", DRAWN, pair(9e-3, -1, 4e-6, turn=0.1, **unlike), all_five, 21.0, 12.0,
             40.0, 280.0),
        case("unlike rows, inner race, later", DRAWN, pair(9e-3, 1, 6e-6, n_balls=9), all_five,
             130.0, 20.0, 15.0, 60.0, "inner", defect_row=1),
    ]  # fmt: skip


if __name__ == "__main__":
    write(scenes(), "rows_reference.json")
