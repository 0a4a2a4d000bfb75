"""Sizes of defects of rigs drawn by seed, in noise, the given scene off in one thing or in none."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

from bearingcore import Recording, Scene, contact_damping, presets, simulate, size_defect

RIG = presets["fan-rig"]
SPACING = math.degrees(RIG.bearing.ball_spacing)
RATE = 20_480.0


def _damping(scene: Scene, factor: float) -> Scene:
    support = scene.support
    return scene.replace(
        contact_damping=contact_damping(scene) * factor,
        damping_x=support.damping_x * factor,
        damping_y=support.damping_y * factor,
    )


def _stiffness(scene: Scene, factor: float) -> Scene:
    return scene.replace(
        load_deflection_factor=scene.bearing.load_deflection_factor * factor,
        stiffness_x=scene.support.stiffness_x * factor,
        stiffness_y=scene.support.stiffness_y * factor,
        contact_damping=contact_damping(scene),
    )


def _load(scene: Scene, factor: float) -> Scene:
    return scene.replace(fy=scene.load.fy * factor, contact_damping=contact_damping(scene))


#: how the truth differs from what the method is given
WRONG: dict[str, Callable[[Scene], Scene]] = {
    "edges": lambda scene: scene.replace(edge="chord"),
    "damping half": lambda scene: _damping(scene, 0.5),
    "stiffness -10 %": lambda scene: _stiffness(scene, 0.9),
    "load -20 %": lambda scene: _load(scene, 0.8),
    "depth -30 %": lambda scene: scene.replace(depth=0.7 * scene.defect.depth),
    "all at once": lambda scene: _load(
        _stiffness(_damping(scene.replace(edge="exact"), 2.0), 0.9), 1.2
    ),
}


class Answer(NamedTuple):
    """Angles in degrees; `room`: how far an extent may be off."""

    kind: str
    truth: float
    extent: float
    room: float
    conclusive: bool

    @property
    def right_turns(self) -> bool:
        """Whether the extent lies within half a ball spacing of the truth, said or not."""
        return abs(self.extent - self.truth) < 0.5 * SPACING

    @property
    def right_extent(self) -> bool:
        return abs(self.extent - self.truth) <= self.room


def answers_of(number: int, kinds: tuple[str, ...]) -> list[Answer]:
    """A rig with extents of 3-100°, 5-30 Hz, 60-1000 N, 15-200 µm, and balls that slip; 20 dB.

    Its outer race is known to be damaged; the extent is not looked at.
    """
    rng = np.random.default_rng([2014, number])
    given = RIG.replace(
        extent=math.radians(rng.uniform(3.0, 100.0)),
        fy=-math.exp(rng.uniform(math.log(60.0), math.log(1000.0))),
        shaft_speed=2.0 * math.pi * rng.uniform(5.0, 30.0),
        depth=math.exp(rng.uniform(math.log(15e-6), math.log(200e-6))),
    )
    slip, extent = rng.uniform(-0.01, 0.01), math.degrees(given.defect.extent)
    answers = []
    for kind in kinds:
        truth = WRONG[kind](given) if kind else given
        start = round(rng.uniform(0.2, 0.4) * RATE)
        turning = truth.replace(shaft_speed=truth.shaft_speed * (1.0 + slip))
        signal = simulate(turning, 1.4 + start / RATE, RATE).outer_acceleration[start:]
        level = 0.1 * math.sqrt(float(np.mean(signal**2)))
        recording = Recording(signal + level * rng.standard_normal(signal.shape), RATE)
        scene = given.replace(extent=0.5)
        found = size_defect(recording, scene, fault="outer race", support_known=True)
        best = math.degrees(found.best.extent)
        answers.append(Answer(kind, extent, best, max(1.0, 0.05 * extent), found.conclusive))
    return answers


DRAWN = {
    0: ("", "edges", "depth -30 %"),
    7: ("", "damping half"),
    11: ("", "stiffness -10 %"),
    12: ("", "load -20 %", "all at once"),
    16: ("",),
}
"""Rigs with 92, 21, 9, 57 and 51°, the last of which is two ball spacings: as a pit."""


@pytest.mark.proof
def test_rigs_drawn_by_seed_are_sized() -> None:
    answers = [one for k, kinds in DRAWN.items() for one in answers_of(k, kinds)]
    like_a_pit = [a for a in answers if abs(a.truth / SPACING - round(a.truth / SPACING)) < 0.05]
    assert len(like_a_pit) == 1
    assert not any(a.conclusive for a in like_a_pit)
    for a in answers:
        assert a.right_turns, a
        assert a.right_extent or (a.kind and not a.conclusive), a
        assert a.conclusive or a.kind or a in like_a_pit, a
    assert any(a.conclusive for a in answers if a.kind)
