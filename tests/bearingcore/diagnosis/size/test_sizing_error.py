"""The error of a sizing by a scene's own signal: small where the signal tells, none elsewhere."""

from __future__ import annotations

import math

import pytest

from bearingcore import Defect, presets
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


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"extent": 0.0}, "extent"),
        ({"depth": 0.0}, "depth"),
        ({"race": "inner"}, "race"),
        ({"defect": (Defect(0.1, 1e-5, 1.0), Defect(0.1, 1e-5, 3.0))}, "defect"),
    ],
)
def test_what_cannot_be_sized_is_refused_by_name(change: dict, field: str) -> None:
    with pytest.raises(ValueError, match=field):
        extent_error(SCENE.replace(**change))


def test_progress_may_end_it() -> None:
    class EndError(Exception):
        pass

    def end(_: float) -> None:
        raise EndError

    with pytest.raises(EndError):
        extent_error(SCENE, progress=end)
