"""What a support lacks is named all at once, with a way to do without it."""

import re

import pytest

from bearingcore import Support, frequency_bands, modes, scene_of, simulate

RADIAL = Support(2.0, 2.0, 2e8, 2e8, 1e3, 1e3)
"""A rotor and a housing without numbers along the shaft and against tilt."""
SCENE = scene_of("6205").replace(support=RADIAL, fz=200.0, dofs="tilt free")


@pytest.mark.parametrize("solve", [modes, frequency_bands, lambda scene: simulate(scene, 0.1)])
def test_a_load_along_the_shaft_says_all_that_it_needs_and_what_can_be_had(solve) -> None:
    with pytest.raises(ValueError, match="is among the free directions") as refused:
        solve(SCENE)
    words = str(refused.value)
    named = re.search(r"Give (.*) of the support, or scene\.replace\(dofs=\('x', 'y'\)\)", words)
    assert named is not None, words
    lacking = named[1].split(", ")
    assert sorted(lacking) == sorted(name for name, value in vars(RADIAL).items() if value is None)
    held = solve(SCENE.replace(dofs=("x", "y")))
    assert held is not None
    given = {name: 1e8 if name.startswith("stiffness") else 0.01 for name in lacking}
    assert solve(SCENE.replace(**given)) is not None
