"""Pictures of states at rest: drawn to scale, as computed, and said in words that fit."""

import dataclasses
import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from bearing_explorer.explorer.plots.frequency_bands import spread
from bearing_explorer.explorer.plots.matrix_cells import PLACES
from bearing_explorer.explorer.results.load_curve import load_curve
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import massless_reference
from bearing_explorer.explorer.views.bearing import BAR_LENGTH, BearingDrawing, Shapes
from bearing_explorer.explorer.views.bearing_editor import facts_of
from bearing_explorer.explorer.views.bearing_picture import bearing_picture
from bearing_explorer.explorer.views.depth_profile import DepthProfile
from bearing_explorer.explorer.views.displacement import Displacement, OperatingPoint
from bearing_explorer.explorer.views.load_distribution import LoadDistribution, defect_strips
from bearing_explorer.explorer.views.maps import (
    FLAT,
    GREATEST,
    NO_ANSWER,
    ONE_SIGN,
    TWO_SIGNS,
    StiffnessMaps,
    whole_numbers,
)
from bearing_explorer.explorer.views.modes import NaturalFrequencies
from bearing_explorer.explorer.views.stiffness import Stiffness
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from hypothesis import given, strategies as st
from scipy.optimize import brentq

from bearingcore import STIFFNESS_TERMS, RoughFloor, Scene, equilibrium, presets, scene_of
from bearingcore.model.scene import FREE_TILT_WORDS

FAN_RIG = presets["fan-rig"]


def drawn(scene: Scene, cage_angle: float = 0.0) -> dict[str, dict[str, np.ndarray]]:
    return BearingDrawing(PackedSource()).data(Results(scene, cage_angle))[0]


def test_balls_turn_with_the_cage_and_carry_their_load_with_them() -> None:
    scene, turn = FAN_RIG.healthy(), math.radians(10.0)
    before, after = drawn(scene)["bearing_balls"], drawn(scene, turn)["bearing_balls"]
    angle = np.arctan2(after["y"], after["x"]) - np.arctan2(before["y"], before["x"])
    np.testing.assert_allclose(np.mod(angle, 2.0 * math.pi), turn, atol=1e-9)
    assert not np.allclose(before["load"], after["load"])


@pytest.mark.parametrize("depth_um", [1.0, 50.0, 500.0])
def test_the_defect_is_as_deep_as_the_drawing_says(depth_um: float) -> None:
    scene = FAN_RIG.replace(depth=1e-6 * depth_um)
    sources = drawn(scene)
    words = sources["bearing_load_words"]
    scale = words["value"][words["kind"] == 4.0][0]
    shape = sources["bearing_defect"]
    deepest = np.hypot(shape["x"], shape["y"]).max() - 1.0
    assert deepest == pytest.approx(scale * 1e-6 * depth_um / 26.5e-3)
    assert 0.1 < deepest / (4.0 / 26.5) <= 0.45 + 1e-9  # seen, and within the ring


def test_an_inner_race_defect_is_cut_into_the_inner_ring_and_turns_faster_than_the_cage() -> None:
    scene = FAN_RIG.replace(race="inner")
    turn = math.radians(10.0)
    middles = []
    for cage_angle in (0.0, turn):
        shape = Shapes(scene, cage_angle).defects()
        assert np.hypot(shape["x"], shape["y"]).max() <= 18.5 / 26.5 + 1e-9
        middles.append(math.atan2(shape["y"].mean(), shape["x"].mean()))
    turned = (middles[1] - middles[0]) % (2.0 * math.pi)
    assert turned == pytest.approx(turn / scene.bearing.cage_ratio)


def test_a_ball_in_the_defect_sinks_into_the_ring() -> None:
    inside = FAN_RIG.replace(center=0.0, extent=math.radians(20.0))
    balls = drawn(inside)["bearing_balls"]
    radius = np.hypot(balls["x"], balls["y"])
    assert radius[0] > radius[1:].max() + 0.01
    np.testing.assert_allclose(radius[1:], radius[1])


def test_bars_are_as_long_as_the_loads_and_only_loaded_balls_have_one() -> None:
    view, results = BearingDrawing(PackedSource()), Results(FAN_RIG, 0.1)
    sources, ranges = view.data(results)
    bars, top = sources["bearing_bars"], ranges["bearing_load"][1]
    length = np.hypot(bars["x1"] - bars["x0"], bars["y1"] - bars["y0"])
    load = results.now.ball_load[0]
    np.testing.assert_allclose(length[load > 0.0], BAR_LENGTH * load[load > 0.0] / top)
    assert np.isnan(length[load == 0.0]).all()
    assert top >= results.equilibrium.ball_load.max()


def test_the_arrow_points_along_the_radial_load() -> None:
    scene = FAN_RIG.replace(fx=30.0, fy=40.0)
    arrow = Shapes(scene, 0.0).load_arrow()
    tip = np.argmax(np.hypot(arrow["x"], arrow["y"]))
    assert math.atan2(arrow["y"][tip], arrow["x"][tip]) == pytest.approx(math.atan2(40.0, 30.0))
    assert Shapes(FAN_RIG.replace(fy=0.0), 0.0).load_arrow()["x"].size == 0


def test_the_arrow_is_as_long_as_the_load_says_while_a_hand_holds_it_and_fits_at_rest() -> None:
    view = BearingDrawing(PackedSource())

    def drawn(load: float, held: bool) -> tuple[float, float, int]:
        """Length, length that the words promise, and parts of the arrow."""
        sources, _ = view.data(Results(FAN_RIG.replace(fy=-load), held=held))
        arrow, words = sources["bearing_arrow"], sources["bearing_load_words"]
        bore = sources["bearing_handles"]["bore"][0]
        promised = load / words["more"][0] * bore
        length = float(np.nanmax(np.hypot(arrow["x"], arrow["y"])))
        return length, promised, int(np.isnan(arrow["x"]).sum()) + 1

    at_rest = drawn(100.0, False)
    for load in (130.0, 240.0, 20.0):
        length, promised, parts = drawn(load, True)
        assert length == pytest.approx(promised) == pytest.approx(at_rest[0] * load / 100.0)
        assert parts == 1
    length, promised, parts = drawn(5000.0, True)
    assert length < 1.5 < promised, "it ends where the figure does"
    assert parts == 2, "with a second head"
    length, promised, parts = drawn(5000.0, False)
    assert length == pytest.approx(promised)
    assert (length < 0.6, parts) == (True, 1), "let go of, it lies within the bore again"
    assert drawn(100.0, False) == at_rest, "a reset brings its scale back"


@pytest.mark.parametrize(("extent", "inside"), [(12.9, 0), (25.8, 1), (60.0, 2)])
def test_ticks_stand_at_whole_ball_spacings(extent: float, inside: int) -> None:
    scene = FAN_RIG.replace(extent=math.radians(extent))
    ticks = Shapes(scene, 0.0).ball_spacings()
    angle = np.degrees(np.arctan2(ticks["y1"], ticks["x1"])) % 360.0
    begins = 270.0 - 0.5 * extent
    np.testing.assert_allclose(angle - begins, 360.0 / 14.0 * np.arange(1, inside + 2))
    drops = Results(scene).ranges.state.cage_angles
    met = [int((Results(scene, float(at)).drop["outer"] > 0.0).sum()) for at in drops[::9]]
    assert min(met) == inside


def test_rows_of_unlike_balls_are_drawn_to_one_scale() -> None:
    pair = presets["7208-back-to-back"]
    low, high = pair.bearing.rows
    rows = (low, dataclasses.replace(high, n_balls=11, ball_diameter=9e-3, pitch_diameter=50e-3))
    scene = pair.replace(bearing=pair.bearing.replace(rows=rows))
    for row, count in enumerate((14, 11)):
        drawn, own = Shapes(scene, 0.5, row), scene.bearing.of_row(row)
        none = dict.fromkeys(("outer", "inner"), np.zeros(count))
        balls = drawn.balls(none, np.zeros(count))
        assert balls["radius"] * drawn.unit == pytest.approx(own.ball_radius)
        assert np.hypot(balls["x"], balls["y"]) * drawn.unit == pytest.approx(
            0.5 * own.pitch_diameter
        )
        assert drawn.outer_race * drawn.unit == pytest.approx(own.outer_raceway_radius)
        turned = drawn.ball_angles()[0] - Shapes(scene, 0.0, row).ball_angles()[0]
        assert turned == pytest.approx(0.5 * scene.bearing.pace(row))
    results = Results(scene, 0.5)
    view = BearingDrawing(PackedSource())
    assert "of 25 balls carry load" in view.sentence(results)
    assert view.table(results)["ball"].tolist() == [*range(1, 15), *range(1, 12)]


@pytest.mark.parametrize("race", ["outer", "inner"])
def test_handles_stand_at_the_ends_of_the_defect_and_at_the_tip_of_the_arrow(race: str) -> None:
    scene = FAN_RIG.replace(race=race, fx=30.0)
    drawn = Shapes(scene, 0.4)
    handles, arrow = drawn.handles(), drawn.load_arrow()
    assert handles["kind"].tolist() == [0.0, 1.0, 2.0, 3.0]
    start, end, middle, tip = np.unwrap(np.arctan2(handles["y"], handles["x"]))
    assert end - start == pytest.approx(scene.defect.extent)
    assert middle - start == pytest.approx(0.5 * scene.defect.extent)
    assert math.hypot(*(handles[axis][3] for axis in "xy")) == pytest.approx(
        np.nanmax(np.hypot(arrow["x"], arrow["y"]))
    )
    assert math.cos(tip - math.atan2(-100.0, 30.0)) == pytest.approx(1.0)
    assert Shapes(FAN_RIG.replace(extent=0.0), 0.4).handles()["kind"].tolist() == [3.0]
    tip = {
        name: column[-1] for name, column in Shapes(FAN_RIG.replace(fy=0.0), 0.4).handles().items()
    }
    assert (tip["x"], tip["y"], tip["kind"]) == (0.0, 0.0, 3.0), "an arrow begins in the middle"


@pytest.mark.parametrize("name", list(presets))
@pytest.mark.parametrize("cage_angle_deg", [4.0, 100.3])
def test_the_balls_lie_on_the_curve(name: str, cage_angle_deg: float) -> None:
    results = Results(presets[name], math.radians(cage_angle_deg))
    sources, _ = LoadDistribution(PackedSource()).data(results)
    balls, bearing = sources["load_distribution_balls"], presets[name].bearing
    n = bearing.n_balls
    for row, which in zip(bearing.all_rows, ("curve", "other_rows"), strict=False):
        curve = sources[f"load_distribution_{which}"]
        own = slice(0, n) if which == "curve" else slice(n, 2 * n)
        # between two of its angles the curve can only be known to lie between its neighbours
        right = np.searchsorted(curve["angle"], balls["angle"][own])
        last = curve["load"].size - 1
        near = np.stack([curve["load"][np.clip(right + k, 0, last)] for k in (-1, 0)])
        slack = 3e-3 * np.nanmax(curve["load"])  # an edge may lie between
        assert np.all(balls["load"][own] >= near.min(axis=0) - slack), row
        assert np.all(balls["load"][own] <= near.max(axis=0) + slack), row
    assert balls["angle"].size == bearing.total_balls


def test_the_key_names_what_is_drawn() -> None:
    with_defect, healthy = Results(FAN_RIG), Results(FAN_RIG.healthy())
    assert "Grey: the bearing without its defect. Shaded: " in LoadDistribution.caption(with_defect)
    assert not {"Grey", "Shaded"} & set(re.findall(r"(\w+): ", LoadDistribution.caption(healthy)))


def test_two_rows_have_a_curve_and_a_name_each() -> None:
    """Back to back under an axial load, the row that it presses carries more."""
    results = Results(presets["7208-back-to-back"].replace(fz=1500.0))
    view = LoadDistribution(PackedSource())
    sources, _ = view.data(results)
    assert sources["load_distribution_rows"]["row"].tolist() == [1.0, 2.0]
    first, second = (
        np.nanmax(sources[f"load_distribution_{which}"]["load"])
        for which in ("curve", "other_rows")
    )
    assert first == pytest.approx(results.equilibrium.ball_load[:, :14].max())
    assert second == pytest.approx(results.equilibrium.ball_load[:, 14:].max())
    assert abs(first / second - 1.0) > 0.2
    assert "the greatest load of a ball of row 2 is" in view.sentence(results)
    one, _ = view.data(Results(FAN_RIG))
    assert one["load_distribution_rows"]["row"].size == 0


def test_the_curve_goes_once_round_and_closes() -> None:
    """Also for an inner-race defect, where it holds the greatest load at each angle."""
    inner = Results(FAN_RIG.replace(race="inner")).equilibrium
    angle, load = load_curve(inner)
    assert np.all(np.diff(angle) > 0.0)
    assert np.nanmax(load) == np.max(inner.ball_load)
    state = Results(FAN_RIG).equilibrium
    angle, load = load_curve(state)
    assert angle[0] < 0.0 <= angle[1]
    assert angle[-2] < 2.0 * math.pi <= angle[-1]
    assert np.all(np.diff(angle) > 0.0)
    assert angle.size == 14 * (state.cage_angles.size - 1) + 2
    assert load[0] == load[-2]
    assert load[-1] == load[1]


@pytest.mark.parametrize(
    ("center_deg", "extent_deg", "expected"),
    [
        (270.0, 12.0, [(264.0, 276.0)]),
        (355.0, 40.0, [(335.0, 360.0), (0.0, 15.0)]),
        (5.0, 40.0, [(345.0, 360.0), (0.0, 25.0)]),
        (10.0, 20.0, [(0.0, 20.0)]),
    ],
)
def test_a_defect_across_0_is_shaded_as_two_pieces(
    center_deg: float, extent_deg: float, expected: list[tuple[float, float]]
) -> None:
    scene = FAN_RIG.replace(center=math.radians(center_deg), extent=math.radians(extent_deg))
    pieces = defect_strips(scene, 0.3)
    assert pieces["start"] == pytest.approx([start for start, _ in expected], abs=1e-9)
    assert pieces["end"] == pytest.approx([end for _, end in expected], abs=1e-9)


def test_an_inner_race_defect_is_shaded_where_the_shaft_has_turned_it() -> None:
    scene = FAN_RIG.replace(race="inner", center=math.radians(90.0), extent=math.radians(20.0))
    quarter = math.radians(90.0) * scene.bearing.cage_ratio
    assert defect_strips(scene, quarter)["start"] == pytest.approx([170.0])


def test_balls_with_mass_show_both_races() -> None:
    """At the outer race comes what the ball's centrifugal load adds, here some newtons."""
    heavy = presets["7208-25deg"].replace(shaft_speed=1500.0, balls="with mass")
    results = Results(heavy)
    view = LoadDistribution(PackedSource())
    sources, _ = view.data(results)
    outer, inner = sources["load_distribution_curve"], sources["load_distribution_inner"]
    assert np.array_equal(outer["angle"], inner["angle"])
    F_c = heavy.bearing.centrifugal_load(1500.0)
    assert np.all(outer["load"] > inner["load"])
    assert np.max(outer["load"] - inner["load"]) < 1.2 * F_c
    assert "at contact angles of" in view.sentence(results)
    table = view.table(results)
    radial = [
        table[f"{load}_load_n"] * np.cos(np.radians(table[f"{race}_contact_angle_deg"]))
        for load, race in (("inner_race", "inner"), ("ball", "outer"))
    ]
    carries = table["inner_race_load_n"] > 1.0
    assert (radial[1] - radial[0])[carries] == pytest.approx(F_c, rel=1e-4)
    massless = Results(heavy.replace(balls="massless"))
    assert not view.data(massless)[0]["load_distribution_inner"]["angle"].size
    assert "inner race" not in view.sentence(massless)
    assert np.array_equal(
        massless.now.ball_load, results.against(massless_reference(results.scene)).now.ball_load
    )


LIEW_LIM = presets["liew-lim"]


@pytest.mark.parametrize("edge", ["published", "chord", "exact"])
@pytest.mark.parametrize("center_deg", [270.0, 2.0, 359.0])
def test_the_slot_is_as_long_and_deep_as_the_defect(edge: str, center_deg: float) -> None:
    scene = FAN_RIG.replace(edge=edge, center=math.radians(center_deg))
    shown = Results(scene).profile
    cut = shown.angle[shown.depth > 0.0]
    assert cut[-1] - cut[0] == pytest.approx(math.radians(12.9), abs=1e-6)
    assert 0.5 * (cut[-1] + cut[0]) % (2.0 * math.pi) == pytest.approx(scene.defects[0].center)
    assert set(shown.depth) == {0.0, 50e-6}
    assert np.all(shown.path <= shown.depth + 1e-15)
    assert np.all(np.diff(shown.angle) >= 0.0)


def test_as_in_the_paper_a_ball_does_not_reach_the_floor_of_5_degrees_but_of_20() -> None:
    view = DepthProfile(PackedSource())
    short = Results(LIEW_LIM.replace(extent=math.radians(5.0)))
    long = Results(LIEW_LIM.replace(extent=math.radians(20.0)))
    assert short.profile.path.max() < 50e-6
    assert long.profile.path.max() == pytest.approx(50e-6)
    assert "does not reach the floor of 50 µm" in view.sentence(short)
    assert "reaches its floor of 50 µm" in view.sentence(long)


def test_a_rough_floor_is_drawn_as_it_was_cut_and_balls_roll_over_its_peaks() -> None:
    floor = RoughFloor(rms_height=5e-6, correlation_length=0.5e-3, seed=3)
    scene = FAN_RIG.replace(extent=math.radians(38.6), floor=floor)
    shown = Results(scene).profile
    inside = np.abs(shown.angle - scene.defects[0].center) < math.radians(15.0)
    assert np.std(shown.depth[inside]) == pytest.approx(5e-6, rel=0.5)
    assert np.std(shown.path[inside]) < np.std(shown.depth[inside])
    assert np.all(shown.path[inside] <= shown.depth[inside] + 1e-7)
    assert "up to" in DepthProfile(PackedSource()).sentence(Results(scene))


RIG = presets["fan-rig"].healthy()


def drop(force: float) -> float:
    """Displacement [m] downwards of the rig's ring, a ball at 270°, under a force [N]: Eq. 13."""
    bearing = RIG.bearing
    phi = 2.0 * math.pi * np.arange(bearing.n_balls) / bearing.n_balls

    def carried(y: float) -> float:
        pressed = np.maximum(y * np.cos(phi) - bearing.radial_clearance, 0.0)
        return float((bearing.load_deflection_factor * pressed**1.5 * np.cos(phi)).sum())

    return brentq(lambda y: carried(y) - force, 0.0, 1e-3, xtol=1e-16)


def test_displacement_and_stiffness_are_those_of_the_force_balance() -> None:
    spacing = 2.0 * math.pi / RIG.bearing.n_balls
    results = Results(RIG, (1.5 * math.pi) % spacing)
    moved = Displacement(PackedSource()).table(results)
    assert moved["y_um"][0] == pytest.approx(-1e6 * drop(100.0), rel=1e-6)
    assert moved["y_um"][1] <= moved["y_um"][2] <= moved["y_um"][3]
    table = OperatingPoint(PackedSource()).table(results)
    now = (table["when"] == "at this cage angle") & (table["load"] == "fy [N]")
    shown = Displacement(PackedSource()).html(results)
    assert shown.count(">0<") >= 12
    assert "·10" not in shown, "beyond the digits of the largest"
    slope = 0.02 / (drop(100.01) - drop(99.99))
    assert table["per_m_y"][now] == pytest.approx(slope, rel=1e-4)
    assert table["displacement_in_si"][now] == pytest.approx(-drop(100.0), rel=1e-6)


def test_directions_that_are_held_or_free_are_said() -> None:
    results = Results(scene_of("7208 B"))
    view = Displacement(PackedSource())
    assert "Tilt is held" in view.sentence(results)
    free = Results(results.scene.replace(dofs="tilt free", fz=6000.0))
    assert FREE_TILT_WORDS in OperatingPoint(PackedSource()).sentence(free)
    unloaded = Results(RIG.replace(fy=0.0))
    assert view.sentence(unloaded).startswith("No displacement: ")
    assert "not known" in view.html(unloaded)


@pytest.mark.parametrize("name", list(presets))
def test_each_band_holds_a_curve_that_is_drawn_and_little_more(name: str) -> None:
    results = Results(presets[name])
    sources, ranges = NaturalFrequencies(PackedSource()).data(results)
    bands = sources["modes_bands"]
    drawn = []
    for direction in style.DIRECTIONS:
        line = sources[f"modes_{direction}"]["frequency"]
        breaks = np.flatnonzero(np.isnan(line))
        for curve in np.split(line, breaks):
            known = curve[np.isfinite(curve)]
            if known.size:
                drawn.append((known.min(), known.max()))
    least, most = np.sort(np.array(drawn), axis=0).T
    low, high = np.sort(bands["low"]), np.sort(bands["high"])
    assert np.all(((1.0 - 1e-9) * low <= least) & (least <= 1.02 * low))
    assert np.all((0.98 * high <= most) & (most <= (1.0 + 1e-9) * high))
    assert len(drawn) == len(results.modes.label)
    low, high = ranges["modes_frequency"]
    assert low <= bands["low"].min()
    assert bands["high"].max() <= high


@given(
    st.lists(st.floats(0.0, 2000.0), max_size=12),
)
def test_labels_never_overlap_and_stay_in_order(places: list[float]) -> None:
    moved = spread(np.array(places), 80.0, 0.0, 2000.0)
    order = np.argsort(places, kind="stable")
    assert np.all(np.diff(moved[order]) >= 80.0 - 1e-6)


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
    groups = {group.get("data-name"): group for group in drawn.iter("g")}
    assert len(groups["n_balls"].findall("circle")) == bearing.n_balls
    assert ("inner_groove_radius_mm" in groups) == bearing.is_drawn
    assert ("roller_length_mm" in groups) == (bearing.kind.element == "roller")
    assert ("row_distance_mm" in groups) == (len(bearing.rows) == 2)
    assert "nan" not in bearing_picture(bearing)


OUTER = presets["fan-rig"]
INNER = OUTER.replace(race="inner")
TURN = 2.0 * math.pi * OUTER.bearing.cage_ratio  # of the cage while the shaft turns once


def test_curves_are_over_a_ball_spacing_or_over_the_turn_that_is_shown() -> None:
    outer = Results(OUTER, 3.0)
    assert outer.stretch[:2] == (0.0, OUTER.bearing.ball_spacing)
    for turn in (0, 1, 2):
        inner = Results(INNER, (turn + 0.3) * TURN)
        np.testing.assert_allclose(inner.stretch[:2], [turn * TURN, (turn + 1) * TURN])
        assert inner.along([(turn + 0.3) * TURN])[0] == pytest.approx(0.3 * 360.0)
        assert inner.along(inner.equilibrium.cage_angles[[0, -1]]).tolist() == [0.0, 360.0]


@pytest.mark.parametrize("cage_angle", [0.4, 0.4 + TURN, 0.4 + 2 * TURN])
def test_the_mark_stands_on_the_curve(cage_angle: float) -> None:
    """Also in later turns, in which the defect meets the balls elsewhere."""
    results = Results(INNER, cage_angle)
    state = results.equilibrium
    at_now = np.interp(cage_angle, state.cage_angles, state.term("k_yy"))
    assert at_now == pytest.approx(results.now.term("k_yy")[0], rel=2e-3)
    sources, _ = Stiffness(PackedSource()).data(results)
    share = results.along([cage_angle])[0] / 360.0
    marks, cells = sources["stiffness_now"]["x"], sources["stiffness_cells"]
    np.testing.assert_allclose(
        marks, cells["left"] + share * (cells["right"] - cells["left"]), rtol=1e-9
    )
    assert set(cells["foot"]) == {0.0, 360.0}
    assert sources["stiffness_axis"]["shaft"].tolist() == [1.0]


HEAD = 20


def sent(results: Results) -> dict:
    return StiffnessMaps(PackedSource()).data(results)[0]


def points(sources: dict) -> tuple[tuple[int, int], np.ndarray]:
    """Rows and columns, and the whole numbers of all maps."""
    numbers = sources["maps_points"]["bits"].view(np.uint16)
    rows, columns = int(numbers[0]), int(numbers[1])
    values = numbers[HEAD : HEAD + 16 * rows * columns]
    return (rows, columns), values.reshape(16, rows, columns)


@pytest.mark.parametrize("scene", [LIEW_LIM, FAN_RIG])
def test_what_is_sent_is_what_was_computed(scene) -> None:
    results = Results(scene)
    sources = sent(results)
    shape, numbers = points(sources)
    cells = sources["maps_cells"]
    assert shape == (91, 121) == results.maps.status.shape
    for i, term in enumerate(STIFFNESS_TERMS):
        low, high = cells["low"][i], cells["high"][i]
        values = results.maps.term(term)
        assert low <= values.min()
        assert values.max() <= high
        back = low + numbers[i] / GREATEST * (high - low)
        np.testing.assert_allclose(back, values, rtol=0.0, atol=0.51 * (high - low) / GREATEST)
    low, high = cells["low"][15], cells["high"][15]
    back = low + numbers[15] / GREATEST * (high - low)
    np.testing.assert_allclose(back, results.maps.loaded_balls, atol=1e-3)


def test_whole_numbers_pass_the_wire_unharmed_two_to_a_float() -> None:
    """Among them bit patterns that are not numbers when read as a float."""
    packed = PackedSource()
    packed.source("points", "bits")
    numbers = np.arange(65536, dtype=np.uint16)
    numbers = np.concatenate([numbers, numbers[::-1]])
    packet = packed.pack({"points": {"bits": numbers.view(np.float32)}}, {})
    np.testing.assert_array_equal(packet[-numbers.size // 2 :].view(np.uint16), numbers)


def test_a_point_without_an_answer_has_no_number() -> None:
    numbers = whole_numbers(np.array([1.0, math.nan, 3.0, 2.0]), 1.0, 3.0)
    assert numbers.tolist() == [0, NO_ANSWER, GREATEST, GREATEST // 2]
    assert whole_numbers(np.array([math.nan]), math.nan, math.nan).tolist() == [NO_ANSWER]
    sources = sent(Results(FAN_RIG.replace(fy=0.0)))
    assert np.all(points(sources)[1] == NO_ANSWER)


def test_scales_are_of_the_kind_that_a_term_needs() -> None:
    cells = sent(Results(LIEW_LIM))["maps_cells"]
    kinds = dict(zip(STIFFNESS_TERMS, cells["kind"], strict=False))
    for i, (row, column) in enumerate(PLACES):
        if row == column:
            assert cells["kind"][i] == ONE_SIGN
            assert cells["low"][i] >= 0.0
    for term in ("k_xy", "k_xz", "k_rxry"):  # odd about the middle of the ball spacing
        assert kinds[term] == TWO_SIGNS
        i = STIFFNESS_TERMS.index(term)
        assert cells["low"][i] == -cells["high"][i]
    radial = sent(Results(FAN_RIG))["maps_cells"]
    assert radial["kind"][STIFFNESS_TERMS.index("k_xz")] == FLAT
    assert radial["zero"][STIFFNESS_TERMS.index("k_xz")] == 1, "by symmetry"
    assert radial["now"][STIFFNESS_TERMS.index("k_xz")] == 0.0


@pytest.mark.parametrize(("extent_deg", "reach_deg"), [(40.0, 90.0), (90.0, 90.0), (100.0, 120.0)])
def test_the_cross_stands_where_the_sliders_do(extent_deg: float, reach_deg: float) -> None:
    angle_deg = 3 * 30.0 + 7.5
    scene = LIEW_LIM.replace(extent=math.radians(extent_deg))
    results = Results(scene, math.radians(angle_deg))
    sources = sent(results)
    marks, grid = sources["maps_now"], {k: v[0] for k, v in sources["maps_grid"].items()}
    assert math.degrees(results.maps.extents[-1]) == pytest.approx(reach_deg)
    x = (marks["x"] - marks["left"]) / (marks["right"] - marks["left"])
    y = (marks["y"] - marks["bottom"]) / (marks["top"] - marks["bottom"])
    angle = grid["x_first"] + x * (grid["x_last"] - grid["x_first"])
    extent = grid["y_first"] + y * (grid["y_last"] - grid["y_first"])
    np.testing.assert_allclose(angle, 7.5)
    np.testing.assert_allclose(extent, extent_deg)
    # the middle of the point at the cross is that of the cage angle
    assert (x[0] * 121) % 1.0 == pytest.approx(0.5)
    now = equilibrium(scene, [math.radians(angle_deg)])
    for i, term in enumerate(STIFFNESS_TERMS):
        np.testing.assert_allclose(sources["maps_cells"]["now"][i], now.term(term)[0], rtol=1e-9)


def test_moving_along_the_maps_computes_nothing() -> None:
    one = Results(LIEW_LIM.replace(extent=0.3), 0.1).maps
    assert Results(LIEW_LIM.replace(extent=0.9), 0.4).maps is one
    assert Results(LIEW_LIM.replace(depth=20e-6)).maps is not one


def test_the_extent_that_varies_is_that_of_the_defect_in_hand() -> None:
    first = LIEW_LIM.defects[0]
    second = dataclasses.replace(first, center=first.center + 2.5, extent=0.1)
    both = LIEW_LIM.replace(defect=(first, second))
    maps = Results(both, focus=1).maps
    row = equilibrium(
        LIEW_LIM.replace(defect=(first, dataclasses.replace(second, extent=maps.extents[30]))),
        maps.cage_angles,
    )
    np.testing.assert_array_equal(maps.loaded_balls[30], row.loaded_balls)
    assert np.any(maps.loaded_balls[30] != Results(both, focus=0).maps.loaded_balls[30])
