"""A ball's way through the defect, without and with its mass: entry, free flight, strike."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results.ball_mass import BallMass, entry_of
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views import passage_view
from bearing_explorer.explorer.views.folded_view import FoldedView
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import Layer, by_number, curve, strips
from bearing_explorer.kit.plots.levels import SHOWN
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore.model.dynamics import RACES_OF_LOADS

WORDS = ("enters", "leaves", "strikes inner race", "strikes outer race", "at the far edge")
"""Words for events, by the numbers that the packed source carries."""

_EVENT_WORDS = f"""
const does = {json.dumps(WORDS)}[row.kind]
return narrow ? does : `{passage_view.BALL} ${{does}}, ${{si(row.time, 's')}}`
"""

MASSLESS: dict[str, Any] = {"color": style.INK, "alpha": 0.35, "width": 3.0}
"""Look of curves of massless balls."""


class MassInTime(FoldedView[Results], passage_view.PassageView):
    """Acceleration of the housing and loads at both contacts of the balls near the defect."""

    name = "mass-time"
    title = "A ball with mass passes the defect"
    about = (
        "In colour with the mass of the balls, in grey without. Above: housing acceleration. "
        "Below: loads of {balls}, full at the outer race, dashed at the inner. "
        "Shaded: a ball touches neither race."
    )
    balls = "the balls near the defect"
    healthy_title = "Vibration with the mass of the balls"
    needs = frozenset({"ball_mass"})
    prefix = "mass"

    def upper_figures(self) -> Sequence[tuple[style.AxisQuantity, int, Sequence[Layer]]]:
        figures: list[tuple[style.AxisQuantity, int, list[Layer]]] = []
        for dof in reversed(SHOWN):
            quantity = style.AxisQuantity("Acceleration", f"a{dof}", "m/s²", prefixed=True)
            heavy = curve("mass_motion", "time", dof, style.color_along(dof), 1.4)
            massless = curve("mass_motion", "time", f"{dof}_massless", **MASSLESS)
            compared = compared_curves.curves("mass_motion", "time", dof)
            figures.append(
                (quantity, 210, [passage_view.event_lines("mass"), massless, *compared, heavy])
            )
        figures[0][2].append(passage_view.event_names("mass", _EVENT_WORDS, ("kind",)))
        return figures

    def lower_figure(self) -> tuple[int, Sequence[Layer]]:
        colors = by_number("slot", style.BALL_COLORS)
        balls = list(enumerate(style.BALL_COLORS))
        return 250, [
            strips("mass_flights", colors, 0.13, low="from", high="to", reads=("slot",)),
            *(curve("mass_loads", "time", f"inner{i}", color, 1.3, (5, 3)) for i, color in balls),
            *(curve("mass_loads", "time", f"outer{i}", color, 1.8) for i, color in balls),
            self.names_of_balls(),
            passage_view.event_lines("mass"),
        ]

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        shown, bearing = results.ball_mass, results.scene.bearing
        massless = passage_view.both_directions(shown.time, shown.massless)
        motions, numbers = self.motions(
            results,
            lambda drawn: (drawn.ball_mass.time, drawn.ball_mass.with_mass),
            {f"{dof}_massless": signal for dof, signal in massless.items()},
        )
        balls = shown.balls[: passage_view.SLOTS]
        loads: dict[str, np.ndarray] = {}
        for race, race_loads in zip(RACES_OF_LOADS, shown.loads, strict=True):
            loads |= passage_view.slot_columns(race, race_loads)
        slot_of = {int(ball): float(slot) for slot, ball in enumerate(balls)}
        free = [(f.begin, f.end, slot_of[f.ball]) for f in shown.flights if f.ball in slot_of]
        flights = np.array(free, dtype=float).reshape(-1, 3).T
        sources: Sources = {
            **motions,
            "mass_loads": passage_view.traces(shown.time, loads),
            "mass_flights": dict(zip(("from", "to", "slot"), flights, strict=True)),
            "mass_ball_names": passage_view.ball_names(balls, bearing),
            "mass_events": event_rows(shown, float(shown.time[0]), float(shown.time[-1])),
        }
        return sources, self.ranges(shown.time, numbers, shown.loads)

    def words(self, results: Results) -> str:
        shown = results.ball_mass
        if shown.broke_off:
            words = shown.broke_off
            return f"{words[0].upper()}{words[1:]}."
        peaks = [
            "The housing's acceleration peaks at "
            f"{style.number(float(np.max(np.abs(shown.with_mass[dof]))), 2)} m/s² along {dof} with "
            f"the mass, {style.number(float(np.max(np.abs(shown.massless[dof]))), 2)} without"
            for dof in ("y", "x")
            if dof in shown.with_mass
        ][:1]
        words = way_of_the_ball(shown)
        free = style.number(100.0 * shown.free_share, 2)
        flying = f"The balls drawn touch neither race for {free} % of the time"
        return ". ".join([words, *peaks, flying]) + "."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.ball_mass.table().named()


def way_of_the_ball(shown: BallMass) -> str:
    """The path of the ball that enters at 0, in words."""
    entry = entry_of(shown.events)
    if entry is None:
        return "No ball enters a defect here"
    words = f"Ball {entry.ball + 1} enters the defect at 0"
    if not shown.strikes:
        where = ""
        if math.isfinite(shown.far_edge):
            where = f", meets the far edge {style.with_prefix(shown.far_edge, 's')} later"
        return f"{words}{where} and stays in contact with both races"
    strikes = [
        f"the {strike.race} race after {style.with_prefix(strike.time, 's')} with "
        f"{style.with_prefix(strike.load, 'N', 2)}"
        for strike in shown.strikes
    ]
    return f"{words} and strikes {style.list_words(strikes)}"


def event_rows(shown: BallMass, start: float, end: float) -> dict[str, np.ndarray]:
    """Entries, exits and strikes as columns, with the places of their labels."""
    events = [(e.time, e.ball, 0 if e.enters else 1) for e in shown.events]
    events += [(s.time, s.ball, 2 + RACES_OF_LOADS.index(s.race)) for s in shown.strikes]
    entry = entry_of(shown.events)
    entering = entry.ball if entry else -1
    if math.isfinite(shown.far_edge):
        events.append((shown.far_edge, entering, 4))
    # events of the ball that enters at 0 come first, because the first labels have most room
    events.sort(key=lambda event: (event[1] != entering, event[0]))
    times, balls, kinds = np.array(events, dtype=float).reshape(-1, 3).T
    times[np.abs(times) <= 1e-8] = 0.0
    return {
        "time": times,
        **passage_view.name_columns(shown.scene.bearing, balls.astype(np.int64)),
        "kind": kinds,
        **passage_view.places_of_labels(
            times.tolist(), start, end, 1.5 * passage_view.LABEL_WIDTH, 1.3
        ),
    }
