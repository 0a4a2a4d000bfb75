"""Housing acceleration and contact forces while balls pass the defect (Fig. 9)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn
from numpy.typing import NDArray

from bearing_explorer.plots import style
from bearing_explorer.plots.element_words import element_name
from bearing_explorer.plots.layers import (
    ON_PAPER,
    Layer,
    Words,
    add_all,
    by_number,
    curve,
    sources_of,
    uprights,
)
from bearing_explorer.plots.ranges import StickyRange
from bearing_explorer.results.excerpt import Event, Excerpt, least_and_greatest
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources, View

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results
    from bearingcore import Bearing

TIME = style.AxisQuantity("Time", "t", "s", prefixed=True)
ACCELERATION = style.AxisQuantity("Housing acceleration", "a", "m/s²", prefixed=True)

NAMED = ("ball", "row", "roller")  # columns that name a ball
PIXELS = 500  # stretches of a line that are kept apart
SHOWN = ("x", "y")
SLOTS = len(style.BALL_COLORS)
LABEL_WIDTH = 0.3  # of the width of the figure: "ball 12 leaves" on a narrow one
NAME_WIDTH = 0.17
ROW_HEIGHT = 0.065  # of its height
EVENT_ROWS = 3
NARROW = 270  # [px] of the frame: with larger type there is room for less

_BALL = "${row.roller ? 'roller' : 'ball'} ${row.ball}${row.row ? ` of row ${row.row}` : ''}"
_EVENT_WORDS = f"""
const does = row.enters ? 'enters' : 'leaves'
return narrow ? `${{row.ball}} ${{does}}` : `{_BALL} ${{does}}`
"""


EVENTS = uprights("vibration_events", "time", style.FAINT_INK, 1.0, 0.55)


def layers_above() -> list[Layer]:
    """Acceleration, with the names of the events."""
    colors = dict(zip(style.DIRECTIONS, style.DIRECTION_COLORS, strict=True))
    return [
        EVENTS,
        *(curve("vibration_motion", "time", dof, colors[dof], 1.4) for dof in reversed(SHOWN)),
        Words(
            "vibration_events",
            "label_from",
            "label_at",
            _EVENT_WORDS,
            reads=(*NAMED, "enters"),
            y_share=True,
            fitting=NARROW,
            look={"x_offset": 4, **ON_PAPER},
        ),
    ]


def layers_below() -> list[Layer]:
    """Loads of the balls, moving and at rest, with their names."""
    return [
        EVENTS,
        curve("vibration_static_loads", "time", "load", style.INK, 1.0),
        *(
            curve("vibration_loads", "time", f"load{i}", color, alpha=0.9)
            for i, color in enumerate(style.BALL_COLORS)
        ),
        Words(
            "vibration_ball_names",
            "from",
            "at",
            f"return `{_BALL}`",
            reads=(*NAMED, "slot"),
            x_share=True,
            y_share=True,
            look={"text_color": by_number("slot", style.BALL_COLORS)},
        ),
    ]


class VibrationInTime(View):
    """Acceleration of the housing, and the loads of the balls meanwhile."""

    name = "vibration-time"
    title = "Vibration as balls pass the defect"
    about = (
        "Above: acceleration of the housing, blue x, orange y. Below: load of the balls that enter "
        "or leave the defect; thin: their static loads."
    )
    needs = frozenset({"excerpt"})

    def build(self, packed: PackedSource) -> Any:
        self._acceleration = StickyRange(-5.0, 5.0, anchor="symmetric", least_span=2e-6)
        self._load = StickyRange(0.0, 100.0, anchor="zero", least_span=1e-3)
        time = packed.range("vibration_time", 0.0, 0.04)
        above = style.make_figure(
            TIME,
            ACCELERATION,
            time,
            packed.range("vibration_acceleration", -5.0, 5.0),
            height=270,
        )
        below = style.make_figure(
            TIME,
            style.BALL_LOAD,
            time,
            packed.range("vibration_load", 0.0, 100.0),
            height=230,
        )
        over, under = layers_above(), layers_below()
        sources = sources_of(packed, [*over, *under])
        add_all(above, sources, over)
        add_all(below, sources, under)
        return pn.Column(above, below, sizing_mode="stretch_width", margin=0)

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        shown = results.excerpt
        missing = np.full(shown.time.size, np.nan)
        signals = np.stack([shown.acceleration.get(dof, missing) for dof in SHOWN], axis=1)
        rows, signals_drawn = least_and_greatest(signals, PIXELS)
        loads = np.full((shown.time.size, SLOTS), np.nan)
        loads[:, : shown.balls.size] = shown.ball_load[:, :SLOTS]
        load_rows, loads_drawn = least_and_greatest(loads, PIXELS)
        start, end = float(shown.time[0]), float(shown.time[-1])
        sources: Sources = {
            "vibration_motion": {
                "time": shown.time[rows],
                **{dof: signals_drawn[:, i] for i, dof in enumerate(SHOWN)},
            },
            "vibration_loads": {
                "time": shown.time[load_rows],
                **{f"load{i}": loads_drawn[:, i] for i in range(SLOTS)},
            },
            "vibration_static_loads": static_lines(shown),
            "vibration_events": event_rows(shown.events, start, end, results.scene.bearing),
            "vibration_ball_names": ball_names(shown, results.scene.bearing),
        }
        # room above the signal for the labels of the events
        room = 1.0 + 2.2 * ROW_HEIGHT * EVENT_ROWS
        greatest = np.nanmax(np.abs(signals), initial=0.0)
        ranges = {
            "vibration_time": (start, end),
            "vibration_acceleration": self._acceleration.fit(greatest * room),
            "vibration_load": self._load.fit(
                1.2 * np.append(shown.ball_load.ravel(), shown.greatest_static_load)
            ),
        }
        return sources, ranges

    def sentence(self, results: Results) -> str:
        shown = results.excerpt
        if shown.broke_off:
            words = shown.broke_off
            return f"{words[0].upper()}{words[1:]}."
        peaks = [
            f"{style.number(float(np.max(np.abs(shown.acceleration[dof]))), 2)} m/s² along {dof}"
            for dof in SHOWN
            if dof in shown.acceleration
        ]
        text = (
            "The housing's acceleration peaks at " + style.list_words(peaks)
            if peaks
            else "The housing cannot move along x or y in this scene"
        )
        bearing = results.scene.bearing
        entry = next((event for event in shown.events if event.enters), None)
        leaving = next(
            (e for e in shown.events if entry and not e.enters and e.time >= entry.time), None
        )
        if entry and leaving:
            text += (
                f"; {element_name(bearing, entry.ball)} enters the defect and "
                f"{style.with_prefix(leaving.time - entry.time, 's', 4)} later "
                + ("it" if leaving.ball == entry.ball else element_name(bearing, leaving.ball))
                + " leaves it"
            )
        return text + "."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.excerpt.table().named()


def static_lines(shown: Excerpt) -> dict[str, np.ndarray]:
    """The static loads of all balls as one line with gaps."""
    n = min(shown.balls.size, SLOTS)
    loads = shown.static_load[:, :n]
    return {
        "time": np.tile(np.append(shown.static_time, np.nan), n),
        "load": np.append(loads, np.full((1, n), np.nan), axis=0).T.ravel(),
    }


def named(bearing: Bearing, balls: NDArray[np.int64]) -> dict[str, np.ndarray]:
    """Columns that name balls, counted from 0 row after row; row 0 is the only one."""
    row, number = np.array([bearing.row_of_ball(ball) for ball in balls.tolist()]).reshape(-1, 2).T
    return {
        "ball": number + 1.0,
        "row": row + 1.0 if bearing.rows else np.zeros(balls.size),
        "roller": np.full(balls.size, float(bearing.kind.line_contact)),
    }


def ball_names(shown: Excerpt, bearing: Bearing) -> dict[str, np.ndarray]:
    """The names of the balls in a row, shares of the figure's width and height."""
    balls = shown.balls[:SLOTS]
    slots = np.arange(float(balls.size))
    return {
        "from": 0.02 + NAME_WIDTH * slots,
        "at": np.full(balls.size, 1.0 - 0.8 * ROW_HEIGHT),
        **named(bearing, balls),
        "slot": slots,
    }


def event_rows(
    events: tuple[Event, ...], start: float, end: float, bearing: Bearing
) -> dict[str, np.ndarray]:
    """Events as columns; a label stands right of its line, in the first row where it has room.

    At the end of the stretch it moves left as far as it needs. An event whose label has room in no
    row keeps its line and loses its label.
    """
    width = LABEL_WIDTH * (end - start)
    free_from = [start] * EVENT_ROWS
    lefts = [min(event.time, end - width) for event in events]
    places: list[float] = []
    for left in lefts:
        row = next((r for r in range(EVENT_ROWS) if left >= free_from[r]), None)
        if row is None:
            places.append(np.nan)
            continue
        free_from[row] = left + width
        places.append(1.0 - ROW_HEIGHT * (row + 0.7))
    return {
        "time": np.array([event.time for event in events]),
        **named(bearing, np.array([event.ball for event in events], dtype=np.int64)),
        "enters": np.array([float(event.enters) for event in events]),
        "label_from": np.array(lefts),
        "label_at": np.array(places),
    }
