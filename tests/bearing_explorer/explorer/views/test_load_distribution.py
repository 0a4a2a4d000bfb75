"""The load distribution: one closed curve, the balls on it, the defect shaded where it is."""

import math
import re

import numpy as np
import pytest
from bearing_explorer.explorer.results.load_curve import load_curve
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import massless as massless_balls
from bearing_explorer.explorer.views.load_distribution import LoadDistribution, shaded
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import presets

FAN_RIG = presets["fan-rig"]


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
    pieces = shaded(scene, 0.3)
    assert pieces["start"] == pytest.approx([start for start, _ in expected], abs=1e-9)
    assert pieces["end"] == pytest.approx([end for _, end in expected], abs=1e-9)


def test_an_inner_race_defect_is_shaded_where_the_shaft_has_turned_it() -> None:
    scene = FAN_RIG.replace(race="inner", center=math.radians(90.0), extent=math.radians(20.0))
    quarter = math.radians(90.0) * scene.bearing.cage_ratio
    assert shaded(scene, quarter)["start"] == pytest.approx([170.0])


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
        massless.now.ball_load, results.against(massless_balls(results.scene)).now.ball_load
    )
