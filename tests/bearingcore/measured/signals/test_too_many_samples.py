"""Samples are counted before anything is done with them."""

import numpy as np
import pytest

from bearingcore import diagnose, presets
from bearingcore.common import thousands
from bearingcore.measured.diagnosis import CANNOT_TELL, DiagnosisStatus
from bearingcore.recordings import Recording

RIG = presets["fan-rig"]


@pytest.fixture
def signal() -> Recording:
    return Recording(np.random.default_rng(1).normal(size=(20_000, 2)), 20_000.0)


def test_a_diagnosis_of_too_many_samples_is_not_begun_and_says_so(
    signal: Recording, monkeypatch: pytest.MonkeyPatch
) -> None:
    def begun(*_: object) -> None:
        raise AssertionError("it was begun")

    monkeypatch.setattr("bearingcore.measured.diagnosis._part.diagnose.ListenedSignal", begun)
    diagnosis = diagnose(signal, RIG.bearing, 260.0, most_samples=39_999)
    assert diagnosis.fault == CANNOT_TELL
    assert diagnosis.status == DiagnosisStatus.TOO_LONG
    assert diagnosis.sentence == (
        f"No clear result: too many samples: {thousands(40_000)}, allowed are most_samples = "
        f"{thousands(39_999)}."
    )
    with pytest.raises(AssertionError, match="it was begun"):
        diagnose(signal, RIG.bearing, 260.0, most_samples=40_000)
    with pytest.raises(ValueError, match="most_samples"):
        diagnose(signal, RIG.bearing, 260.0, most_samples=0)
