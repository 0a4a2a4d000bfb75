"""Origins of speed and bearing are said as they are, and no part is named without a bearing."""

import numpy as np
import pytest

from bearingcore import Recording, diagnose, presets
from bearingcore.measured.diagnosis import DiagnosisStatus
from bearingcore.measured.diagnosis._part.mains import WITHIN, magnetic_share

BEARING = presets["6205"].bearing
NOISE = Recording(np.random.default_rng(8).standard_normal(24_000), 12_000.0, ("y",))


def test_origins_are_said_and_given_is_only_what_is_given():
    diagnosis = diagnose(NOISE, BEARING, 150.0)
    assert (diagnosis.speed_source, diagnosis.bearing_source) == ("given", "given")
    assert "assumed" not in diagnosis.sentence
    diagnosis = diagnose(
        NOISE, BEARING, 150.0,
        speed_source="assumed: the scene's", bearing_source="assumed: the scene's",
    )  # fmt: skip
    assert "turns a minute (assumed: the scene's)" in diagnosis.sentence
    assert "Bearing assumed: the scene's." in diagnosis.sentence
    assert "given" not in diagnosis.sentence
    diagnosis = diagnose(NOISE, BEARING, (149.0, 151.0), speed_source="from the file")
    assert diagnosis.speed_source == "from the file as a range, its middle"
    assert diagnosis.shaft_speed == pytest.approx(150.0)


def test_without_a_bearing_no_part_is_named_and_it_is_asked_for():
    diagnosis = diagnose(NOISE, None, 150.0)
    assert diagnosis.status == DiagnosisStatus.BEARING_OPEN
    assert not diagnosis.conclusive
    assert diagnosis.bearing_source == "unknown"
    assert "depends on the bearing, which is not known" in diagnosis.sentence


def test_the_share_of_magnetic_noise_falls_with_the_distance_from_twice_the_mains():
    """Bayes by hand: exponential against uniform, as probable before; EN 50160's 1 %."""
    scale = 0.01 / np.log(200.0)
    for frequency, middle in ((100.0, 100.0), (100.4, 100.0), (119.2, 120.0)):
        away = abs(frequency / middle - 1.0)
        magnetic = np.exp(-away / scale) / (2.0 * scale)
        share = magnetic_share(frequency, 0.0, 0.02)
        assert share == pytest.approx(magnetic / (magnetic + 1.0 / 0.04), rel=1e-9)
    assert magnetic_share(100.0 * (1.0 + 1.01 * WITHIN), 0.0, 0.02) == 0.0
    assert magnetic_share(100.5, 0.5, 0.02) == magnetic_share(100.0, 0.0, 0.02)
