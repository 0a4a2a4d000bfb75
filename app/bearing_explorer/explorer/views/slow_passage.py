"""The simulated motion in slow motion, as balls cross the defect."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
from bokeh.models import Range1d
from bokeh.plotting import figure

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views import bearing, vibration_time
from bearing_explorer.explorer.views.passage_view import both_directions, traces
from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.element_words import element_name
from bearing_explorer.kit.plots.layers import draw, uprights
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.serve.panel_internals import LiveComponent
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import stack
from bearingcore.common import table_of
from bearingcore.model.scene import ball_angles


class SlowMotion(LiveComponent):
    """Buttons for play, speed and place, which move the figures in the browser alone."""

    _esm = scripts("element.js", "slow_motion.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text(f"{name}.css") for name in ("button", "controls", "slow_motion")
    ]


class SlowPassage(bearing.BearingDrawing):
    """The bearing with its balls at an instant of the motion, and this instant on a time axis.

    The positions of the whole stretch are sent once; the script `slow_motion.js` draws an instant.
    """

    name = "slow-passage"
    title = "A ball crosses the defect, slowly"
    about = (
        "Ball loads in motion, and the housing acceleration. Blue: x. Orange: y. Line: the instant "
        "drawn. Arrow keys step."
    )
    needs = frozenset({"excerpt"})
    prefix = "slow"
    grabbed = False
    at_rest = True

    def build(self, packed: PackedSource) -> Any:
        drawing = super().build(packed)
        self._acceleration = StickyRange(-5.0, 5.0, anchor="symmetric", least_span=2e-6)
        for name, columns in {
            "frames": ("time", "turned", "shaft"),
            "path": ("radius", "load"),
            "start": ("angle",),
            "base_rings": ("x", "y", "turns"),
            "base_defect": ("x", "y", "turns"),
            "scale": ("bar_start", "bar_length", "number_right", "number_up"),
        }.items():
            packed.source(f"slow_{name}", *columns)
        motion = style.make_figure(
            style.TIME,
            vibration_time.ACCELERATION,
            packed.range("slow_time", 0.0, 0.04),
            packed.range("slow_acceleration", -5.0, 5.0),
            height=200,
            name="slow_drawing",
        )
        cursor = uprights("slow_cursor", "now", style.DEFECT, 2.5, 1.0)
        draw(motion, packed, [*vibration_time.motion_layers("slow"), cursor])
        figures = stack(drawing, motion, stylesheets=[style.SIDE_BY_SIDE])
        return self.only_with_numbers(SlowMotion(), figures)

    def _figure(self, x: Range1d, y: Range1d) -> figure:
        return style.bare_figure(x, y, height=340)

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        shown, scene = results.excerpt, results.scene
        entry = next((event for event in shown.events if event.enters), None)
        row = scene.bearing.row_of_ball(entry.ball)[0] if entry else 0
        row_balls = scene.bearing.balls_of_rows[row]
        top_range = self._load_range.fit(shown.moving_load)
        # the first frame is the instant at which a ball enters
        frame = int(np.argmin(np.abs(shown.static_time)))
        cage = shown.static_cage_angle
        drawn = bearing.Shapes(scene, float(cage[frame]), row)
        load = shown.moving_load[:, row_balls]
        drop = {race: drops[:, row_balls] for race, drops in shown.drop.items()}
        first_drop = {race: drops[frame] for race, drops in drop.items()}
        shapes = drawn.all(load[frame], first_drop, top_range[1])
        shapes["spacings"] = dict.fromkeys(
            shapes["spacings"], np.zeros(0)
        )  # they would have to turn
        angles = ball_angles(scene.bearing, cage)[:, row_balls]
        frames = {
            "time": shown.static_time,
            "turned": angles[:, 0] - angles[frame, 0],
            "shaft": (cage - cage[frame]) / scene.bearing.cage_ratio,
        }
        signals = both_directions(shown.time, shown.acceleration)
        start, end = float(shown.time[0]), float(shown.time[-1])
        sources = {f"slow_{name}": columns for name, columns in shapes.items()} | {
            "slow_load_words": bearing.load_words(scene.load, drawn.depth_scale),
            "slow_frames": frames,
            "slow_path": {"radius": drawn.ball_radii(drop).ravel(), "load": load.ravel()},
            "slow_start": {"angle": angles[frame]},
            "slow_base_rings": _turning(shapes["rings"], [0.0, 0.0, 1.0, 1.0]),
            "slow_base_defect": _turning(
                shapes["defect"], [float(span.race == "inner") for span in drawn.spans]
            ),
            "slow_scale": {
                "bar_start": np.array([drawn.rim + bearing.BAR_START]),
                "bar_length": np.array([bearing.BAR_LENGTH / top_range[1]]),
                "number_right": np.array([bearing.NUMBER_RIGHT]),
                "number_up": np.array([bearing.NUMBER_UP]),
            },
            "slow_motion": traces(shown.time, signals),
            "slow_events": vibration_time.event_rows(shown.events, start, end, scene.bearing, 1.5),
            "slow_cursor": {"now": shown.static_time[[frame]]},
        }
        peak = 1.4 * np.nanmax(np.abs([*signals.values()]), initial=0.0)
        return sources, {
            "slow_load": top_range,
            "slow_width": (-bearing.HALF_WIDTH, bearing.HALF_WIDTH),
            "slow_time": (start, end),
            "slow_acceleration": self._acceleration.fit(peak),
        }

    def title_of(self, content: Results) -> str:
        return self.title if content.scene.defects else "The balls in slow motion"

    def sentence(self, results: Results) -> str:
        shown = results.excerpt
        if shown.broke_off:
            return f"{shown.broke_off[0].upper()}{shown.broke_off[1:]}."
        loads = np.nan_to_num(shown.moving_load)
        frame, ball = np.unravel_index(np.argmax(loads), loads.shape)
        length = float(shown.time[-1] - shown.time[0])
        name = element_name(results.scene.bearing, int(ball))
        return (
            f"In these {style.with_prefix(length, 's')} {name} "
            f"carries most: {style.with_prefix(loads[frame, ball], 'N')} at "
            f"{style.with_prefix(float(shown.static_time[frame]), 's')}."
        )

    def table(self, results: Results) -> dict[str, np.ndarray]:
        shown = results.excerpt
        loads = [(f"ball_{k + 1}_load", "N", load) for k, load in enumerate(shown.moving_load.T)]
        time = ("time", "s", shown.static_time)
        cage = ("cage_angle", "rad", shown.static_cage_angle)
        return table_of(time, cage, *loads).in_units().named()


def _turning(shape: dict[str, np.ndarray], turns: list[float]) -> dict[str, np.ndarray]:
    """Add to a shape of polygons a column of `turns`: 1 for those that turn with the shaft."""
    part = np.cumsum(np.isnan(shape["x"]))
    return {**shape, "turns": np.array([*turns, 0.0])[part]}
