"""Values of a wrong type: a TypeError that names the field and says what is wanted."""

from collections.abc import Callable

import numpy as np
import pytest

import bearingcore as core
from bearingcore.bearings import Row, bearing_of
from bearingcore.common import _checks as checks
from bearingcore.errors import FieldError
from bearingcore.model.dynamics import to_ross

SCENE = core.presets["6205"]
BEARING = SCENE.bearing
RECORDING = core.Recording(np.random.default_rng(1).normal(size=(4096, 1)), 4096.0, ("y",))
NOT_A_SCENE = ("scene", 'a Scene, such as scene_of("6205")')
WRONG: list[tuple[Callable[[], object], str, str]] = [
    *(
        (lambda of=of: of("6205"), *NOT_A_SCENE)
        for of in (
            core.equilibrium, core.modes, core.frequency_bands, core.contact_damping, core.orbit,
            core.simulate, core.life, core.limits, core.stiffness_maps, core.contact_pressures,
            core.ball_positions, core.static_state,
        )
    ),
    (lambda: core.film(BEARING, viscosity=0.01), *NOT_A_SCENE),
    (lambda: to_ross(None, [100.0]), *NOT_A_SCENE),
    (lambda: core.size_defect(RECORDING, BEARING), *NOT_A_SCENE),
    (lambda: core.size_defect(SCENE, SCENE), "recording", "a Recording"),
    (lambda: core.measure_extent([1.0], BEARING, 100.0), "recording", "a Recording"),
    (lambda: core.indicators(np.zeros(4096)), "recording", "a Recording"),
    (lambda: core.diagnose(np.zeros(4096), BEARING, 100.0), "recording", "a Recording"),
    (lambda: core.trend([1.0], BEARING, 100.0, direction="y"), "recordings", "of Recording"),
    (lambda: core.diagnose(RECORDING, 6205, 100.0), "bearing", "a designation"),
    (lambda: core.diagnose(RECORDING, SCENE, 100.0), "bearing", "a designation"),
    (lambda: core.dynamic_load_rating(None), "bearing", "a designation"),
    (lambda: core.read_designation(6205), "designation", "text"),
    (lambda: core.diagnose(RECORDING, BEARING, "fast"), "shaft_speed", "a finite number"),
    (lambda: core.simulate(SCENE, "long"), "duration", "a finite number"),
    (lambda: core.Load(fy="abc"), "fy", "a finite number"),
    (lambda: core.Load(fy=None), "fy", "a finite number"),
    (lambda: SCENE.replace(bearing=6205), "bearing", "a designation"),
    (lambda: SCENE.replace(defect=0.2), "defect", "a Defect"),
    (lambda: SCENE.replace(load=(0.0, -100.0)), "load", "a Load"),
    (lambda: SCENE.replace(defect={}), "defect", "a Defect"),
    *((lambda name=name: SCENE.replace(**{name: "1"}), name, "number") for name in (
        "fy", "shaft_speed", "extent", "row", "n_balls", "density", "inner_mass",
    )),
    (lambda: SCENE.replace(depth=b"1"), "depth", "a finite number"),
    (lambda: SCENE.replace(fy=np.bool_(True)), "fy", "a finite number"),
    (lambda: BEARING.replace(estimated=1), "estimated", "n_balls"),
    (lambda: Row(facing="1"), "facing of a row", "a whole number"),
    (lambda: SCENE.replace(contact_law=3), "contact_law", "published"),
    (lambda: core.equilibrium(SCENE, "all"), "cage_angles", "finite numbers"),
    (lambda: checks.whole_number("n", "abc", at_least=1, at_most=9), "n", "a whole number"),
]  # fmt: skip


@pytest.mark.parametrize(("call", "field", "wanted"), WRONG)
def test_a_wrong_type_is_refused_by_name(
    call: Callable[[], object], field: str, wanted: str
) -> None:
    with pytest.raises(TypeError) as caught:
        call()
    assert isinstance(caught.value, FieldError)
    assert isinstance(caught.value, ValueError), "who catches what a value was refused for"
    assert caught.value.field == field
    assert wanted in caught.value.allowed_text


def test_a_number_out_of_range_is_no_matter_of_type() -> None:
    for call in (lambda: core.Load(fy=float("nan")), lambda: BEARING.replace(n_balls=-1)):
        with pytest.raises(ValueError, match="allowed") as caught:
            call()
        assert not isinstance(caught.value, TypeError)


def test_a_bearing_may_be_given_by_its_number() -> None:
    named = core.read_designation("6205-2RS/C3")
    assert bearing_of("6205-2RS/C3") == bearing_of(named) == bearing_of(named.entry)
    listed = core.catalogue()["6205-2RS, CWRU drive end"]
    assert bearing_of("6205-2RS, CWRU drive end") == bearing_of(listed) == listed.bearing
    assert SCENE.replace(bearing="6206").bearing == core.read_designation("6206").bearing
    changed = SCENE.replace(bearing="6206", radial_clearance=4e-6).bearing
    assert changed == core.read_designation("6206").bearing.replace(radial_clearance=4e-6)
    with pytest.raises(ValueError, match="designation is 'fan-rig'; allowed: a bearing of the ser"):
        bearing_of("fan-rig")
