"""Extents from signals that another program made."""

import math

import numpy as np
import pytest

from bearingcore import Recording, presets, size_defect
from tests.outside.test_charts import RATE, exact
from tests.outside.witness import witness


@witness(
    "function: size_defect",
    by="vibration of the fan rig by SciPy's DOP853, with noise",
    compared="extent of the likeliest candidate, 12.9 and 38.6°", within="1°",
)  # fmt: skip
@pytest.mark.proof
@pytest.mark.parametrize("extent", [12.9, 38.6])
def test_extents_of_the_fan_rig(extent: float) -> None:
    signal = exact("fan-rig", 1.4, "published", math.radians(extent))
    noise = np.random.default_rng(4).standard_normal(signal.shape)
    recording = Recording(signal + 0.05 * signal.std(axis=0) * noise, RATE, ("x", "y"))
    rig = presets["fan-rig"].replace(extent=math.radians(5.0))
    found = size_defect(recording, rig, fault="outer race", support_known=True)
    best = max(found.candidates, key=lambda one: one.probability)
    assert math.degrees(best.extent) == pytest.approx(extent, abs=1.0)
