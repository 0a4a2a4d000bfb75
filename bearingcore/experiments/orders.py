"""Measured orders of fixed-step methods: how errors fall with the step, on four kinds of motion."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bearingcore.common.progress import Cancelled, Progress, in_turn
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.problem import motion_problem
from bearingcore.experiments.integrators import METHODS
from bearingcore.experiments.motions import BAND
from bearingcore.experiments.points import slope
from bearingcore.experiments.references import motion_reference
from bearingcore.scene.presets import presets
from bearingcore.scene.scene import Scene


def _all_loaded() -> Scene:
    """Pressed along the shaft so hard that no ball ever lets go."""
    return presets["liew-lim"].replace(fy=-200.0, fz=3000.0, contact_damping=300.0).healthy()


def _kinked() -> Scene:
    """The same over a shallow defect: the path has corners, yet no ball lets go."""
    defect = presets["liew-lim"].defects[0]
    return _all_loaded().replace(defect=defect).replace(depth=1e-6, extent=math.radians(20.0))


def _losing_contact() -> Scene:
    """Balls let go and touch again, and no contact damps."""
    return presets["fan-rig"].replace(contact_damping=0.0)


def _switching() -> Scene:
    """The same with damping that switches on at touch: the force jumps."""
    return presets["fan-rig"].replace(contact_damping=122.0)


KINDS: dict[str, Callable[[], Scene]] = {
    "smooth": _all_loaded,
    "kinked path": _kinked,
    "losing contact": _losing_contact,
    "switching damping": _switching,
}
"""Kinds of motion by name, each with a scene that has just that."""

MULTIPLES = (1, 2, 3, 4, 6, 8, 12, 16)
OFFSET = 0.02
"""How far the inner ring starts beside its place, over one ball's compression under all the load:
enough for all modes to ring, too little for a ball to let go that the load holds."""

FIRST = 10.0
"""Steps in a period of the highest natural frequency at the longest step."""


@dataclass(frozen=True)
class Order:
    """How the error of one method fell on one kind of motion.

    Attributes
    ----------
    method, kind
        who, and on which of KINDS.
    step_rates : (n,) [Hz]
    errors : (n,)
        root mean square error of the displacements over their swing.
    order
        slope of log error against log step, by least squares over all steps above the floor.
    floor
        how far the two families of the reference are apart: errors near it do not count.
    """

    method: str
    kind: str
    step_rates: tuple[float, ...]
    errors: tuple[float, ...]
    order: float
    floor: float


def measured_orders(
    *, progress: Progress | None = None, cancelled: Cancelled | None = None
) -> tuple[Order, ...]:
    """The order of every fixed-step method on every kind of motion, over 60 ms.

    The inner ring starts beside its place by OFFSET, so that all modes ring.
    """
    orders = []
    names = [name for name, method in METHODS.items() if method.fixed_step]
    for kind in in_turn(tuple(KINDS), str, progress, cancelled):
        scene = KINDS[kind]()
        scale = motion_problem(scene).scale[0]
        offset = OFFSET * scale * np.ones(len(scene.active_dofs))
        problem = motion_problem(scene, offset=offset)
        highest = highest_natural_frequency(scene)
        rate = FIRST * highest
        reference = motion_reference(problem, 0.06, rate, BAND * highest)
        truth = reference.history[:, (0, 3)]
        swing = float(np.abs(truth - truth.mean(axis=0)).max())
        floor = reference.reference.agreement["displacement"]
        for name in names:
            errors = []
            for multiple in MULTIPLES:
                march = METHODS[name].march(problem, multiple * rate, 0.06, rate)
                found = march.history[::multiple, (0, 3)][: len(truth)]
                square = np.mean((found - truth[: len(found)]) ** 2)
                errors.append(math.sqrt(float(square)) / swing)
            counted = [
                (1.0 / m, e) for m, e in zip(MULTIPLES, errors, strict=True) if e > 5 * floor
            ]
            order = slope([h for h, _ in counted], [e for _, e in counted])
            rates = tuple(multiple * rate for multiple in MULTIPLES)
            orders.append(Order(name, kind, rates, tuple(errors), order, floor))
    return tuple(orders)


def order_table(orders: tuple[Order, ...]) -> str:
    """Methods down, kinds across."""
    names = list(dict.fromkeys(order.method for order in orders))
    kinds = list(dict.fromkeys(order.kind for order in orders))
    width = max(len(name) for name in names) + 2
    found = {(order.method, order.kind): order.order for order in orders}
    lines = [f"  {'measured order':{width}}" + "".join(f"{kind:>20}" for kind in kinds)]
    lines += [
        f"  {name:{width}}"
        + "".join(f"{found.get((name, kind), math.nan):>20.1f}" for kind in kinds)
        for name in names
    ]
    return "\n".join(lines)
