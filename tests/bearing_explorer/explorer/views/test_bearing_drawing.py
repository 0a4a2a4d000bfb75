"""The drawing of the bearing: to scale, symmetric where the scene is, turning with the cage."""

import dataclasses
import math

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.bearing import BAR_LENGTH, BearingDrawing, Shapes
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import Scene, presets

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
