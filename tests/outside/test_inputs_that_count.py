"""Inputs that decide an answer: each counts, or is refused; none is dropped without a word."""

import math

import numpy as np
import pytest

from bearingcore import (
    Defect,
    Scene,
    equilibrium,
    life,
    presets,
    read_designation,
    scene_of,
    stiffness_maps,
)
from bearingcore.errors import FieldError
from bearingcore.model.scene._defect import drop_into
from bearingcore.model.statics import ball_positions, static_ranges, static_state
from bearingcore.model.sweeps import sweep
from tests.outside.witness import witness

RPM = math.pi / 30.0
DEGREE = math.radians(1.0)
FAST_PAIR = scene_of("7010 C DB").replace(
    fx=0.0, fy=-150.0, fz=100.0, shaft_speed=18_000.0 * RPM, balls="with mass"
)


@witness(
    "race: outer", "race: inner",
    by="two spalls that touch are one spall",
    compared="path of a ball over 600 pairs of whole degrees to 0.1 µm of 50, loads", within=1e-4,
)  # fmt: skip
@pytest.mark.parametrize("race", ["outer", "inner"])
def test_spalls_that_touch_are_one(race: str) -> None:
    """Degrees that are turned into radians and added leave gaps of rounding: no walls."""
    bearing = presets["fan-rig"].bearing
    angle = np.linspace(-0.2, 0.5, 400)
    for first in range(0, 360, 12):
        for a in range(1, 11, 2):
            for b in (2, 5, 9, 10):
                left, right, whole = (
                    Defect(e * DEGREE, 50e-6, (first + m) * DEGREE, race, "exact")
                    for e, m in ((a, 0.5 * a), (b, a + 0.5 * b), (a + b, 0.5 * (a + b)))
                )
                at = first * DEGREE + angle
                two, one = (drop_into(d, bearing, at) for d in ((left, right), (whole,)))
                assert np.abs(two - one).max() < 1e-7, (first, a, b)
    spalls = [Defect(6 * DEGREE, 50e-6, c * DEGREE, race, "exact") for c in (267.0, 273.0)]
    joined = Defect(12 * DEGREE, 50e-6, 270.0 * DEGREE, race, "exact")
    two, one = (
        equilibrium(presets["fan-rig"].replace(defect=d)).ball_load for d in (tuple(spalls), joined)
    )
    assert np.abs(two - one).max() < 1e-4 * one.max()


def test_a_race_spalled_all_around_has_no_wall_at_its_seam() -> None:
    """12 × 30° is a turn but for rounding: a race worn down everywhere has no edges left."""
    extent = sum(math.radians(30.0) for _ in range(12)) - 1e-15
    assert Defect(extent, 50e-6, 0.0).extent == 2.0 * math.pi
    scene = presets["fan-rig"]
    with pytest.raises(FieldError, match="whole race"):
        scene.replace(defect=tuple(Defect(30 * DEGREE, 5e-5, k * 30 * DEGREE) for k in range(12)))


@witness(
    "balls: with mass", "function: life",
    by="ISO 16281 written out in the test, on the loads of `ball_positions`",
    compared="L_10r of a 7010 C pair at 18,000 rpm: 75,420 million turns, 2.76e6 massless",
    within=1e-5,
)  # fmt: skip
def test_life_counts_the_centrifugal_load_of_balls() -> None:
    rated = life(FAST_PAIR, positions="load line")
    line = math.atan2(-150.0, 0.0) % FAST_PAIR.bearing.ball_spacing
    inner, outer = ball_positions(FAST_PAIR, [line]).load[:, 0].reshape(2, 2, -1)
    failing = sum(
        (np.mean(inner[row] ** 3) ** (1 / 3) / rated.inner_rating) ** (10 / 3)
        + (np.mean(outer[row] ** (10 / 3)) ** 0.3 / rated.outer_rating) ** (10 / 3)
        for row in (0, 1)
    )
    assert rated.million_revolutions == pytest.approx(failing**-0.9, rel=1e-5)
    assert life(FAST_PAIR).million_revolutions == pytest.approx(75_420.0, rel=1e-4)


def test_a_sweep_of_heavy_balls_is_their_static_state() -> None:
    """Stiffness and loads over the speed are those of `static_state`."""
    made = sweep(
        FAST_PAIR.replace(extent=0.2, depth=1e-5),
        {"balls": ["massless", "with mass"], "extent": [0.1, 0.2]},
        outputs=["k_yy_mean", "ball_load_greatest"],
    )
    heavy = static_state(FAST_PAIR.replace(extent=0.1, depth=1e-5))
    own = made["k_yy_mean"].sel(balls="with mass", extent=0.1)
    assert float(own) == pytest.approx(heavy.shares @ heavy.term("k_yy"), rel=1e-9)
    light, loaded = made["ball_load_greatest"].sel(extent=0.1).values
    assert loaded == pytest.approx(heavy.ball_load.max(), rel=1e-9)
    assert light < 0.5 * loaded


@witness(
    "function: life",
    by="ISO 281: C_r has no clearance, preload, distance or arrangement in it",
    compared="rating of a 7310 BECBP DB that is preloaded by 1 µm, 27,359 h", within=1e-4,
)  # fmt: skip
def test_what_is_no_rated_dimension_leaves_the_rating() -> None:
    scene = scene_of("7310 BECBP DB")
    bearing, rating = scene.bearing, scene.bearing.dynamic_load_rating
    low, high = bearing.rows
    turned = (low.__class__(low.place, high.facing), low.__class__(high.place, low.facing))
    for kept in (
        bearing.replace(preload=1e-6), bearing.replace(row_distance=0.1),
        bearing.replace(rows=turned), bearing.replace(radial_clearance=1e-6, density=7700.0),
        bearing.replace(load_deflection_factor=1e10), bearing.replace(youngs_modulus=200e9),
    ):  # fmt: skip
        assert kept.dynamic_load_rating == rating
    # the number from outside is of the clearance CB as a radial one, with 1 µm of preload
    preloaded = bearing.replace(preload=1e-6, radial_clearance=11.1005e-6)
    assert life(scene.replace(bearing=preloaded)).hours == pytest.approx(27_359.0, rel=1e-4)
    larger = low.__class__(low.place, low.facing, n_balls=11)
    for lost in (
        bearing.replace(n_balls=11), bearing.replace(contact_angle=0.6),
        bearing.replace(rows=bearing.rows[:1]), bearing.replace(rows=(larger, high)),
    ):  # fmt: skip
        assert lost.dynamic_load_rating is None
    aligning = read_designation("1208").bearing
    same = aligning.replace(contact_angle=aligning.contact_angle, radial_clearance=1e-6)
    assert same.dynamic_load_rating == aligning.dynamic_load_rating


@pytest.mark.parametrize("name", ["1208", "2310"])
def test_a_self_aligning_bearing_takes_no_moment(name: str) -> None:
    """Its outer race is a sphere about the middle, on which the inner ring turns freely."""
    for moment in ("mx", "my"):
        with pytest.raises(FieldError, match="tilts freely"):
            scene_of(name).replace(**{moment: 500.0})


@pytest.mark.parametrize(("dofs", "load"), [(("x", "y"), "fz"), ("tilt held", "mx")])
def test_a_load_that_the_bearing_does_not_carry_is_said(dofs: object, load: str) -> None:
    scene = scene_of("6208").replace(dofs=dofs, **{load: 20.0})
    for sentence in (life(scene).sentence, equilibrium(scene, [0.0]).sentence):
        assert f"Other parts of the machine carry {load}, not this bearing." in sentence


@pytest.mark.parametrize("given", [np.zeros((2, 2)), [[0.1, 0.2]], np.zeros((1, 1, 1))])
def test_angles_that_are_no_row_are_refused(given: object) -> None:
    scene: Scene = presets["6205"]
    with pytest.raises(FieldError, match="an array of shape"):
        equilibrium(scene, given)  # type: ignore[arg-type]
    with pytest.raises(FieldError, match="an array of shape"):
        stiffness_maps(scene, given, [0.0])  # type: ignore[arg-type]
    assert equilibrium(scene, 0.1).cage_angles.shape == (1,)


@witness(
    "function: equilibrium",
    by="means over a period without its last angle, where all angles count alike",
    compared="k_xx of the fan rig, 16.872 MN/m, and displacements", within=1e-9,
)  # fmt: skip
def test_means_in_time_count_both_ends_of_a_period_once() -> None:
    """A periodic function's mean is that of equal steps, of which the end is the beginning."""
    state = equilibrium(presets["fan-rig"])
    open_ended = equilibrium(state.scene, state.cage_angles[:-1])
    for one in (state, open_ended):
        mean = one.stiffness_table()["per_m_x"][0]
        assert mean == pytest.approx(np.mean(state.term("k_xx")[:-1]), rel=1e-9)
    assert mean == pytest.approx(16.872e6, abs=500.0)
    own = state.displacement_table()["mean"]
    assert own == pytest.approx(state.displacement[:-1].mean(axis=0), rel=1e-9)
    assert static_ranges(state.scene).mean(state.term("k_xx")) == pytest.approx(mean, rel=1e-9)
    coarse = stiffness_maps(state.scene, [0.2], state.cage_angles)
    balls = equilibrium(state.scene.replace(extent=0.2)).loaded_balls[:-1].mean()
    assert coarse.mean_loaded_balls[0] == pytest.approx(balls, rel=1e-9)
