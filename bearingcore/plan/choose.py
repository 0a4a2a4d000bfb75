"""The cheapest settings that keep a scene's picture inside an error budget.

Model no more than a scene needs: only directions that can move, cage angles at events and where a
curve bends, the longest step that will do, and instead of a transient the periodic orbit where it
is proven stable. A plan says what was chosen, the error to expect and what it costs.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks
from bearingcore.dynamics.motion import MOST_STEPS
from bearingcore.plan.balls import compare_balls
from bearingcore.plan.cage_angles import CURVES
from bearingcore.plan.curves import plan_curves
from bearingcore.plan.motions import Asked, plan_motion
from bearingcore.plan.plans import (
    BUDGETS,
    VIEWS,
    Plan,
)
from bearingcore.scene.scene import MASSLESS, WITH_MASS, Scene, check_dofs

Array = NDArray[np.float64]


def plan(
    scene: Scene,
    view: str,
    error_budget: float | None = None,
    *,
    duration: float = 1.4,
    sample_rate: float = 65536.0,
    dofs: Iterable[str] | None = None,
    step_rate: float | None = None,
    march: bool = False,
    most_steps: int = MOST_STEPS,
    up_to: float | None = None,
) -> Plan:
    """The cheapest way to compute a view of a scene within an error budget.

    Parameters
    ----------
    scene, view
        what to show of what: see VIEWS.
    error_budget
        None takes that of BUDGETS.
    duration, sample_rate
        [s], [Hz] of motions.
    dofs, step_rate, march
        overrule the plan: directions, steps a second [Hz], a march where an orbit would do. The
        predicted error is then that of what was asked for.
    most_steps
        steps of each march that is tried for a motion's plan. They are counted before the first:
        where there would be more nothing is tried, the budget counts as not met, and the note says
        how many there would be.
    up_to
        the highest frequency [Hz] that is looked at. Where it is given, motions have massless balls
        if those are within the budget up to there, and else balls with mass; None: as the scene
        says.

    Raises
    ------
    ValueError
        for unknown views, a budget that is not positive, or what `simulate` refuses.
    """
    checks.choice("view", view, VIEWS)
    budget = checks.number(
        "error_budget", BUDGETS[view] if error_budget is None else error_budget, above=0.0
    )
    began = time.perf_counter()
    if dofs is not None:
        scene = scene.replace(dofs=check_dofs(dofs))
    most_steps = checks.whole_number("most_steps", most_steps, at_least=1, at_most=10**12)
    if view in CURVES:
        return plan_curves(scene, view, budget, began)
    note = ""
    if up_to is not None:
        up_to = checks.number("up_to", up_to, above=0.0, at_most=0.5 * sample_rate, unit="Hz")
        comparison = compare_balls(scene.replace(balls=MASSLESS), budget, sample_rate=sample_rate)
        scene = scene.replace(balls=MASSLESS if comparison.enough_up_to(up_to) else WITH_MASS)
        note = comparison.sentence if scene.balls == MASSLESS else ""
    asked = Asked(scene, view, budget, duration, sample_rate, step_rate, march, most_steps)
    made = plan_motion(asked, began)
    return dataclasses.replace(made, note="; ".join(filter(None, (made.note, note))))
