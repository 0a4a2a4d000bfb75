"""Lengths of spalls by simulating each: statuses, refusals, and that an answer stays an answer."""

import dataclasses
import math

import numpy as np
import pytest

from bearingcore import Recording, modes, size_defect
from bearingcore.errors import FieldError
from bearingcore.model.scene import Scene
from bearingcore.sizing import Sizing, SizingStatus
from tests.helpers.recordings import RATE, RIG, noisy, signal_of

EXTENT = math.radians(47.3)
SIGNAL = noisy(signal_of(RIG.replace(extent=EXTENT)), 20.0)
RECORDING = Recording(SIGNAL, RATE)


@pytest.fixture(scope="module")
def sizing() -> Sizing:
    return size_defect(RECORDING, RIG, support_known=True)


def test_an_answer_has_what_a_picture_of_it_needs(sizing: Sizing) -> None:
    best, second = sizing.candidates[:2]
    assert sizing.status == SizingStatus.SIZED
    assert best.low < EXTENT < best.high
    assert best.extent == pytest.approx(EXTENT, abs=math.radians(0.1))
    assert best.ratio == 1.0 < second.ratio == pytest.approx(second.misfit / best.misfit)
    spacings = [abs(c.extent - best.extent) / RIG.bearing.ball_spacing for c in sizing.candidates]
    assert any(0.8 < count < 1.2 for count in spacings), "with the same entry and exit"
    assert best.bands == modes(RIG.replace(extent=best.extent)).bands() == modes(best.scene).bands()
    assert f"{math.degrees(best.extent):.1f}°" in sizing.sentence
    assert sizing.table()["extent"].tolist() == [c.extent for c in sizing.candidates]


def test_the_misfit_is_that_of_the_lines_it_comes_with(sizing: Sizing) -> None:
    """By the formula, written out: each direction of power 1."""
    for candidate in sizing.candidates:
        size = np.linalg.norm(sizing.lines, axis=0)
        measured, simulated = sizing.lines / size, candidate.lines / size
        alike = np.sum(np.conj(measured) * simulated).real
        alike /= math.sqrt(2.0 * np.sum(np.abs(simulated) ** 2))
        assert candidate.misfit == pytest.approx(1.0 - alike, abs=1e-9)
    near = np.abs(sizing.lines - sizing.candidates[0].lines).max() / np.abs(sizing.lines).max()
    assert near < 0.05, "the simulated lines are not scaled, and lie over the measured ones"


def test_one_direction_and_another_start_in_time_are_enough() -> None:
    late = size_defect(Recording(SIGNAL[777:, 1], RATE, ("y",)), RIG, support_known=True)
    assert late.best is not None
    assert late.best.extent == pytest.approx(EXTENT, abs=math.radians(0.2))


def test_a_changing_speed_that_was_measured_is_followed() -> None:
    """The signal of a steady shaft on a clock that runs 5 % fast and slow is as of such a shaft."""
    time = np.arange(len(SIGNAL)) / RATE
    pace = 2.0 * math.pi / time[-1]
    clock = time + 0.05 * (1.0 - np.cos(pace * time)) / pace
    warped = np.stack([np.interp(clock, time, column) for column in SIGNAL.T], axis=1)
    assert not size_defect(Recording(warped, RATE), RIG, support_known=True).conclusive
    measured = Recording(warped, RATE, shaft_angle=RIG.shaft_speed * clock)
    sizing = size_defect(measured, RIG, support_known=True)
    assert sizing.conclusive
    assert sizing.best.extent == pytest.approx(EXTENT, abs=math.radians(0.2))


@pytest.mark.parametrize(
    ("recording", "scene", "status"),
    [
        (RECORDING, RIG.replace(race="inner"), SizingStatus.INNER_RACE),
        (
            RECORDING,
            dataclasses.replace(
                RIG, defect=(RIG.defect, dataclasses.replace(RIG.defect, center=1.0))
            ),
            SizingStatus.SEVERAL_DEFECTS,
        ),
        (Recording(SIGNAL[:2000], RATE), RIG, SizingStatus.TOO_SHORT),
        (Recording(SIGNAL, 5000.0), RIG, SizingStatus.TOO_COARSE),
        (RECORDING, RIG.replace(shaft_speed=1000.0), SizingStatus.TOO_FAST),
    ],
    ids=str,
)
def test_what_cannot_be_sized_says_why(
    recording: Recording, scene: Scene, status: SizingStatus
) -> None:
    sizing = size_defect(recording, scene, support_known=True)
    assert sizing.status == status
    assert (sizing.candidates, sizing.best, sizing.sentence) == ((), None, status.sentence)


def test_a_machine_of_unknown_support_is_given_no_length() -> None:
    sizing = size_defect(RECORDING, RIG)
    assert sizing.status == SizingStatus.SUPPORT_UNKNOWN
    assert "stiffness of its support" in sizing.sentence


def test_progress_is_called_often_and_ends_the_search() -> None:
    parts: list[float] = []

    def progress(part: float, words: str) -> None:
        assert words.endswith("°")
        parts.append(part)
        if len(parts) == 5:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        size_defect(RECORDING, RIG, support_known=True, progress=progress)
    assert parts == sorted(parts)
    assert parts[-1] < 0.1


def test_refusals_name_the_field() -> None:
    with pytest.raises(FieldError, match="shaft_speed"):
        size_defect(RECORDING, RIG.replace(shaft_speed=0.0), support_known=True)
    with pytest.raises(FieldError, match="dofs"):
        size_defect(RECORDING, RIG.replace(dofs=("y",)), support_known=True)
    with pytest.raises(FieldError, match="stiffness"):
        size_defect(RECORDING, RIG.replace(stiffness_x=None), support_known=True)
