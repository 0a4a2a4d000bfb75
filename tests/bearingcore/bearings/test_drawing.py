"""Bearings from drawings: contact angle and clearance are one freedom, impossible ones refused."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from bearingcore import Bearing, Defect, Load, Scene, equilibrium, presets
from bearingcore.bearings._drawing import WIDEST_CONFORMITY

D_B, D_P = 9.525e-3, 46e-3
DRAWING: dict[str, Any] = {
    "n_balls": 9,
    "ball_diameter": D_B,
    "pitch_diameter": D_P,
    "inner_groove_radius": 0.52 * D_B,
    "outer_groove_radius": 0.53 * D_B,
}
A0 = 0.05 * D_B
PLAY = 40e-6
ALL = ("x", "y", "z", "rx", "ry")
ANGLES = np.linspace(0.0, 2.0 * math.pi / 9.0, 13)


def scene_of(bearing: Bearing, load: Load, defect: Defect | None = None) -> Scene:
    return Scene(bearing, defect or Defect.none(), load, 100.0, presets["fan-rig"].support)


@pytest.mark.parametrize(("angle", "play"), [(None, PLAY), (0.4, None), (0.4, PLAY)])
def test_the_clearance_lies_on_top_of_the_angle(angle: float | None, play: float | None) -> None:
    freedoms = {"contact_angle": angle, "diametral_clearance": play}
    bearing = Bearing.from_drawing(**DRAWING, **freedoms)
    angle, play = angle or 0.0, play or 0.0
    assert (bearing.contact_angle, bearing.radial_clearance) == (angle, play / 2)
    cosine = math.cos(angle) - play / 2 / A0
    assert math.cos(bearing.free_contact_angle) == pytest.approx(cosine, rel=1e-13)
    assert bearing.diametral_play == pytest.approx(2.0 * A0 * (1.0 - cosine), rel=1e-13)


@pytest.mark.parametrize("angle_deg", [0.0, 20.0])
def test_play_is_how_far_the_ring_moves_sideways(angle_deg: float) -> None:
    """One ball under a radial load pulls the grooves opposite each other by itself.

    The ring then stands half the play beside the middle, and what the ball gives way further.
    """
    drawing = {**DRAWING, "n_balls": 1, "contact_angle": math.radians(angle_deg)}
    bearing = Bearing.from_drawing(**drawing, diametral_clearance=PLAY)
    load = 100.0
    state = equilibrium(scene_of(bearing, Load(fy=-load)), [math.radians(270.0)], ("y", "z"))
    assert state.converged[0]
    _, y, z, _, _ = state.displacement[0]
    pressed = (load / bearing.load_deflection_factor) ** (2.0 / 3.0)
    assert -y == pytest.approx(0.5 * bearing.diametral_play + pressed, rel=1e-9)
    assert -z == pytest.approx(A0 * math.sin(bearing.contact_angle), rel=1e-9, abs=1e-15)


def test_a_tiny_clearance_keeps_its_angle() -> None:
    """1 − cos of a small angle must not cancel: α_f → √(s/A0)."""
    bearing = Bearing.from_drawing(**DRAWING, diametral_clearance=1e-15)
    assert bearing.free_contact_angle == pytest.approx(math.sqrt(1e-15 / A0), rel=1e-9)


LOADS = [
    pytest.param(Load(fy=-2000.0, fz=800.0), id="radial and axial"),
    pytest.param(Load(fx=300.0, fy=-1500.0, fz=900.0, mx=4.0, my=-2.0), id="all"),
    pytest.param(Load(fy=-500.0, fz=-900.0), id="thrust the other way"),
    pytest.param(Load(fy=-2000.0, fz=5.0), id="nearly radial"),
    pytest.param(Load(fz=700.0, my=6.0), id="thrust and moment"),
]


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("play", [10e-6, PLAY, 200e-6])
def test_clearance_and_free_angle_are_one_bearing(load: Load, play: float) -> None:
    """(α0 = 0, clearance) and (free angle, none): alike but for the axial origin A0 sin α_f."""
    flat = Bearing.from_drawing(**DRAWING, diametral_clearance=play)
    seated = dataclasses.replace(flat, contact_angle=flat.free_contact_angle, radial_clearance=0.0)
    assert seated.contact_angle > 0.0
    drawn = equilibrium(scene_of(flat, load), ANGLES, ALL)
    other = equilibrium(scene_of(seated, load), ANGLES, ALL)
    assert drawn.converged.all()
    assert other.converged.all()
    heaviest = drawn.ball_load.max()
    assert np.abs(drawn.ball_load - other.ball_load).max() < 1e-8 * heaviest
    shift = np.array([0.0, 0.0, A0 * math.sin(seated.contact_angle), 0.0, 0.0])
    lever = np.array([1.0, 1.0, 1.0, flat.groove_center_radius, flat.groove_center_radius])
    off = np.abs((drawn.displacement - shift - other.displacement) * lever)
    assert off.max() < 1e-13  # m
    diagonal = np.abs(np.diagonal(drawn.stiffness, axis1=1, axis2=2)).max(axis=0)
    scale = np.sqrt(np.outer(diagonal, diagonal))
    assert (np.abs(drawn.stiffness - other.stiffness) / scale).max() < 1e-7
    same = drawn.ball_load > 1e-6 * heaviest
    assert np.abs(drawn.contact_angle - other.contact_angle)[same].max() < 1e-7


CHANGES: list[dict[str, Any]] = [
    {"ball_diameter": 9.3e-3},
    {"pitch_diameter": 50e-3},
    {"contact_angle": 0.5},
    {"inner_groove_radius": 0.515 * D_B, "poisson": 0.28},
    {"youngs_modulus": 200e9},
    {"n_balls": 7},
]


@pytest.mark.parametrize("changes", CHANGES, ids=[" ".join(change) for change in CHANGES])
def test_a_changed_dimension_redraws_the_bearing(changes: dict[str, Any]) -> None:
    bearing = Bearing.from_drawing(**DRAWING, contact_angle=0.2)
    expected = Bearing.from_drawing(**{**DRAWING, "contact_angle": 0.2, **changes})
    scene = scene_of(bearing, Load(fy=-100.0, fz=50.0))
    assert scene.replace(**changes).bearing == expected


def test_a_number_set_apart_from_the_drawing_stays_in_proportion() -> None:
    bearing = Bearing.from_drawing(
        **DRAWING, contact_angle=0.0, groove_center_radius=0.5 * D_P
    ).replace(load_deflection_factor=1e10)
    same = bearing.replace(n_balls=8)
    assert same.groove_center_radius == 0.5 * D_P
    assert same.load_deflection_factor == 1e10
    softer = bearing.replace(youngs_modulus=105e9)
    assert softer.load_deflection_factor == pytest.approx(5e9)
    assert softer.groove_center_radius == 0.5 * D_P


def test_a_bearing_without_a_drawing_changes_field_by_field() -> None:
    bearing = presets["fan-rig"].bearing
    assert not bearing.is_drawn
    changed = bearing.replace(ball_diameter=7e-3)
    assert changed == dataclasses.replace(bearing, ball_diameter=7e-3)
    with pytest.raises(ValueError, match="inner_groove_radius is None"):
        bearing.race_contact("inner")


IMPOSSIBLE: list[tuple[dict[str, Any], str]] = [
    ({"inner_groove_radius": 0.5 * D_B}, r"inner_groove_radius is 0.0047625; .*above 0.0047625"),
    ({"outer_groove_radius": 4.7e-3}, r"outer_groove_radius is 0.0047; .*above 0.0047625"),
    (
        {"outer_groove_radius": 1.01 * WIDEST_CONFORMITY * D_B},
        r"outer_groove_radius is 0.0057\d*; .*at most 0.005715",
    ),
    ({"n_balls": 16}, r"n_balls is 16; .*balls of 0.009525 m do not overlap .*at most 15"),
    ({"ball_diameter": 47e-3}, r"pitch_diameter is 0.046; .*above 0.047"),
    ({"contact_angle": math.radians(81.0)}, r"contact_angle is 1.41372; .*80 degrees"),
    ({"contact_angle": None, "diametral_clearance": 0.9e-3}, r"diametral_clearance is 0.0009; "),
    ({"diametral_clearance": -1.0}, r"diametral_clearance is -1; .*at least -0"),
    ({"poisson": 0.5}, r"poisson is 0.5; .*below 0.5"),
    ({"groove_center_radius": -1.0}, r"groove_center_radius is -1; "),
]


@pytest.mark.parametrize(("changes", "said"), IMPOSSIBLE, ids=[said for _, said in IMPOSSIBLE])
def test_impossible_drawings_are_refused_with_the_numbers(
    changes: dict[str, Any], said: str
) -> None:
    good = {**DRAWING, "contact_angle": 0.3}
    Bearing.from_drawing(**good)
    with pytest.raises(ValueError, match=said):
        Bearing.from_drawing(**{**good, **changes})


def test_the_largest_clearance_ends_at_80_degrees() -> None:
    most = 2.0 * A0 * (1.0 - math.cos(math.radians(80.0)))
    bearing = Bearing.from_drawing(**DRAWING, diametral_clearance=0.999999 * most)
    assert math.degrees(bearing.free_contact_angle) == pytest.approx(80.0, abs=1e-3)
    with pytest.raises(ValueError, match="free contact angle above 80 degrees"):
        Bearing.from_drawing(**DRAWING, diametral_clearance=1.000001 * most)
