"""The overview: what its sentence says is what the core gives, and only what matters is lively."""

import dataclasses
import re

import numpy as np
import pytest
from bearing_explorer.explorer.results.chain import Chain, Peak
from bearing_explorer.explorer.results.reasons import STIFF_WHERE_HELD
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import BEFORE, Reference
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views.model_editor import ModelEditor
from bearing_explorer.explorer.views.overview.change import LastChange
from bearing_explorer.explorer.views.overview.spectrum import BAND_NAME_WIDTH, named_bands
from bearing_explorer.explorer.views.overview.stiffness import (
    HIGH,
    WIDE,
    OverviewStiffness,
    cells_for,
    free_terms,
)
from bearing_explorer.explorer.views.overview.words import Cause, story
from bearing_explorer.explorer.views.stiffness import Stiffness
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import Scene, equilibrium, presets, scene_of
from bearingcore.model.scene import FREE_TILT_WORDS
from bearingcore.model.statics import STIFFNESS_TERMS

FAN_RIG = presets["fan-rig"]
LONGER = FAN_RIG.replace(extent=FAN_RIG.defect.extent + FAN_RIG.bearing.ball_spacing)


def told(now: Scene, before: Scene | None) -> str:
    return LastChange(PackedSource()).sentence(
        Results(now, before=before and Reference(before, BEFORE))
    )


def test_a_ball_spacing_longer() -> None:
    """Of numbers that `test_chain.py` holds against the core, for both scenes."""
    now, before = Results(LONGER).chain, Results(FAN_RIG).chain
    fall, rise = (now.stiffness[term] / before.stiffness[term] for term in ("k_yy", "k_xx"))
    (low, high), (low0, high0) = now.bands["y1"], before.bands["y1"]
    assert told(LONGER, FAN_RIG) == (
        "Defect longer by one ball spacing (12.9 → 38.61°): the balls beside the defect take over "
        f"the load, so k_yy falls by {100 * (1 - fall):.0f} % and k_xx rises by "
        f"{100 * (rise - 1):.0f} %. "
        f"Therefore y₁ sinks from {low0:.0f}–{high0:.0f} to {low:.0f}–{high:.0f} Hz "
        "and the spectrum's peak with it, "
        f"from {before.peaks['y'].frequency:.0f} to {now.peaks['y'].frequency:.0f} Hz."
    )
    assert now.off_line > before.off_line


def test_the_cause_is_that_of_the_change() -> None:
    """A larger load presses contacts harder, a longer defect moves the load, thrust loads more."""
    pressed = told(FAN_RIG.replace(fy=-300.0), FAN_RIG)
    assert "each contact is stiffer on average, so k_yy rises" in pressed
    assert "the load turns by 31°, so k_yy falls" in told(FAN_RIG.replace(fx=60.0), FAN_RIG)
    assert "more balls carry" in told(FAN_RIG.replace(fz=200.0), FAN_RIG)
    back = told(FAN_RIG, LONGER)
    assert "balls near the line of the load carry more of it, so k_yy rises" in back


ALL_AROUND = FAN_RIG.replace(extent=2.0 * np.pi)


@pytest.mark.parametrize(
    ("now", "before", "cause"),
    [
        # all around nothing is beside the defect; a groove that is less deep takes nothing away
        (ALL_AROUND.replace(depth=1e-9), ALL_AROUND, "load spreads to balls farther from its line"),
        (ALL_AROUND, FAN_RIG, "balls near the line of the load carry more of it, so k_xx falls"),
        # of other balls and contacts it is no cause where the loads lie
        *((scene_of(name), scene_of(former), "Another bearing: k_") for former, name in
          (("30206", "2206"), ("NU 208", "608"), ("2206", "1205"))),
    ],
)  # fmt: skip
def test_no_cause_that_works_the_other_way(now: Scene, before: Scene, cause: str) -> None:
    said = told(now, before)
    assert cause in said
    outwards, inwards = "(beside the defect|spreads)", "(gathers|carry more of it)"
    wrong = rf"{outwards}[^;.]*k_(yy rises|xx falls)|{inwards}[^;.]*k_(yy falls|xx rises)"
    assert not re.search(wrong, said), said


def test_a_change_of_bearing_is_one_cause_and_names_the_rotor_that_came_with_it() -> None:
    editor = SceneEditor("fan-rig")
    scenes = [editor.scene]
    for name in ("NU 208", "30206", "NJ 208", "6205"):
        assert editor.choose({"bearing": name}) == {}
        scenes.append(editor.scene)
        said = told(*reversed(scenes[-2:]))
        assert said.startswith("Another bearing: ")
        assert "(frequencies go with √(k/m): the rotor is " in said
        for part, mass in (("rotor", "inner_mass"), ("housing", "outer_mass")):
            now, before = (f"{getattr(scene.support, mass):.3g} kg" for scene in scenes[:-3:-1])
            assert f"the {part} is {now} instead of {before}" in said
    heavier = told(FAN_RIG.replace(inner_mass=9.0), FAN_RIG)
    assert heavier.startswith("Mass of the rotor")
    assert "instead of" not in heavier, "it is named once"


def test_only_what_really_changed_is_said() -> None:
    assert told(FAN_RIG.replace(depth=50.001e-6), FAN_RIG) == (
        "Depth (50 → 50.001 µm): nothing changes, as no ball is pressed against "
        "the floor of the defect at either depth."
    )
    shallow = FAN_RIG.replace(depth=1e-6)
    assert "hardly anything changes" in told(shallow.replace(depth=1.001e-6), shallow)
    heavier = told(FAN_RIG.replace(inner_mass=4.0), FAN_RIG)
    assert "y₁ sinks" in heavier
    assert "k_" not in heavier
    assert "load" not in heavier, "static answers do not depend on the mass"
    faster = told(FAN_RIG.replace(shaft_speed=2.0 * FAN_RIG.shaft_speed), FAN_RIG)
    assert not {"y₁", "k_yy", "load"} & set(re.split(r"\W+", faster)), "nor on the speed"
    assert "dB higher" in faster


def test_what_has_no_answer_is_said_too() -> None:
    loose = FAN_RIG.replace(fy=0.0)
    assert "there is no equilibrium any more (nothing touches" in told(loose, FAN_RIG)
    assert told(FAN_RIG, None).startswith("The balls beside the defect take over"), (
        "before the first change"
    )
    assert "now there is an equilibrium" in told(FAN_RIG, loose)
    still = told(FAN_RIG.replace(shaft_speed=0.0), FAN_RIG)
    assert still.endswith("there is no spectrum: nothing turns.")
    begun = told(FAN_RIG, FAN_RIG.replace(shaft_speed=0.0))
    assert begun.endswith("now there is a spectrum.")
    assert "hardly" not in begun


def test_contact_angle_and_clearance_are_told_as_the_play_that_they_make() -> None:
    both = FAN_RIG.replace(contact_angle=np.radians(5.0), radial_clearance=5e-6)
    words = told(both, FAN_RIG)
    of_angle = 2e9 * both.bearing.groove_center_distance * (1.0 - np.cos(np.radians(5.0)))
    assert "the play grows from 6 µm to 10 µm" in words
    assert f"({10 * round(of_angle / 10)} nm of it the contact angle, 10 µm the cl" in words


CHAIN = Chain(
    1.0, "", 0.5, -1.57, 40.0, 4.0, {"k_xx": 2e7, "k_yy": 4e7},
    {"x1": (365.0, 480.0), "y1": (615.0, 678.0), "y2": (1790.0, 1840.0)},
    {"x": Peak(448.0, -44.0, 32.0), "y": Peak(672.0, -22.0, 32.0)}, "",
)  # fmt: skip


def changed(**news: object) -> str:
    return story(Cause("So"), dataclasses.replace(CHAIN, **news), CHAIN)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("news", "words"),
    [
        ({}, "So: nothing changes."),
        ({"off_line": 0.53}, "So: load spreads to balls farther from its line."),
        ({"off_line": 0.6, "direction": -1.0}, "So: the load turns by 33°."),
        ({"greatest_load": 90.0}, "So: the greatest load of a ball rises to 2.2 times."),
        # under a diagonal load the lower mode may be named y₁ and the upper one x₁: not compared
        ({"stiffness": {"k_xx": 2e7, "k_yy": 3.6e7},
          "bands": {**CHAIN.bands, "x1": (642.0, 678.0), "y1": (295.0, 435.0)}},
         "So: balls push back more sideways (sin²φ 0.67 → 0.64) and each contact is softer on "
         "average, so k_yy falls by 10 %."),
        ({"stiffness": {"k_xx": 2e7, "k_yy": 3e7}},
         "So: balls push back more sideways (sin²φ 0.67 → 0.60) and each contact is softer on "
         "average, so k_yy falls by 25 %."),
        ({"stiffness": {"k_xx": 1.5e7, "k_yy": 3e7}, "loaded_balls": 3.0},
         "So: fewer balls carry (4 → 3), so k_yy falls by 25 %."),
        ({"bands": {**CHAIN.bands, "y1": (600.0, 690.0)}},
         "So: y₁ widens from 615–678 to 600–690 Hz."),
        # a peak goes with a band only where it lies in it, both times, and goes its way
        ({"bands": {**CHAIN.bands, "y1": (532.0, 616.0)},
          "peaks": {"y": Peak(576.0, -22.0, 32.0)}},
         "So: y₁ sinks from 615–678 to 532–616 Hz and the spectrum's peak with it, "
         "from 672 to 576 Hz."),
        ({"bands": {**CHAIN.bands, "y1": (532.0, 616.0)},
          "peaks": {"y": Peak(1088.0, -30.0, 32.0)}},
         "So: y₁ sinks from 615–678 to 532–616 Hz; the spectrum's peak along y moves "
         "from 672 to 1088 Hz, 8 dB lower."),
        ({"peaks": {"y": Peak(672.0, -19.0, 32.0)}},
         "So: the spectrum's peak at 672 Hz is 3 dB higher."),
        # next to almost nothing decibels say nothing
        ({"peaks": {"y": Peak(640.0, -76.0, 32.0)}},
         "So: hardly any vibration is left at 672 Hz."),
        ({"peaks": {}, "silent": "nothing turns"},
         "So: at rest hardly anything changes; there is no spectrum: nothing turns."),
        # what is said is not only what happens where the housing is loudest
        ({"peaks": {**CHAIN.peaks, "x": Peak(448.0, -34.0, 32.0)}},
         "So: the spectrum's peak along x at 448 Hz is 10 dB higher."),
        ({"answered": 0.75, "reason": "why"},
         "So: nothing changes; at 25 % of the cage angles there is no "
         "equilibrium (why)."),
    ],
)  # fmt: skip
def test_each_link_in_words(news: dict, words: str) -> None:
    assert changed(**news) == words


def test_a_ball_that_carries_more_is_no_cause_of_less_stiffness() -> None:
    softer = dataclasses.replace(
        CHAIN, greatest_load=60.0, stiffness={"k_xx": 1.8e7, "k_yy": 3.6e7}
    )
    assert story(Cause("So", defect=True), softer, CHAIN) == (
        "So: each contact is softer on average, so k_yy falls by 10 %."
    )
    none = dataclasses.replace(softer, stiffness={"k_xx": 1.8e7, "k_yy": 1e3})
    assert "k_yy falls to 0.0025 %" in story(Cause("So"), none, CHAIN)


def test_only_terms_that_matter_are_lively() -> None:
    view = OverviewStiffness(PackedSource())
    terms = view.data(Results(FAN_RIG, 0.1))[0]["overview_terms"]
    assert list(terms["term"]) == [0, 1, 5], "k_xx, k_xy and k_yy: the ring moves along x and y"
    assert terms["now"][2] == equilibrium(FAN_RIG, [0.1]).term("k_yy")[0]
    assert free_terms(("x", "y", "z")) == {"k_xx", "k_xy", "k_xz", "k_yy", "k_yz", "k_zz"}
    all_of = OverviewStiffness(PackedSource()).data(Results(presets["liew-lim"], 0.1))[0]
    assert len(all_of["overview_terms"]["term"]) > 10
    wide = {name: sources["overview_terms"]["right"][0] - sources["overview_terms"]["left"][0]
            for name, sources in (("few", {"overview_terms": terms}), ("all", all_of))}  # fmt: skip
    assert wide["few"] > 1.6 * wide["all"], "few terms are drawn larger"


@pytest.mark.parametrize("count", range(16))
def test_cells_of_terms_are_apart_and_inside(count: int) -> None:
    cells = cells_for(count)
    assert len(cells) == count
    assert all(0.0 < c.left < c.right < WIDE and -HIGH < c.bottom < c.top < 0.0 for c in cells)
    assert len({(c.left, c.top) for c in cells}) == count


def test_what_is_held_is_said_alike_on_all_tabs() -> None:
    def said(scene: Scene) -> list[str]:
        views = (OverviewStiffness, Stiffness, ModelEditor)
        return [view(PackedSource()).sentence(Results(scene)) for view in views]

    short, *full = said(FAN_RIG)
    needed = "Only x and y matter here"
    assert f"{needed}." in short
    why = f"{needed}: no load along the shaft, no moment. {STIFF_WHERE_HELD}"
    assert all(why in words for words in full)
    chosen = FAN_RIG.replace(dofs=("x", "y", "z"))
    assert all("θx and θy are held by choice." in words for words in said(chosen))
    rollers = "cylindrical rollers carry nothing along the shaft and resist no tilt"
    assert all(rollers in words for words in said(presets["nu208"])[1:])
    assert not any(STIFF_WHERE_HELD in words for words in said(presets["nu208"]))
    free = said(presets["liew-lim"])
    assert not any("are held" in words or needed in words for words in free)
    assert FREE_TILT_WORDS in free[-1]
    tilts_held = "θx and θy are held, as by the shaft's other bearing."
    assert all(tilts_held in words for words in said(presets["liew-lim"].replace(dofs=None)))


def test_no_rounding_noise_is_said() -> None:
    for name in ("fan-rig", "liew-lim", "3208"):
        words = OverviewStiffness(PackedSource()).sentence(Results(presets[name]))
        assert not re.search(r"\b[nµ]N|−\d", words), words


@pytest.mark.parametrize("name", ["liew-lim", "3208"])
def test_names_of_bands_in_a_line_are_apart(name: str) -> None:
    top = 3500.0
    named = named_bands(Results(presets[name], 0.0), top)
    for line in np.unique(named["line"]):
        own = named["line"] == line
        assert np.all(np.diff(named["name_at"][own]) >= 0.999 * BAND_NAME_WIDTH * top)
        assert np.all(np.abs(named["name_at"][own] - named["low"][own]) < 0.05 * top)


def test_a_lesson_compares_its_term_on_one_axis_from_zero():
    """Back to back and face to face: 13 times softer against tilt (lesson 12)."""
    view, k = Stiffness(PackedSource()), list(STIFFNESS_TERMS).index("k_rxrx")

    def limits(preset: str) -> tuple[float, float]:
        scene = presets[preset].replace(extent=0.0)
        cells = view.data(Results(scene, 0.0, lesson_term="k_rxrx"))[0]["stiffness_cells"]
        return float(cells["low"][k]), float(cells["high"][k])

    first = limits("7208-back-to-back")
    assert first[0] == 0.0 < 220e3 < first[1]
    assert limits("7208-face-to-face") == first
