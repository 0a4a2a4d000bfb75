"""Depth profile of the defect: the race itself and the path of a ball's centre (Figs. 2, 8f)."""

from __future__ import annotations

from typing import Any

import numpy as np

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results.defect_shape import Profile
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.element_words import extent_words, row_words
from bearing_explorer.kit.plots.layers import ball_dots, curve, draw
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources

DEPTH = style.AxisQuantity("Depth", "d", "m", prefixed=True)
BRIDGED_LENGTH = 10e-6
"""Length [m] of a defect that a contact bridges: contacts are some tenths of a millimetre long."""
EDGE_WORDS = {
    "published": "an edge as in the paper",
    "chord": "a chord over the whole arc",
    "exact": "the exact, curved edge",
}


LAYERS = (
    *compared_curves.curves("depth_profile", "angle", "drop"),
    curve("depth_profile_path", "angle", "drop", style.DEFECTIVE, dash=(6, 4)),
    ball_dots("depth_profile_balls", "angle", "drop"),
)
"""Layers of the profile over the race."""


class DepthProfile(ComparingView):
    """The race around the defect, and the path of a ball's centre over it."""

    name = "depth-profile"
    title = "Depth profile"
    about = (
        "Solid: race surface. Dashed: path of the ball centre. Down is into the ring. Dots: balls "
        "at this cage angle."
    )
    needs = frozenset({"profile", "drop", "now"})

    def build(self, packed: PackedSource) -> Any:
        self._range = StickyRange(0.0, 60e-6, anchor="zero", least_span=1e-6)
        plot = style.make_figure(
            style.BALL_ANGLE,
            DEPTH,
            packed.range("depth_profile_angle", 240.0, 300.0),
            packed.range("depth_profile_depth", 60e-6, -4e-6),
            height=215,
        )
        surface = packed.source("depth_profile_surface", "angle", "depth", "bottom")
        plot.varea(
            "angle", "depth", "bottom", source=surface, fill_color=style.STEEL, fill_alpha=1.0
        )
        curve("", "angle", "depth", style.FAINT_INK, 1.6).add(plot, surface)
        draw(plot, packed, LAYERS)
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        profile = results.profile
        angle = np.degrees(profile.angle)
        compared = compared_curves.sources(
            "depth_profile",
            ("angle", "drop"),
            results.compared_results,
            lambda other: _path(other.profile),
        )
        highest = float(min(profile.depth.min(), profile.path.min()))
        deepest = self._range.fit(
            1.15 * profile.depth, 1.15 * compared_curves.numbers(compared, "drop")
        )[1]
        start, end = float(angle[0]), float(angle[-1])
        row_balls = results.scene.bearing.balls_of_rows[profile.row]
        balls = np.degrees(results.now.ball_angle[0, row_balls])
        # the axis may run past 360°: draw a ball in the turn that is in view
        balls = start + (balls - start) % 360.0
        balls[balls > end] = np.nan
        sources = {
            **compared,
            "depth_profile_surface": {
                "angle": angle,
                "depth": profile.depth,
                "bottom": np.full(angle.size, deepest),
            },
            "depth_profile_path": _path(profile),
            "depth_profile_balls": {
                "angle": balls,
                "drop": results.drop[profile.race][row_balls],
                "element": np.arange(row_balls.start, row_balls.stop) + 1.0,
            },
        }
        return sources, {
            "depth_profile_angle": (start, end),
            # depth grows downwards; a rim stands above the race
            "depth_profile_depth": (deepest, min(-0.07 * deepest, 1.15 * highest)),
        }

    def sentence(self, results: Results) -> str:
        scene, profile = results.scene, results.profile
        if not scene.defects:
            return "The race has no defect: the profile is flat."
        defect = scene.defects[results.focus]
        turning = (
            "; it turns with the shaft, and is shown where it is now"
            if defect.race == "inner"
            else ""
        )
        turning = row_words(scene.bearing, defect.row) + turning
        ball = scene.bearing.kind.element
        length = extent_words(defect, scene.bearing)
        deepest = float(np.max(profile.path))
        if defect.floor is not None:
            height = -float(np.min(profile.depth))
            deep = style.with_prefix(float(np.max(profile.depth)), "m")
            raised = f" and {style.with_prefix(height, 'm')} high" if height > 0.0 else ""
            return (
                f"The {defect.race}-race defect is {length} "
                f"long and up to {deep} deep{raised}; "
                f"a {ball}'s centre sinks by at most {style.with_prefix(deepest, 'm')}{turning}."
            )
        floor = style.with_prefix(defect.depth, "m")
        reaches = (
            f"a {ball} reaches its floor of {floor}"
            if deepest >= defect.depth * (1.0 - 1e-9)
            else f"a {ball} sinks {style.with_prefix(deepest, 'm')} and does not reach the floor "
            f"of {floor}"
        )
        text = (
            f"The {defect.race}-race defect is {length} long; "
            f"with {EDGE_WORDS[defect.edge]} {reaches}{turning}."
        )
        if 0.0 < defect.extent * defect.raceway_radius(scene.bearing) < BRIDGED_LENGTH:
            text += " A contact under a usual load is longer and bridges it; here it has no length."
        return text

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.profile.table().in_units().named()


def _path(profile: Profile) -> dict[str, np.ndarray]:
    """The path of a ball's centre as columns."""
    return {"angle": np.degrees(profile.angle), "drop": profile.path}
