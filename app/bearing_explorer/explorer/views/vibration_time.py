"""Housing acceleration and contact forces while balls pass the defect (Fig. 9)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.excerpt import Event
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views import passage_view
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.plots.element_words import element_name, with_elements_of
from bearing_explorer.kit.plots.levels import SHOWN
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore import Bearing

ACCELERATION = style.AxisQuantity("Acceleration", "a", "m/s²", prefixed=True)
EVENT_WORDS = f"""
const does = row.enters ? 'enters' : 'leaves'
const words = `{passage_view.BALL} ${{does}}`
let room = Infinity
try {{ room = {passage_view.LABEL_WIDTH}*plot.inner_width }} catch {{}}
return words.length*5.8*larger < room ? words : `${{row.ball}} ${{does}}`
"""


class VibrationInTime(passage_view.PassageView):
    """Acceleration of the housing, and the loads of the balls meanwhile."""

    name = "vibration-time"
    title = "Vibration as balls pass the defect"
    about = (
        "Above: acceleration of the housing, blue x, orange y. Below: load of {balls}; thin: their "
        "static loads."
    )
    balls = "the balls that enter or leave the defect"
    healthy_title = "Vibration in time"
    needs = frozenset({"excerpt"})
    prefix = "vibration"

    def build(self, packed: PackedSource) -> Any:
        upper, lower = super().build(packed)
        upper.tags = [compared_curves.THIN]
        return [upper, lower]

    def upper_figures(self) -> Sequence[tuple[style.AxisQuantity, int, Sequence[layers.Layer]]]:
        compared = compared_curves.curves(
            "vibration_motion", "time", *SHOWN[::-1], width=1.4, thin="x"
        )
        return [(ACCELERATION, 270, [*compared, *motion_layers("vibration")])]

    def lower_figure(self) -> tuple[int, Sequence[layers.Layer]]:
        lines = [
            layers.curve("vibration_loads", "time", f"load{i}", color, alpha=0.9)
            for i, color in enumerate(style.BALL_COLORS)
        ]
        static = layers.curve("vibration_static_loads", "time", "load", style.INK, 1.0)
        return 230, [passage_view.event_lines("vibration"), static, *lines, self.names_of_balls()]

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        shown, bearing = results.excerpt, results.scene.bearing
        moved, numbers = self.motions(
            results, lambda one: (one.excerpt.time, one.excerpt.acceleration)
        )
        start, end = float(shown.time[0]), float(shown.time[-1])
        static = ((shown.static_time, load) for load in shown.static_load.T[: passage_view.SLOTS])
        sources: Sources = {
            **moved,
            "vibration_loads": passage_view.traces(
                shown.time, passage_view.slot_columns("load", shown.ball_load)
            ),
            "vibration_static_loads": layers.with_gaps(static, "time", "load"),
            "vibration_events": event_rows(shown.events, start, end, bearing),
            "vibration_ball_names": passage_view.ball_names(
                shown.balls[: passage_view.SLOTS], bearing
            ),
        }
        carried = np.append(shown.ball_load.ravel(), shown.greatest_static_load)
        return sources, self.ranges(shown.time, numbers, carried)

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
        below = style.with_prefix(shown.bandwidth, "Hz", 2)
        text = (
            f"The housing's acceleration below {below} peaks at " + style.list_words(peaks)
            if peaks
            else "The housing cannot move along x or y in this scene"
        )
        bearing = results.scene.bearing
        entry = next((event for event in shown.events if event.enters), None)
        leaving = next(
            (e for e in shown.events if entry and not e.enters and e.time >= entry.time), None
        )
        if entry and leaving:
            name = element_name(bearing, entry.ball)
            other = "it" if leaving.ball == entry.ball else element_name(bearing, leaving.ball)
            later = style.with_prefix(leaving.time - entry.time, "s", 4)
            text += f". {name[0].upper()}{name[1:]} enters the defect, and {later} later {other} "
            text += "leaves it"
        why = with_elements_of(bearing, reasons.jolt(shown, bearing))
        return f"{why} {text}.".lstrip()

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.excerpt.table().named()


def motion_layers(prefix: str) -> list[layers.Layer]:
    """Acceleration along x and y, with the events, of the sources of that prefix."""
    return [
        passage_view.event_lines(prefix),
        *(
            layers.curve(f"{prefix}_motion", "time", dof, style.color_along(dof), 1.4)
            for dof in reversed(SHOWN)
        ),
        passage_view.event_names(prefix, EVENT_WORDS, ("enters",)),
    ]


def event_rows(
    events: tuple[Event, ...], start: float, end: float, bearing: Bearing, apart: float = 1.0
) -> dict[str, np.ndarray]:
    """Events as columns, with the places of their labels, whose rows are `apart`."""
    times = [event.time for event in events]
    return {
        "time": np.array(times),
        **passage_view.named(bearing, np.array([event.ball for event in events], dtype=np.int64)),
        "enters": np.array([float(event.enters) for event in events]),
        **passage_view.places_of_labels(times, start, end, apart=apart),
    }
