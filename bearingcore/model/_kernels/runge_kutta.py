"""Classical Runge-Kutta steps of order 4, for balls with and without mass."""

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
        total += y[i] - y[i]  # 0, or NaN if y[i] is not finite
    return total == 0.0


@inlined
def try_state(y, part, before, trial):
    """Write the state y + part·before into trial, each (n,)."""
    for r in range(y.size):
        trial[r] = y[r] + part * before[r]


def stepper(
    lay_out: Callable[..., Any],
    rates: Callable[..., Any],
    changed: Callable[..., Any],
    record: Callable[..., Any],
) -> Any:
    """Return a compiled function that steps a system, from four compiled functions.

    * `lay_out(angle, turn, count, system, work)` writes the balls at `count` instants to work.
    * `rates(y, part, before, k, instant, system, work)` writes the rate of y + part·before to k.
    * `changed(y, instant, system, work)` may change y as a step begins, with its rate in work.k[0];
      it returns True if it did.
    * `record(sample, y, instant, system, out, work)` writes y to the output.
    """

    @inlined
    def runge_kutta(y, h, start_angle, stride, system, out, work, span):
        """March in steps of h [s] from the state y and start_angle of the cage; y becomes the last.

        Every `stride` steps a sample is recorded, as many as out.history has. span holds the first
        step and the step before which to end, both multiples of half a BLOCK; see `parts`. Returns
        the number of steps after which all was still finite; this is tested once in half a BLOCK.
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
            # Each call of an inlined function repeats its code, so each is called at one place. If
            # `changed` returns True, the rate of stage 0 is computed again for the new state.
            is_new = False
            stage = 0
            while stage < 4:
                instant = i + (stage + 1) // 2
                part = 0.0 if stage == 0 else (h if stage == 3 else 0.5 * h)
                rates(y, part, k[max(stage - 1, 0)], k[stage], instant, system, work)
                if stage == 0:
                    if not is_new and changed(y, instant, system, work):
                        is_new = True
                        continue
                    if step % stride == 0:
                        record(step // stride, y, instant, system, out, work)
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
