"""The error of a sizing by a scene's own signal: small where the signal tells, none elsewhere."""

import math

from bearingcore import presets
from bearingcore.diagnosis.size.sizing_error import extent_error

SCENE = presets["fan-rig"].replace(extent=math.radians(38.6), depth=50e-6, fy=-100.0)


def test_a_clear_signal_is_sized_to_a_degree() -> None:
    found = extent_error(SCENE)
    assert found.sizing.conclusive
    assert abs(math.degrees(found.error)) < 1.0
    assert found.error == found.sizing.best.extent - SCENE.defects[0].extent


def test_a_signal_under_noise_gives_no_number() -> None:
    found = extent_error(SCENE, noise=-30.0)
    assert math.isnan(found.error)
    assert "not clear" in found.sizing.sentence
