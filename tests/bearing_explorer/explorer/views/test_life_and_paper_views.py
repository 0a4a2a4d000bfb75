"""Life and the figures of the paper on the page: numbers of the core, or a sentence why none."""

import math

import numpy as np
import pytest
from bearing_explorer import figures
from bearing_explorer.explorer.results.endurance import LifeInputs, assume_usual_grooves, endurance
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.results.verdict import rows_of
from bearing_explorer.explorer.views.life import groups_of
from bearing_explorer.explorer.views.paper import TAB_TITLES
from bearing_explorer.explorer.views.paper_figures import FIGURES, PaperFigure
from bearing_explorer.page import SECTIONS

from bearingcore import Limit, contact_pressures, dynamic_load_rating, life, presets
from bearingcore.model.statics import state_of_limits


def facts(name: str, **given: float) -> dict[str, dict[str, str]]:
    groups = groups_of(Results(presets[name], life_inputs=LifeInputs(**given)))
    return {
        group.title: {fact.name: fact.value for fact in group.facts} | {"words": group.words}
        for group in groups
    }


def test_the_numbers_are_those_of_the_core() -> None:
    scene = presets["6205"]
    said = facts("6205")
    lasts = life(scene.healthy(), dynamic_load_rating(scene.bearing))
    healthy = said["Life of the healthy bearing"]
    assert "computed from the dimensions by ISO 281" in healthy["Dynamic load rating C<sub>r</sub>"]
    turns = number(healthy["Life L<sub>10r</sub>"])
    assert turns == pytest.approx(lasts.million_revolutions, rel=5e-3)
    hours = number(healthy["at the speed of the scene"])
    assert hours == pytest.approx(1e6 * lasts.million_revolutions / (1797.0 * 60.0), rel=5e-3)
    inner = float(said["Greatest contact pressure"]["Inner race"].split()[0])
    expected = contact_pressures(scene).inner.greatest_pressure
    assert inner == pytest.approx(expected / 1e9, rel=1e-2)
    assert "upper limit" in healthy["words"], "what the standard leaves out is said"
    damaged = life(scene, dynamic_load_rating(scene.bearing))
    assert f"{100.0 * damaged.share_of_healthy:.0f} % of that" in healthy["words"]


def test_the_default_bearing_has_an_answer_that_says_what_it_assumes() -> None:
    scene = presets["fan-rig"]
    assert not scene.bearing.knows_contacts
    answer = endurance(scene, LifeInputs())
    assert answer.healthy is not None
    assert answer.pressures is not None
    assert "Assumed" in facts("fan-rig")["Life of the healthy bearing"]["words"]
    usual = assume_usual_grooves(scene)
    assert usual is not None
    loads = [state_of_limits(one).ball_load for one in (scene, usual)]
    np.testing.assert_allclose(loads[1], loads[0], atol=1e-9)
    assert assume_usual_grooves(scene.replace(fz=10.0)) is None, "then the grooves change the loads"


def number(text: str) -> float:
    return float(text.split(" ")[0].replace("\u202f", ""))


def film_limit(inputs: LifeInputs) -> Limit:
    limits = Results(presets["nu208"], life_inputs=inputs).limits
    return next(limit for limit in limits if limit.name == "film parameter")


def test_the_limit_is_judged_by_an_oil_that_was_given_and_by_no_assumed_one() -> None:
    assumed = film_limit(LifeInputs())
    assert math.isnan(assumed.value)
    row = next(row for row in rows_of((assumed,)))
    assert row["state"] == "unknown"
    assert "under Life" in row["sentence"]
    assert film_limit(LifeInputs(viscosity=1e-3)).crossed
    assert not film_limit(LifeInputs(viscosity=1.0)).crossed
    rollers = facts("nu208")
    assert "profile of ISO 16281" in rollers["Life of the healthy bearing"]["words"]
    assert "assumed viscosity" in rollers["Oil film"]["words"]
    assert "assumed" not in facts("nu208", viscosity=1.0)["Oil film"]["words"]


@pytest.mark.parametrize("name", list(presets))
def test_every_preset_has_an_answer_or_a_sentence(name: str) -> None:
    unrated = endurance(presets[name], LifeInputs())
    for answer, words in (
        (unrated.life, unrated.no_life),
        (unrated.pressures, unrated.no_pressures),
        (unrated.film, unrated.no_film),
    ):
        assert (answer is None) == bool(words)
        assert words == "" or words.endswith(".")
    rated = endurance(presets[name], LifeInputs(dynamic_load_rating=40e3))
    if presets[name].bearing.knows_contacts:
        assert rated.life is not None
        assert math.isfinite(rated.life.million_revolutions)
        assert rated.pressures is not None


BY_NUMBER = {figure.number: figure for figure in FIGURES}


def ours(figure: int) -> dict[str, str]:
    """Our values by their names."""
    paper_figure = BY_NUMBER[figure]
    return {printed.name: printed.ours(paper_figure.scenes) for printed in paper_figure.printed}


def test_all_figures_from_3_to_10_are_there() -> None:
    assert [figure.number for figure in FIGURES] == list(range(3, 11))
    assert {figure.tab for figure in FIGURES} <= {section.name for section in SECTIONS}


@pytest.mark.parametrize("figure", FIGURES, ids=lambda figure: f"figure {figure.number}")
def test_each_has_the_sentence_of_the_model_and_every_value(figure: PaperFigure) -> None:
    assert figure.slip.endswith(".")
    assert all(value and "no value" not in value for value in ours(figure.number).values())


def test_the_numbers_of_a_figure_are_had_outside_of_the_page() -> None:
    shown = figures.paper(presets["6205"], choices={"figure": 8})
    assert shown.table()["paper"][0] == "25.7°"
    assert "the tab Frequencies draws it" in shown.sentence
    with pytest.raises(ValueError, match="figure is 2"):
        figures.paper(presets["6205"], choices={"figure": 2})


def test_every_tab_of_a_figure_has_its_title() -> None:
    assert {figure.tab for figure in FIGURES} == set(TAB_TITLES)
