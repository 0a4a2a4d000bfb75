"""Simulated measurements of small pits, with balls that have mass."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore import Load, presets, spectrum
from bearingcore.scene.pit import pit
from tests.helpers.simulated import simulated_recording

CWRU = presets["6205"].replace(
    load=Load(fy=-400.0), shaft_speed=1796 * math.pi / 30.0, contact_damping=300.0
)


@pytest.mark.parametrize(
    ("length_mm", "extent_deg", "sinks_um"),
    [(0.178, 0.434, 0.83), (0.356, 0.867, 3.31), (0.533, 1.301, 7.45)],
)
def test_pits_as_machines_have_them(length_mm: float, extent_deg: float, sinks_um: float) -> None:
    """Seeded pits of the 6205: how long in degrees, how deep a ball sinks, which bridges them."""
    made = pit(CWRU, 1e-3 * length_mm)
    assert math.degrees(made.extent) == pytest.approx(extent_deg, abs=2e-3)
    deepest = float(made.path([made.center], CWRU.bearing)[0])
    assert deepest * 1e6 == pytest.approx(sinks_um, rel=0.02)
    assert deepest < made.depth


def test_what_mass_adds_to_a_small_pit_lies_above_20_khz() -> None:
    """0.533 mm under load: below 10 kHz the step and the strike are those of massless balls.

    The contacts hardly open, as the ball sinks less than it is compressed; what mass adds lies near
    the contact resonance of 40 kHz.
    """
    scene = CWRU.replace(defect=pit(CWRU, 0.533e-3))

    def levels(with_mass: bool) -> np.ndarray:
        recording = simulated_recording(scene, 0.25, with_mass=with_mass)
        frequency, density = spectrum(recording.acceleration[:, 1], recording.sample_rate)
        bands = ((300.0, 2100.0), (2100.0, 1e4), (2e4, 3.2e4))
        return np.array(
            [
                10.0 * math.log10(density[(frequency >= low) & (frequency < high)].sum())
                for low, high in bands
            ]
        )

    added = levels(True) - levels(False)
    assert np.abs(added[:2]).max() < 0.5
    assert added[2] > 1.0


def test_a_pit_has_a_length() -> None:
    with pytest.raises(ValueError, match="length"):
        pit(CWRU, 0.0)
