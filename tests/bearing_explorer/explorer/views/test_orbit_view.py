"""The steady orbit on the page: drawn as found, told in words, never made up."""

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.results.verdict import orbit_verdict
from bearing_explorer.explorer.views.orbit import SteadyOrbit, marched_path, orbit_path
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import presets

RIG = presets["fan-rig"].replace(contact_damping=130.0)
INNER = RIG.replace(race="inner")


def test_a_stable_orbit_is_what_the_marched_motion_settles_to() -> None:
    results = Results(RIG)
    path, marched = orbit_path(results), marched_path(results)
    for dof in ("x", "y"):
        assert path[dof][0] == pytest.approx(path[dof][-1], abs=1e-9)
        assert np.ptp(path[dof]) == pytest.approx(np.ptp(marched[dof]), rel=0.01)
    assert SteadyOrbit(PackedSource()).sentence(results).startswith("Periodic with each ball pass")


def test_an_inner_race_defect_is_marched_and_it_is_said() -> None:
    view = SteadyOrbit(PackedSource())
    results = Results(INNER)
    assert results.orbit is None
    sources, _ = view.data(results)
    assert sources["orbit_path"]["x"].size == 0
    assert sources["orbit_marched"]["x"].size > 100
    assert f"only after {results.ball_passes} ball passes" in view.sentence(results)
    assert orbit_verdict(results.orbit, results.moving)[0] == "bad"


def test_a_race_that_never_comes_round_has_no_orbit() -> None:
    results = Results(presets["liew-lim"].replace(race="inner"))
    assert results.ball_passes is None
    assert orbit_verdict(results.orbit, results.moving)[1] == "No common period"
    assert "have no common period" in SteadyOrbit(PackedSource()).sentence(results)


def test_an_unbalance_turns_with_the_shaft_and_is_named() -> None:
    words = SteadyOrbit(PackedSource()).sentence(Results(RIG.replace(unbalance=1e-4)))
    assert words.startswith("With an unbalance, which turns with the shaft,")
    assert "inner race" not in words
