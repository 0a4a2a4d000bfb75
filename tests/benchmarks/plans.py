"""Hold plans against the truth.

    python -m tests.benchmarks.plans [--scenes 200] [--motions 200]

Random scenes within what the page's sliders allow, from a seed. For each view the plan's true error
is measured (curves against 8,000 cage angles and more about every node, motions against a
multistep reference on which two families agree) and what the plan saves against the full model.
"""

from __future__ import annotations

import argparse
import math
import statistics
import sys
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from bearingcore import Scene, equilibrium, presets
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.problem import motion_problem
from bearingcore.experiments.references import motion_reference
from bearingcore.plan import SETTLED, VIBRATION, Plan, plan
from bearingcore.plan.cage_angles import LEAST_INTERVAL, curves_of, swings
from bearingcore.plan.pilot import BAND, spectra_apart
from bearingcore.scene.packing import length_units
from tests.benchmarks.machine import pace

SAMPLE_RATE = 65536.0


def random_scenes(count: int, seed: int = 20141121) -> Iterator[Scene]:
    """Scenes spread over presets and sliders."""
    random = np.random.default_rng(seed)
    for k in range(count):
        base = presets[("fan-rig", "liew-lim")[k % 2]]
        size = base.load
        force = max(abs(size.fy), 100.0)
        flat = base.bearing.contact_angle == 0.0
        yield base.replace(
            n_balls=int(base.bearing.n_balls + random.integers(-4, 1)),
            radial_clearance=float(random.uniform(0.0, 12e-6)),
            contact_angle=0.0 if flat else math.radians(random.uniform(10.0, 40.0)),
            extent=math.radians(random.uniform(1.0, 100.0)),
            depth=float(10.0 ** random.uniform(-6.0, -4.0)),
            center=math.radians(random.uniform(0.0, 360.0)),
            edge=str(random.choice(["published", "chord", "exact"])),
            fx=float(force * random.uniform(-0.5, 0.5)),
            fy=float(-force * random.uniform(0.3, 2.5)),
            fz=0.0 if flat else float(force * random.uniform(0.1, 1.0)),
            shaft_speed=2.0 * math.pi * float(random.uniform(3.0, 30.0)),
            contact_law="no tension" if random.random() < 0.2 else "published",
        )


@dataclass(frozen=True)
class Held:
    """A plan and what it truly is off by; `trusted` where the truth is known."""

    plan: Plan
    error: float
    trusted: bool = True

    @property
    def kept(self) -> bool:
        """Within the budget, or honest that it is not."""
        return not self.trusted or self.error <= self.plan.error_budget or not self.plan.met


def held_curves(scene: Scene, view: str, budget: float | None = None) -> Held:
    """Lines between the planned angles against a dense grid, finer about the nodes."""
    made = plan(scene, view, budget)
    nodes = made.cage_angles
    assert nodes is not None
    gaps = np.diff(nodes)
    # where a curve jumps two nodes stand so near to each other that the line between is upright
    wide = gaps > 1.01 * LEAST_INTERVAL * scene.bearing.ball_spacing
    equal = np.linspace(nodes[0], nodes[-1], 8001)[1:]
    dense = np.unique(
        np.concatenate(
            [equal[wide[np.searchsorted(nodes, equal) - 1]]]
            + [(nodes[:-1] + part * gaps)[wide] for part in (0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98)]
        )
    )
    truth = curves_of(equilibrium(scene, dense), view)
    drawn = curves_of(equilibrium(scene, nodes), view)
    lines = np.stack([np.interp(dense, nodes, drawn[:, i]) for i in range(drawn.shape[1])], axis=1)
    error = np.abs(lines - truth) / swings(truth)
    return Held(made, float(error[np.isfinite(error)].max(initial=0.0)))


def held_motion(scene: Scene, view: str, duration: float = 0.35) -> Held:
    """The housing's spectrum against a reference; for orbits that of the reference's last part."""
    made = plan(scene, view, duration=duration)
    band = BAND * highest_natural_frequency(scene)
    reference = motion_reference(motion_problem(scene), made.duration, SAMPLE_RATE, band)
    truth = reference.history[:-1, 5]
    # the reference must have settled as far as it is asked to agree
    first = round(made.drop * SAMPLE_RATE)
    if made.orbit is not None:
        found = made.orbit.outer_acceleration(np.arange(len(truth)) / SAMPLE_RATE)
    else:
        found = made.run().outer_acceleration  # type: ignore[union-attr]
    found = found * length_units(scene, made.dofs)
    n = min(len(found), len(truth))
    error = spectra_apart(found[first:n], truth[first:n], SAMPLE_RATE, band)
    return Held(made, error, reference.reference.trusted)


def report(title: str, found: list[Held]) -> bool:
    """A paragraph; True where every plan kept its word."""
    broken = [held for held in found if not held.kept]
    trusted = [held for held in found if held.trusted]
    unmet = [held for held in trusted if not held.plan.met]
    shares = [held.error / held.plan.error_budget for held in trusted]
    saved = [h.plan.full_seconds / h.plan.seconds for h in trusted]
    calls = [h.plan.full_evaluations / max(h.plan.evaluations, 1) for h in trusted]
    full = [h.plan.full_error / h.plan.error_budget for h in trusted]
    methods = {m: sum(h.plan.method == m for h in found) for m in {h.plan.method for h in found}}
    machine = pace()
    planning = [held.plan.planning_seconds for held in found]
    print(
        f"{title}: {len(found)} scenes, {len(broken)} over budget unannounced, {len(unmet)} said "
        f"that they cannot meet it, {len(found) - len(trusted)} without a trusted reference\n"
        f"  ways: {methods}\n"
        f"  true error over budget: median {statistics.median(shares):.2f}, worst "
        f"{max(shares):.2f}; of the full model (predicted): median {statistics.median(full):.2f}, "
        f"worst {max(full):.2f}\n"
        f"  full over planned: time median {statistics.median(saved):.1f}, worst {min(saved):.2f}; "
        f"evaluations median {statistics.median(calls):.1f}, worst {min(calls):.2f}\n"
        f"  planning: median {1e3 * statistics.median(planning):.1f} ms, worst "
        f"{1e3 * max(planning):.0f} ms ({machine.ratio(max(planning))})\n  {machine}",
        flush=True,
    )
    for held in broken:
        print(f"    {held.error / held.plan.error_budget:.2f} of {held.plan.sentence()}")
    return not broken


def main() -> int:
    """Measure and print; 1 where a plan broke its word."""
    parser = argparse.ArgumentParser(description="Plans against the truth.")
    parser.add_argument("--scenes", type=int, default=200, help="of curves")
    parser.add_argument("--motions", type=int, default=200, help="scenes of motions, 0 for none")
    parser.add_argument("--seed", type=int, default=20141121, help="of the scenes")
    chosen = parser.parse_args()
    good = True
    for view in ("load", "stiffness", "modes"):
        found = [held_curves(scene, view) for scene in random_scenes(chosen.scenes, chosen.seed)]
        good &= report(view, found)
    for view in (VIBRATION, SETTLED) if chosen.motions else ():
        moving = [held_motion(scene, view) for scene in random_scenes(chosen.motions, chosen.seed)]
        good &= report(view, moving)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
