"""The overview and the reasons: what sentences say is what the core gives, of that scene."""

import dataclasses
import math
import re
from functools import cache

import numpy as np
import pytest
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.chain import Chain, Peak
from bearing_explorer.explorer.results.reasons import STIFF_WHERE_HELD
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import BEFORE, Reference
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views.bearing import BearingDrawing
from bearing_explorer.explorer.views.load_distribution import LoadDistribution
from bearing_explorer.explorer.views.model_editor import ModelEditor
from bearing_explorer.explorer.views.modes import NaturalFrequencies
from bearing_explorer.explorer.views.overview.bearing import OverviewBearing
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
from bearing_explorer.explorer.views.vibration_spectrum import VibrationSpectra, why_words
from bearing_explorer.explorer.views.vibration_time import VibrationInTime
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import (
    DOF_NAMES,
    STIFFNESS_TERMS,
    Scene,
    equilibrium,
    modes,
    presets,
    scene_of,
    simulate,
    spectrum,
)
from bearingcore.model.scene import FREE_TILT_WORDS

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


def test_a_term_without_an_answer_is_not_zero_by_symmetry() -> None:
    """Without a contact angle x and y are not coupled to the other three directions."""
    view = Stiffness(PackedSource())
    for scene, count in ((FAN_RIG, 6), (FAN_RIG.replace(fy=0.0), 0)):
        assert view.data(Results(scene))[0]["stiffness_cells"]["flat"].sum() == count


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


RIG = presets["fan-rig"]
SIDEWAYS = RIG.replace(fx=100.0, fy=0.0)
"""The load passes by the defect, which is below."""
FAST = RIG.replace(shaft_speed=60.0 * math.pi)
UNDER = 3.0 * math.pi / 2.0 - RIG.bearing.ball_spacing * 10
"""Cage angle with ball 11 at the bottom."""


@cache
def of(scene: Scene) -> Results:
    return Results(scene, UNDER)


def test_a_ball_in_the_defect_leaves_its_load_to_those_beside_it() -> None:
    words = BearingDrawing(PackedSource()).sentence
    load = equilibrium(RIG, [UNDER]).ball_load[0]
    assert load[10] == 0.0
    assert words(of(RIG)).startswith(
        f"Balls 10 and 12 carry most, {load[9]:.3g} N each: ball 11, nearer the line of the load, "
        "lies in the defect and carries nothing."
    )
    assert "Ball 11 carries most, 39 N: it lies on the line of the load" in words(of(RIG.healthy()))
    assert "nearest the line of the load (13°)" in words(of(SIDEWAYS))
    evenly = RIG.healthy().replace(fy=0.0, fz=100.0)
    assert "All balls carry alike" in words(of(evenly))
    assert "rollers" not in words(of(RIG))
    assert "Roller" in words(Results(presets["nu208"], UNDER))
    short = OverviewBearing(PackedSource()).sentence
    assert short(of(RIG)) == "Balls 10 and 12 carry most: ball 11 is in the defect."
    assert short(of(RIG.healthy())) == "Ball 11 carries most: it lies on the line of the load."
    most = LoadDistribution(PackedSource()).sentence
    assert "ball 11, nearer the line of the load, lies in the defect" in most(of(RIG))
    assert "in the defect" not in most(of(RIG.healthy()))
    ranges = of(RIG).ranges.state
    worst = math.degrees(ranges.cage_angles[np.argmax(ranges.ball_load.max(axis=1))])
    assert f"It occurs with the cage at {worst:.1f}°. There ball" in most(of(RIG))


@pytest.mark.parametrize("name", ["fan-rig", "3208", "nu208"])
def test_all_that_carry_the_most_are_named(name: str) -> None:
    """Halfway between two balls as many of each row carry alike, by symmetry."""
    scene = presets[name].healthy().replace(fx=0.0, fy=-1000.0, fz=0.0)
    at = 1.5 * math.pi - scene.bearing.ball_spacing * 10.5
    state = equilibrium(scene, [at])
    most = np.flatnonzero(state.ball_load[0] > 0.99 * state.ball_load.max())
    said = reasons.most_loaded(scene, state, 0, np.zeros(state.ball_load.shape[1]))
    head, rest = said.split(" carry most")
    assert (
        len(most)
        == 2 * len(scene.bearing.all_rows)
        == len(re.findall(r"\d+(?! of| and of)", re.sub(r"of row \d", "", head)))
    )
    assert " each: they lie nearest the line of the load" in rest


def test_stiffness_falls_as_balls_push_back_sideways_or_as_fewer_carry() -> None:
    text = reasons.stiffness(of(RIG))
    damaged, healthy = (equilibrium(s, np.linspace(0, s.bearing.ball_spacing, 721)[:-1])
                      for s in (RIG, RIG.healthy()))  # fmt: skip
    share = [float((e.term("k_yy")).mean() / (e.term("k_xx") + e.term("k_yy")).mean())
             for e in (healthy, damaged)]  # fmt: skip
    # of contacts alone: what each pushes back with goes with the cube root of its load (Hertz)
    for e, expected in zip((healthy, damaged), share, strict=True):
        k = np.cbrt(e.ball_load)
        angles = float((k * np.sin(e.ball_angle) ** 2).sum() / k.sum())
        assert angles == pytest.approx(expected, abs=0.01)
    assert f"sin²φ {share[0]:.2f} → {share[1]:.2f}" in text
    assert "k_yy falls" in text
    assert "farther from the vertical" in text
    assert "and fewer balls carry" in text
    assert "and fewer balls carry" in reasons.stiffness(of(RIG), briefly=True)
    assert "hardly changes" in reasons.stiffness(of(SIDEWAYS))
    assert "lie near the vertical" in reasons.stiffness(of(RIG.healthy()))
    assert "lie near the horizontal" in reasons.stiffness(of(SIDEWAYS.healthy()))
    assert "alike" in reasons.stiffness(of(RIG.healthy().replace(fy=0.0, fz=100.0)))


def test_each_term_is_what_the_contacts_add() -> None:
    """k·cos²φ, k·sin²φ and k·sinφ·cosφ of all contacts, with k as the cube root of the load."""
    why = {term: reasons.stiffness_term(of(RIG), term) for term in STIFFNESS_TERMS}
    assert all(text.startswith(("Each contact", "k_")) for text in why.values())
    assert "square of the lever of θx" in why["k_rxrx"]
    rollers = Results(presets["nu208"], UNDER)
    assert reasons.stiffness_term(rollers, "k_zz") == "k_zz is zero: no contact resists z."
    assert "adds k·(cosα·cosφ)² to k_xx" in why["k_xx"]
    assert "fewer balls carry" in why["k_yy"]
    assert "k_xz is zero" in why["k_xz"]
    assert "left and right cancel" in why["k_xy"]
    state = equilibrium(RIG, np.linspace(0.0, RIG.bearing.ball_spacing, 25)[:-1])
    assert "so k_yy steps as balls enter or leave the loaded zone or the defect" in why["k_yy"]
    assert np.ptp(state.loaded_balls) > 0
    k = np.cbrt(state.ball_load)
    added = (k * np.sin(state.ball_angle) * np.cos(state.ball_angle)).sum(axis=1)
    assert np.corrcoef(added, state.term("k_xy"))[0, 1] > 0.99
    assert added.min() < 0.0 < added.max()


def test_a_frequency_moves_with_the_root_of_its_stiffness_or_less() -> None:
    assert "square root of the stiffness" in reasons.frequencies(of(RIG))
    shared = RIG.replace(fz=200.0, dofs=DOF_NAMES)
    assert "less than its square root, as the support's" in reasons.frequencies(of(shared))
    (low, high), ranges = of(shared).bands["y1"], of(shared).ranges
    most = math.sqrt(ranges.greatest["k_yy"] / ranges.least["k_yy"])
    assert high / low - 1.0 < 0.7 * (most - 1.0)
    words = NaturalFrequencies(PackedSource()).sentence
    assert words(of(RIG)).startswith(reasons.frequencies(of(RIG)))


def test_a_peak_is_in_a_band_or_at_a_multiple_of_the_ball_passes() -> None:
    slow, fast = why_words(of(RIG)), why_words(of(FAST))
    assert "672 Hz along y, lies in the band of y₁" in slow
    assert "No peak at the ball-pass frequency, 40.3 Hz: this spectrum resolves only 32 Hz" in slow
    assert "lies in no band of y. It is the line nearest 10 × 172.7 Hz" in fast
    assert "Peaks stand 173 Hz apart" in fast
    rate = FAST.bearing.bpfo(FAST.shaft_speed)
    for scene in (RIG, FAST):  # too slow to be resolved, and a line that stands out
        words = why_words(of(scene.healthy()))
        assert words.startswith("No defect: a healthy bearing also shakes as its"), "the one seen"
    still = of(RIG.healthy().replace(fy=0.0, fz=100.0))  # all balls carry alike, wherever they are
    assert VibrationSpectra(PackedSource()).sentence(still).startswith("The housing does not move")
    assert "healthy" not in fast + slow
    assert 10 * rate == pytest.approx(1728, abs=16)


def test_the_largest_jolt_is_of_a_ball_that_carries() -> None:
    words = VibrationInTime(PackedSource()).sentence
    assert "leaves the defect and takes back its load" in words(of(RIG))
    assert "No loaded ball passes the defect" in words(of(SIDEWAYS))
    inner = RIG.replace(race="inner")
    opposite = dataclasses.replace(inner.defect, center=inner.defect.center - math.pi)
    both = of(inner.replace(defect=(opposite, inner.defect)))
    assert both.excerpt.ball_load.max() > 0.5 * both.excerpt.greatest_static_load
    assert "its load (" in words(both), "one of two defects is where nothing is loaded"


def test_what_life_assumes_is_said_by_life_and_limits_alike() -> None:
    """The Life tab has a pressure with usual groove radii, which limits do not judge."""
    rig = of(RIG)
    assert "no limit is judged by them" in rig.endurance.assumed
    assert rig.endurance.pressures is not None
    pressures = [limit for limit in rig.limits if limit.name.startswith("contact pressure, ")]
    assert len(pressures) == 2
    for limit in pressures:
        assert math.isnan(limit.value)
        assert limit.sentence.endswith("Life assumes usual ones, but no limit is judged by them.")
    assert not any("Life assumes" in limit.sentence for limit in Results(presets["nu208"]).limits)


@pytest.mark.parametrize("scene", [FAN_RIG, LONGER], ids=["as it is", "longer"])
def test_the_numbers_are_those_of_the_core(scene) -> None:
    chain = Results(scene).chain
    angles = np.linspace(0.0, scene.bearing.ball_spacing, 20_001)[:-1]  # a mean of its own
    state = equilibrium(scene, angles)
    assert chain.stiffness["k_yy"] == pytest.approx(state.term("k_yy").mean(), rel=5e-3)
    assert chain.stiffness["k_xx"] == pytest.approx(state.term("k_xx").mean(), rel=5e-3)
    assert chain.loaded_balls == pytest.approx(state.loaded_balls.mean(), rel=5e-3)
    assert chain.greatest_load == pytest.approx(state.ball_load.max(), rel=5e-3)
    for label, band in modes(scene, angles).bands().items():
        assert chain.bands[label] == pytest.approx(band, rel=5e-3)
    motion = simulate(scene, 1.4, 65536.0, step_rate=2 * 65536.0)  # finer than the page's own
    late = motion.outer_acceleration[motion.time.size // 2 :]
    frequency, density = spectrum(late, motion.sample_rate)
    heard = (frequency >= 100.0) & (frequency <= 2500.0)
    for i, dof in enumerate(motion.dofs):
        line = np.argmax(np.where(heard, density[:, i], 0.0))
        assert chain.peaks[dof].frequency == frequency[line]
        assert chain.peaks[dof].level == pytest.approx(10 * np.log10(density[line, i]), abs=0.2)
    assert chain.loudest == "y"
    assert not chain.silent


def test_what_is_missing_is_said() -> None:
    still = Results(FAN_RIG.replace(shaft_speed=0.0)).chain
    assert (still.peaks, still.silent) == ({}, "nothing turns")
    assert still.bands
    nothing = Results(FAN_RIG.replace(fy=0.0)).chain
    assert nothing.answered == 0.0
    assert "nothing touches" in nothing.reason
    unknown = Results(presets["6205"].replace(fz=100.0, stiffness_z=None)).chain
    assert not unknown.bands
    assert "stiffness_z" in unknown.silent
