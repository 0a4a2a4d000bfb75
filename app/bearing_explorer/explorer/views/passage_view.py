"""Views of balls that pass the defect: acceleration above, loads of the balls below."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.plots.levels import SHOWN
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore import Bearing

Array = NDArray[np.float64]

SLOTS = len(style.BALL_COLORS)
PIXELS = 500  # stretches of a line that can be told apart on the screen
LABEL_WIDTH = 0.3  # of "ball 12 leaves", as a share of the width of a narrow figure
NAME_WIDTH, LONG_NAME_WIDTH = 0.17, 0.24  # of "ball 12" and "ball 12 of row 2", also shares
ROW_HEIGHT = 0.065  # of a row of names, as a share of the height of the figure
ROW_PIXELS = 17.0  # height of a row of names of events
EVENT_ROWS = 3

MOST_LOADED = "the two balls that carry most"
NAMED = ("element", "ball", "row", "roller")  # columns that name a ball
BALL = "${row.roller ? 'roller' : 'ball'} ${row.ball}${row.row ? ` of row ${row.row}` : ''}"
"""The name of a ball in a template of JavaScript."""


class PassageView(ComparingView):
    """A view of acceleration and of ball loads in time; subclasses provide the layers."""

    #: prefix of the names of sources and ranges
    prefix: ClassVar[str]
    #: words for the balls that are drawn ("{balls}" of `about`), and the title without a defect
    balls: ClassVar[str]
    healthy_title: ClassVar[str]

    @classmethod
    def caption(cls, content: Results | None = None) -> str:
        healthy = content is not None and not content.scene.defects
        return super().caption(content).replace("{balls}", MOST_LOADED if healthy else cls.balls)

    def title_of(self, content: Results) -> str:
        return self.title if content.scene.defects else self.healthy_title

    def upper_figures(self) -> Sequence[tuple[style.AxisQuantity, int, Sequence[layers.Layer]]]:
        """Quantity, height [px] and layers of the figures of acceleration."""
        raise NotImplementedError

    def lower_figure(self) -> tuple[int, Sequence[layers.Layer]]:
        """Height [px] and layers of the figure of loads."""
        raise NotImplementedError

    def build(self, packed: PackedSource) -> Any:
        self._acceleration = StickyRange(-5.0, 5.0, anchor="symmetric", least_span=2e-6)
        self._load = StickyRange(0.0, 100.0, anchor="zero", least_span=1e-3)
        time = packed.range(f"{self.prefix}_time", 0.0, 0.04)
        acceleration = packed.range(f"{self.prefix}_acceleration", -5.0, 5.0)
        load = packed.range(f"{self.prefix}_load", 0.0, 100.0)
        figures = [(*figure, acceleration) for figure in self.upper_figures()]
        figures.append((style.BALL_LOAD, *self.lower_figure(), load))
        sources = layers.sources_of(packed, [layer for figure in figures for layer in figure[2]])
        plots = []
        for number, (quantity, height, drawn, shown) in enumerate(figures):
            name = f"{self.prefix}_drawing_{number}"
            plot = style.make_figure(style.TIME, quantity, time, shown, height=height, name=name)
            layers.add_all(plot, sources, drawn)
            plots.append(plot)
        return plots

    def ranges(self, time: Array, signals: Array, loads: ArrayLike) -> Ranges:
        """Ranges of the axes, with room above the signals for the labels of the events."""
        room = 1.0 + 2.2 * ROW_HEIGHT * EVENT_ROWS
        greatest = np.nanmax(np.abs(signals), initial=0.0)
        return {
            f"{self.prefix}_time": (float(time[0]), float(time[-1])),
            f"{self.prefix}_acceleration": self._acceleration.fit(greatest * room),
            f"{self.prefix}_load": self._load.fit(1.2 * np.asarray(loads)),
        }

    def motions(
        self,
        results: Results,
        signals_of: Callable[[Results], tuple[Array, Mapping[str, Array]]],
        more: Mapping[str, Array] = MappingProxyType({}),
    ) -> tuple[Sources, Array]:
        """Sources of the acceleration along x and y, also of compared scenes, and all numbers.

        `signals_of` returns time and acceleration of results. `more` are further columns to draw.
        """

        def columns(drawn_results: Results) -> tuple[Array, dict[str, Array]]:
            time, acceleration = signals_of(drawn_results)
            return time, both_directions(time, acceleration)

        name = f"{self.prefix}_motion"
        compared = compared_curves.sources(
            name,
            ("time", *SHOWN),
            results.compared_results,
            lambda other: traces(*columns(other)),
        )
        time, acceleration = columns(results)
        drawn = acceleration | dict(more)
        numbers = [compared_curves.numbers(compared, dof) for dof in SHOWN]
        sources: Sources = {**compared, name: traces(time, drawn)}
        return sources, np.concatenate([*drawn.values(), *numbers])

    def names_of_balls(self) -> layers.Layer:
        """The names of the balls in their colours."""
        return layers.Words(
            f"{self.prefix}_ball_names",
            "from",
            "at",
            # numbers alone where large type has no room for more
            f"return narrow && row.row ? `${{row.ball}}, row ${{row.row}}` "
            f": narrow && larger > 1 ? row.ball : `{BALL}`",
            reads=(*NAMED, "slot"),
            x_share=True,
            y_share=True,
            fitting=style.NARROW,
            look={"text_color": layers.by_number("slot", style.BALL_COLORS)},
        )


def event_lines(prefix: str) -> layers.Layer:
    """Vertical lines at the events in the source of this prefix."""
    lines = layers.uprights(f"{prefix}_events", "time", style.FAINT_INK, 1.0, 0.55)
    return replace(lines, reads=("element",), lit=layers.LIT)


def event_names(prefix: str, code: str, reads: tuple[str, ...]) -> layers.Layer:
    """Names of the events, by JavaScript `code` that knows the width of the frame."""
    return layers.Words(
        f"{prefix}_events",
        "label_from",
        "label_at",
        code,
        reads=(*NAMED, *reads, "label_down"),
        y_share=True,
        fitting=style.NARROW,
        look={"x_offset": 4, "y_offset": style.text_offset("label_down"), **layers.ON_PAPER},
    )


def name_columns(bearing: Bearing, balls: NDArray[np.int64]) -> dict[str, np.ndarray]:
    """Columns that name balls, counted from 0 through all rows; row 0: there is only one row."""
    row, number = np.array([bearing.row_of_ball(ball) for ball in balls.tolist()]).reshape(-1, 2).T
    return {
        "element": balls + 1.0,
        "ball": number + 1.0,
        "row": row + 1.0 if bearing.rows else np.zeros(balls.size),
        "roller": np.full(balls.size, float(bearing.kind.line_contact)),
    }


def ball_names(balls: NDArray[np.int64], bearing: Bearing) -> dict[str, np.ndarray]:
    """Columns that name balls side by side, at shares of the figure's width and height."""
    slots = np.arange(float(balls.size))
    return {
        "from": 0.02 + (LONG_NAME_WIDTH if bearing.rows else NAME_WIDTH) * slots,
        "at": np.full(balls.size, 1.0 - 0.8 * ROW_HEIGHT),
        **name_columns(bearing, balls),
        "slot": slots,
    }


def both_directions(time: Array, acceleration: Mapping[str, Array]) -> dict[str, Array]:
    """Acceleration along x and y over time; NaN where the housing cannot move."""
    missing = np.full(time.size, np.nan)
    return {dof: acceleration.get(dof, missing) for dof in SHOWN}


def slot_columns(name: str, loads: Array) -> dict[str, Array]:
    """Loads of balls (n, balls) as one column for each drawn slot; NaN for an empty slot."""
    missing = np.full(len(loads), np.nan)
    filled = list(loads.T[:SLOTS])
    return {f"{name}{i}": filled[i] if i < len(filled) else missing for i in range(SLOTS)}


def traces(time: Array, columns: Mapping[str, Array]) -> dict[str, np.ndarray]:
    """Columns over time, reduced to the points that the pixels of a figure can show."""
    rows, drawn = layers.least_and_greatest(np.stack(list(columns.values()), axis=1), PIXELS)
    return {"time": time[rows], **dict(zip(columns, drawn.T, strict=True))}


def places_of_labels(
    times: Sequence[float], start: float, end: float, share: float = LABEL_WIDTH, apart: float = 1.0
) -> dict[str, np.ndarray]:
    """Places of labels right of their lines, each in the first row that has room for it.

    At the end of the stretch a label moves left as far as it needs. The first labels are placed
    first; a label without room in any row gets NaN. `share` is the width of a label over that of
    the figure, `apart` the distance of the rows over ROW_PIXELS.
    """
    width = share * (end - start)
    lefts = np.array([min(time, end - width) for time in times])
    rows: list[list[float]] = [[] for _ in range(EVENT_ROWS)]
    places, down = np.full(len(times), np.nan), np.zeros(len(times))
    for event, left in enumerate(lefts):
        free = (r for r in range(EVENT_ROWS) if all(abs(left - x) >= width for x in rows[r]))
        if (row := next(free, None)) is not None:
            rows[row].append(left)
            places[event], down[event] = 1.0, ROW_PIXELS * (apart * row + 0.8)
    return {"label_from": lefts, "label_at": places, "label_down": down}
