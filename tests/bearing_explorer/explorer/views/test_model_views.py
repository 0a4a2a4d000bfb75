"""The editors' numbers, the free directions, and the warnings."""

import math
from xml.etree import ElementTree

import pytest
from bearing_explorer.explorer.views.bearing_editor import facts_of
from bearing_explorer.explorer.views.bearing_picture import bearing_picture

from bearingcore import presets


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
