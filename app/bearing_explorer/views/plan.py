"""The plan in full: for each kind of picture how it is computed, what that errs and costs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import panel as pn
import param
from bokeh.models import CustomJSTickFormatter, FixedTicker, Range1d

from bearing_explorer.assets import asset_path, asset_text
from bearing_explorer.plots import style
from bearing_explorer.results import compiling
from bearing_explorer.serve.live_component import LiveComponent
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources, View
from bearing_explorer.widgets.plan_choice import TITLES
from bearingcore.common.numbers import count, decibels, percent, scientific
from bearingcore.common.table import table_of
from bearingcore.plan import CURVES, SETTLED
from bearingcore.plan.plans import plans_table
from bearingcore.scene.scene import DOF_SYMBOLS

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results
    from bearingcore.plan import Plan

HEADS = (
    "What is drawn",
    "Directions",
    "How",
    "Error expected",
    "Error allowed",
    "Time",
    "Full model: time",
    "Its error",
    "Planned in",
)


class PlanTable(LiveComponent):
    """Plans as rows, with remarks beneath."""

    #: {"heads": [words], "rows": [[words]], "remarks": [sentences], "stale": bool}
    shown = param.Dict(default={"heads": list(HEADS), "rows": [], "remarks": [], "stale": True})

    _esm = asset_path("plan_table.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("plan_table.css")]


class PlanInFull(View):
    """What was planned for each kind of picture, and where the cage angles stand."""

    name = "plan"
    title = "The plan in full"
    about = (
        "No more work than the allowed error asks for. The directions, cage angles and steps "
        "that the program chose for this scene, and the periodic orbit where it is stable and "
        "cheaper than a march. “Plan”, beside the status line, overrules it."
    )
    needs = frozenset()
    plans = (*CURVES, SETTLED)

    def build(self, packed: PackedSource) -> Any:
        self._rows: dict[str, Any] = {"heads": list(HEADS), "rows": [], "remarks": []}
        self._table = PlanTable(sizing_mode="stretch_width", margin=0)
        plot = style.make_figure(
            style.CAGE_ANGLE,
            style.AxisQuantity("", "", ""),
            packed.range("plan_angle", 0.0, 30.0),
            Range1d(-0.6, len(CURVES) - 0.4, syncable=False),
            height=150,
        )
        plot.yaxis.axis_label = None
        plot.yaxis.ticker = FixedTicker(ticks=list(range(len(CURVES))), minor_ticks=[])
        plot.yaxis.formatter = CustomJSTickFormatter(
            code=f"return {[TITLES[view] for view in CURVES]}[tick] ?? ''"
        )
        plot.ygrid.visible = False
        plot.scatter(
            "angle",
            "row",
            marker="dash",
            source=packed.source("plan_nodes", "angle", "row"),
            angle=0.5 * math.pi,
            size=16,
            line_color=style.DEFECTIVE,
            line_width=1.0,
        )
        return pn.Column(self._table, plot, sizing_mode="stretch_width", margin=0)

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        first, last, _ = results.stretch
        rows = [np.degrees(angles) for angles in nodes_of(results).values()]
        sources: Sources = {
            "plan_nodes": {
                "angle": np.concatenate(rows),
                "row": np.repeat(np.arange(float(len(rows))), [row.size for row in rows]),
            }
        }
        first, last = math.degrees(first), math.degrees(last)
        edge = 0.004 * (last - first)  # room for the first and the last
        return sources, {"plan_angle": (first - edge, last + edge)}

    def sentence(self, results: Results) -> str:
        if not results.plans:
            return (
                "It is planned as soon as the hand rests; until then curves are drawn at equally "
                "spaced cage angles."
            )
        unmet = [TITLES[view].lower() for view, made in results.plans.items() if not made.met]
        words = (
            "Below the table: the cage angles of each kind of curve, close where balls meet edges, "
            "touch or let go"
        )
        if unmet:
            words += f". What is allowed is not met for {style.list_words(unmet)}"
        if SETTLED not in results.plans and not compiling.ready():
            words += ". Motions are planned as soon as all is compiled, which is done once"
        return words + "."

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is None:
            return
        if made := results.plans:
            self._rows = {
                "heads": list(HEADS),
                "rows": [row_of(plan) for plan in made.values()],
                "remarks": [words for plan in made.values() for words in remarks_of(plan)],
            }
        self._table.put(shown={**self._rows, "stale": not made})

    def table(self, results: Results) -> dict[str, np.ndarray]:
        made = list(results.plans.values())
        titles = table_of(("what", "", [TITLES[plan.view] for plan in made]))
        nodes = (
            (f"{view}_cage_angle", "rad", angles) for view, angles in nodes_of(results).items()
        )
        return (titles | plans_table(made) | table_of(*nodes)).in_units().named()


def nodes_of(results: Results) -> dict[str, np.ndarray]:
    """Cage angles [rad] at which each kind of curve is computed."""
    first, last, count = results.stretch
    equal = np.linspace(first, last, count)
    found = {}
    for view in CURVES:
        plan = results.plans.get(view)
        angles = None if plan is None else plan.cage_angles
        overruled = results.settings.cage_angles is not None or first != 0.0
        found[view] = equal if angles is None or overruled else angles
    return found


def row_of(plan: Plan) -> list[str]:
    """A plan as words, one for each of HEADS."""
    return [
        TITLES[plan.view],
        " ".join(DOF_SYMBOLS[dof] for dof in plan.dofs),
        how_of(plan),
        error_of(plan, plan.predicted_error),
        error_of(plan, plan.error_budget),
        style.with_prefix(plan.seconds, "s"),
        style.with_prefix(plan.full_seconds, "s"),
        error_of(plan, plan.full_error),
        style.with_prefix(plan.planning_seconds, "s"),
    ]


def how_of(plan: Plan) -> str:
    """The way of a plan in words."""
    if plan.cage_angles is not None:
        return f"{plan.cage_angles.size} cage angles"
    if plan.orbit is not None:
        length = count(plan.orbit.ball_passes, "ball pass", "ball passes")
        return f"stable orbit of {length}, {style.with_prefix(plan.step_rate, 'Hz')}"
    steps = (
        f"steps by a tolerance of {scientific(plan.tolerance)}"
        if plan.method == "adaptive steps"
        else f"steps at {style.with_prefix(plan.step_rate, 'Hz')}"
    )
    return f"march of {style.with_prefix(plan.duration, 's')}, {steps}"


def error_of(plan: Plan, error: float) -> str:
    """An error in the plan's unit."""
    if not math.isfinite(error):
        return "not known"
    if plan.cage_angles is not None:
        return percent(error, 2)
    return decibels(error)


def remarks_of(plan: Plan) -> list[str]:
    """What else there is to say of a plan."""
    remarks = []
    what = TITLES[plan.view]
    if plan.note:
        remarks.append(f"{what}: {plan.note}.")
    if not plan.met:
        remarks.append(f"{what}: what is allowed is not met.")
    remarks += [
        f"{what}: {' '.join(DOF_SYMBOLS[dof] for dof in offer.dofs)} alone would err by "
        f"{error_of(plan, offer.error)} and take {style.with_prefix(offer.seconds, 's')}."
        for offer in plan.offers
        if offer.error <= MOST_OFFERED[plan.cage_angles is not None]
    ]
    return remarks


MOST_OFFERED = {True: 0.05, False: 3.0}
"""Errors above which fewer directions are no offer: of curves over their swing, of spectra [dB]."""
