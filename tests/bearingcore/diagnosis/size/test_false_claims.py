"""Sizes that were once claimed and false: of measured records, and of a made signal."""

import dataclasses
import math
import os
from pathlib import Path

import pytest

from bearingcore import Load, Recording, Scene, Support, measure_extent, presets
from bearingcore.diagnosis.extent.measure import ExtentStatus, MeasuredExtent
from bearingcore.diagnosis.size.answer import AT_MOST, Sizing, SizingStatus
from bearingcore.diagnosis.size.judge import confirmed, judged
from bearingcore.diagnosis.size.sizing import _knocks, size_defect
from tests.bearingcore.diagnosis.extent.test_measure_extent import MOTOR, RATE, SPEED, signal
from tests.benchmarks.measured_records import records
from tests.helpers import recordings
from tests.helpers.recordings import RIG, noisy, signal_of

pytestmark = pytest.mark.proof

MEASURED = os.environ.get("MEASURED_RECORDS", "")


def guessed(bearing, speed: float, stiffness: float, damping: float, load: float) -> Scene:
    """A scene for a machine whose support is not known."""
    support = Support(2.0, 5.0, stiffness, stiffness, damping, damping)
    defect = presets["fan-rig"].replace(depth=100e-6).defect
    return Scene(bearing, defect, Load(fy=-load), speed, support, dofs=("x", "y"))


@pytest.fixture(scope="module")
def made() -> Sizing:
    """A spall of 6°, knocks 5° apart; with the support as if it were known."""
    recording = Recording(signal(), RATE, ("y",))
    scene = guessed(MOTOR, SPEED, 1e8, 5e3, 400.0)
    return size_defect(recording, scene, fault="outer race", support_known=True)


@pytest.fixture(scope="module")
def knocks() -> MeasuredExtent:
    """What its envelope says."""
    found = measure_extent(Recording(signal(), RATE, ("y",)), MOTOR, SPEED, race="outer")
    assert found.measured
    return found


def test_a_spall_is_not_called_a_pit_where_the_envelope_knocks_twice(made, knocks):
    """The search itself refuses it; a pit that it did claim would be refused for its knocks."""
    assert judged(made).status == made.status == SizingStatus.UNEXPLAINED
    assert not made.bound
    assert not made.conclusive
    claim = dataclasses.replace(made, status=AT_MOST)
    assert claim.end(AT_MOST) < math.radians(1.6)
    assert confirmed(claim, knocks).status == SizingStatus.TWO_KNOCKS
    assert made.status.sentence.endswith(".")


def test_entry_and_exit_have_to_bear_a_size_out(made, knocks):
    for extent_deg, status in ((6.0, SizingStatus.SIZED), (12.0, SizingStatus.UNCONFIRMED)):
        best = dataclasses.replace(made.best, extent=math.radians(extent_deg), probability=1.0)
        claim = dataclasses.replace(made, candidates=(best,), status=SizingStatus.SIZED)
        assert confirmed(claim, knocks).status == status
    silent = dataclasses.replace(knocks, status=ExtentStatus.ONE_KNOCK)
    assert confirmed(dataclasses.replace(made, status=AT_MOST), silent).status == AT_MOST


def test_a_load_that_no_ball_loses_in_a_spall_is_a_reason_and_no_error(made):
    crushing = made.best.scene.replace(load=Load(fy=-1e8))
    best = dataclasses.replace(made.best, scene=crushing)
    claim = dataclasses.replace(made, candidates=(best,), status=SizingStatus.SIZED)
    said = confirmed(claim, _knocks(claim, crushing))
    assert said.status == SizingStatus.UNCONFIRMED
    assert "load is 1e+08" in said.sentence


def test_without_the_support_a_spall_of_a_spacing_and_a_rest_has_no_size():
    """38.6° of the fan rig; with the support it has one, in `test_sizing`."""
    spall = RIG.replace(extent=math.radians(38.6))
    recording = Recording(noisy(signal_of(spall), 20.0), recordings.RATE)
    unknown = size_defect(recording, RIG, fault="outer race")
    assert unknown.status == SizingStatus.SUPPORT_NOT_MEASURED
    assert not unknown.candidates
    assert not unknown.conclusive
    assert not unknown.bound
    assert "measured masses and stiffness of the support" in unknown.sentence


@pytest.mark.skipif(not MEASURED, reason="MEASURED_RECORDS names no folder")
@pytest.mark.parametrize("name", ["OR2_600", "OR5_900", "OR8_900"])
def test_measured_spalls_are_given_nothing_that_is_not_so(name):
    """Of 2° it was 106.26° ± 0.06° with 95 %, of 5° "2.7° at most", of 8° "1.4° at most"."""
    (one,) = (one for one in records(Path(MEASURED, "hitsm")) if one.name == name)
    scene = guessed(one.bearing, one.shaft_speed, 3e8, 1e4, 100.0)
    found = size_defect(one.recording, scene, fault="outer race")
    assert found.status == SizingStatus.SUPPORT_NOT_MEASURED
    assert not found.conclusive
    assert not found.bound
