"""Stiffness against the closed form of rotor dynamics, without clearance, by Palmgren's law."""

import math

import numpy as np
import pytest

from bearingcore import Scene, equilibrium, presets
from tests.benchmarks import charts, rotor_bearings
from tests.benchmarks.rotor_bearings import RATIOS, friswell, mean_stiffness, radially_loaded
from tests.outside.witness import witness

PALMGREN = 4.36e-8
"""[m (m/N²)^(1/3)] Palmgren: between races a ball of d [m] yields by 4.36e-8 Q^(2/3) / d^(1/3)."""


def scene_without_clearance(n_balls: int, diameter: float, load: float, angle: float) -> Scene:
    """Return a scene of the closed form: Palmgren's balls, no clearance, distant grooves."""
    return radially_loaded("fan-rig", load).replace(
        n_balls=n_balls,
        ball_diameter=diameter,
        contact_angle=angle,
        load_deflection_factor=PALMGREN**-1.5 * math.sqrt(diameter),
        radial_clearance=0.0,
        pitch_diameter=20.0 * diameter,
        groove_center_distance=0.8 * diameter,
        dofs=("x", "y"),
    )


@witness(
    "ball bearing: stiffness",
    by="closed form of ROSS (Friswell and others, 2010, page 184)",
    compared="k_yy of 24 bearings",
    within=0.02,
)
@pytest.mark.parametrize("n_balls", [8, 12, 16])
@pytest.mark.parametrize("diameter", [6e-3, 12e-3])
@pytest.mark.parametrize("load", [100.0, 1000.0])
@pytest.mark.parametrize("angle", [0.0, math.radians(25.0)])
def test_along_the_load_it_is_the_closed_form(
    n_balls: int, diameter: float, load: float, angle: float
) -> None:
    """13e6 is 12.87e6 rounded: Palmgren's law, and Stribeck's 4.37 without clearance."""
    _, along, _ = mean_stiffness(scene_without_clearance(n_balls, diameter, load, angle))
    assert along == pytest.approx(friswell(n_balls, diameter, load, angle)[1], rel=0.02)


def test_across_the_load_eight_balls_with_one_below_are_the_printed_ratio() -> None:
    state = equilibrium(scene_without_clearance(8, 8e-3, 1000.0, 0.0), [0.0])
    assert state.ball_load.argmax() == 6, "a ball is right below"
    assert state.term("k_xx") / state.term("k_yy") == pytest.approx(RATIOS[8], abs=0.005)


def test_across_the_load_many_balls_are_two_thirds() -> None:
    """2/3 is the ratio of the integrals of cos^(1/2) sin² and cos^(5/2) over the half circle."""
    across, along, loaded = mean_stiffness(scene_without_clearance(60, 4e-3, 1000.0, 0.0))
    assert across / along == pytest.approx(2.0 / 3.0, rel=1e-3)
    assert loaded == pytest.approx(30.0, abs=0.6)


def test_the_table_of_the_document_has_the_computed_numbers() -> None:
    text = charts.DOCUMENT.read_text(encoding="utf-8")
    assert rotor_bearings.document(text) == text
    assert presets["6205"].bearing.n_balls == 9


def test_ross_has_the_same_closed_form() -> None:
    ross = pytest.importorskip("ross")
    for n_balls in (8, 9, 14):
        element = ross.BallBearingElement(
            n=0, n_balls=n_balls, d_balls=8e-3, fs=1000.0, alpha=math.radians(10.0)
        )
        across, along = friswell(n_balls, 8e-3, 1000.0, math.radians(10.0))
        assert np.diag(element.K(0.0))[:2] == pytest.approx([across, along], rel=1e-9)
