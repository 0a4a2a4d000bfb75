"""Sizing defects: of signals made here by another code path, and of scenes drawn by seed."""

import dataclasses
import math
import re
from functools import partial

import numpy as np
import pytest

from bearingcore import Defect, Scene, presets, simulate
from bearingcore.diagnosis.size.answer import AT_LEAST, AT_MOST, Sizing, SizingStatus
from bearingcore.diagnosis.size.judge import judged
from bearingcore.diagnosis.size.search import GREATEST_EXTENT, LEAST_EXTENT
from bearingcore.diagnosis.size.simulation import Simulator
from bearingcore.diagnosis.size.sizing import size_defect
from bearingcore.files.table import read_table
from bearingcore.signals.averaging import average_passes, coefficients
from bearingcore.signals.recording import Recording
from tests.benchmarks.sizing import FAMILIES, as_given, size_all
from tests.helpers.recordings import RATE, RIG, file_from_elsewhere, noisy, signal_of
from tests.helpers.simulated import pit, simulated_recording

pytestmark = pytest.mark.proof

sized_by = partial(size_defect, support_known=True)
"""Sizing where the scene's support is that of the machine."""

SPACING = RIG.bearing.ball_spacing


@pytest.fixture(scope="module")
def measured() -> tuple[Scene, bytes]:
    return file_from_elsewhere()


def test_a_file_from_elsewhere_is_sized(measured):
    truth, content = measured
    recording = read_table("rig.csv", content).recording(
        ["vertical", "horizontal"], ["y", "x"], "g"
    )
    sized = sized_by(recording, truth.replace(extent=1.0))
    assert math.degrees(sized.best.extent) == pytest.approx(47.3, abs=0.5)
    assert sized.best.turns == 1
    assert sized.best.probability > 0.9
    assert sized.conclusive
    assert abs(sized.best.extent - truth.defect.extent) < 4.0 * sized.extent_uncertainty
    # the clock runs 0.1 % fast, so balls pass 0.1 % more often than the shaft speed says
    nominal = truth.bearing.bpfo(truth.shaft_speed)
    assert sized.passes.frequency == pytest.approx(1.001 * nominal, rel=1.5e-4)


def test_in_another_unit_it_says_so(measured):
    truth, content = measured
    recording = read_table("rig.csv", content).recording([1, 2], ["x", "y"], "m/s²")
    sized = sized_by(recording, truth)
    assert not sized.conclusive
    assert "20 dB weaker" in sized.sentence
    assert "unit" in sized.sentence


@pytest.fixture(scope="module")
def paper() -> dict[float, Sizing]:
    """The paper's two defects, a ball spacing apart, at 20 dB; the extent told is a third one."""
    return {
        extent: sized_by(
            Recording(noisy(signal_of(RIG.replace(extent=math.radians(extent))), 20.0), RATE),
            RIG.replace(extent=math.radians(80.0)),
        )
        for extent in (12.9, 38.6)
    }


@pytest.mark.parametrize(("extent", "turns"), [(12.9, 0), (38.6, 1)])
def test_the_paper_s_two_defects_are_told_apart(paper, extent, turns):
    sized = paper[extent]
    assert math.degrees(sized.best.extent) == pytest.approx(extent, abs=0.3)
    assert (sized.best.turns, sized.conclusive) == (turns, True)
    assert sum(c.probability for c in sized.candidates) == pytest.approx(1.0)
    assert f"{turns} whole" in sized.sentence
    assert "unexplained" not in sized.sentence
    extents = [c.extent for c in sized.candidates]
    assert extents == sorted(extents)
    assert len(extents) >= 4
    away, stated = sized.best.extent - math.radians(extent), sized.extent_uncertainty
    assert abs(away) < 4.0 * stated < math.radians(1.2)


@pytest.mark.parametrize(
    ("changes", "best", "status", "words"),
    [
        ({}, {"waveform_misfit": np.array([0.4, 0.6])}, SizingStatus.UNEXPLAINED, "leaves 50 %"),
        ({"quality": {"strongest": 0.8, "harmonics": 1.5}}, {}, SizingStatus.ONE_TONE, "80 %"),
        ({"apart": math.radians(3.0)}, {}, SizingStatus.WIDE, "from 10° to 16°"),
        ({"apart": math.radians(2.0)}, {}, SizingStatus.SIZED, ""),
        ({}, {"extent": LEAST_EXTENT}, AT_MOST, "at most: shorter ones cannot"),
        ({}, {"extent": GREATEST_EXTENT}, AT_LEAST, "at least"),
        # as a ball enters another leaves: a spall of a whole spacing knocks like a pit
        ({}, {"extent": SPACING + math.radians(0.8)}, SizingStatus.LIKE_A_PIT, "a pit shorter"),
        ({}, {"extent": SPACING - math.radians(0.8)}, SizingStatus.LIKE_A_PIT, "a pit shorter"),
        ({}, {"extent": SPACING + math.radians(6.0)}, SizingStatus.SIZED, ""),
    ],
)
def test_answers_are_refused_or_bounds_where_the_signal_does_not_say(
    paper, changes, best, status, words
):
    sized = paper[12.9]
    if "quality" in changes:
        changes = {"quality": dataclasses.replace(sized.quality, **changes["quality"])}
    changed = dataclasses.replace(sized.best, **best)
    others = [c for c in sized.candidates if c is not sized.best]
    claim = dataclasses.replace(sized, candidates=(changed, *others), **changes)
    answer = judged(claim)
    assert answer.status == status
    assert words in answer.sentence


def test_no_size_is_looked_for_where_another_part_is_accused_or_none():
    """Noise, and a signal of an inner race: knocks at 8.28 times the shaft, louder in its turn."""
    rng = np.random.default_rng(5)
    noise = Recording(rng.standard_normal((round(2.0 * RATE), 1)), RATE, ("y",))
    sized = sized_by(noise, RIG.replace(shaft_speed=2.0 * math.pi * 20.0))
    assert sized.candidates == ()
    assert not sized.conclusive
    assert sized.diagnosis is not None
    assert sized.status == SizingStatus.OTHER_PART
    assert sized.sentence == sized.diagnosis.sentence
    with pytest.raises(ValueError, match=re.escape(sized.sentence[:20])):
        _ = sized.best
    assert len(sized.table()["extent"]) == 0


def test_only_outer_races_can_be_told_by_hand():
    noise = Recording(np.random.default_rng(5).standard_normal((40_000, 1)), RATE, ("y",))
    with pytest.raises(ValueError, match="fault is 'inner race'; allowed: outer race"):
        sized_by(noise, RIG, fault="inner race")


def test_what_is_no_defect_s_signal_is_not_sized():
    rig = RIG.replace(shaft_speed=2.0 * math.pi * 20.0)
    noise = np.random.default_rng(4).standard_normal((20_000, 2))
    sized = sized_by(Recording(noise, RATE), rig)
    assert not sized.conclusive
    assert sized.candidates == ()
    insisted = sized_by(Recording(noise, RATE), rig, fault="outer race")
    assert not insisted.conclusive
    assert "no lines stand out" in insisted.sentence
    still = Recording(noisy(signal_of(rig.healthy()), 20.0), RATE)
    elsewhere = rig.replace(shaft_speed=1.07 * rig.shaft_speed)
    assert not sized_by(still, rig, fault="outer race").conclusive
    moved = Recording(signal_of(rig), RATE)
    assert not sized_by(moved, elsewhere, fault="outer race").conclusive


@pytest.mark.parametrize(
    ("scene", "told"),
    [
        (RIG.replace(race="inner"), "race is 'inner'"),
        (RIG.replace(depth=0.0), "depth is 0"),
        (RIG.replace(shaft_speed=0.0), "shaft_speed is 0"),
        (RIG.replace(dofs=("y",)), "dofs is .*with x"),
        (RIG.replace(defect=(RIG.defect, Defect(0.1, 5e-5, 1.0))), "2 defects"),
    ],
)
def test_scenes_that_are_not_fit_are_refused(scene, told):
    with pytest.raises(ValueError, match=told):
        sized_by(Recording(signal_of(RIG), RATE), scene)


def test_signals_that_are_too_short_or_too_slow_are_refused():
    signal = signal_of(RIG)
    with pytest.raises(ValueError, match=r"signal is 'of 0.195 s'.*ball passes"):
        sized_by(Recording(signal[:4000], RATE), RIG)
    with pytest.raises(ValueError, match="sample_rate is 1000"):
        sized_by(Recording(signal, 1000.0), RIG)


def test_averages_find_the_frequency_and_lose_the_noise():
    """A known waveform at a known rate, 2 dB of noise: coefficients within their own scatter."""
    rng = np.random.default_rng(8)
    frequency, order = 41.037, np.arange(1, 41)
    time = np.arange(30_000) / RATE
    size = rng.standard_normal((40, 2)) + 1j * rng.standard_normal((40, 2))
    turn = np.exp(2j * math.pi * frequency * time[:, None] * order)
    clean = 2.0 * (turn @ size).real
    found = average_passes(noisy(clean, 2.0), RATE, 40.8, 0.02, 30.0, 1700.0, 1700.0)
    assert found.frequency == pytest.approx(frequency, rel=3e-5)
    error = np.abs(found.harmonics[3:40] - size[3:])
    expected = np.sqrt(found.scatter[3:40])
    assert np.mean(error**2 < 9.0 * (expected**2 + 0.02**2)) > 0.97
    assert found.prominence > 10.0


def marched(scene, frequency, count, columns) -> np.ndarray:
    """Harmonics of ball passes by `simulate`, of a long motion with fine steps."""
    n, settle, passes = 600, 90, 30
    nominal = scene.bearing.bpfo(scene.shaft_speed)
    scene = scene.replace(shaft_speed=scene.shaft_speed * frequency / nominal)
    rate = n * frequency
    motion = simulate(scene, (settle + passes) / frequency, rate, step_rate=rate)
    signal = motion.outer_acceleration[settle * n :, list(columns)]
    return coefficients(signal.reshape(passes, n, len(columns)), count).mean(axis=0)


def test_scenes_drawn_by_seed_are_sized_as_the_proof_says():
    """A small part of `python -m tests.benchmarks.sizing given`, with room for bad luck."""
    answers = list(size_all(partial(as_given, FAMILIES["given"], noises=(20.0,)), 8))
    right = [a for a in answers if a.kind == "right, 20 dB"]
    wrong = [a for a in answers if a not in right]
    assert len(right) == 8
    assert len(wrong) >= 8
    assert sum(a.right_turns for a in right) >= 7
    assert sum(a.right_extent for a in right) >= 7
    assert sum(a.right_turns for a in wrong) >= 0.8 * len(wrong)
    assert sum(a.right_extent for a in wrong) >= 0.7 * len(wrong)
    sure = [a for a in answers if a.conclusive]
    assert sum(a.right_turns for a in sure) >= 0.9 * len(sure)
    # whole ball spacings long, a defect looks like a pit and none is sized
    like_a_pit = [a for a in answers if _from_whole_spacings(a.truth) < 2.0]
    assert not any(a.conclusive for a in like_a_pit)
    assert len(sure) >= 0.7 * (len(answers) - len(like_a_pit))


def _from_whole_spacings(extent: float) -> float:
    """How far [deg] an extent is from one, two, ... ball spacings of the fan rig."""
    spacing = math.degrees(presets["fan-rig"].bearing.ball_spacing)
    return abs(extent - max(round(extent / spacing), 1) * spacing)


def apart(one, other) -> float:
    """Power of the difference of two passes, as a share of the first one's."""
    return float((np.abs(one - other) ** 2).sum() / (np.abs(one) ** 2).sum())


def test_a_simulator_gives_the_passes_of_a_motion():
    """Extent and edge changed in the kernels' structs: the pass of the scene changed so."""
    frequency = RIG.bearing.bpfo(RIG.shaft_speed)
    simulator = Simulator(RIG, frequency, 40, (0, 1))
    for edge in ("published", "exact"):
        extent = math.radians(31.0)
        passes = simulator.passes(extent, edge)
        scene = RIG.replace(extent=extent, edge=edge)
        assert apart(marched(scene, frequency, 40, (0, 1)), passes.harmonics) < 2e-3


def test_short_pits_are_stepped_finely_enough():
    """A pit of half a step of the usual ones against steps twelve times as many."""
    frequency = RIG.bearing.bpfo(RIG.shaft_speed)
    passes = [
        Simulator(RIG, frequency, 60, (0, 1), steps).passes(math.radians(0.3), "exact")
        for steps in (9.0, 400.0)
    ]
    assert apart(passes[1].harmonics, passes[0].harmonics) < 0.02


@pytest.mark.parametrize(("speed", "bounded"), [(9.0, False), (30.0, True)])
def test_a_pit_is_sized_where_its_edges_are_resolved_and_bounded_elsewhere(speed, bounded):
    """0.4 mm, 0.86°, of balls with mass, whose edges are others than those that are told."""
    rig = RIG.replace(shaft_speed=2.0 * math.pi * speed)
    truth = pit(rig, 0.4e-3)
    recording = simulated_recording(rig.replace(defect=truth), 1.0, 40_960.0, with_mass=True)
    sized = sized_by(recording, rig, fault="outer race")
    if bounded:
        assert (sized.bound, sized.conclusive) == ("at most", False)
        assert truth.extent < sized.end(sized.bound) < math.radians(3.0)
    else:
        assert sized.conclusive
        assert sized.best.extent == pytest.approx(truth.extent, abs=math.radians(0.08))
