"""The status line and the sentences of the views say the same of a scene without an equilibrium."""

from dataclasses import replace

import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.results.verdict import rows_of
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.explorer.views.life import LifeOfBearing, groups_of
from bearing_explorer.explorer.views.load_distribution import LoadDistribution
from bearing_explorer.explorer.views.modes import NaturalFrequencies
from bearing_explorer.kit.pictures import picture_of
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.widgets.limits import judged

import bearingcore
from bearingcore import Load, Scene, limits, presets, simulate

CONE = presets["30206-back-to-back"].bearing.replace(rows=())
RIG = presets["nu208"].healthy()
SHOWN = frozenset({"equilibrium", "now", "endurance", "motion"})


def cone(fy: float, fz: float, dofs: tuple[str, ...] | None) -> Results:
    load = Load(0.0, fy, fz)
    return Results(Scene(CONE, RIG.defect, load, RIG.shaft_speed, RIG.support, dofs=dofs), 0.1)


@pytest.mark.parametrize(
    ("fy", "fz", "dofs", "missing"),
    [
        (-4000.0, 4000.0, ("x", "y", "z", "rx", "ry"), "tilts that are held"),
        (0.0, -500.0, None, "500 N press the inner ring out"),
        (-4000.0, 500.0, ("x", "y", "z"), "more axial load"),
    ],
)
def test_nothing_is_called_converged_where_a_cone_leaves_its_cup(
    fy: float, fz: float, dofs: tuple[str, ...] | None, missing: str
) -> None:
    results = cone(fy, fz, dofs)
    for shown in (frozenset({"equilibrium"}), SHOWN):
        line = results.status(0.01, shown)
        assert line["mood"] == "bad"
        assert line["words"].startswith("No answer: no contact can carry this load")
        assert missing in line["words"]
        assert "onverged" not in " ".join([line["words"], *line["details"]])
    for kind in (LoadDistribution, NaturalFrequencies):
        assert missing in kind(PackedSource()).sentence(results)
    facts = {fact.name: fact.value for group in groups_of(results) for fact in group.facts}
    assert facts["Life L<sub>10r</sub>"] == "not known"
    assert facts["at the speed of the scene"] == "not known"
    assert missing in " ".join(group.words for group in groups_of(results))
    assert missing in LifeOfBearing(PackedSource()).sentence(results)


def test_no_equilibrium_between_the_cage_angles_of_the_curves_is_seen_too() -> None:
    results = cone(-4000.0, 4000.0, ("x", "y", "z"))
    assert results.verdict(SHOWN - {"motion"}).words == "Computed without problems"
    lost = cone(-4000.0, 500.0, ("x", "y", "z"))
    results.__dict__["now"] = lost.now
    said = results.verdict(frozenset({"now"}))
    assert said.mood == "bad"
    assert said.words.startswith("No answer at this cage angle: no contact")


def test_too_little_thrust_stands_first_among_the_limits() -> None:
    first = rows_of(limits(cone(-4000.0, 1100.0, ("x", "y", "z")).scene))[0]
    assert first["state"] == "crossed"
    assert first["sentence"].startswith("The axial load is below the one it induces (1.26 kN)")


def test_no_equilibrium_at_a_place_that_only_the_change_looks_at_is_seen_too() -> None:
    results = cone(-4000.0, 4000.0, ("x", "y", "z"))
    results.__dict__["chain"] = replace(results.chain, answered=0.75, reason="nothing touches")
    said = results.verdict(frozenset({"chain"}))
    assert said == ("bad", "No answer at 25 % of the cage angles: nothing touches")


def test_a_card_that_cannot_be_shown_is_in_the_status() -> None:
    class Refused(NaturalFrequencies):
        def sentence(self, results: Results) -> str:
            raise ValueError("no steel is known")

    results = cone(-4000.0, 4000.0, ("x", "y", "z"))
    for kind, words in ((NaturalFrequencies, "Computed without problems"),
                        (Refused, "Not all can be shown")):  # fmt: skip
        assert picture_of(results, [kind(PackedSource())]).status["words"] == words


def test_the_status_line_says_what_happened() -> None:
    good = Results(presets["fan-rig"]).status(0.0123)
    assert (good["mood"], good["words"]) == ("good", "Computed without problems")
    assert good["details"][1:] == [
        "2 degrees of freedom: x y",
        "361 cage angles",
        "12.3 ms of computing",
    ]
    assert "residual at most" in good["details"][0]
    bad = Results(presets["fan-rig"].replace(fy=0.0)).status(0.001)
    assert bad["mood"] == "bad"
    assert "nothing touches" in bad["words"]
    kept, crossed = (
        rows_of(Results(presets["fan-rig"].replace(fy=fy)).limits) for fy in (-100.0, -2e4)
    )
    assert judged(good, kept) == good
    warned = judged(good, crossed)
    assert (warned["mood"], warned["words"]) == ("warn", "Computed, limits exceeded")
    assert judged(bad, crossed) == bad


def test_a_motion_that_breaks_off_is_not_converged(monkeypatch: pytest.MonkeyPatch) -> None:
    broken = simulate(presets["fan-rig"], 0.2, step_rate=1024.0)
    monkeypatch.setattr(bearingcore, "simulate", lambda *_, **__: broken)
    results = Results(presets["fan-rig"], settings=Settings(duration=0.2))
    line = results.status(0.0, frozenset({"motion"}))
    assert line["mood"] == "bad"
    assert "diverged after" in line["words"]
