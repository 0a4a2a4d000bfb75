"""A ball's way through the defect, without and with its mass: entry, free flight, strike."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn
from bokeh.models import ColumnDataSource, CustomJS, LinearColorMapper, Range1d
from bokeh.plotting import figure

from bearing_explorer.plots import style
from bearing_explorer.plots.ranges import StickyRange
from bearing_explorer.results.ball_mass import BallMass
from bearing_explorer.results.excerpt import least_and_greatest, why_ended
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
let width = 0  // on a phone there is room for less
try {{ width = plot.inner_width }} catch {{ /* not laid out yet */ }}
return width && width < 420 ? does : `ball ${{row.ball}} ${{does}}, ${{si(row.time, 's')}}`
"""


MASSLESS_LINE = {"line_color": style.INK, "line_alpha": 0.35, "line_width": 3.0}
"""Look of what moves without the mass of the balls."""


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
        events = packed.source("mass_events", "time", "ball", "kind", "label_from", "label_at")
        motion = packed.source("mass_motion", "time", *SHOWN, *(f"{d}_massless" for d in SHOWN))
        plots = []
        for dof in reversed(SHOWN):
            quantity = style.AxisQuantity("Acceleration", f"a{dof}", "m/s²", prefixed=True)
            plot = style.make_figure(
                TIME, quantity, time, height, height=210, name=f"mass_acceleration_{dof}"
            )
            self._mark(plot, events)
            color = style.DIRECTION_COLORS[style.DIRECTIONS.index(dof)]
            plot.line("time", f"{dof}_massless", source=motion, **MASSLESS_LINE)
            plot.line("time", dof, source=motion, line_color=color, line_width=1.4)
            plots.append(plot)
        self._label_events(plots[0], events)
        # labels are shorter where there is little room, which is known later than they are
        write = CustomJS(args={"events": events}, code="events.change.emit()")
        plots[0].js_on_change("inner_width", write)
        below = style.make_figure(
            TIME,
            style.BALL_LOAD,
            time,
            packed.range("mass_load", 0.0, 100.0),
            height=250,
            name="mass_loads",
        )
        self._draw_loads(below, packed)
        self._mark(below, events)
        return pn.Column(*plots, below, sizing_mode="stretch_width", margin=0)

    def _mark(self, plot: figure, events: ColumnDataSource) -> None:
        plot.vspan("time", source=events, line_color=style.FAINT_INK, line_alpha=0.55, line_width=1)

    def _label_events(self, plot: figure, events: ColumnDataSource) -> None:
        plot.extra_y_ranges["shares"] = Range1d(0.0, 1.0, syncable=False)
        plot.text(
            "label_from", "label_at", y_range_name="shares",
            text=style.words_of(events, _EVENT_WORDS, plot=plot), source=events, x_offset=4,
            text_font={"value": style.FONT}, text_font_size=style.SMALL_TEXT_SIZE,
            text_color=style.INK, text_baseline="middle", background_fill_color="white",
            background_fill_alpha=0.85,
        )  # fmt: skip

    def _draw_loads(self, plot: figure, packed: PackedSource) -> None:
        colors = LinearColorMapper(palette=list(style.BALL_COLORS), low=-0.5, high=SLOTS - 0.5)
        free = packed.source("mass_flights", "from", "to", "slot")
        plot.vstrip("from", "to", source=free, fill_color={"field": "slot", "transform": colors},
                    fill_alpha=0.13, line_color=None)  # fmt: skip
        loads = packed.source(
            "mass_loads", "time", *(f"{race}{i}" for race in RACES_OF_LOADS for i in range(SLOTS))
        )
        for i, color in enumerate(style.BALL_COLORS):
            plot.line("time", f"inner{i}", source=loads, line_color=color, line_width=1.3,
                      line_dash=[5, 3])  # fmt: skip
            plot.line("time", f"outer{i}", source=loads, line_color=color, line_width=1.8)
        names = packed.source("mass_ball_names", "from", "at", "ball", "slot")
        plot.extra_x_ranges["shares"] = Range1d(0.0, 1.0, syncable=False)
        plot.extra_y_ranges["shares"] = Range1d(0.0, 1.0, syncable=False)
        plot.text(
            "from", "at", x_range_name="shares", y_range_name="shares",
            text=style.words_of(names, "return `ball ${row.ball}`"), source=names,
            text_baseline="middle", text_font={"value": style.FONT},
            text_font_size=style.SMALL_TEXT_SIZE,
            text_color={"field": "slot", "transform": colors},
        )  # fmt: skip

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
            words = why_ended(shown.broke_off)
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
    """What becomes of the ball that enters at 0, in words."""
    entry = shown.entry
    if entry is None:
        return "No ball enters a defect here"
    words = f"Ball {entry.ball + 1} enters the defect at 0"
    if not shown.strikes:
        where = ""
        if math.isfinite(shown.far_edge):
            where = f", meets the far edge {style.with_prefix(shown.far_edge, 's')} later"
        return f"{words}{where} and never lets go of its races: it does not fly"
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
