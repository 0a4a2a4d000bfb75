"""Random scenes with centrifugal load: ``python -m tests.benchmarks.random_balls``.

None may be wrong silently. Each answer is judged by sums that share nothing with the solver
(`tests.two_contacts`): what is left on every ball and on the ring. Prints how many converged, how
many said why not, and every answer that is wrong without saying so; ends with status 1 where there
is one.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections import Counter

import numpy as np

from bearingcore import Bearing, Defect, Load, Scene, kernels, presets
from bearingcore.statics.ball_positions import BallPositions, ball_positions
from tests.benchmarks.machine import pace
from tests.two_contacts import TwoContacts

TOLERANCE = 1e-7
"""Unbalanced load over the greatest load, from which on an answer counts as wrong."""


def random_scene(rng: np.random.Generator) -> Scene:
    """Any bearing, defects in either race, load, speed: light and heavy, slow and very fast."""
    n_balls = int(rng.integers(5, 25))
    D_b = 10.0 ** rng.uniform(-2.5, -1.4)
    D_p = D_b * max(n_balls / math.pi * rng.uniform(1.08, 1.8), 2.0)
    bearing = Bearing.from_drawing(
        n_balls,
        D_b,
        D_p,
        rng.uniform(0.505, 0.56) * D_b,
        rng.uniform(0.505, 0.56) * D_b,
        contact_angle=rng.choice([0.0, rng.uniform(0.0, 0.9)]),
    ).replace(radial_clearance=rng.choice([0.0, rng.uniform(0.0, 2e-3) * D_b]))
    heading = rng.uniform(0.0, 2.0 * math.pi)
    size = 10.0 ** rng.uniform(0.0, 4.5)
    share = rng.choice([0.0, rng.uniform(0.0, 2.0)])
    defects = tuple(
        Defect(
            rng.uniform(0.01, 0.6),
            rng.uniform(0.0, 0.03) * D_b,
            heading + 2.0 * race + rng.uniform(-0.5, 0.5),
            ("outer", "inner")[race],
            str(rng.choice(["published", "chord", "exact"])),
        )
        for race in range(int(rng.integers(0, 3)))
    )
    return Scene(
        bearing=bearing,
        defect=defects,
        load=Load(size * math.cos(heading), size * math.sin(heading), share * size),
        shaft_speed=10.0 ** rng.uniform(0.0, 3.3),
        support=presets["fan-rig"].support,
        dofs=[None, ("x", "y"), ("x", "y", "z")][int(rng.integers(3))],
    )


def faults(found: BallPositions, i: int, *, weights: tuple[bool, ...] = (False, True)) -> str:
    """What is wrong with a cage angle's answer, "" for nothing: right, or said not to be."""
    if found.status[i] not in (kernels.CONVERGED, kernels.FREE_DIRECTION):
        silent = np.isfinite(found.load[:, i]).any() and found.status[i] >= kernels.NOT_CARRIED
        return "numbers without an answer" if silent else ""
    scene = found.scene
    if found.status[i] == kernels.FREE_DIRECTION:
        known = np.isfinite(found.displacement[i]).all()
        return "a free direction with a displacement" if known else ""
    sums = TwoContacts(
        scene, found.cage_angles[i], found.displacement[i], np.zeros(5), found.position[i]
    )
    size = max(float(found.load[:, i].max()), float(np.linalg.norm(scene.load.vector[:3])))
    left = min(
        float(np.abs(sums.on_balls(centrifugal=found.centrifugal_load, weight=w)).max())
        for w in weights
    )
    lever = np.array([1.0, 1.0, 1.0, *[scene.bearing.groove_center_radius] * 2])
    free = [("x", "y", "z", "rx", "ry").index(dof) for dof in found.dofs]
    ring = float(np.abs((sums.force(0) - scene.load.vector) / lever)[free].max())
    if left > TOLERANCE * size:
        return f"{left:.2e} N left on a ball, of {size:.2e} N"
    if ring > TOLERANCE * size:
        return f"{ring:.2e} N left on the ring, of {size:.2e} N"
    return ""


def main() -> int:
    """Run and print; see the head of the module."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    outcomes: Counter[str] = Counter()
    wrong = 0
    begin = time.perf_counter()
    for number in range(arguments.scenes):
        scene = random_scene(rng)
        angle, weight = rng.uniform(0.0, 6.3), bool(rng.integers(2))
        found = ball_positions(scene, [angle], weight=weight)
        outcomes[found.reason(0).split(":")[0].split(" along ")[0]] += 1
        fault = faults(found, 0, weights=(weight,))
        if fault:
            wrong += 1
            print(f"scene {number}: {fault}")
    seconds = time.perf_counter() - begin
    print(f"{arguments.scenes} scenes in {seconds:.0f} s, {wrong} wrong silently; {pace()}")
    for outcome, count in outcomes.most_common():
        print(f"{count:8d}  {outcome}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
