"""The editors' numbers, the comparison of directions, and the warnings."""

import math
from xml.etree import ElementTree

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.explorer.views.bearing_editor import facts_of
from bearing_explorer.explorer.views.bearing_picture import bearing_picture
from bearing_explorer.explorer.views.dof_comparison import DofDifferences
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import DOF_NAMES, presets

SHORT = Settings(duration=0.3)


def facts(name: str, **changes: float) -> dict[str, str]:
    return {fact["symbol"]: fact["value"] for fact in facts_of(presets[name].replace(**changes))}


def test_clearance_and_contact_angle_stand_for_one_another() -> None:
    tight = facts("fan-rig")
    assert tight["s"] == "6 µm"
    assert float(tight["α<sub>f</sub>"][:-1]) == pytest.approx(
        math.degrees(math.acos(1.0 - 3.0 / 50.0)), abs=0.01
    )
    assert "slips through" in facts("fan-rig", radial_clearance=60e-6)["α<sub>f</sub>"]


@pytest.mark.parametrize("name", list(presets))
def test_the_picture_shows_what_a_kind_of_bearing_is_given_by(name: str) -> None:
    """Well-formed, all balls in front, and arrows for no more than there are controls."""
    bearing = presets[name].bearing
    drawn = ElementTree.fromstring(bearing_picture(bearing))
    groups = {group.get("data-name"): group for group in drawn.findall("g")}
    assert len(groups["n_balls"].findall("circle")) == bearing.n_balls
    assert ("inner_groove_radius_mm" in groups) == bearing.is_drawn
    assert ("roller_length_mm" in groups) == (bearing.kind.element == "roller")
    assert ("row_distance_mm" in groups) == (len(bearing.rows) == 2)
    assert "nan" not in bearing_picture(bearing)


def test_an_exact_reduction_changes_nothing() -> None:
    results = Results(presets["fan-rig"], settings=SHORT)
    found = results.dof_comparison
    assert (found.chosen, found.other) == (("x", "y"), DOF_NAMES)
    assert max(found.static.values()) < 1e-9
    assert max(found.motion.values()) < 0.05
    assert "as the scene needs" in DofDifferences(PackedSource()).sentence(results)


def test_a_forced_set_shows_its_error() -> None:
    scene = presets["liew-lim"].replace(dofs=("x", "y"))
    results = Results(scene, settings=SHORT)
    found = results.dof_comparison
    assert found.other == scene.needed_dofs
    forced, free = Results(scene).equilibrium, Results(scene.replace(dofs=None)).equilibrium
    expected = np.abs(forced.term("k_yy") - free.term("k_yy")).max() / free.term("k_yy").max()
    assert found.static["k_yy"] == pytest.approx(expected)
    assert expected > 0.01
    words = DofDifferences(PackedSource()).sentence(results)
    assert "forced on the scene" in words
    assert "%" in words
