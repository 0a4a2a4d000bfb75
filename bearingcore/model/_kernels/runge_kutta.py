"""Classical Runge-Kutta steps of order 4, for all that moves."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bearingcore.model._kernels.compiling import inlined
from bearingcore.model._kernels.path import BLOCK


@inlined
def all_finite(y):
    """Return True if every number of y (n,) is finite."""
    total = 0.0
    for i in range(y.size):
        total += y[i] - y[i]  # 0, or NaN for what is not finite
    return total == 0.0


@inlined
def try_state(y, part, before, trial):
    """The state y + part·before into trial, each (n,)."""
    for r in range(y.size):
        trial[r] = y[r] + part * before[r]


def stepper(
    lay_out: Callable[..., Any],
    rates: Callable[..., Any],
    changed: Callable[..., Any],
    record: Callable[..., Any],
) -> Any:
    """Compiled steps of a system, out of four compiled functions of it.

    `lay_out(angle, turn, count, system, work)` puts positions of the balls at `count` cage angles
    into work; `rates(y, part, before, k, at, system, work)` the rate of y + part·before at the
    instant `at` of these into k; `changed(y, at, system, work)` says whether it has changed y as a
    step begins, whose rate is in work.k[0]; `record(sample, y, at, system, out, work)` keeps it.
    """

    @inlined
    def runge_kutta(y, h, start_angle, stride, system, out, work, span):
        """Steps of h [s] from y, which is moved to the end; the cage begins at start_angle [rad].

        Every `stride` steps a sample is recorded, as many as out.history has. span holds the first
        step and that before which to end, whole numbers of half a BLOCK; see `parts`.
        Returns the number of steps after which all was still finite, which is looked at once in
        half a BLOCK.
        """
        k = work.k
        n_steps = stride * (out.history.shape[0] - 1)
        half_turn = 0.5 * h * system.rotor.cage_speed
        first, end = span
        for step in range(first, min(end, n_steps + 1)):
            i = (2 * step) % BLOCK
            if i == 0:
                if not all_finite(y):
                    return max(step - BLOCK // 2, 0)
                instants = min(BLOCK, 2 * (n_steps - step)) + 1
                lay_out(start_angle + 2 * step * half_turn, half_turn, instants, system, work)
            # large functions are called at one place: each call is their code once more
            looked = False
            stage = 0
            while stage < 4:
                at = i + (stage + 1) // 2
                part = 0.0 if stage == 0 else (h if stage == 3 else 0.5 * h)
                rates(y, part, k[max(stage - 1, 0)], k[stage], at, system, work)
                if stage == 0:
                    if not looked and changed(y, at, system, work):
                        looked = True
                        continue
                    if step % stride == 0:
                        record(step // stride, y, at, system, out, work)
                    if step == n_steps:
                        break
                stage += 1
            if step == n_steps:
                break
            for r in range(y.size):
                y[r] += h / 6.0 * (k[0, r] + 2.0 * (k[1, r] + k[2, r]) + k[3, r])
        if end <= n_steps:
            return end
        return n_steps if all_finite(y) else max(n_steps - BLOCK // 2, 0)

    return runge_kutta
