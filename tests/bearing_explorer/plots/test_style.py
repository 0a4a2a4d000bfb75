"""Angles in the house style."""

import math

from bearing_explorer.plots import style


def test_angles_lie_between_0_and_360() -> None:
    written = [style.in_degrees(math.radians(x)) for x in (257.14, -90.0, 359.99, 720.0, 12.5)]
    assert written == ["257.1°", "270°", "0°", "0°", "12.5°"]
