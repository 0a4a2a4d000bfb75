"""Load distribution: load of a ball against angular position (Fig. 3)."""

from __future__ import annotations

from functools import reduce
from operator import or_
from typing import Any

import numpy as np
from bokeh.models import HoverTool, Range1d

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.plots.frequency_bands import spread
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.defect_shape import pieces, spans
from bearing_explorer.explorer.results.load_curve import Curve, curves_table, load_curve, row_name
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.plots.ranges import ROOM, StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore import Equilibrium, Scene
from bearingcore.common import ResultTable, table_of
from bearingcore.model.statics import EquilibriumWithMass

OTHER_ROWS = style.DIRECTION_COLORS[1]
"""Colour of the rows after the first."""


CURVES = (
    layers.curve("load_distribution_other_rows", "angle", "load", OTHER_ROWS),
    layers.curve("load_distribution_curve", "angle", "load", style.DEFECTIVE),
)
LAYERS: tuple[layers.Layer, ...] = (
    layers.strips("load_distribution_defect", style.DEFECT, 0.16, low="start", high="end"),
    layers.curve("load_distribution_healthy", "angle", "load", style.HEALTHY),
    layers.curve("load_distribution_other_healthy", "angle", "load", style.HEALTHY, dash=(6, 4)),
    *compared_curves.curves("load_distribution", "angle", "load"),
    layers.curve("load_distribution_inner", "angle", "load", style.DEFECTIVE, 1.4, (5, 3)),
    *CURVES,
    layers.ball_dots("load_distribution_balls", "angle", "load"),
    layers.Words(
        "load_distribution_rows",
        "angle",
        "load",
        "return `row ${row.row}`",
        reads=("row",),
        look={"y_offset": -5, "text_align": "center", "text_baseline": "bottom"},
    ),
)
"""Layers from the lowest to the highest."""


class LoadDistribution(ComparingView):
    """Load of a ball over its angle, with the balls at this cage angle on the curve."""

    name = "load-distribution"
    title = "Load distribution"
    about = (
        "Ball load against angular position. Blue: this scene. Grey: {grey}. Shaded: the "
        "defect. Dots: balls now. For an inner-race defect, the curve is the greatest load in "
        "all turns of the shaft. A second row is orange, its reference dashed. For balls with "
        "mass, the full line is the load at the outer race, which also carries their centrifugal "
        "force, and the dashed line that at the inner race."
    )
    needs = frozenset({"equilibrium", "now", "ranges"})

    def build(self, packed: PackedSource) -> Any:
        self._range = StickyRange(0.0, 100.0, anchor="zero", least_span=1e-3, room=ROOM)
        plot = style.make_figure(
            style.BALL_ANGLE,
            style.BALL_LOAD,
            Range1d(0.0, 360.0, syncable=False),
            packed.range("load_distribution_load", 0.0, 100.0),
            height=280,
        )
        style.fixed_ticks(plot.xaxis[0], range(0, 361, 45))
        plot.xgrid.ticker = plot.xaxis[0].ticker
        drawn = layers.draw(plot, packed, LAYERS)
        curves = [glyph for layer, glyph in zip(LAYERS, drawn, strict=True) if layer in CURVES]
        plot.add_tools(
            HoverTool(
                renderers=curves,
                visible=False,  # it is always on, so the toolbar has no button for it
                mode="vline",
                line_policy="nearest",
                tooltips=[("Position", "@angle{0.0}°"), ("Load", "@load{0,0.0} N")],
            )
        )
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        (angle, load), *others = results.load_curves
        (healthy_angle, healthy_load), *healthy_others = results.reference.load_curves
        now = results.now
        compared = compared_curves.sources(
            "load_distribution",
            ("angle", "load"),
            results.compared_results,
            lambda other: _one_line(other.load_curves),
        )
        sources = {
            **compared,
            "load_distribution_other_rows": _one_line(others),
            "load_distribution_other_healthy": _one_line(healthy_others),
            "load_distribution_inner": _one_line(results.inner_load_curves),
            "load_distribution_rows": _names(results.load_curves),
            "load_distribution_defect": defect_strips(results.scene, results.cage_angle),
            "load_distribution_curve": {"angle": np.degrees(angle), "load": load},
            "load_distribution_healthy": {"angle": np.degrees(healthy_angle), "load": healthy_load},
            "load_distribution_balls": {
                "angle": np.degrees(now.ball_angle[0]) % 360.0,
                "load": now.ball_load[0],
                "element": np.arange(1.0, now.ball_load[0].size + 1.0),
            },
        }
        room = 1.0 if len(results.load_curves) == 1 else 1.08  # for the names of the rows
        curves = (*results.load_curves, *results.reference.load_curves)
        loads = [room * load for _, load in curves]
        loads.append(compared_curves.numbers(compared, "load"))
        return sources, {"load_distribution_load": self._range.fit(*loads)}

    def sentence(self, results: Results) -> str:
        bearing = results.scene.bearing
        if not results.equilibrium.converged.any():
            return f"There is no load distribution: {results.equilibrium.reason(0)}."
        parts: list[str] = []
        curves = zip(results.load_curves, results.reference.load_curves, strict=False)
        for row, ((angle, load), (_, healthy)) in enumerate(curves):
            most = int(np.nanargmax(load))
            which = f" of row {row + 1}" if bearing.rows else ""
            part = (
                f"{'the' if parts else 'The'} greatest load of a {bearing.kind.element}{which} is "
                f"{style.with_prefix(load[most], 'N')}, at {style.in_degrees(angle[most])}"
            )
            if results.grey.label and np.isfinite(healthy).any():
                healthy_most = style.with_prefix(np.nanmax(healthy), "N")
                part += f" ({results.grey.label} {healthy_most})"
            parts.append(part)
        words = "; ".join(parts)
        if results.over_shaft:
            words += " (the most at each angle in all turns of the shaft)"
        why = reasons.greatest_load(results)
        words += f". {why[:-1]}" if why else ""
        now = results.now
        if isinstance(now, EquilibriumWithMass) and now.converged[0] and results.inner_load_curves:
            words += f". {_both_races(now)}"
        return words + "."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        tables = [curves_table(results.load_curves)]
        if results.inner_load_curves:
            rows = range(len(results.load_curves))
            tables += [_both_races_table(results.ranges.state, row) for row in rows]
        tables.append(curves_table(results.reference.load_curves).prefixed("healthy"))
        return reduce(or_, tables).in_units().named()


def _both_races(now: EquilibriumWithMass) -> str:
    """Loads and contact angles of the most loaded ball at both races, in words."""
    most = int(np.argmax(now.ball_load[0]))
    inner, outer = now.inner_load[0, most], now.ball_load[0, most]
    angles = [now.inner_contact_angle[0, most], now.contact_angle[0, most]]
    words = (
        f"Centrifugal load is {style.with_prefix(now.positions.centrifugal_load, 'N')} for each: "
        f"the most loaded one carries {style.with_prefix(inner, 'N', 4)} at the inner race and "
        f"{style.with_prefix(outer, 'N', 4)} at the outer"
    )
    if np.abs(angles).max() > 1e-3:
        words += f", at contact angles of {style.in_degrees(angles[0])} and "
        words += style.in_degrees(angles[1])
    return words


def _both_races_table(state: Equilibrium, row: int) -> ResultTable:
    """Loads and contact angles of a row's balls with mass, along its curve."""
    assert isinstance(state, EquilibriumWithMass)
    prefix = row_name(row)
    columns = (
        ("inner_race_load", "N", state.inner_load),
        ("inner_contact_angle", "rad", state.inner_contact_angle),
        ("outer_contact_angle", "rad", state.contact_angle),
    )
    return table_of(
        *(
            (f"{prefix}{name}", unit, load_curve(state, row, values)[1][1:-1])
            for name, unit, values in columns
        )
    )


def _one_line(curves: list[Curve]) -> dict[str, np.ndarray]:
    """Join curves to one line with gaps, angles in degrees."""
    return layers.with_gaps(((np.degrees(angle), load) for angle, load in curves), "angle", "load")


NAMES_APART = 40.0
"""Least distance [degrees] of the names of rows whose greatest loads are close together."""


def _names(curves: list[Curve]) -> dict[str, np.ndarray]:
    """Places of the names of rows, at the tops of their curves; empty for a single row."""
    rows = [
        (float(np.degrees(angle[np.nanargmax(load)])), float(np.nanmax(load)), row + 1.0)
        for row, (angle, load) in enumerate(curves)
        if len(curves) > 1 and np.isfinite(load).any()
    ]
    angle, load, row = np.array(rows, dtype=float).reshape(-1, 3).T
    return {"angle": spread(angle % 360.0, NAMES_APART, 0.0, 360.0), "load": load, "row": row}


def defect_strips(scene: Scene, cage_angle: float) -> dict[str, np.ndarray]:
    """The defects as intervals of ball angle [deg]; a defect across 0° gives two."""
    all_pieces = [piece for span in spans(scene, cage_angle) for piece in pieces(span)]
    start, end = np.degrees(np.array(all_pieces).reshape(-1, 2)).T
    return {"start": start, "end": end}
