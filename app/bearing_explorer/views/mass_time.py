"""A ball's way through the defect, without and with its mass: entry, free flight, strike."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn

from bearing_explorer.plots import style
from bearing_explorer.plots.layers import (
    ON_PAPER,
    Layer,
    Words,
    add_all,
    by_number,
    curve,
    sources_of,
    strips,
    uprights,
)
from bearing_explorer.plots.ranges import StickyRange
from bearing_explorer.results.ball_mass import BallMass
from bearing_explorer.results.excerpt import least_and_greatest
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources, View
from bearing_explorer.views.vibration_time import (
    LABEL_WIDTH,
    NAME_WIDTH,
    PIXELS,
    ROW_HEIGHT,
    SHOWN,
    TIME,
)
from bearingcore.dynamics.strikes import RACES_OF_LOADS

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results

SLOTS = len(style.BALL_COLORS)
WORDS = ("enters", "leaves", "strikes inner race", "strikes outer race", "at the far edge")
"""Of events, by the numbers that the packed source carries."""
EVENT_ROWS = 3

_EVENT_WORDS = f"""
const does = {json.dumps(WORDS)}[row.kind]
return narrow ? does : `ball ${{row.ball}} ${{does}}, ${{si(row.time, 's')}}`
"""

MASSLESS: dict[str, Any] = {"color": style.INK, "alpha": 0.35, "width": 3.0}
"""Look of curves of massless balls."""


EVENTS = uprights("mass_events", "time", style.FAINT_INK, 1.0, 0.55)
NAMES_OF_EVENTS = Words(
    "mass_events",
    "label_from",
    "label_at",
    _EVENT_WORDS,
    reads=("ball", "kind"),
    y_share=True,
    fitting=style.NARROW,
    look={"x_offset": 4, **ON_PAPER},
)


def layers_above(dof: str) -> list[Layer]:
    """Acceleration along a direction, with and without mass."""
    color = style.color_along(dof)
    return [
        EVENTS,
        curve("mass_motion", "time", f"{dof}_massless", **MASSLESS),
        curve("mass_motion", "time", dof, color, 1.4),
    ]


def layers_below() -> list[Layer]:
    """Free flights, loads at both races, and the names of the balls."""
    colors = by_number("slot", style.BALL_COLORS)
    balls = list(enumerate(style.BALL_COLORS))
    return [
        strips("mass_flights", colors, 0.13, low="from", high="to", reads=("slot",)),
        *(curve("mass_loads", "time", f"inner{i}", color, 1.3, (5, 3)) for i, color in balls),
        *(curve("mass_loads", "time", f"outer{i}", color, 1.8) for i, color in balls),
        Words(
            "mass_ball_names",
            "from",
            "at",
            "return `ball ${row.ball}`",
            reads=("ball", "slot"),
            x_share=True,
            y_share=True,
            look={"text_color": colors},
        ),
        EVENTS,
    ]


class MassInTime(View):
    """Acceleration of the housing and loads at both contacts of the balls near the defect."""

    name = "mass-time"
    title = "A ball with mass passes the defect"
    about = (
        "In colour with mass of the balls, in grey without. Above: acceleration of the housing. "
        "Below: loads of the balls near the defect, full at the outer race, dashed at the inner. "
        "Shaded: a ball flies free, it touches neither."
    )
    needs = frozenset({"ball_mass"})

    def build(self, packed: PackedSource) -> Any:
        self._acceleration = StickyRange(-5.0, 5.0, anchor="symmetric", least_span=2e-6)
        self._load = StickyRange(0.0, 100.0, anchor="zero", least_span=1e-3)
        time = packed.range("mass_time", 0.0, 0.03)
        height = packed.range("mass_acceleration", -5.0, 5.0)
        loads = layers_below()
        above = {dof: layers_above(dof) for dof in SHOWN}
        sources = sources_of(packed, [*loads, *above["x"], *above["y"], NAMES_OF_EVENTS])
        plots = []
        for dof in reversed(SHOWN):
            quantity = style.AxisQuantity("Acceleration", f"a{dof}", "m/s²", prefixed=True)
            plot = style.make_figure(
                TIME, quantity, time, height, height=210, name=f"mass_acceleration_{dof}"
            )
            add_all(plot, sources, above[dof])
            plots.append(plot)
        add_all(plots[0], sources, [NAMES_OF_EVENTS])
        below = style.make_figure(
            TIME,
            style.BALL_LOAD,
            time,
            packed.range("mass_load", 0.0, 100.0),
            height=250,
            name="mass_loads",
        )
        add_all(below, sources, loads)
        return pn.Column(*plots, below, sizing_mode="stretch_width", margin=0)

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        shown = results.ball_mass
        missing = np.full(shown.time.size, np.nan)
        kinds = (shown.with_mass, shown.massless)
        signals = np.stack([kind.get(dof, missing) for kind in kinds for dof in SHOWN], axis=1)
        rows, drawn = least_and_greatest(signals, PIXELS)
        names = (*SHOWN, *(f"{dof}_massless" for dof in SHOWN))
        balls = shown.balls[:SLOTS]
        loads = np.full((shown.time.size, 2 * SLOTS), np.nan)
        for race in range(2):
            first = race * SLOTS
            loads[:, first : first + balls.size] = shown.loads[race, :, :SLOTS]
        load_rows, loads_drawn = least_and_greatest(loads, PIXELS)
        columns = [f"{race}{i}" for race in RACES_OF_LOADS for i in range(SLOTS)]
        slots = np.arange(float(balls.size))
        slot_of = {int(ball): slot for slot, ball in enumerate(balls)}
        free = [flight for flight in shown.flights if flight.ball in slot_of]
        start, end = float(shown.time[0]), float(shown.time[-1])
        sources: Sources = {
            "mass_motion": {
                "time": shown.time[rows],
                **{name: drawn[:, i] for i, name in enumerate(names)},
            },
            "mass_loads": {
                "time": shown.time[load_rows],
                **{name: loads_drawn[:, i] for i, name in enumerate(columns)},
            },
            "mass_flights": {
                "from": np.array([flight.begin for flight in free]),
                "to": np.array([flight.end for flight in free]),
                "slot": np.array([float(slot_of[flight.ball]) for flight in free]),
            },
            "mass_ball_names": {
                "from": 0.02 + NAME_WIDTH * slots,
                "at": np.full(balls.size, 1.0 - 0.8 * ROW_HEIGHT),
                "ball": balls + 1.0,
                "slot": slots,
            },
            "mass_events": event_rows(shown, start, end),
        }
        room = 1.0 + 2.2 * ROW_HEIGHT * EVENT_ROWS
        greatest = np.nanmax(np.abs(signals), initial=0.0)
        ranges = {
            "mass_time": (start, end),
            "mass_acceleration": self._acceleration.fit(greatest * room),
            "mass_load": self._load.fit(1.2 * shown.loads.ravel()),
        }
        return sources, ranges

    def sentence(self, results: Results) -> str:
        shown = results.ball_mass
        if shown.broke_off:
            words = shown.broke_off
            return f"{words[0].upper()}{words[1:]}."
        peaks = [
            "the housing's acceleration peaks at "
            f"{style.number(float(np.max(np.abs(shown.with_mass[dof]))), 2)} m/s² along {dof} with "
            f"mass, {style.number(float(np.max(np.abs(shown.massless[dof]))), 2)} without"
            for dof in ("y", "x")
            if dof in shown.with_mass
        ][:1]
        words = way_of_the_ball(shown)
        free = style.number(100.0 * shown.free_share, 2)
        flying = f"; the balls drawn fly free for {free} % of the time"
        return "; ".join([words, *peaks]) + flying + "."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.ball_mass.table().named()


def way_of_the_ball(shown: BallMass) -> str:
    """The path of the ball that enters at 0, in words."""
    entry = shown.entry
    if entry is None:
        return "No ball enters a defect here"
    words = f"Ball {entry.ball + 1} enters the defect at 0"
    if not shown.strikes:
        where = ""
        if math.isfinite(shown.far_edge):
            where = f", meets the far edge {style.with_prefix(shown.far_edge, 's')} later"
        return f"{words}{where} and stays in contact with both races"
    struck = [
        f"the {strike.race} race after {style.with_prefix(strike.time, 's')} with "
        f"{style.with_prefix(strike.load, 'N', 2)}"
        for strike in shown.strikes
    ]
    return f"{words} and strikes {style.list_words(struck)}"


def event_rows(shown: BallMass, start: float, end: float) -> dict[str, np.ndarray]:
    """Entries, exits and the strike as columns, with labels in rows where they have room."""
    events = [(e.time, e.ball, 0 if e.enters else 1) for e in shown.events]
    events += [(s.time, s.ball, 2 + RACES_OF_LOADS.index(s.race)) for s in shown.strikes]
    if shown.entry is not None and math.isfinite(shown.far_edge):
        events.append((shown.far_edge, shown.entry.ball, 4))
    # those of the ball that enters at 0 get their labels first
    own = shown.entry.ball if shown.entry is not None else -1
    events.sort(key=lambda event: (event[1] != own, event[0]))
    width = 1.5 * LABEL_WIDTH * (end - start)
    taken: list[list[float]] = [[] for _ in range(EVENT_ROWS)]
    lefts, places = [], []
    for time, _, _ in events:
        left = min(time, end - width)
        row = next(
            (r for r in range(EVENT_ROWS) if all(abs(left - x) >= width for x in taken[r])), None
        )
        lefts.append(left)
        places.append(np.nan if row is None else 1.0 - ROW_HEIGHT * (1.3 * row + 0.9))
        if row is not None:
            taken[row].append(left)
    return {
        "time": np.array([time if abs(time) > 1e-8 else 0.0 for time, _, _ in events]),
        "ball": np.array([ball + 1.0 for _, ball, _ in events]),
        "kind": np.array([float(kind) for _, _, kind in events]),
        "label_from": np.array(lefts),
        "label_at": np.array(places),
    }
