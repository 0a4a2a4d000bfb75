"""Displacement and stiffness on the page, recomputed without the solver."""

import math

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.displacement import Displacement, OperatingPoint
from bearing_explorer.kit.serve.packed_source import PackedSource
from scipy.optimize import brentq

from bearingcore import presets, scene_of
from bearingcore.model.scene import FREE_TILT_WORDS

RIG = presets["fan-rig"].healthy()


def drop(force: float) -> float:
    """Displacement [m] downwards of the rig's ring, a ball at 270°, under a force [N]: Eq. 13."""
    bearing = RIG.bearing
    phi = 2.0 * math.pi * np.arange(bearing.n_balls) / bearing.n_balls

    def carried(y: float) -> float:
        pressed = np.maximum(y * np.cos(phi) - bearing.radial_clearance, 0.0)
        return float((bearing.load_deflection_factor * pressed**1.5 * np.cos(phi)).sum())

    return brentq(lambda y: carried(y) - force, 0.0, 1e-3, xtol=1e-16)


def test_displacement_and_stiffness_are_those_of_the_force_balance() -> None:
    spacing = 2.0 * math.pi / RIG.bearing.n_balls
    results = Results(RIG, (1.5 * math.pi) % spacing)
    moved = Displacement(PackedSource()).table(results)
    assert moved["y_um"][0] == pytest.approx(-1e6 * drop(100.0), rel=1e-6)
    assert moved["y_um"][1] <= moved["y_um"][2] <= moved["y_um"][3]
    table = OperatingPoint(PackedSource()).table(results)
    now = (table["when"] == "at this cage angle") & (table["load"] == "fy [N]")
    shown = Displacement(PackedSource()).html(results)
    assert shown.count(">0<") >= 12
    assert "·10" not in shown, "beyond the digits of the largest"
    slope = 0.02 / (drop(100.01) - drop(99.99))
    assert table["per_m_y"][now] == pytest.approx(slope, rel=1e-4)
    assert table["displacement_in_si"][now] == pytest.approx(-drop(100.0), rel=1e-6)


def test_directions_that_are_held_or_free_are_said() -> None:
    results = Results(scene_of("7208 B"))
    view = Displacement(PackedSource())
    assert "Tilt is held" in view.sentence(results)
    free = Results(results.scene.replace(dofs="tilt free", fz=6000.0))
    assert FREE_TILT_WORDS in OperatingPoint(PackedSource()).sentence(free)
    unloaded = Results(RIG.replace(fy=0.0))
    assert view.sentence(unloaded).startswith("No displacement: ")
    assert "not known" in view.html(unloaded)
