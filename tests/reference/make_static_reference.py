"""Scenes of one row of balls, and their equilibrium: writes `static_reference.json`.

    python -m tests.reference.make_static_reference   # a minute

The equations are in `statics.py` of this folder.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tests.reference.statics import DOFS, write

LIEW_LIM = {
    "n_balls": 12,
    "ball_diameter": 6e-3,
    "pitch_diameter": 39.3e-3,
    "contact_angle": math.radians(30.0),
    "groove_center_radius": 19.65e-3,
    "groove_center_distance": 50e-6,
    "radial_clearance": 0.05e-6,
    "load_deflection_factor": 1.45e10,
    "outer_raceway_radius": 22.65e-3,
    "inner_raceway_radius": 16.65e-3,
}
FAN_RIG = {
    "n_balls": 14,
    "ball_diameter": 8e-3,
    "pitch_diameter": 45e-3,
    "contact_angle": 0.0,
    "groove_center_radius": 22.5e-3,
    "groove_center_distance": 50e-6,
    "radial_clearance": 3e-6,
    "load_deflection_factor": 5453e6,
    "outer_raceway_radius": 26.5e-3,
    "inner_raceway_radius": 18.5e-3,
}
LIEW_LIM_LOAD = {"fx": 0.0, "fy": -2000.0, "fz": 500.0, "mx": 0.0, "my": 0.0}
FAN_RIG_LOAD = {"fx": 0.0, "fy": -100.0, "fz": 0.0, "mx": 0.0, "my": 0.0}
NO_LOAD = {"fx": 0.0, "fy": 0.0, "fz": 0.0, "mx": 0.0, "my": 0.0}


def case(
    name: str,
    bearing: dict[str, Any],
    load: dict[str, float],
    cage_deg: float,
    extent_deg: float = 0.0,
    depth_um: float = 50.0,
    center_deg: float = 270.0,
    race: str = "outer",
    edge: str = "published",
    dofs: tuple[str, ...] = DOFS,
) -> dict[str, Any]:
    """One scene in plain floats [SI, rad]; what is rounded here is what goes in everywhere."""
    return {
        "name": name,
        "bearing": bearing,
        "load": load,
        "defect": {
            "extent": math.radians(extent_deg),
            "depth": depth_um * 1e-6,
            "center": math.radians(center_deg),
            "race": race,
            "edge": edge,
        },
        "dofs": list(dofs),
        "cage_angle": math.radians(cage_deg),
    }


def scenes() -> list[dict[str, Any]]:
    """The spread of scenes: presets, edges, races, depths, loads, bearings, sets of DOFs."""
    ll, ll_load, fan, fan_load = LIEW_LIM, LIEW_LIM_LOAD, FAN_RIG, FAN_RIG_LOAD
    general = {"fx": 300.0, "fy": -1500.0, "fz": 800.0, "mx": 5.0, "my": -8.0}
    xy = ("x", "y")
    cases = [
        case("liew-lim sound", ll, ll_load, 0.0),
        case("liew-lim 5 deg, ball at the middle", ll, ll_load, 0.0, 5.0),
        case("liew-lim 40 deg", ll, ll_load, 7.0, 40.0),
        case("liew-lim 70 deg", ll, ll_load, 11.0, 70.0),
        case("liew-lim 40 deg chord", ll, ll_load, 13.0, 40.0, edge="chord"),
        case("liew-lim 40 deg exact", ll, ll_load, 3.0, 40.0, edge="exact"),
        case("liew-lim 5 deg exact deep", ll, ll_load, 0.5, 5.0, 500.0, edge="exact"),
        case("liew-lim 20 deg chord, ball on the edge", ll, ll_load, 9.0, 20.0, edge="chord"),
        case("liew-lim 64 deg shallow chord", ll, ll_load, 1.0, 64.0, 30.0, edge="chord"),
        case("liew-lim 40 deg depth 100", ll, ll_load, 4.0, 40.0, 100.0),
        case("liew-lim 40 deg depth 200", ll, ll_load, 4.0, 40.0, 200.0),
        case("liew-lim 40 deg depth 500", ll, ll_load, 4.0, 40.0, 500.0),
        case("liew-lim 25 deg depth 0", ll, ll_load, 4.0, 25.0, 0.0),
        case("liew-lim depth 3, floor carries", ll, ll_load, 4.0, 60.0, 3.0),
        case("liew-lim inner 40 deg", ll, ll_load, 5.0, 40.0, race="inner"),
        case("liew-lim inner 20 deg chord", ll, ll_load, 2.0, 20.0, race="inner", edge="chord"),
        case("liew-lim inner 30 deg exact, turns later", ll, general, 1234.0, 30.0, 20.0, 100.0,
             race="inner", edge="exact"),
        case("inner 50 deg exact deep, backwards", ll, general, -77.0, 50.0, 300.0, 10.0,
             race="inner", edge="exact"),
        case("across zero from above", ll, {**NO_LOAD, "fx": 1500.0, "fz": 600.0}, 2.0, 50.0,
             center_deg=3.0),
        case("across zero from below", ll, {**NO_LOAD, "fx": 1500.0, "fz": 600.0}, 2.0, 50.0,
             center_deg=357.0, edge="exact"),
        case("across zero, negative centre", ll, {**NO_LOAD, "fx": 900.0, "fz": 600.0}, 2.0, 30.0,
             center_deg=-2.0, edge="chord"),
        case("extent 200 deg exact", ll, general, 6.0, 200.0, 20.0, edge="exact"),
        case("extent 350 deg exact", ll, general, 6.0, 350.0, 20.0, 90.0, edge="exact"),
        case("whole race, balls off the joint", ll, general, 15.0, 360.0, 20.0, 90.0),
        case("all five loads", ll, general, 21.0, 33.0, center_deg=240.0),
        case("moments under preload", ll, {**NO_LOAD, "fz": 1200.0, "mx": 6.0, "my": 4.0}, 8.0,
             25.0, center_deg=45.0),
        case("axial load the other way", ll, {**NO_LOAD, "fy": -400.0, "fz": -900.0}, 8.0, 25.0),
        case("liew-lim x and y", ll, ll_load, 7.0, 40.0, dofs=xy),
        case("liew-lim x, y and z", ll, ll_load, 7.0, 40.0, dofs=("x", "y", "z")),
        case("liew-lim x, z and ry", ll, {**NO_LOAD, "fx": -800.0, "fz": 700.0, "my": 3.0}, 7.0,
             40.0, center_deg=180.0, dofs=("x", "z", "ry")),
        case("fan rig sound", fan, fan_load, 5.0, dofs=xy),
        case("fan rig 12.9 deg, ball entering", fan, fan_load, 7.5, 12.9, dofs=xy),
        case("fan rig 38.6 deg", fan, fan_load, 3.0, 38.6, dofs=xy),
        case("fan rig 38.6 deg five DOFs", fan, fan_load, 3.0, 38.6),
        case("fan rig 12.9 deg chord five DOFs", fan, {**FAN_RIG_LOAD, "fx": 40.0, "mx": 0.2},
             20.0, 12.9, edge="chord"),
        case("fan rig wide clearance", {**fan, "radial_clearance": 100e-6},
             {**FAN_RIG_LOAD, "fy": -3000.0}, 4.0, 12.9, edge="exact", dofs=xy),
        case("zero contact angle, axial load, clearance 50",
             {**fan, "radial_clearance": 50e-6}, {**NO_LOAD, "fy": -300.0, "fz": 900.0}, 4.0, 30.0),
        case("guard active and loaded", fan, {**NO_LOAD, "fy": -800.0, "fz": 25e3}, 4.0, 90.0,
             400.0),
        case("guard active and loaded, 15 deg", {**fan, "contact_angle": math.radians(15.0)},
             {**NO_LOAD, "fy": -800.0, "fz": -40e3, "mx": 20.0}, 9.0, 90.0, 400.0),
        case("three balls", {**ll, "n_balls": 3, "contact_angle": math.radians(20.0)},
             {**NO_LOAD, "fx": 20.0, "fy": -50.0, "fz": 300.0}, 10.0, 20.0, 2.0),
        case("five balls, 40 deg", {**ll, "n_balls": 5, "contact_angle": math.radians(40.0)},
             {**NO_LOAD, "fy": -300.0, "fz": 2500.0, "mx": 2.0}, 30.0, 50.0, 10.0, edge="exact"),
        case("thirty balls", {**ll, "n_balls": 30, "ball_diameter": 3.5e-3,
                              "contact_angle": math.radians(25.0)},
             {**general, "fy": -6000.0, "fz": 2000.0}, 1.0, 100.0, edge="chord"),
        case("thirty balls, 360 deg less a hair",
             {**ll, "n_balls": 30, "ball_diameter": 3.5e-3}, general, 1.0, 359.0, 15.0),
        case("heavy", ll, {**NO_LOAD, "fx": 4e3, "fy": -20e3, "fz": 9e3, "mx": 30.0, "my": 40.0},
             17.0, 45.0, 500.0, 285.0),
    ]  # fmt: skip
    return cases + edge_scenes() + random_scenes(12)


def edge_scenes() -> list[dict[str, Any]]:
    """A loaded ball a little way into either edge, each edge model on each race."""
    cases = []
    ratio = LIEW_LIM["ball_diameter"] * math.cos(LIEW_LIM["contact_angle"])
    turns = 2.0 / (1.0 - ratio / LIEW_LIM["pitch_diameter"])
    for race in ("outer", "inner"):
        for edge, into_deg in (("published", 0.9), ("chord", 0.45), ("exact", 0.5)):
            for side, cage_deg in ((-1.0, 13.0), (1.0, -400.0)):
                ball_deg = cage_deg % 30.0 + 240.0  # one of the twelve is there
                middle = ball_deg - side * (20.0 - into_deg)
                if race == "inner":
                    middle -= cage_deg * turns
                which = "lower" if side < 0.0 else "upper"
                name = f"{race} {edge}, ball {into_deg} deg into the {which} edge"
                cases.append(
                    case(name, LIEW_LIM, LIEW_LIM_LOAD, cage_deg, 40.0, 50.0, middle, race, edge)
                )
    return cases


def random_scenes(count: int) -> list[dict[str, Any]]:
    """Scenes drawn from a wide box with a fixed seed, loaded enough to have one answer."""
    rng = np.random.default_rng(20140101)
    cases = []
    for number in range(count):
        n_balls = int(rng.integers(5, 25))
        pitch = float(rng.uniform(25e-3, 120e-3))
        ball = float(rng.uniform(0.4, 0.8) * pitch * math.sin(math.pi / n_balls))
        bearing = {
            "n_balls": n_balls,
            "ball_diameter": ball,
            "pitch_diameter": pitch,
            "contact_angle": math.radians(float(rng.uniform(5.0, 40.0))),
            "groove_center_radius": float(pitch / 2 * rng.uniform(1.0, 1.03)),
            "groove_center_distance": float(ball * rng.uniform(0.02, 0.1)),
            "radial_clearance": float(rng.uniform(0.0, 30e-6)),
            "load_deflection_factor": float(10 ** rng.uniform(9.5, 10.5)),
            "outer_raceway_radius": pitch / 2 + ball / 2,
            "inner_raceway_radius": pitch / 2 - ball / 2,
        }
        axial = float(rng.uniform(300.0, 3000.0))
        tilt = 0.2 * axial * pitch
        load = {
            "fx": float(rng.uniform(-1, 1) * axial),
            "fy": float(rng.uniform(-1, 1) * axial),
            "fz": axial,
            "mx": float(rng.uniform(-1, 1) * tilt),
            "my": float(rng.uniform(-1, 1) * tilt),
        }
        cases.append(
            case(
                f"random {number}",
                bearing,
                load,
                float(rng.uniform(0.0, 360.0)),
                float(rng.uniform(0.0, 120.0)),
                float(rng.choice([5.0, 20.0, 50.0, 500.0])),
                float(rng.uniform(0.0, 360.0)),
                str(rng.choice(["outer", "inner"])),
                str(rng.choice(["published", "chord", "exact"])),
            )
        )
    return cases


if __name__ == "__main__":
    write(scenes(), "static_reference.json")
