"""The editors' numbers, the comparison of directions, and the warnings."""

import math
from xml.etree import ElementTree

import numpy as np
import pytest
from bearing_explorer.results.dof_comparison import other_dofs, spectrum_differences
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.settings import Settings
from bearing_explorer.views.bearing_editor import BearingEditor, facts_of
from bearing_explorer.views.bearing_picture import bearing_picture
from bearing_explorer.views.dof_comparison import DofDifferences
from bearing_explorer.views.dof_comparison import facts_of as differences_of
from bearing_explorer.views.model_editor import ModelEditor
from bearing_explorer.widgets.limits import rows_of

from bearingcore import DOF_NAMES, Spectrum, presets

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


def test_the_picture_is_drawn_from_the_bearing() -> None:
    view = BearingEditor(PackedSource())
    view.say(Results(presets["6205"]), "")
    drawn = view.rows.picture
    assert drawn == bearing_picture(presets["6205"].bearing)
    view.say(None, "Not shown.")
    assert view.rows.picture == drawn, "the last good picture stays"


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


def test_the_automatic_damping_is_shown_and_a_given_one_said() -> None:
    view = ModelEditor(PackedSource())
    results = Results(presets["fan-rig"])
    view.say(results, "")
    assert float(view.rows.automatic) == pytest.approx(results.contact_damping, rel=1e-3)
    assert "from its stiffness" in view.sentence(results)
    given = Results(presets["fan-rig"].replace(contact_damping=77.0))
    assert "77 N·s/m, given" in view.sentence(given)


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


def test_all_directions_leave_nothing_out() -> None:
    full = presets["liew-lim"].replace(mx=1.0)
    assert other_dofs(full) == full.needed_dofs == DOF_NAMES
    results = Results(full)
    assert differences_of(results.dof_comparison) == []
    assert "nothing left out" in DofDifferences(PackedSource()).sentence(results)


def test_a_motion_that_cannot_be_simulated_is_said() -> None:
    scene = presets["fan-rig"].replace(stiffness_z=None)
    found = Results(scene, settings=SHORT).dof_comparison
    assert found.motion == {}
    assert "stiffness_z" in found.no_motion
    assert any("none:" in fact.value for fact in differences_of(found))


def test_levels_are_compared_where_they_are_heard() -> None:
    frequency = np.arange(4.0)
    loud = Spectrum(frequency, np.array([1.0, 1e-2, 1e-9, 0.0]))
    other = Spectrum(frequency, np.array([1.0, 1e-3, 1.0e-9 * 100, 5.0]))
    assert spectrum_differences({"x": loud}, {"x": loud}) == {"x": 0.0}
    assert spectrum_differences({"x": other}, {"x": loud})["x"] == pytest.approx(10.0)
    assert spectrum_differences({"x": loud}, {"y": loud}) == {}


def test_limits_that_are_crossed_come_first_with_their_number() -> None:
    calm = rows_of(Results(presets["6205"]).limits)
    assert {row["state"] for row in calm} == {"kept", "unknown"}  # no motion was simulated
    names = [row["name"] for row in calm]
    assert "time steps in a defect" in names
    heavy = rows_of(Results(presets["6205"].replace(fy=-20000.0)).limits)
    assert heavy[0]["state"] == "crossed"
    pressed = next(row for row in heavy if row["name"] == "contact pressure, inner race")
    assert pressed["state"] == "crossed"
    assert pressed["limit"] == "4.2 GPa"
    assert pressed["value"].replace(" GPa", "") in pressed["sentence"]
    unknown = rows_of(Results(presets["fan-rig"]).limits)
    assert any(row["state"] == "unknown" and row["value"] == "not known" for row in unknown)
