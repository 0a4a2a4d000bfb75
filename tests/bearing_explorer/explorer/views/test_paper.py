"""The paper's figures: what is printed against what comes out, their layout and their links."""

import math
from types import SimpleNamespace

import pytest
from bearing_explorer import figures
from bearing_explorer.explorer.state.address import read
from bearing_explorer.explorer.views.paper import TAB_TITLES, PaperFigures
from bearing_explorer.explorer.views.paper_figures import FIGURES, PaperFigure
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.page import SECTIONS

from bearingcore import presets

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


def test_a_link_has_the_scene_the_other_curves_and_the_tab() -> None:
    figure = BY_NUMBER[4]
    place = read(figure.link)
    assert place is not None
    assert (place.tab, place.scene) == ("stiffness", figure.scenes[-1])
    assert [reference.scene for reference in place.compared] == figure.scenes[1:-1]
    assert [reference.name for reference in place.compared] == ["5°, 50 µm", "40°, 50 µm"]


def test_the_numbers_of_a_figure_are_had_outside_of_the_page() -> None:
    shown = figures.paper(presets["6205"], choices={"figure": 8})
    assert shown.table()["paper"][0] == "25.7°"
    assert "the tab Frequencies draws it" in shown.sentence
    with pytest.raises(ValueError, match="figure is 2"):
        figures.paper(presets["6205"], choices={"figure": 2})


def test_every_tab_of_a_figure_has_its_title() -> None:
    assert {figure.tab for figure in FIGURES} == set(TAB_TITLES)


def test_section_4_opens_the_signal_of_its_defect_on_the_diagnosis_tab() -> None:
    view = PaperFigures(PackedSource())
    opened: list[str] = []
    view.parts = SimpleNamespace(
        open_link=lambda _, link: opened.append(link), simulate=opened.append
    )
    view._size_a_defect()
    link, noise = opened
    place = read(link)
    assert place is not None
    assert (place.tab, noise) == ("diagnosis", "20")
    assert place.scene == presets["fan-rig"].replace(extent=math.radians(38.6))
