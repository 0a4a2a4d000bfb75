"""Bad input is refused in a sentence: the field, its value and what is allowed. What has no answer
is no bad input: it comes back as a status, never as an exception and never as a number.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from bearingcore import (
    DOF_NAMES,
    Bearing,
    Defect,
    Load,
    Scene,
    Support,
    contact_damping,
    equilibrium,
    modes,
    presets,
    simulate,
)
from bearingcore.model import _kernels as kernels
from tests.helpers.judge import verdict

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
NAN, INF = math.nan, math.inf


def refused(field: str, shown: str, act: Callable[[], object]) -> str:
    """Return the words on what is allowed, after checking that field and value are named."""
    with pytest.raises(ValueError, match=r"; allowed: .") as error:
        act()
    said = str(error.value)
    assert said.startswith(f"{field} is {shown}"), said
    return said.split("; allowed: ")[1]


@pytest.mark.parametrize(
    ("field", "value", "shown", "allowed"),
    [
        ("radial_clearance", -1.0, "-1", "at least -0.0"),
        ("radial_clearance", NAN, "nan", "finite"),
        ("radial_clearance", True, "True", "finite"),
        ("n_balls", 0, "0", "from 1"),
        ("n_balls", 7.5, "7.5", "whole number"),
        ("n_balls", True, "True", "whole number"),
        ("n_balls", 10**9, "1e+09", "500"),
        ("n_balls", 60, "60", "do not overlap"),
        ("contact_angle", math.radians(90.0), "1.5708", "80 degrees"),
        ("contact_angle", -0.1, "-0.1", "at least 0"),
        ("ball_diameter", 0.0, "0", "above 0"),
        ("ball_diameter", 0.04, "0.04", "pitch_diameter"),
        ("ball_diameter", "thick", "'thick'", "finite number"),
        ("groove_center_distance", -5e-5, "-5e-05", "above 0"),
        ("load_deflection_factor", 0.0, "0", "above 0"),
        ("load_deflection_factor", INF, "inf", "finite"),
        ("outer_raceway_radius", NAN, "nan", "finite"),
        ("inner_raceway_radius", 0.0227, "0.0227", "outer_raceway_radius"),
        # the defect
        ("extent", -0.1, "-0.1", "at least 0"),
        ("extent", 6.3, "6.3", "at most 6.28319"),
        ("depth", -1e-6, "-1e-06", "at least 0"),
        ("depth", 3.1e-3, "0.0031", "ball radius of 0.003 m"),
        ("center", INF, "inf", "finite"),
        ("race", "middle", "'middle'", "outer, inner"),
        ("edge", "round", "'round'", "published, chord, exact"),
        # the load
        ("fx", NAN, "nan", "finite"),
        ("fy", "heavy", "'heavy'", "finite number"),
        ("mx", None, "None", "finite number"),
        # the support
        ("inner_mass", 0.0, "0", "above 0"),
        ("outer_mass", -2.0, "-2", "above 0"),
        ("stiffness_z", -1.0, "-1", "above 0"),
        ("damping_y", -1.0, "-1", "at least 0"),
        ("damping_rx", NAN, "nan", "at least 0"),
        ("inner_inertia", 0.0, "0", "above 0"),
        # the scene
        ("shaft_speed", -1.0, "-1", "at least 0"),
        ("contact_damping", -1.0, "-1", "at least 0"),
        ("contact_law", "sticky", "'sticky'", "published, no tension"),
        ("dofs", ("x", "y", "rz"), "('x', 'y', 'rz')", "x, y, z, rx, ry"),
        ("dofs", (), "()", "x, y, z, rx, ry"),
        ("dofs", ("x", "x"), "('x', 'x')", "different names"),
        ("dofs", "theta", "('theta',)", "x, y, z, rx, ry"),
        ("support", "rubber", "'rubber'", "Support"),
    ],
)
def test_a_field_that_cannot_be(field: str, value: object, shown: str, allowed: str) -> None:
    assert allowed in refused(field, shown, lambda: LIEW_LIM.replace(**{field: value}))


@pytest.mark.parametrize("name", ["Fx", "", "displacement", "extent_deg"])
def test_a_field_that_does_not_exist(name: str) -> None:
    allowed = refused("name of a field", repr(name), lambda: LIEW_LIM.replace(**{name: 1.0}))
    for known in ("extent", "fy", "n_balls", "stiffness_x", "dofs"):
        assert known in allowed


def test_parts_refuse_on_their_own_too() -> None:
    refused("extent", "-1", lambda: Defect(-1.0, 0.0, 0.0))
    refused("edge", "'soft'", lambda: Defect(1.0, 1e-5, 0.0, edge="soft"))
    refused("fx", "nan", lambda: Load(fx=NAN))
    refused("damping_x", "-1", lambda: Support(1.0, 1.0, 1e8, 1e8, -1.0, 0.0))
    numbers = (9, 8e-3, 39e-3, 0.0, 19e-3, 5e-5, -5e-3, 1e10, 23e-3, 15e-3)
    refused("radial_clearance", "-0.005", lambda: Bearing(*numbers))
    deep = Defect(1.0, 5e-3, 0.0)
    refused("depth", "0.005", lambda: deep.path(0.0, LIEW_LIM.bearing))


def test_a_bad_number_does_not_hide_behind_a_good_one() -> None:
    """Of several defects each is checked."""
    good, deep = LIEW_LIM.defect, Defect(0.1, 4e-3, 0.0)
    refused("depth", "0.004", lambda: LIEW_LIM.replace(defect=(good, deep)))


def test_numbers_that_only_look_bad() -> None:
    """Values that a caller may mean: whole floats, NumPy numbers, integers, 360° as a decimal."""
    assert LIEW_LIM.replace(n_balls=12.0) == LIEW_LIM
    assert LIEW_LIM.replace(n_balls=np.int32(12), fy=np.float32(-2000.0)) == LIEW_LIM
    assert LIEW_LIM.replace(fy=-2000) == LIEW_LIM
    assert LIEW_LIM.replace(extent=6.2831853072).defect.extent == 2.0 * math.pi
    assert LIEW_LIM.replace(dofs=["ry", "x"]).dofs == ("x", "ry")
    assert LIEW_LIM.replace(depth=3e-3).defect.depth == 3e-3
    assert hash(LIEW_LIM.replace(defect=[LIEW_LIM.defect])) is not None


@pytest.mark.parametrize("function", [equilibrium, modes])
@pytest.mark.parametrize(
    "angles", [[0.0, NAN], [INF], NAN, "all", [[0.0], [1.0, 2.0]], [1j], object()]
)
def test_cage_angles_that_are_not_angles(function: Callable[..., object], angles: Any) -> None:
    with pytest.raises(ValueError, match=r"^cage_angles is .*; allowed: finite numbers"):
        function(LIEW_LIM, angles)


def test_the_least_sample_rate_is_twice_the_highest_natural_frequency() -> None:
    """The refusal names the rate that is enough, and just that one is."""
    allowed = refused("sample_rate", "1000", lambda: simulate(FAN_RIG, 0.01, 1000.0))
    enough = float(allowed.split()[2])
    highest = float(np.nanmax(modes(FAN_RIG).undamped_frequency))
    assert enough == pytest.approx(2.0 * highest, rel=2e-3)
    assert simulate(FAN_RIG, 0.01, enough + 1.0).completed
    refused("sample_rate", f"{enough - 1.0:g}", lambda: simulate(FAN_RIG, 0.01, enough - 1.0))


def test_a_shaft_that_stands_still_makes_no_motion() -> None:
    still = FAN_RIG.replace(shaft_speed=0.0)
    assert "above 0" in refused("shaft_speed", "0", lambda: simulate(still, 0.01))
    assert equilibrium(still).converged.all()


@pytest.mark.parametrize("function", [lambda scene: simulate(scene, 0.01), modes])
@pytest.mark.parametrize("missing", ["stiffness_z", "damping_rx", "inner_inertia"])
def test_a_support_that_is_not_known_where_it_is_needed(
    function: Callable[[Scene], object], missing: str
) -> None:
    unknown = LIEW_LIM.replace(**{missing: None})
    assert "free directions" in refused(missing, "None", lambda: function(unknown))
    assert equilibrium(unknown).converged.all()
    function(unknown.replace(dofs=("x", "y")))


@pytest.mark.parametrize(
    "scene",
    [
        FAN_RIG.replace(fy=0.0),
        LIEW_LIM.replace(fy=0.0, fz=0.0),
        LIEW_LIM.replace(dofs=("x", "rx")),
        FAN_RIG.replace(fy=0.0, radial_clearance=0.0),
    ],
    ids=["no load", "no load, five directions", "load only where it is held", "no clearance"],
)
def test_without_a_load_nothing_touches(scene: Scene) -> None:
    answer = equilibrium(scene)
    assert np.all(answer.status == kernels.NOTHING_TOUCHES)
    assert not answer.converged.any()
    assert answer.reason(0).startswith("nothing touches")
    assert np.isnan(answer.displacement).all()
    assert np.all(answer.ball_load == 0.0)
    assert verdict(answer, 0) == ""
    assert np.isnan(modes(scene).frequency).all()
    assert contact_damping(scene) == 0.0
    motion = simulate(scene, 0.001)
    assert not motion.completed
    assert motion.reason.startswith("no static state to start from: nothing touches")
    assert np.isnan(motion.outer_acceleration).all()


def test_free_directions_are_named_all_and_only() -> None:
    """Two loaded balls in five directions leave one motion free, of z and a tilt together."""
    scene = FAN_RIG.healthy().replace(radial_clearance=100e-6, fy=-1.0, dofs=DOF_NAMES)
    answer = equilibrium(scene, [1.5 * math.pi + 0.5 * scene.bearing.ball_spacing])
    assert answer.loaded_balls[0] == 2
    assert answer.reason(0) == "the ring can move without resistance along z, rx"
    assert np.array_equal(np.isnan(answer.displacement[0]), [False, False, True, True, False])
