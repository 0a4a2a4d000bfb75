"""Ways to march balls with mass, error against cost: ``python -m tests.benchmarks.ball_methods``.

The fan rig at 12.9°, c = 122 N·s/m, both contact laws. Under each table stand the default steps and
their cost in processor time over that of the massless march at its own default, in one run.
"""

from __future__ import annotations

import argparse
import math
import time

from bearingcore import presets, simulate
from bearingcore.experiments.balls import BALL_METHODS, balls_experiment
from bearingcore.scene.scene import MASSLESS, WITH_MASS, Scene
from tests.benchmarks.machine import pace


def least(scene: Scene, duration: float, runs: int = 7) -> float:
    """Least processor time [s] of a simulated motion."""
    simulate(scene, duration)
    best = math.inf
    for _ in range(runs):
        start = time.process_time()
        simulate(scene, duration)
        best = min(best, time.process_time() - start)
    return best


def main() -> None:
    """Run and print; see the head of the module."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--speed", type=float, default=7.0, help="of the shaft [Hz]")
    parser.add_argument("--duration", type=float, default=1.4, help="[s]")
    arguments = parser.parse_args()
    for law in ("published", "no tension"):
        scene = presets["fan-rig"].replace(
            shaft_speed=2.0 * math.pi * arguments.speed, contact_damping=122.0, contact_law=law
        )
        heavy = scene.replace(balls=WITH_MASS)
        for march in BALL_METHODS.values():  # so that nothing is compiled while time is taken
            march(heavy, 1, 0.01, 65536.0)
        print(law)
        print(balls_experiment(scene, duration=arguments.duration).table().csv())
        motion = simulate(heavy, 0.01)
        massless = least(scene.replace(balls=MASSLESS), arguments.duration)
        cost = least(heavy, arguments.duration)
        machine = pace()
        print(
            f"  by default {motion.step_rate:.0f} steps/s in {1e3 * cost:.1f} ms, "
            f"{cost / massless:.1f} times the massless march's {1e3 * massless:.1f} ms,\n"
            f"  {machine.ratio(cost)}; {machine}\n"
        )


if __name__ == "__main__":
    main()
