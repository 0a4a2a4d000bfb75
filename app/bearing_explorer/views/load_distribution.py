"""Load distribution: what a ball carries at each angular position (Fig. 3)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from bokeh.models import HoverTool, Range1d

from bearing_explorer.compute.defect_shape import pieces, spans
from bearing_explorer.figures import style
from bearing_explorer.figures.ranges import StickyRange
from bearing_explorer.server.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources, View

if TYPE_CHECKING:
    from bearing_explorer.compute.results import Results
    from bearingcore import Scene


class LoadDistribution(View):
    """Load of a ball over its angle, the balls of this cage angle on the curve."""

    name = "load-distribution"
    title = "Load distribution"
    about = (
        "What a ball carries at each angle: blue with the defect, grey without. Shaded: the "
        "defect. Dots: balls now. With a defect of the inner race the curve is the most in a turn"
        " of the shaft."
    )
    needs = frozenset({"equilibrium", "healthy_equilibrium", "now"})
    plans = ("load",)

    def build(self, packed: PackedSource) -> Any:
        self._range = StickyRange(0.0, 100.0, anchor="zero", least_span=1e-3)
        plot = style.house_figure(
            style.BALL_ANGLE,
            style.BALL_LOAD,
            Range1d(0.0, 360.0, syncable=False),
            packed.range("load_distribution_load", 0.0, 100.0),
            height=280,
        )
        style.fixed_ticks(plot.xaxis[0], range(0, 361, 30))
        plot.xgrid.ticker = plot.xaxis[0].ticker
        plot.vstrip(
            "start",
            "end",
            source=packed.source("load_distribution_defect", "start", "end"),
            fill_color=style.DEFECT,
            fill_alpha=0.16,
            line_color=None,
        )
        plot.line(
            "angle",
            "load",
            source=packed.source("load_distribution_healthy", "angle", "load"),
            line_color=style.HEALTHY,
            line_width=2.0,
        )
        curve = plot.line(
            "angle",
            "load",
            source=packed.source("load_distribution_curve", "angle", "load"),
            line_color=style.DEFECTIVE,
            line_width=2.0,
        )
        plot.scatter(
            "angle",
            "load",
            source=packed.source("load_distribution_balls", "angle", "load"),
            size=8,
            fill_color="white",
            line_color=style.INK,
            line_width=1.6,
            level="annotation",  # whole, also on the edge of the frame
        )
        plot.add_tools(
            HoverTool(
                renderers=[curve],
                visible=False,  # no button: it is always on
                mode="vline",
                line_policy="nearest",
                tooltips=[("Ball at", "@angle{0.0}°"), ("carries", "@load{0,0.0} N")],
            )
        )
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        angle, load = results.load_curve
        healthy_angle, healthy_load = results.healthy_load_curve
        now = results.now
        sources = {
            "load_distribution_defect": shaded(results.scene, results.cage_angle),
            "load_distribution_curve": {"angle": np.degrees(angle), "load": load},
            "load_distribution_healthy": {"angle": np.degrees(healthy_angle), "load": healthy_load},
            "load_distribution_balls": {
                "angle": np.degrees(now.ball_angle[0]) % 360.0,
                "load": now.ball_load[0],
            },
        }
        return sources, {"load_distribution_load": self._range.fit(load, healthy_load)}

    def sentence(self, results: Results) -> str:
        angle, load = results.load_curve
        if not results.equilibrium.converged.any():
            return f"There is no load distribution: {results.equilibrium.reason(0)}."
        most = int(np.nanargmax(load))
        words = (
            f"A ball carries most, {style.with_prefix(load[most], 'N')}, at "
            f"{style.in_degrees(angle[most])}"
        )
        _, healthy = results.healthy_load_curve
        if results.beside_words and np.isfinite(healthy).any():
            words += f"; {results.beside_words} {style.with_prefix(np.nanmax(healthy), 'N')}"
        if results.over_shaft:
            words += " (the most at each angle while the shaft makes this turn)"
        now = results.now
        if now.converged[0]:
            count = int(now.loaded_balls[0])
            words += (
                f". At this cage angle {count} of {results.scene.bearing.n_balls} balls "
                f"{'carries' if count == 1 else 'carry'} load"
            )
        return words + "."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        angle, load = results.load_curve
        healthy_angle, healthy_load = results.healthy_load_curve
        return {
            "ball_angle_deg": np.degrees(angle[1:-1]),
            "ball_load_n": load[1:-1],
            f"{results.beside_name}_ball_angle_deg": np.degrees(healthy_angle[1:-1]),
            f"{results.beside_name}_ball_load_n": healthy_load[1:-1],
        }


def shaded(scene: Scene, cage_angle: float) -> dict[str, np.ndarray]:
    """The defects as intervals of ball angle [deg]: two where one lies across 0°."""
    found = [piece for span in spans(scene, cage_angle) for piece in pieces(span)]
    start, end = np.degrees(np.array(found).reshape(-1, 2)).T
    return {"start": start, "end": end}
