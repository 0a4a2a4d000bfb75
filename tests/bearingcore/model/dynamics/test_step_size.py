"""Steps that the program takes see what longer ones miss, and steps that are too long say so."""

import math

import numpy as np
import pytest

from bearingcore import presets, simulate

FAN_RIG = presets["fan-rig"]
RATE = 65536.0


def test_a_step_longer_than_the_passage_misses_the_defect() -> None:
    """1° at 70 Hz is passed in 96 µs; ten steps a ball pass, 248 µs each, step right over it.

    The defect lies between the angles at which balls are looked at, so the march gives the healthy
    bearing's motion to the last digit, and says nothing. The steps taken by default are told by the
    passage: they see the defect, and finer ones see the same.
    """
    scene = FAN_RIG.replace(
        shaft_speed=2.0 * math.pi * 70.0,
        extent=math.radians(1.0),
        edge="exact",
        center=1.5 * math.pi + 0.25 * FAN_RIG.bearing.ball_spacing / 10.0,
    )
    # a ball stands at 270° whenever the cage has turned a multiple of half a step
    assert 1.5 * math.pi / scene.bearing.ball_spacing * 2 % 1 == pytest.approx(0.0, abs=1e-9)
    rate = 10.0 * scene.bearing.bpfo(scene.shaft_speed)
    passage = scene.defect.extent / scene.cage_speed
    assert 1.0 / rate > 2.5 * passage
    blind = simulate(scene, 0.1, rate, step_rate=rate).outer_acceleration
    healthy = simulate(scene.healthy(), 0.1, rate, step_rate=rate).outer_acceleration
    assert np.array_equal(blind, healthy)
    seen = simulate(scene, 0.1, RATE)
    healthy = simulate(scene.healthy(), 0.1, RATE)
    assert seen.step_rate > 20.0 / passage
    assert np.ptp(seen.outer_acceleration[:, 1]) > 3.0 * np.ptp(healthy.outer_acceleration[:, 1])
    finer = simulate(scene, 0.1, RATE, step_rate=4.0 * seen.step_rate).outer_acceleration
    level = np.sqrt(np.mean(finer**2))
    assert np.sqrt(np.mean((seen.outer_acceleration - finer) ** 2)) < 0.05 * level


@pytest.mark.parametrize(("load", "known"), [(2.0, False), (100.0, True)])
def test_bands_of_contacts_that_let_go_are_marked_where_steps_change_them(load, known):
    scene = FAN_RIG.replace(contact_law="no tension", fy=-load)
    motion = simulate(scene, 0.5, RATE)
    assert motion.completed
    assert motion.reason.startswith("completed; its contacts open") != known
    finer = simulate(scene, 0.5, RATE, step_rate=4.0 * motion.step_rate)
    apart = []
    for middle in 6000.0 * 2.0 ** -np.arange(0.0, 5.0, 1.0 / 3.0):
        low, high = 2.0 ** (-1.0 / 6.0) * middle, 2.0 ** (1.0 / 6.0) * middle
        power = [
            lines.density[(lines.frequency > low) & (lines.frequency < high)].sum()
            for lines in (motion.spectrum(since=0.25), finer.spectrum(since=0.25))
        ]
        apart.append(abs(10.0 * math.log10(power[0] / power[1])))
    assert (max(apart) < 1.0) == known
