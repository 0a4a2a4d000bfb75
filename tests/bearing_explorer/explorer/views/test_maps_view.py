"""Maps on the page: what is sent is what was computed, on scales that fit, and marked."""

import dataclasses
import math

import numpy as np
import pytest
from bearing_explorer.explorer.plots.matrix_cells import PLACES
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.maps import (
    FLAT,
    GREATEST,
    NO_ANSWER,
    ONE_SIGN,
    TWO_SIGNS,
    StiffnessMaps,
    whole_numbers,
)
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import STIFFNESS_TERMS, equilibrium, presets

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
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
